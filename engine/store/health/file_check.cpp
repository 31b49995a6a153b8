#include "store/health/file_check.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>

#include "core/error.h"
#include "core/project_name.h"
#include "store/database/database_error.h"
#include "store/health/raw_file.h"

namespace eyrie {
namespace {

constexpr std::size_t kHeaderBytes = 100;

struct Beginning {
    std::array<unsigned char, kHeaderBytes> bytes{};
    std::uint64_t file_size = 0;

    bool isDatabase() const {
        return file_size >= sizeof kSqliteMagic && std::memcmp(bytes.data(), kSqliteMagic, sizeof kSqliteMagic) == 0;
    }
};

/// Nothing when the file cannot be read.
std::optional<Beginning> readBeginning(const std::filesystem::path& path) {
    const auto file = RawFile::open(path);
    Beginning beginning;
    if (!file || !file->read(0, beginning.bytes)) return std::nullopt;
    beginning.file_size = file->size();
    return beginning;
}

std::uint32_t bigEndian(const unsigned char* at, int bytes) {
    std::uint32_t value = 0;
    for (int i = 0; i < bytes; ++i) value = value << 8 | at[i];
    return value;
}

}  // namespace

bool hasLog(const std::filesystem::path& project) {
    std::error_code missing;
    const auto size = std::filesystem::file_size(project.string() + "-wal", missing);
    return !missing && size > 0;
}

bool isProject(const std::filesystem::path& path) {
    std::error_code failed;
    if (std::filesystem::is_directory(path, failed)) return false;
    if (hasProjectName(path)) return true;
    // Opening a pipe would wait for its writer.
    if (!std::filesystem::is_regular_file(path, failed)) return false;
    const auto beginning = readBeginning(path);
    return beginning && beginning->isDatabase();
}

void checkFile(const std::filesystem::path& path) {
    std::error_code failed;
    const auto status = std::filesystem::status(path, failed);
    if (!std::filesystem::exists(status)) {
        throw Error(ErrorKind::project,
                    "there is no project " + path.string() + "; check the name, or start a new project");
    }
    if (!std::filesystem::is_regular_file(status)) {
        throw Error(ErrorKind::project, path.string() + " is not a file; name the project file itself (*.eyrie)");
    }
    const auto beginning = readBeginning(path);
    if (!beginning) {
        throw Error(ErrorKind::project, "the project " + path.string() + " cannot be read; check its permissions");
    }
    if (beginning->file_size == 0)
        throw Error(ErrorKind::project, path.string() + " is empty, not a project; delete it or choose another file");
    if (!beginning->isDatabase()) {
        throw Error(ErrorKind::project,
                    path.string() + " is not an Eyrie project, or its beginning is damaged; choose another file");
    }
    if (beginning->file_size < kHeaderBytes) throw damagedProject(path, "it ends within its header");
    const unsigned char* header = beginning->bytes.data();
    const std::uint32_t stored_page_size = bigEndian(header + 16, 2);
    const std::uint64_t page_size = stored_page_size == 1 ? 65536 : stored_page_size;
    const std::uint64_t pages = bigEndian(header + 28, 4);
    const bool size_is_valid = bigEndian(header + 24, 4) == bigEndian(header + 92, 4);
    // Pages that still wait in the log, or go back where they were, make a short file normal.
    if (size_is_valid && !hasLog(path) && !std::filesystem::exists(path.string() + "-journal", failed) &&
        beginning->file_size < pages * page_size) {
        throw damagedProject(path, "it is cut off: " + std::to_string(beginning->file_size) + " of " +
                                       std::to_string(pages * page_size) + " bytes");
    }
}

}  // namespace eyrie

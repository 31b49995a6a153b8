#include "store/file_check.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>

#include "core/error.h"
#include "store/database_error.h"

namespace eyrie {
namespace {

// The layout of the first 100 bytes is documented by SQLite ("Database File Format", §1.3) and frozen.
constexpr std::size_t kHeaderBytes = 100;
constexpr char kMagic[] = "SQLite format 3";  // with its terminating zero: 16 bytes

std::uint32_t bigEndian(const char* at, int bytes) {
    std::uint32_t value = 0;
    for (int i = 0; i < bytes; ++i) value = value << 8 | static_cast<unsigned char>(at[i]);
    return value;
}

}  // namespace

bool hasLog(const std::filesystem::path& project) {
    std::error_code missing;
    const auto size = std::filesystem::file_size(project.string() + "-wal", missing);
    return !missing && size > 0;
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
    std::ifstream file(path, std::ios::binary);
    std::array<char, kHeaderBytes> header{};
    const auto size = std::filesystem::file_size(path, failed);
    if (!file || failed) {
        throw Error(ErrorKind::project, "the project " + path.string() + " cannot be read; check its permissions");
    }
    if (size == 0)
        throw Error(ErrorKind::project, path.string() + " is empty, not a project; delete it or choose another file");
    file.read(header.data(), header.size());
    if (file.gcount() < static_cast<std::streamsize>(sizeof kMagic) ||
        std::memcmp(header.data(), kMagic, sizeof kMagic) != 0) {
        throw Error(ErrorKind::project,
                    path.string() + " is not an Eyrie project, or its beginning is damaged; choose another file");
    }
    if (file.gcount() < static_cast<std::streamsize>(header.size())) {
        throw damagedProject(path, "it ends within its header");
    }
    const std::uint32_t stored_page_size = bigEndian(header.data() + 16, 2);
    const std::uint64_t page_size = stored_page_size == 1 ? 65536 : stored_page_size;
    const std::uint64_t pages = bigEndian(header.data() + 28, 4);
    const bool size_is_valid = bigEndian(header.data() + 24, 4) == bigEndian(header.data() + 92, 4);
    // Pages that still wait in the log make a short file normal.
    if (size_is_valid && !hasLog(path) && size < pages * page_size) {
        throw damagedProject(
            path, "it is cut off: " + std::to_string(size) + " of " + std::to_string(pages * page_size) + " bytes");
    }
}

}  // namespace eyrie

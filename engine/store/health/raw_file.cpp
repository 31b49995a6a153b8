#include "store/health/raw_file.h"

#include <sqlite3.h>

#include <utility>

namespace eyrie {

std::optional<RawFile> RawFile::open(const std::filesystem::path& path) {
    if (sqlite3_initialize() != SQLITE_OK) return std::nullopt;
    sqlite3_vfs* system = sqlite3_vfs_find(nullptr);
    auto* file = static_cast<sqlite3_file*>(sqlite3_malloc(system->szOsFile));
    if (file == nullptr) return std::nullopt;
    file->pMethods = nullptr;
    // SQLite wants names of its own making for main databases, and goes on using them until the file is closed.
    const char* name = sqlite3_create_filename(std::filesystem::absolute(path).c_str(), "", "", 0, nullptr);
    if (name == nullptr) {
        sqlite3_free(file);
        return std::nullopt;
    }
    const bool open =
        system->xOpen(system, name, file, SQLITE_OPEN_READONLY | SQLITE_OPEN_MAIN_DB, nullptr) == SQLITE_OK;
    RawFile opened(file, name);
    sqlite3_int64 size = 0;
    if (!open || file->pMethods->xFileSize(file, &size) != SQLITE_OK) return std::nullopt;
    opened.size_ = static_cast<std::uint64_t>(size);
    return opened;
}

RawFile::RawFile(RawFile&& other) noexcept
    : file_(std::exchange(other.file_, nullptr)), name_(std::exchange(other.name_, nullptr)), size_(other.size_) {}

RawFile::~RawFile() {
    if (file_ == nullptr) return;
    if (file_->pMethods != nullptr) file_->pMethods->xClose(file_);
    sqlite3_free(file_);
    sqlite3_free_filename(const_cast<char*>(name_));
}

bool RawFile::read(std::uint64_t offset, std::span<unsigned char> bytes) const {
    const int result =
        file_->pMethods->xRead(file_, bytes.data(), static_cast<int>(bytes.size()), static_cast<sqlite3_int64>(offset));
    return result == SQLITE_OK || result == SQLITE_IOERR_SHORT_READ;
}

}  // namespace eyrie

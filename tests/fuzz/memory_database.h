#pragma once

#include <sqlite3.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <set>
#include <string>

namespace eyrie::fuzz {

/// Stands in for one database file: whatever opens its path through SQLite gets bytes in memory, which may change
/// between transactions. So an input costs what reading it costs, and no calls of the system. One of a process.
class MemoryDatabase {
 public:
    /// A file must lie at `path` for whoever asks the system about it.
    MemoryDatabase(const std::filesystem::path& path, std::string contents)
        : bytes(std::move(contents)), path_(path.string()), system_(sqlite3_vfs_find(nullptr)) {
        only() = this;
        page_size_ = std::size_t{static_cast<unsigned char>(bytes.at(16))} << 8 | static_cast<unsigned char>(bytes[17]);
        vfs_ = *system_;
        vfs_.zName = "fuzz";
        vfs_.szOsFile = std::max(vfs_.szOsFile, static_cast<int>(sizeof(sqlite3_file)));
        vfs_.xOpen = open;
        if (sqlite3_vfs_register(&vfs_, 1) != SQLITE_OK) std::abort();
    }
    MemoryDatabase(const MemoryDatabase&) = delete;
    MemoryDatabase& operator=(const MemoryDatabase&) = delete;

    std::string bytes;
    bool stands_in = true;  ///< false: the file of the system is opened
    bool notes_pages = false;
    std::set<std::size_t> pages_read;  ///< from 0, while they are noted

    std::size_t pageOf(std::size_t position) const { return position / page_size_; }
    /// Tells open connections that the bytes are not those they read before: both counters of changes in the header
    /// ("Database File Format", §1.3.7 and §1.3.16).
    void tellOfChange() {
        ++changes_;
        for (const std::size_t at : {std::size_t{24}, std::size_t{92}}) {
            for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(changes_ >> (24 - 8 * i));
        }
    }

 private:
    static MemoryDatabase*& only() {
        static MemoryDatabase* database = nullptr;
        return database;
    }
    static int open(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* opened) {
        MemoryDatabase& self = *only();
        if (name == nullptr || !self.stands_in || self.path_ != name)
            return self.system_->xOpen(self.system_, name, file, flags, opened);
        file->pMethods = methods();
        if (opened != nullptr) *opened = flags;
        return SQLITE_OK;
    }
    static int read(sqlite3_file*, void* to, int size, sqlite3_int64 offset) {
        MemoryDatabase& self = *only();
        const auto begin = std::min(static_cast<std::size_t>(offset), self.bytes.size());
        const auto wanted = static_cast<std::size_t>(size);
        const auto there = std::min(wanted, self.bytes.size() - begin);
        if (self.notes_pages) self.pages_read.insert(begin / self.page_size_);
        std::memcpy(to, self.bytes.data() + begin, there);
        std::memset(static_cast<char*>(to) + there, 0, wanted - there);
        return there == wanted ? SQLITE_OK : SQLITE_IOERR_SHORT_READ;
    }
    static const sqlite3_io_methods* methods() {
        static const sqlite3_io_methods table = [] {
            sqlite3_io_methods made{};
            made.iVersion = 1;
            made.xClose = [](sqlite3_file*) { return SQLITE_OK; };
            made.xRead = read;
            made.xWrite = [](sqlite3_file*, const void*, int, sqlite3_int64) { return SQLITE_READONLY; };
            made.xTruncate = [](sqlite3_file*, sqlite3_int64) { return SQLITE_READONLY; };
            made.xSync = [](sqlite3_file*, int) { return SQLITE_OK; };
            made.xFileSize = [](sqlite3_file*, sqlite3_int64* size) {
                *size = static_cast<sqlite3_int64>(only()->bytes.size());
                return SQLITE_OK;
            };
            made.xLock = [](sqlite3_file*, int) { return SQLITE_OK; };
            made.xUnlock = [](sqlite3_file*, int) { return SQLITE_OK; };
            made.xCheckReservedLock = [](sqlite3_file*, int* taken) {
                *taken = 0;
                return SQLITE_OK;
            };
            made.xFileControl = [](sqlite3_file*, int, void*) { return SQLITE_NOTFOUND; };
            made.xSectorSize = [](sqlite3_file*) { return 512; };
            made.xDeviceCharacteristics = [](sqlite3_file*) { return 0; };
            return made;
        }();
        return &table;
    }

    std::string path_;
    sqlite3_vfs* system_;
    sqlite3_vfs vfs_{};
    std::size_t page_size_ = 0;
    std::uint32_t changes_ = 0;
};

}  // namespace eyrie::fuzz

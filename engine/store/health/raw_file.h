#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

struct sqlite3_file;

namespace eyrie {

/// What a database begins with, with its terminating zero: the layout of the first 100 bytes is documented by SQLite
/// ("Database File Format", §1.3) and frozen.
inline constexpr char kSqliteMagic[] = "SQLite format 3";

/// The bytes of a database file in whatever state it is, read through SQLite's own layer: opened any other way, closing
/// it would drop the locks that connections of this process hold on it.
class RawFile {
 public:
    /// Nothing when the file is not there or cannot be read.
    static std::optional<RawFile> open(const std::filesystem::path& path);
    RawFile(RawFile&& other) noexcept;
    RawFile(const RawFile&) = delete;
    RawFile& operator=(const RawFile&) = delete;
    ~RawFile();

    std::uint64_t size() const { return size_; }
    /// Fills `bytes`, with zeros beyond the end of the file; false when the disk refuses.
    bool read(std::uint64_t offset, std::span<unsigned char> bytes) const;

 private:
    /// Takes both, whether the file is open or not.
    RawFile(sqlite3_file* file, const char* name) : file_(file), name_(name) {}
    sqlite3_file* file_;
    const char* name_;
    std::uint64_t size_ = 0;
};

}  // namespace eyrie

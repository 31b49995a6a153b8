#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/error.h"

/// What the fuzz targets share.
namespace eyrie::fuzz {

/// A folder in memory that vanishes at the end of the process.
class MemoryFolder {
 public:
    MemoryFolder() {
        const std::filesystem::path shared = "/dev/shm";
        const auto base = std::filesystem::is_directory(shared) ? shared : std::filesystem::temp_directory_path();
        std::string pattern = (base / "eyrie-fuzz-XXXXXX").string();
        if (mkdtemp(pattern.data()) == nullptr) std::abort();
        path_ = pattern;
    }
    ~MemoryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    MemoryFolder(const MemoryFolder&) = delete;
    MemoryFolder& operator=(const MemoryFolder&) = delete;
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
    std::filesystem::path path_;
};

/// Replaces the file's bytes; quick, as no file system's journal is asked.
inline void writeBytes(const std::filesystem::path& path, const void* bytes, std::size_t size) {
    const int file = open(path.c_str(), O_CREAT | O_WRONLY | O_TRUNC | O_CLOEXEC, 0600);
    if (file < 0 || write(file, bytes, size) != static_cast<ssize_t>(size)) std::abort();
    close(file);
}

/// Reading ends with an answer or with an Error that is not our own defect; anything else ends the process, which the
/// fuzzer reports.
template <class Read>
void expectAnswer(const Read& read) {
    try {
        read();
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::internal) return;
        std::fprintf(stderr, "internal error: %s\n", error.what());
        std::abort();
    }
}

/// The value of "--name=value" on the command line (words that begin with two dashes are none of the fuzzer's), or
/// `fallback`.
inline std::string option(int argc, char** argv, const std::string& name, const std::string& fallback) {
    const std::string begin = "--" + name + "=";
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word.starts_with(begin)) return word.substr(begin.size());
    }
    return fallback;
}

}  // namespace eyrie::fuzz

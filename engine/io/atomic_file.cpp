#include "io/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "core/error.h"

namespace eyrie {

namespace {

[[noreturn]] void failToWrite(const std::filesystem::path& path, int reason) {
    throw Error(ErrorKind::output, path.string() + ": cannot be written (" + std::strerror(reason) +
                                       "); choose a folder that may be written and has room");
}

std::filesystem::path temporaryBeside(const std::filesystem::path& path) {
    static std::atomic<int> count{0};
    return path.string() + "." + std::to_string(::getpid()) + "-" + std::to_string(++count) + ".part";
}

bool writeAll(int file, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(file, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

}  // namespace

void writeFileAtomically(const std::filesystem::path& path, std::string_view bytes) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) failToWrite(path, EISDIR);
    // Devices and pipes (/dev/stdout) cannot be replaced, only written to.
    const bool in_place = std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored);
    const std::filesystem::path target = in_place ? path : temporaryBeside(path);
    const int flags = in_place ? O_WRONLY | O_CLOEXEC : O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC;
    const int file = ::open(target.c_str(), flags, 0666);
    if (file < 0) failToWrite(path, errno);
    bool written = writeAll(file, bytes);
    if (written && !in_place) written = ::fsync(file) == 0;
    int reason = errno;
    if (::close(file) != 0 && written) {
        written = false;
        reason = errno;
    }
    if (written && !in_place && ::rename(target.c_str(), path.c_str()) != 0) {
        written = false;
        reason = errno;
    }
    if (written) return;
    if (!in_place) ::unlink(target.c_str());
    failToWrite(path, reason);
}

std::string readWholeFile(const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored))
        throw Error(ErrorKind::input, path.string() + ": there is no such file");
    if (std::filesystem::is_directory(path, ignored))
        throw Error(ErrorKind::input, path.string() + ": is a folder, expected a file");
    std::ifstream file(path, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (!file.good() && !file.eof())
        throw Error(ErrorKind::input, path.string() + ": cannot be read; check its permissions");
    return bytes;
}

}  // namespace eyrie

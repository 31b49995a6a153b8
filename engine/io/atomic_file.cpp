#include "io/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

#include "core/error.h"
#include "core/text.h"

namespace eyrie {

namespace {

[[noreturn]] void failToWrite(const std::filesystem::path& path, int reason) {
    throw Error(ErrorKind::output, displayText(path) + ": cannot be written (" + std::strerror(reason) +
                                       "); choose a folder that may be written and has room");
}

/// The descriptor that /dev/stdout and the like stand for. Opening them anew would write over what was printed to a
/// file, or replace the device itself.
int ownDescriptor(const std::filesystem::path& path) {
    const std::string name = path.lexically_normal().string();
    if (name == "/dev/stdout") return STDOUT_FILENO;
    if (name == "/dev/stderr") return STDERR_FILENO;
    for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
        if (!name.starts_with(folder)) continue;
        int descriptor = -1;
        const char* end = name.data() + name.size();
        const auto read = std::from_chars(name.data() + folder.size(), end, descriptor);
        if (read.ec == std::errc() && read.ptr == end) return descriptor;
    }
    return -1;
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

/// A device, a pipe or an own descriptor, to be written into as it is; −1 and errno where that fails.
int openInPlace(const std::filesystem::path& path) {
    const int own = ownDescriptor(path);
    if (own < 0) return ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    std::fflush(nullptr);  // what was printed before comes before
    return ::fcntl(own, F_DUPFD_CLOEXEC, 3);
}

}  // namespace

bool isOwnStream(const std::filesystem::path& path) {
    return ownDescriptor(path) >= 0;
}

std::filesystem::path throughLinks(const std::filesystem::path& path) {
    std::error_code failed;
    if (!std::filesystem::is_symlink(path, failed)) return path;
    const std::filesystem::path target = std::filesystem::canonical(path, failed);
    return failed ? path : target;
}

void removeAbandonedParts(const std::filesystem::path& path) {
    const std::filesystem::path folder = path.parent_path();
    const std::string name = path.filename().string();
    std::error_code failed;
    for (const auto& entry : std::filesystem::directory_iterator(folder.empty() ? "." : folder, failed)) {
        const std::string other = entry.path().filename().string();
        if (!other.starts_with(name + ".") || !other.ends_with(".part")) continue;
        long process = 0;
        const char* begin = other.data() + name.size() + 1;
        const auto read = std::from_chars(begin, other.data() + other.size(), process);
        if (read.ec != std::errc() || *read.ptr != '-' || process <= 0) continue;
        if (::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH) {
            std::error_code stays;
            std::filesystem::remove(entry.path(), stays);
        }
    }
}

std::filesystem::path temporaryBeside(const std::filesystem::path& path) {
    static std::atomic<int> count{0};
    char ending[48];
    const int length = std::snprintf(ending, sizeof ending, ".%ld-%d.part", static_cast<long>(::getpid()), ++count);
    std::string name = path.filename().string();
    name.resize(std::min<std::size_t>(name.size(), NAME_MAX - static_cast<std::size_t>(length)));
    return path.parent_path() / (name + ending);
}

void writeFileAtomically(const std::filesystem::path& path, std::string_view bytes, Durability durability) {
    AtomicFileWriter file(path, durability);
    file.write(bytes);
    file.finish();
}

AtomicFileWriter::AtomicFileWriter(std::filesystem::path path, Durability durability)
    : path_(std::move(path)), durability_(durability) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path_, ignored)) failToWrite(path_, EISDIR);
    const bool stream = std::filesystem::exists(path_, ignored) && !std::filesystem::is_regular_file(path_, ignored);
    if (stream || isOwnStream(path_)) {
        file_ = openInPlace(path_);
    } else {
        target_ = throughLinks(path_);
        aside_ = temporaryBeside(target_);
        file_ = ::open(aside_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    }
    if (file_ < 0) failToWrite(path_, errno);
}

AtomicFileWriter::~AtomicFileWriter() {
    if (file_ < 0) return;
    ::close(file_);
    if (!aside_.empty()) ::unlink(aside_.c_str());
}

void AtomicFileWriter::fail(int reason) {
    if (file_ >= 0) ::close(std::exchange(file_, -1));
    if (!aside_.empty()) ::unlink(aside_.c_str());
    failToWrite(path_, reason);
}

void AtomicFileWriter::put(std::string_view bytes) {
    if (!writeAll(file_, bytes)) fail(errno);
}

void AtomicFileWriter::write(std::string_view bytes) {
    constexpr std::size_t kWorthACall = 1 << 16;
    if (waiting_.size() + bytes.size() < kWorthACall) {
        waiting_ += bytes;
        return;
    }
    put(waiting_);
    waiting_.clear();
    put(bytes);
}

void AtomicFileWriter::finish() {
    put(waiting_);
    waiting_.clear();
    const bool in_place = aside_.empty();
    if (!in_place && durability_ == Durability::synchronised && ::fsync(file_) != 0) fail(errno);
    if (::close(std::exchange(file_, -1)) != 0) fail(errno);
    if (!in_place && ::rename(aside_.c_str(), target_.c_str()) != 0) fail(errno);
}

void checkReadableFile(const std::filesystem::path& path) {
    std::error_code failed;
    const auto status = std::filesystem::status(path, failed);
    const std::string name = displayText(path);
    if (failed && failed != std::errc::no_such_file_or_directory)
        throw Error(ErrorKind::input, name + ": cannot be read (" + failed.message() + ")");
    if (!std::filesystem::exists(status)) throw Error(ErrorKind::input, name + ": there is no such file");
    if (std::filesystem::is_directory(status)) throw Error(ErrorKind::input, name + ": is a folder, expected a file");
    if (!std::filesystem::is_regular_file(status))
        throw Error(ErrorKind::input, name + ": is a pipe or a device; save what comes from it to a file first");
    if (::access(path.c_str(), R_OK) != 0)
        throw Error(ErrorKind::input, name + ": cannot be read (" + std::strerror(errno) + "); check its permissions");
}

std::string readWholeFile(const std::filesystem::path& path) {
    checkReadableFile(path);
    std::ifstream file(path, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (!file.good() && !file.eof())
        throw Error(ErrorKind::input, displayText(path) + ": cannot be read; check its permissions");
    return bytes;
}

}  // namespace eyrie

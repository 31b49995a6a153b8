#include "store/database/file_lock.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <functional>
#include <system_error>
#include <utility>

#include "core/time/utc_time.h"

namespace eyrie {
namespace {

constexpr int kTries = 20;
constexpr std::size_t kLongestName = 255;  // bytes, on every file system in use

std::string hostName() {
    std::array<char, 256> name{};
    if (gethostname(name.data(), name.size() - 1) != 0) return "unknown";
    return name.data();
}

/// The whole file, for writing. Locks of this kind belong to the open file and not to the process, so that two windows
/// of one process exclude each other, and work over network drives.
struct flock wholeFile(short type) {
    struct flock range {};
    range.l_type = type;
    range.l_whence = SEEK_SET;
    return range;
}

/// Who holds the lock, as the file says.
std::string wordsIn(int descriptor) {
    std::array<char, 512> text{};
    const ssize_t size = pread(descriptor, text.data(), text.size() - 1, 0);
    if (size <= 0) return "another program";
    return std::string(text.data(), static_cast<std::size_t>(size));
}

/// Whether the descriptor is still the file of that name: the holder before may have removed it meanwhile.
bool isPresent(int descriptor, const std::filesystem::path& path) {
    struct stat held {};
    struct stat named {};
    return fstat(descriptor, &held) == 0 && stat(path.c_str(), &named) == 0 && held.st_ino == named.st_ino &&
           held.st_dev == named.st_dev;
}

std::string errorText(int error) {
    return std::generic_category().message(error);
}

}  // namespace

std::filesystem::path lockFileBeside(const std::filesystem::path& guarded, const std::string& ending) {
    std::error_code failed;
    std::filesystem::path path = std::filesystem::weakly_canonical(guarded, failed);
    if (failed) path = guarded;
    std::string name = path.filename().string() + ending;
    if (name.size() > kLongestName) {
        const std::string number = std::to_string(std::hash<std::string>()(name));
        name = name.substr(0, kLongestName - number.size() - ending.size()) + number + ending;
    }
    return path.replace_filename(name);
}

FileLock::FileLock(std::filesystem::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}

FileLock::Attempt FileLock::tryTake(const std::filesystem::path& file) {
    for (int i = 0; i < kTries; ++i) {
        const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor < 0)
            return {Outcome::impossible, nullptr, file.string() + " cannot be written (" + errorText(errno) + ")"};
        struct flock range = wholeFile(F_WRLCK);
        if (fcntl(descriptor, F_OFD_SETLK, &range) != 0) {
            const int error = errno;
            const bool held = error == EAGAIN || error == EACCES;
            Attempt attempt;
            attempt.outcome = held ? Outcome::held : Outcome::impossible;
            attempt.words = held ? wordsIn(descriptor) : file.string() + " cannot be locked (" + errorText(error) + ")";
            close(descriptor);
            return attempt;
        }
        if (!isPresent(descriptor, file)) {
            close(descriptor);
            continue;
        }
        const std::string holder =
            "process " + std::to_string(getpid()) + " on " + hostName() + " (since " + nowUtc() + ")";
        // Only a hint for others; the lock holds without it.
        if (ftruncate(descriptor, 0) == 0) {
            [[maybe_unused]] const ssize_t written = pwrite(descriptor, holder.data(), holder.size(), 0);
        }
        return {Outcome::taken, std::unique_ptr<FileLock>(new FileLock(file, descriptor)), {}};
    }
    return {Outcome::impossible, nullptr, file.string() + " keeps appearing and disappearing; try again"};
}

std::optional<std::string> FileLock::holderOf(const std::filesystem::path& file) {
    const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) return std::nullopt;
    struct flock range = wholeFile(F_RDLCK);
    std::optional<std::string> holder;
    if (fcntl(descriptor, F_OFD_GETLK, &range) == 0 && range.l_type != F_UNLCK) holder = wordsIn(descriptor);
    close(descriptor);
    return holder;
}

FileLock::~FileLock() {
    std::error_code ignored;
    // Removed while it is still locked, so that nobody's file is removed.
    if (isPresent(descriptor_, path_)) std::filesystem::remove(path_, ignored);
    close(descriptor_);
}

}  // namespace eyrie

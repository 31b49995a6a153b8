#include "store/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include "store/sequence_rows.h"

namespace eyrie {
namespace {

constexpr int kTries = 20;

std::string hostName() {
    std::array<char, 256> name{};
    if (gethostname(name.data(), name.size() - 1) != 0) return "unknown";
    return name.data();
}

/// Who holds the lock, as the file says.
std::string holderOf(int descriptor) {
    std::array<char, 512> text{};
    const ssize_t size = pread(descriptor, text.data(), text.size() - 1, 0);
    if (size <= 0) return "another window";
    return std::string(text.data(), static_cast<std::size_t>(size));
}

/// Whether the descriptor is still the file of that name: the holder before may have removed it meanwhile.
bool isPresent(int descriptor, const std::filesystem::path& path) {
    struct stat held {};
    struct stat named {};
    return fstat(descriptor, &held) == 0 && stat(path.c_str(), &named) == 0 && held.st_ino == named.st_ino &&
           held.st_dev == named.st_dev;
}

std::string inWords(int error) {
    return std::generic_category().message(error);
}

}  // namespace

std::filesystem::path lockFileBeside(const std::filesystem::path& guarded, const std::string& ending) {
    std::error_code failed;
    std::filesystem::path path = std::filesystem::weakly_canonical(guarded, failed);
    if (failed) path = guarded;
    path += ending;
    return path;
}

FileLock::FileLock(std::filesystem::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}

FileLock::Attempt FileLock::tryTake(const std::filesystem::path& file) {
    for (int i = 0; i < kTries; ++i) {
        const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor < 0)
            return {Outcome::impossible, nullptr, file.string() + " cannot be written (" + inWords(errno) + ")"};
        if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
            const int error = errno;
            Attempt attempt;
            attempt.outcome = error == EWOULDBLOCK ? Outcome::held : Outcome::impossible;
            attempt.words = error == EWOULDBLOCK ? holderOf(descriptor)
                                                 : file.string() + " cannot be locked (" + inWords(error) + ")";
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
    return {Outcome::impossible, nullptr, file.string() + " comes and goes; try again"};
}

FileLock::~FileLock() {
    std::error_code ignored;
    // Removed while it is still locked, so that nobody's file is removed.
    if (isPresent(descriptor_, path_)) std::filesystem::remove(path_, ignored);
    close(descriptor_);
}

}  // namespace eyrie

#include "store/writer_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "store/sequence_rows.h"

namespace eyrie {
namespace {

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

WriterLock::WriterLock(std::filesystem::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}

std::unique_ptr<WriterLock> WriterLock::tryTake(const std::filesystem::path& project, std::string& reason) {
    std::error_code failed;
    std::filesystem::path path = std::filesystem::weakly_canonical(project, failed);
    if (failed) path = project;
    path += ".labelling";
    constexpr int kTries = 20;
    for (int i = 0; i < kTries; ++i) {
        const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor < 0) {
            reason = "the labels can only be read: " + path.string() + " cannot be written (" + inWords(errno) +
                     "); check the permissions of the folder, or copy the project";
            return nullptr;
        }
        if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
            const int error = errno;
            reason = error == EWOULDBLOCK ? "the labels can only be read here: " + holderOf(descriptor) +
                                                " is labelling this project; close that window to go on here"
                                          : "the labels can only be read: " + path.string() + " cannot be locked (" +
                                                inWords(error) + "); copy the project to a drive of this computer";
            close(descriptor);
            return nullptr;
        }
        if (!isPresent(descriptor, path)) {
            close(descriptor);
            continue;
        }
        const std::string holder =
            "process " + std::to_string(getpid()) + " on " + hostName() + " (since " + nowUtc() + ")";
        // Only a hint for others; the lock holds without it.
        if (ftruncate(descriptor, 0) == 0) {
            [[maybe_unused]] const ssize_t written = pwrite(descriptor, holder.data(), holder.size(), 0);
        }
        return std::unique_ptr<WriterLock>(new WriterLock(path, descriptor));
    }
    reason = "the labels can only be read: " + path.string() + " comes and goes; try again";
    return nullptr;
}

WriterLock::~WriterLock() {
    std::error_code ignored;
    // Removed while it is still locked, so that nobody's file is removed.
    if (isPresent(descriptor_, path_)) std::filesystem::remove(path_, ignored);
    close(descriptor_);
}

}  // namespace eyrie

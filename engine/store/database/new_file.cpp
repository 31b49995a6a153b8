#include "store/database/new_file.h"

#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "core/error.h"
#include "store/database/file_lock.h"

namespace eyrie {
namespace {

using Path = std::filesystem::path;

/// An open file that is closed whatever happens.
class Descriptor {
 public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() {
        if (number_ >= 0) close(number_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    bool isOpen() const { return number_ >= 0; }
    int number() const { return number_; }

    /// Answers whether all is on the disk; else errno says why not.
    bool writeAll(std::string_view bytes) const {
        while (!bytes.empty()) {
            const ssize_t written = write(number_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written <= 0) return false;
            bytes.remove_prefix(static_cast<std::size_t>(written));
        }
        return fsync(number_) == 0;
    }

 private:
    int number_;
};

[[noreturn]] void fail(const Path& path, int reason) {
    throw Error(ErrorKind::output, path.string() + " cannot be made (" + std::generic_category().message(reason) +
                                       "); check that its folder may be written and that the disk has space");
}

/// Whether a name was given to the file; false when the name is taken.
bool placed(int failed, const Path& path) {
    if (failed == 0) return true;
    if (errno == EEXIST) return false;
    fail(path, errno);
}

/// For file systems without nameless files, which say so in many ways: written under another name and then linked or
/// renamed, without replacing. What can be made in no way fails here, too.
bool makeAside(const Path& path, std::string_view bytes) {
    const Path aside = lockFileBeside(path, ".new-" + std::to_string(getpid()));
    unlink(aside.c_str());
    const Descriptor file(open(aside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (!file.isOpen()) fail(path, errno);
    if (!file.writeAll(bytes)) {
        const int reason = errno;
        unlink(aside.c_str());
        fail(path, reason);
    }
    int failed = link(aside.c_str(), path.c_str());
    if (failed != 0 && errno != EEXIST)
        failed = renameat2(AT_FDCWD, aside.c_str(), AT_FDCWD, path.c_str(), RENAME_NOREPLACE);
    const int reason = errno;
    unlink(aside.c_str());
    errno = reason;
    return placed(failed, path);
}

}  // namespace

bool makeNewFile(const Path& path, std::string_view bytes) {
    std::error_code ignored;
    if (std::filesystem::exists(std::filesystem::symlink_status(path, ignored))) return false;
    const Path folder = std::filesystem::absolute(path, ignored).parent_path();
    const Descriptor file(open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666));
    if (!file.isOpen()) return makeAside(path, bytes);
    if (!file.writeAll(bytes)) fail(path, errno);
    const std::string nameless = "/proc/self/fd/" + std::to_string(file.number());
    const int failed = linkat(AT_FDCWD, nameless.c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW);
    if (failed != 0 && errno != EEXIST) return makeAside(path, bytes);
    return placed(failed, path);
}

}  // namespace eyrie

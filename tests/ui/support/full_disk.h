#pragma once

#include <sys/resource.h>

#include <csignal>

namespace eyrie::ui::test {

/// While it lives, no file of this process can be written beyond `bytes`: a limit on the size of files stands for a
/// full disk. Pages that are there already can be written again.
class FullDisk {
 public:
    explicit FullDisk(rlim_t bytes = 1) {
        signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &before_);
        rlimit small = before_;
        small.rlim_cur = bytes;
        setrlimit(RLIMIT_FSIZE, &small);
    }
    ~FullDisk() { setrlimit(RLIMIT_FSIZE, &before_); }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

 private:
    rlimit before_{};
};

}  // namespace eyrie::ui::test

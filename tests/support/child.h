#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <functional>

namespace eyrie::test {

/// Runs `work` in a process of its own and answers its exit code: 99 when it threw, −1 when a signal ended it.
inline int inChild(const std::function<int()>& work) {
    const pid_t child = fork();
    if (child == 0) {
        int code = 99;
        try {
            code = work();
        } catch (...) {
        }
        _exit(code);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace eyrie::test

#include "cli/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>

namespace eyrie::cli {

void prepareStreams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        // Standard output cannot be written then, which is told at the end.
        if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
    }
    std::signal(SIGPIPE, SIG_IGN);
}

bool finishOutput() {
    errno = 0;
    std::cout.flush();
    const bool flushed = std::fflush(stdout) == 0;
    int reason = errno;
    if (flushed && std::cout.good() && std::ferror(stdout) == 0) return true;
    // What was printed last may have gone wrong long before; then only another attempt tells why.
    if (reason == 0 && ::write(STDOUT_FILENO, "\n", 1) < 0) reason = errno;
    std::fprintf(stderr, "eyrie-cli: standard output cannot be written%s%s%s; what was printed is not complete\n",
                 reason == 0 ? "" : " (", reason == 0 ? "" : std::strerror(reason), reason == 0 ? "" : ")");
    return false;
}

}  // namespace eyrie::cli

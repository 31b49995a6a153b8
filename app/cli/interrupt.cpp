#include "cli/interrupt.h"

#include <pthread.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "cli/command.h"
#include "core/error.h"

namespace eyrie::cli {
namespace {

/// A signal that whoever started us wants ignored (nohup) stays so.
sigset_t stopSignals() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction present {};
        if (sigaction(signal, nullptr, &present) == 0 && present.sa_handler != SIG_IGN) sigaddset(&set, signal);
    }
    return set;
}

}  // namespace

// The signals are blocked for all threads and taken by one of ours, so that nothing runs in a signal handler.
InterruptGuard::InterruptGuard() {
    const sigset_t set = stopSignals();
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
    // What came while whoever started us held signals back is not left to when the watcher wakes up.
    const timespec no_time{};
    if (sigtimedwait(&set, nullptr, &no_time) >= 0) stop_.request_stop();
    watcher_ = std::jthread([this](const std::stop_token& done) {
        const sigset_t waited = stopSignals();
        while (!done.stop_requested()) {
            const timespec interval{0, 100'000'000};
            const int signal = sigtimedwait(&waited, nullptr, &interval);
            if (signal < 0) continue;
            // A closed terminal may tell so twice, and whoever ends a job tells its processes and they tell each other;
            // only a person who presses Ctrl-C again means it.
            if (!stop_.request_stop() && signal == SIGINT) std::_Exit(130);
        }
    });
}

InterruptGuard::~InterruptGuard() {
    watcher_ = {};
    const sigset_t set = stopSignals();
    pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

int untilStopped(const std::function<int(const std::stop_token& stop)>& work) {
    const InterruptGuard interrupt;
    try {
        return work(interrupt.token());
    } catch (const Error& error) {
        if (!interrupt.token().stop_requested()) throw;
        std::fprintf(stderr, "eyrie-cli: %s\n", error.what());
        return exit_stopped;
    }
}

}  // namespace eyrie::cli

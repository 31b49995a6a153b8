#include "cli/interrupt.h"

#include <pthread.h>

#include <csignal>
#include <cstdlib>
#include <ctime>

namespace eyrie::cli {
namespace {

sigset_t stopSignals() {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    return set;
}

}  // namespace

// The signals are blocked for all threads and taken by one of ours, so that nothing runs in a signal handler.
InterruptGuard::InterruptGuard() {
    const sigset_t set = stopSignals();
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
    watcher_ = std::jthread([this](const std::stop_token& done) {
        const sigset_t waited = stopSignals();
        while (!done.stop_requested()) {
            const timespec interval{0, 100'000'000};
            if (sigtimedwait(&waited, nullptr, &interval) < 0) continue;
            if (!stop_.request_stop()) std::_Exit(130);
        }
    });
}

InterruptGuard::~InterruptGuard() {
    watcher_ = {};
    const sigset_t set = stopSignals();
    pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

}  // namespace eyrie::cli

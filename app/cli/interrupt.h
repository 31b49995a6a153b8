#pragma once

#include <stop_token>
#include <thread>

namespace eyrie::cli {

/// While it lives, Ctrl-C (SIGINT), SIGTERM and a closed terminal (SIGHUP) request a stop instead of ending the
/// process; a second Ctrl-C ends it.
/// At most one at a time.
class InterruptGuard {
 public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    std::stop_token token() const { return stop_.get_token(); }

 private:
    std::stop_source stop_;
    std::jthread watcher_;
};

}  // namespace eyrie::cli

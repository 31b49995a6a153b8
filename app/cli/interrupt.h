#pragma once

#include <functional>
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

/// Does the work of a command that a person may stop, and answers its exit code. What cannot be done because of that,
/// such as opening a video that is still being indexed, is told, and the command ends as one that was stopped.
int untilStopped(const std::function<int(const std::stop_token& stop)>& work);

}  // namespace eyrie::cli

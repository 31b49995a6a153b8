#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>

namespace eyrie::ui {

/// One background thread that does tasks: ordinary ones in order; one "newest" slot, in which a later task replaces an
/// earlier one that has not begun; one "idle" slot, done when nothing else waits. Tasks must not throw. Destruction
/// stops the running task through its token, drops the others and waits.
class TaskThread {
 public:
    using Task = std::function<void(std::stop_token)>;

    TaskThread();
    ~TaskThread();
    TaskThread(const TaskThread&) = delete;
    TaskThread& operator=(const TaskThread&) = delete;

    void post(Task task);
    void postNewest(Task task);
    void postIdle(Task task);
    std::thread::id id() const { return thread_.get_id(); }

 private:
    void work(const std::stop_token& stop);
    Task next();

    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::deque<Task> ordinary_;
    Task newest_;
    Task idle_;
    std::jthread thread_;
};

}  // namespace eyrie::ui

#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace eyrie::ui {

/// Threads for whoever has something to do. What a person waits for gets one at once, a free one or a new one, however
/// long others are at work; idle tasks share one. Tasks must not throw, and must have ended before the pool goes.
class TaskPool {
 public:
    using Task = std::function<void()>;

    /// The one of the window; it lasts as long as anybody holds it.
    static std::shared_ptr<TaskPool> common();

    TaskPool() = default;
    ~TaskPool();
    TaskPool(const TaskPool&) = delete;
    TaskPool& operator=(const TaskPool&) = delete;

    void post(Task task);
    void postIdle(Task task);

 private:
    bool idleIsDue() const { return !idle_.empty() && !idle_at_work_; }
    void wake();
    void work();

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Task> waited_for_;
    std::deque<Task> idle_;
    std::size_t free_ = 0;  ///< threads without a task
    bool idle_at_work_ = false;
    bool ended_ = false;
    std::vector<std::jthread> threads_;
};

}  // namespace eyrie::ui

#pragma once

#include <atomic>
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

    /// How much of what people did is on its way into files: whoever ends the program, or leaves a file, waits until
    /// there is none. Counted by BackgroundQuery::write(). On any thread.
    int writesDue() const { return writes_due_; }
    void countWrites(int more) { writes_due_ += more; }
    /// How many writes have failed so far.
    int writesFailed() const { return writes_failed_; }
    void countFailedWrite() { ++writes_failed_; }

 private:
    bool idleIsDue() const { return !idle_.empty() && !idle_at_work_; }
    void wake();
    void work();

    std::atomic<int> writes_due_ = 0;
    std::atomic<int> writes_failed_ = 0;
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

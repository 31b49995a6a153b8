#include "session/background/task_pool.h"

#include <utility>

namespace eyrie::ui {

std::shared_ptr<TaskPool> TaskPool::common() {
    static std::mutex mutex;
    static std::weak_ptr<TaskPool> pool;
    const std::scoped_lock lock(mutex);
    std::shared_ptr<TaskPool> held = pool.lock();
    if (!held) pool = held = std::make_shared<TaskPool>();
    return held;
}

TaskPool::~TaskPool() {
    const std::scoped_lock lock(mutex_);
    ended_ = true;
    changed_.notify_all();
}

void TaskPool::post(Task task) {
    const std::scoped_lock lock(mutex_);
    waited_for_.push_back(std::move(task));
    wake();
}

void TaskPool::postIdle(Task task) {
    const std::scoped_lock lock(mutex_);
    idle_.push_back(std::move(task));
    wake();
}

/// A thread for every task that may begin: a task may last for hours, so none counts on a thread that has one.
void TaskPool::wake() {
    if (free_ < waited_for_.size() + (idleIsDue() ? 1 : 0)) {
        ++free_;
        threads_.emplace_back([this] { work(); });
    } else {
        changed_.notify_one();
    }
}

void TaskPool::work() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return ended_ || !waited_for_.empty() || idleIsDue(); });
        if (ended_) return;
        const bool idle = waited_for_.empty();
        auto& tasks = idle ? idle_ : waited_for_;
        Task task = std::move(tasks.front());
        tasks.pop_front();
        --free_;
        if (idle) idle_at_work_ = true;
        lock.unlock();
        task();
        task = nullptr;
        lock.lock();
        ++free_;
        if (idle) idle_at_work_ = false;
    }
}

}  // namespace eyrie::ui

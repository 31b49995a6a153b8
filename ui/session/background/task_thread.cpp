#include "session/background/task_thread.h"

#include <utility>

namespace eyrie::ui {

TaskThread::TaskThread() : thread_([this](const std::stop_token& stop) { work(stop); }) {}

TaskThread::~TaskThread() {
    thread_.request_stop();
    thread_.join();
}

void TaskThread::post(Task task) {
    const std::scoped_lock lock(mutex_);
    ordinary_.push_back(std::move(task));
    changed_.notify_one();
}

void TaskThread::postNewest(Task task) {
    const std::scoped_lock lock(mutex_);
    newest_ = std::move(task);
    changed_.notify_one();
}

void TaskThread::postIdle(Task task) {
    const std::scoped_lock lock(mutex_);
    idle_ = std::move(task);
    changed_.notify_one();
}

TaskThread::Task TaskThread::next() {
    if (!ordinary_.empty()) {
        Task task = std::move(ordinary_.front());
        ordinary_.pop_front();
        return task;
    }
    return std::exchange(newest_ ? newest_ : idle_, nullptr);
}

void TaskThread::work(const std::stop_token& stop) {
    while (true) {
        Task task;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, stop, [this] { return !ordinary_.empty() || newest_ || idle_; });
            if (stop.stop_requested()) return;
            task = next();
        }
        task(stop);
    }
}

}  // namespace eyrie::ui

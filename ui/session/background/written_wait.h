#pragma once

#include <QTimer>
#include <chrono>
#include <functional>
#include <memory>

#include "session/background/task_pool.h"

namespace eyrie::ui {

/// Waits until what people did is in its files, without holding the window up.
class WrittenWait {
 public:
    explicit WrittenWait(std::shared_ptr<TaskPool> pool = TaskPool::common());

    bool anythingDue() const { return pool_->writesDue() > 0; }
    bool waiting() const { return then_ != nullptr; }
    /// From here on it is noticed what fails; to be called before what is at work is asked to end. While it waits, it
    /// is noticed already.
    void watch() {
        if (!waiting()) failed_before_ = pool_->writesFailed();
    }
    /// Whether a write has failed since watch(): its owner has told so, or is about to.
    bool anythingFailed() const { return pool_->writesFailed() > failed_before_; }
    /// Calls `then` from the event loop once nothing is due, and what failed of it was told, or when this took too
    /// long: `all` says which. Takes the place of what was waited for before.
    void begin(std::function<void(bool all)> then);
    void cancel();

 private:
    void look();

    std::shared_ptr<TaskPool> pool_;
    std::function<void(bool all)> then_;
    std::chrono::steady_clock::time_point latest_{};
    bool none_due_ = false;  ///< when it was looked at last
    int failed_before_ = 0;  ///< watch()
    QTimer look_again_;
};

}  // namespace eyrie::ui

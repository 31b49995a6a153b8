#pragma once

#include <memory>
#include <utility>

#include "session/background/task_pool.h"

namespace eyrie::ui {

/// Work whose result goes into a file once it is done: as long as this lives it counts as a write that is due, so that
/// whoever ends the program, or leaves the file, waits for it.
class DueWrite {
 public:
    explicit DueWrite(std::shared_ptr<TaskPool> pool = TaskPool::common()) : pool_(std::move(pool)) {
        pool_->countWrites(1);
    }
    DueWrite(DueWrite&& other) noexcept : pool_(std::move(other.pool_)) {}
    ~DueWrite() {
        if (pool_) pool_->countWrites(-1);
    }
    DueWrite(const DueWrite&) = delete;
    DueWrite& operator=(const DueWrite&) = delete;
    DueWrite& operator=(DueWrite&&) = delete;

 private:
    std::shared_ptr<TaskPool> pool_;
};

}  // namespace eyrie::ui

#include "session/background/written_wait.h"

#include <utility>

namespace eyrie::ui {

namespace {
constexpr int kLookAgain_ms = 10;
/// A write that another program holds up gives up after five seconds by itself.
constexpr std::chrono::seconds kLongestWait(15);
}  // namespace

WrittenWait::WrittenWait(std::shared_ptr<TaskPool> pool) : pool_(std::move(pool)) {
    look_again_.setInterval(kLookAgain_ms);
    look_again_.callOnTimeout([this] { look(); });
}

void WrittenWait::begin(std::function<void(bool all)> then) {
    then_ = std::move(then);
    latest_ = std::chrono::steady_clock::now() + kLongestWait;
    none_due_ = false;
    look_again_.start();
}

void WrittenWait::cancel() {
    look_again_.stop();
    then_ = nullptr;
}

void WrittenWait::look() {
    // What failed is told by a call that may be on its way still: it has come when this is asked the next time.
    const bool all = std::exchange(none_due_, !anythingDue()) && none_due_;
    if (!all && std::chrono::steady_clock::now() < latest_) return;
    look_again_.stop();
    if (const auto then = std::exchange(then_, nullptr)) then(all);
}

}  // namespace eyrie::ui

#pragma once

#include <QTimer>
#include <functional>
#include <utility>

namespace eyrie::ui {

/// A call once nothing has asked for it any more for a while. It stops with its owner.
class DelayedCall {
 public:
    DelayedCall(int delay_ms, std::function<void()> call) {
        timer_.setSingleShot(true);
        timer_.setInterval(delay_ms);
        timer_.callOnTimeout(std::move(call));
    }

    /// Asks for the call; asked for again, the delay begins anew.
    void start() { timer_.start(); }
    void stop() { timer_.stop(); }
    /// Whether the call is still to come.
    bool pending() const { return timer_.isActive(); }

 private:
    QTimer timer_;
};

}  // namespace eyrie::ui

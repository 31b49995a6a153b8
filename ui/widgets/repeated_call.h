#pragma once

#include <QTimer>
#include <functional>
#include <utility>

namespace eyrie::ui {

/// A call again and again from start() to stop(). It stops with its owner.
class RepeatedCall {
 public:
    RepeatedCall(int period_ms, std::function<void()> call) {
        timer_.setInterval(period_ms);
        timer_.callOnTimeout(std::move(call));
    }

    void start() { timer_.start(); }
    void stop() { timer_.stop(); }

 private:
    QTimer timer_;
};

}  // namespace eyrie::ui

#pragma once

#include <chrono>

namespace eyrie::ui {

/// How fast a task goes on, for those who wait for it. Begins when it is made.
class Pace {
 public:
    /// Whether it is time to tell how far it is: ten times a second at most.
    bool isDue() {
        const Clock::time_point now = Clock::now();
        if (now - told_ < kBetweenTold) return false;
        told_ = now;
        return true;
    }
    /// How long `left` more steps take, s, when the first `done` took until now; `done` > 0.
    double secondsLeft(int done, int left) const {
        return std::chrono::duration<double>(Clock::now() - begin_).count() * left / done;
    }

 private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds kBetweenTold{100};
    Clock::time_point begin_ = Clock::now();
    Clock::time_point told_ = begin_;
};

}  // namespace eyrie::ui

#pragma once

#include <chrono>

#include "core/values/frame_result.h"

namespace eyrie {

/// Adds the wall-clock time of a scope to one stage.
class Stopwatch {
 public:
    Stopwatch(StageTimes& times, Stage stage)
        : times_(times), stage_(stage), start_(std::chrono::steady_clock::now()) {}
    ~Stopwatch() {
        const std::chrono::duration<float, std::milli> passed = std::chrono::steady_clock::now() - start_;
        times_[static_cast<std::size_t>(stage_)] += passed.count();
    }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

 private:
    StageTimes& times_;
    Stage stage_;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace eyrie

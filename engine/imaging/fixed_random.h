#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace eyrie {

/// While it lives, what OpenCV draws on this thread (k-means does) begins with the same state every time; then the
/// generator goes on where it was.
class FixedRandom {
 public:
    FixedRandom() : before_(cv::theRNG().state) { cv::theRNG().state = 1; }
    ~FixedRandom() { cv::theRNG().state = before_; }
    FixedRandom(const FixedRandom&) = delete;
    FixedRandom& operator=(const FixedRandom&) = delete;

 private:
    std::uint64_t before_;
};

}  // namespace eyrie

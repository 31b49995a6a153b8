#pragma once

#include <cstdint>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <stop_token>
#include <string>
#include <vector>

namespace eyrie {

/// Feature vectors with what they are.
struct TrainingSet {
    cv::Mat1f features;                 ///< one row per sample
    std::vector<std::uint8_t> vehicle;  ///< 1 or 0 per row

    int count() const { return features.rows; }
    int dimension() const { return features.cols; }
};

/// Throws Error(input) unless the sizes agree, every value is finite and both classes have at least `least` samples.
void requireTrainable(const TrainingSet& set, int least);

/// How far a training is.
struct TrainingProgress {
    std::string phase;  ///< for people: "boosting, round 1 of 3"
    double share = 0;   ///< of the phase, 0 … 1
};

/// Lets somebody watch a training and end it early. Calls come one at a time, from any thread.
struct TrainingWatch {
    std::function<void(const TrainingProgress&)> progress;
    std::stop_token stop;

    bool stopped() const { return stop.stop_requested(); }
    void show(const std::string& phase, double share) const {
        if (progress) progress({phase, share});
    }
};

}  // namespace eyrie

#pragma once

#include <opencv2/imgproc.hpp>

#include "learning/classifiers/seeded_random.h"
#include "learning/models/window.h"
#include "learning/training/sample_set.h"

namespace eyrie::test {

/// A window full of noise, for comparing arithmetic.
inline cv::Mat noiseWindow(std::uint64_t seed) {
    SeededRandom random(seed);
    cv::Mat window(kWindowHeight, kWindowWidth, CV_8UC1);
    for (auto& pixel : cv::Mat1b(window)) pixel = static_cast<uchar>(random.below(256));
    return window;
}

/// Ground with a little noise, and on it a bright or dark rectangle the size of a car, or something else.
inline cv::Mat drawnWindow(bool vehicle, SeededRandom& random) {
    cv::Mat window(kWindowHeight, kWindowWidth, CV_8UC1, cv::Scalar(100 + random.below(40)));
    const int tone = random.below(2) == 0 ? 30 + random.below(30) : 200 + random.below(40);
    if (vehicle) {
        const cv::Rect body(3 + random.below(2), 5 + random.below(2), 9, 21);
        cv::rectangle(window, body, cv::Scalar(tone), cv::FILLED);
    } else {
        const cv::Point centre(random.below(kWindowWidth), random.below(kWindowHeight));
        switch (random.below(3)) {
            case 0:  // an edge
                cv::line(window, {0, centre.y}, {kWindowWidth, random.below(kWindowHeight)}, cv::Scalar(tone), 3);
                break;
            case 1:  // a blob
                cv::circle(window, centre, 3 + random.below(4), cv::Scalar(tone), cv::FILLED);
                break;
            default:
                break;
        }
    }
    for (auto& pixel : cv::Mat1b(window)) pixel = cv::saturate_cast<uchar>(pixel + random.below(13) - 6);
    return window;
}

inline SampleSet drawnSamples(int vehicles, int others, std::uint64_t seed) {
    SeededRandom random(seed);
    SampleSet samples;
    for (int i = 0; i < vehicles + others; ++i) {
        const bool vehicle = i < vehicles;
        samples.push_back({drawnWindow(vehicle, random), vehicle, "drawn", "group " + std::to_string(i % 7), false});
    }
    return samples;
}

}  // namespace eyrie::test

#pragma once

#include <cmath>

#include "learning/classifiers/seeded_random.h"
#include "learning/training/training_set.h"

namespace eyrie::test {

/// Six features of which the first two tell the classes apart, with noise; `vehicles` of `count` samples are vehicles.
inline TrainingSet noisySet(int count, int vehicles, std::uint64_t seed, int features = 6) {
    SeededRandom random(seed);
    TrainingSet set{cv::Mat1f(count, features), {}};
    for (int i = 0; i < count; ++i) {
        const int label = static_cast<int>((static_cast<long>(i) * 7919) % count) < vehicles ? 1 : 0;
        set.vehicle.push_back(static_cast<std::uint8_t>(label));
        for (int f = 0; f < features; ++f) {
            const double signal = f == 0 ? 1.1 * label : f == 1 ? -0.6 * label : 0;
            set.features(i, f) = static_cast<float>((f + 1) * (signal + random.between(-1, 1)) + 3 * f);
        }
        if (features > 3) set.features(i, 3) = std::floor(set.features(i, 3));  // few values, with ties
    }
    return set;
}

}  // namespace eyrie::test

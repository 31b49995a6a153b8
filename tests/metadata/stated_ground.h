#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "metadata/ground_view.h"

namespace eyrie::test {

inline const cv::Size kImage(200, 100);
inline constexpr double kPerDegree = 111'319.49;       // metres of longitude at the equator: 6378137 · π / 180
inline constexpr double kNorthPerDegree = 110'574.28;  // of latitude there: 6378137 · (1 − e²) · π / 180

inline MetadataState stateOf(std::vector<MetadataPacket::Number> numbers) {
    MetadataState state;
    std::sort(numbers.begin(), numbers.end(), [](const auto& a, const auto& b) { return a.tag < b.tag; });
    state.numbers = std::move(numbers);
    return state;
}

/// Corners at the equator, metres east and north: upper left, upper right, lower right, lower left.
inline MetadataState cornersAt(const std::array<cv::Point2d, 4>& metres) {
    std::vector<MetadataPacket::Number> numbers;
    for (int i = 0; i < 4; ++i) {
        const cv::Point2d corner = metres[static_cast<std::size_t>(i)];
        numbers.push_back({tag::kCorners + 2 * i, corner.y / kNorthPerDegree});
        numbers.push_back({tag::kCorners + 2 * i + 1, corner.x / kPerDegree});
    }
    return stateOf(numbers);
}

inline const std::array<cv::Point2d, 4> kNorthUp{cv::Point2d(0, 50), {100, 50}, {100, 0}, {0, 0}};

inline void set(MetadataState& state, int tag, double value) {
    std::vector<MetadataPacket::Number> numbers = state.numbers;
    std::erase_if(numbers, [&](const auto& one) { return one.tag == tag; });
    numbers.push_back({tag, value});
    state = stateOf(numbers);
}

}  // namespace eyrie::test

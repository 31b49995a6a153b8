#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace eyrie {

/// Of distances from the mean that are normal with a deviation of 1: their median.
inline constexpr double kMedianOfAbsoluteNormal = 0.6745;

/// The middle value, of an even number the upper one; there must be one.
inline double medianOf(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Robust standard deviation: 1.48 times the median distance to the median.
inline double spreadOf(const std::vector<double>& values) {
    const double middle = medianOf(values);
    std::vector<double> off;
    off.reserve(values.size());
    for (const double value : values) off.push_back(std::abs(value - middle));
    return 1.48 * medianOf(std::move(off));
}

}  // namespace eyrie

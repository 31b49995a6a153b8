#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace eyrie {

/// Of distances from the mean that are normal with a deviation of 1: their median.
inline constexpr double kMedianOfAbsoluteNormal = 0.6745;

/// The smallest of the values that at least a share of them, 0 … 1, do not exceed; there must be one.
inline double quantileOf(std::vector<double> values, double share) {
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(values.size())));
    const auto place = values.begin() + std::max<std::ptrdiff_t>(rank - 1, 0);
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

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

#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace eyrie {

/// Of distances from the mean that are normal with a deviation of 1: their median.
inline constexpr double kMedianOfAbsoluteNormal = 0.6745;

/// The value that a share of the values, 0 … 1, lie below; the upper one between two; there must be one.
inline double quantileOf(std::vector<double> values, double share) {
    const auto below = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
    const auto place = values.begin() + std::min(below, static_cast<std::ptrdiff_t>(values.size()) - 1);
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

/// The middle value, of an even number the upper one; there must be one.
inline double medianOf(std::vector<double> values) {
    return quantileOf(std::move(values), 0.5);
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

#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace eyrie {

/// Fewer corners do not tell how much standing ones seem to move.
constexpr std::size_t kEnoughCorners = 60;

/// The middle of the values, which must not be empty; the upper one of the two when their number is even. Changes their
/// order.
inline float upperMedianOf(std::vector<float>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace eyrie

#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace eyrie::cli {

/// The middle of the values; the upper one of the two when their number is even, 0 when there is none.
inline double medianOf(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace eyrie::cli

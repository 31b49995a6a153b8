#pragma once

#include <cstdint>
#include <vector>

namespace eyrie {

/// One comparator: afterwards place `low` holds the smaller and place `high` the larger of the two, as far as needed.
struct Comparator {
    std::uint16_t low = 0;
    std::uint16_t high = 0;
    bool keep_low = true;   ///< the smaller value is used later
    bool keep_high = true;  ///< the larger value is used later
};

/// Comparators that bring the value of rank `rank` (0 = smallest) of `count` values to place `rank`: Batcher's odd-even
/// merge network with everything left out that this one place does not depend on.
std::vector<Comparator> selectionNetwork(int count, int rank);

}  // namespace eyrie

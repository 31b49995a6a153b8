#pragma once

#include <vector>

namespace eyrie {

/// A possible pair and what it is worth (> 0).
struct WeightedPair {
    int row = 0;
    int column = 0;
    double weight = 0;
};

/// The one-to-one selection of pairs with the largest sum of weights (Hungarian method on each connected part, so
/// scattered objects cost next to nothing). Returns positions in `pairs`, ascending. Rows and columns may stay alone.
std::vector<int> bestAssignment(const std::vector<WeightedPair>& pairs);

}  // namespace eyrie

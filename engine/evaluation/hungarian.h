#pragma once

#include <Eigen/Core>
#include <vector>

namespace eyrie {

/// One-to-one assignment of rows to columns with the largest total score, for matrices of any shape: as many pairs as
/// the shorter side has entries. Shortest augmenting paths with dual variables, O(n² m) for n ≤ m; the same input
/// always gives the same answer. Scores must be finite, else Error(internal).
/// Returns the column of every row, −1 for rows that are left over.
std::vector<int> assignMaximum(const Eigen::MatrixXd& score);

}  // namespace eyrie

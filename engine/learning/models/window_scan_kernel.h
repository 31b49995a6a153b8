#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace eyrie {

/// A boosted tree over rectangle sums of an integral image in memory.
struct ScanTree {
    /// Per node: positions of the rectangle's four corners (upper left, upper right, lower left, lower right) relative
    /// to the window's upper left corner in channel 0.
    std::array<std::array<std::size_t, 4>, 3> offset{};
    std::array<std::uint16_t, 3> threshold{};  ///< a sum ≥ the threshold goes to the right
    std::array<std::int16_t, 4> leaf{};
    std::int32_t rejection_line = 0;  ///< windows whose sum of leaves is below it are given up
};

/// Sums are held against the rejection line after every fourth tree, whatever the machine's vectors can do, so that
/// all machines give up the same windows.
inline constexpr std::size_t kTreesPerCheck = 4;

/// Sums of leaves of `count` neighbouring windows in 1/512, −∞ where given up; `row` is the first window's upper left
/// corner in channel 0. Vectors of neighbours first; once few of them are left, those alone. Reads whole vectors beyond
/// the last window. Returns the number of trees evaluated for windows.
std::int64_t scanRow(const std::uint16_t* row, int count, const std::vector<ScanTree>& trees, float* decision);

}  // namespace eyrie

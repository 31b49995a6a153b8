#pragma once

#include <vector>

#include "registration/pictures/padded_picture.h"

namespace eyrie {

/// Where a picture shows nothing: the constant bars and wedges that letter-boxing and stabilisation leave at its
/// border. Only areas that touch the border and keep one grey level count; a dark street does not.
class PaddingMask {
 public:
    explicit PaddingMask(const PaddedPicture& picture);

    /// Whether the pixel lies in the padding or within 8 px of it. Inside the picture only.
    bool contains(int x, int y) const {
        if (from_left_.empty()) return false;
        const auto column = std::size_t(x);
        const auto row = std::size_t(y);
        return x < from_left_[row] || x >= from_right_[row] || y < from_top_[column] || y >= from_bottom_[column];
    }

 private:
    // Where the picture's content begins and ends in every row and column; empty when nothing is padded.
    std::vector<int> from_left_;
    std::vector<int> from_right_;
    std::vector<int> from_top_;
    std::vector<int> from_bottom_;
};

}  // namespace eyrie

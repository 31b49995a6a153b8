#pragma once

#include <vector>

#include "registration/padded_picture.h"

namespace eyrie {

/// Where a picture shows nothing: the constant bars and wedges that letter-boxing and stabilisation leave at its
/// border. Only areas that touch the border and keep one grey level count; a dark street does not.
class PaddingMask {
 public:
    explicit PaddingMask(const PaddedPicture& picture);

    /// Nothing is padded; `contains` is false everywhere.
    bool empty() const { return padded_.empty(); }
    /// Whether the pixel lies in the padding or within a block (8 px) of it. Inside the picture only.
    bool contains(int x, int y) const {
        return !padded_.empty() &&
               padded_[std::size_t(y / kBlock) * std::size_t(blocks_across_) + std::size_t(x / kBlock)] != 0;
    }

 private:
    static constexpr int kBlock = 8;
    int blocks_across_ = 0;
    std::vector<unsigned char> padded_;  ///< per block, empty when there is no padding
};

}  // namespace eyrie

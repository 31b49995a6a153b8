#pragma once

#include <array>
#include <vector>

#include "annotation/keyframes/box_reader.h"
#include "annotation/keyframes/keyframe_reduction.h"

namespace eyrie {

/// Keyframes to either side of one up to which it has an influence on what is interpolated.
inline constexpr std::size_t kKeyframeReach = 3;

/// The dense boxes that an interpolation must keep to, in ascending frames, ready to be compared again and again.
class DenseBoxes {
 public:
    /// `boxes` and `options` must outlive it.
    DenseBoxes(const std::vector<FrameBox>& boxes, const ReductionOptions& options);

    std::size_t size() const { return boxes_.size(); }
    const FrameBox& operator[](std::size_t i) const { return boxes_[i]; }
    const FrameBox& back() const { return boxes_.back(); }
    /// The first box in this frame or after it; size() behind the last.
    std::size_t from(FrameIndex frame) const;
    /// How far box i is from what an interpolation shows in its frame: 1 at the tolerance, more beyond it.
    double deviation(std::size_t i, BoxReader& shown) const;

 private:
    const std::vector<FrameBox>& boxes_;
    const ReductionOptions& options_;
    std::vector<std::array<cv::Point2d, 4>> corners_;
};

/// How far each of many boxes is off. Finds the worst without looking at all of them.
class Deviations {
 public:
    explicit Deviations(std::size_t count) : values_(count, 0), blocks_((count + kBlock - 1) / kBlock) {}
    double operator[](std::size_t i) const { return values_[i]; }
    void set(std::size_t i, double value);
    /// The first of the largest; there must be one.
    std::size_t worst();

 private:
    static constexpr std::size_t kBlock = 64;
    struct Block {
        double largest = 0;
        bool known = true;
    };
    std::size_t worstOf(std::size_t block) const;
    std::vector<double> values_;
    std::vector<Block> blocks_;
};

}  // namespace eyrie

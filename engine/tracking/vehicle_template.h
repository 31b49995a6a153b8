#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/geometry/oriented_box.h"

namespace eyrie {

/// Where something was compared, and how well it agrees there.
struct LookMatch {
    cv::Point2d centre;  ///< px, of the best place
    double agreement =
        0;  ///< normalised correlation there, −1 … 1: neither brightness nor contrast of the light counts
    double beside = 0;  ///< the best one half a vehicle away
};

/// What a vehicle looked like at one moment: a small grey chip of it and a narrow strip of the ground about it, in the
/// axes of its box. It is never renewed by what is found, so that it cannot come to look like the ground.
class VehicleTemplate {
 public:
    /// Nothing for boxes that leave the image, are tiny, or have no contrast. `gray`: CV_8UC1.
    static std::optional<VehicleTemplate> of(const cv::Mat& gray, const OrientedBox& box);

    /// The best agreement at most `reach` px from the centre of `expected` along each of its axes. Its size may differ
    /// by a zoom of up to two. Nothing when `expected` leaves the image or shows no contrast.
    std::optional<LookMatch> find(const cv::Mat& gray, const OrientedBox& expected, double reach) const;

    /// What is remembered of the frames so far, written or read; see core/state_archive.h.
    template <class Archive>
    void transfer(Archive& archive);

 private:
    cv::Mat chip_;  ///< CV_8UC1, heading up
    OrientedBox box_;
    double step_ = 1;  ///< px of the image it was taken from, a pixel of the chip
};

}  // namespace eyrie

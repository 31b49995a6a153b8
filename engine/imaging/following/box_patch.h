#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/geometry/oriented_box.h"

namespace eyrie {

/// How the inside of a box looks, upright and of a fixed number of samples, brightness and contrast taken out.
class BoxPatch {
 public:
    /// Samples for boxes of about this size; at most 48 along each side.
    static cv::Size samplesFor(const OrientedBox& box);

    BoxPatch() = default;
    /// Samples a picture (CV_8UC1); beyond its border the border's value goes on.
    BoxPatch(const cv::Mat& gray, const OrientedBox& box, cv::Size samples);

    bool empty() const { return values_.empty(); }
    /// Normalised cross-correlation, −1 … 1; 0 when either shows nothing but one grey.
    double correlation(const BoxPatch& other) const;
    /// Share of its parts that look like those of the other one, 0 … 1, each compared by itself, so that what lies in
    /// front of some takes nothing from the rest. Parts in which the other one shows nothing do not count.
    double seenOf(const BoxPatch& other) const;
    /// Blends another patch of the same size in.
    void learn(const BoxPatch& other, double share);

 private:
    void normalise();
    cv::Size samples_;
    std::vector<float> values_;  ///< mean 0, norm 1; all 0 when flat
};

}  // namespace eyrie

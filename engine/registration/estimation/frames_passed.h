#pragma once

#include <deque>
#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>
#include <vector>

#include "registration/corners/corner_set.h"
#include "registration/corners/corner_tracker.h"

namespace eyrie {

/// Over how many frames everything may have moved on to a picture that comes after `repeated` frozen ones, or after
/// missing ones: `most` of them, or one; the likeliest first, alone where the camera tells. `motion`: from the last
/// other picture; `recent`: what the camera did from frame to frame before that.
std::vector<int> framesPassedBy(const cv::Matx33d& motion, const std::deque<cv::Matx33d>& recent, int repeated,
                                int most, cv::Size image);

/// Corners that moved by themselves before, fast enough to tell how many frames have passed.
struct TellingMovers {
    int all = 0;
    int there = 0;  ///< found where they should be
};

/// Of the corners of a picture, found in another one; `to_from` is the camera's motion between them. `elapsed`: frames
/// that are taken to have passed, not `other`.
TellingMovers moversAfter(int elapsed, int other, const CornerSet& set, const std::vector<TrackedPosition>& found,
                          const cv::Matx33d& to_from);

}  // namespace eyrie

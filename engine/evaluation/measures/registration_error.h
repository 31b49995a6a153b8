#pragma once

#include <map>
#include <opencv2/core.hpp>
#include <vector>

#include "core/values/corner.h"

namespace eyrie {

/// For every frame the true map into one common frame (the first, or the ground plane).
using TrueHomographies = std::map<FrameIndex, cv::Matx33d>;

/// Distance between where an estimated and the true map take a grid of points, for one pair of frames.
struct FrameRegistrationError {
    FrameIndex frame = 0;
    double mean_px = 0;
    double rms_px = 0;
    double max_px = 0;
};

/// Registration error over a sequence.
struct RegistrationError {
    std::vector<FrameRegistrationError> frames;  ///< the reliable ones, ascending
    int unregistered = 0;                        ///< frames with a truth whose registration is not reliable
    double mean_px = 0;                          ///< over all grid points of all frames
    double rms_px = 0;
    double max_px = 0;
};

/// Grid error of one estimate at `columns` × `rows` points spread over the image from edge to edge. `estimate` and
/// `truth` take points of one frame to the next.
FrameRegistrationError gridError(const Homography& estimate, const cv::Matx33d& truth, cv::Size image, int columns = 9,
                                 int rows = 7);

/// Compares every registration with the truth of its two frames; frames without a truth are skipped.
RegistrationError registrationError(const std::vector<Registration>& registrations, const TrueHomographies& truth,
                                    cv::Size image);

}  // namespace eyrie

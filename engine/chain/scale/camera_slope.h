#pragma once

#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>
#include <vector>

#include "core/values/corner.h"

namespace eyrie {

/// The way of a camera from picture to picture, as long as registrations are reliable.
class CameraWay {
 public:
    /// Of the next frame; that of the first one has nothing to say.
    void add(const Registration& registration);
    /// The map of each picture into the next one.
    const std::vector<cv::Matx33d>& steps() const { return steps_; }

 private:
    std::vector<cv::Matx33d> steps_;
    bool ended_ = false;
};

/// What the way of the camera over flat ground says of how the scale grows downwards in its pictures, whatever drives
/// there: the growth from the middle of a picture to its lower edge, 1 if a metre covers twice as many pixels there,
/// with a level horizon.
///
/// A camera that flies over a plane sees it move by R + T·nᵀ (R: its turn, T: its way over the distance of the middle,
/// n: the normal of the ground), of which each growth allows its own kind. What a growth costs is how far the
/// registrations are off what it allows, where a turn about the axes of the picture is the less likely the larger it
/// is: on a short way everything could be a turn, so that a camera that hovers says nothing.
class CameraSlope {
 public:
    /// `image`: size of the pictures, px.
    explicit CameraSlope(cv::Size image);

    /// Takes the way through a stretch of frames. Stretches count each for itself, and none for much.
    void add(const std::vector<cv::Matx33d>& steps);
    /// What a growth costs beyond the best one; as the negative logarithm of its likelihood, at most 10 for each
    /// stretch. 0 where nothing is known. Growths beyond −0.9 and 4 cost what these do.
    double cost(double growth) const;

 private:
    cv::Size image_;
    std::vector<double> costs_;  ///< of growths, see growthAt()
};

}  // namespace eyrie

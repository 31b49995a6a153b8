#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "imaging/following/box_follower.h"
#include "tracking/finishing/track_occupancy.h"
#include "tracking/pictures/held_pictures.h"

namespace eyrie {

/// Follows one track on, frame by frame, from one of its states: while the pictures surely show it, it brakes as
/// vehicles do, lies in the image and keeps off other tracks.
class EndFollower {
 public:
    /// `way`: 1 or −1, towards later or earlier frames. `gray` shows it in that state.
    EndFollower(const TimedPathState& from, int way, const cv::Mat& gray, const SceneScale& scale);

    /// Its state in the next frame; nothing where the pictures do not surely show it there.
    std::optional<TimedPathState> next(const HeldPictures& pictures, const GroundMotion& ground,
                                       const TrackOccupancy& taken);

    /// Whether it ended since there is another track where it would go on.
    bool met() const { return met_; }
    /// How many of the states found last are not to be trusted now that it has ended.
    std::size_t doubtful() const { return braked_ ? window_ - 1 : 0; }

 private:
    bool drivesBySight(const BoxFollower::Step& moved, const Homography& map) const;
    bool brakesTooHard(const OrientedBox& box, const Homography& map);
    cv::Point2d meanStep(std::size_t begin, std::size_t end) const;

    int way_;
    PathState state_;
    FrameIndex frame_;
    BoxFollower follower_;
    std::deque<cv::Point2d> steps_;  ///< px over the ground in the picture reached, of twice the window at most
    std::size_t window_ = 0;         ///< frames
    double allowed_change_ = 0;      ///< px/frame
    bool braked_ = false;
    bool met_ = false;
};

}  // namespace eyrie

#include "ground/followed_pose.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace eyrie {
namespace {

constexpr FrameIndex kHalfWindow = 12;

}  // namespace

std::optional<FollowedPose> followedPose(const EventTrack& track, FrameIndex frame, const CameraMotion& camera) {
    const auto earlier = [](const TrackedBox& box, FrameIndex index) { return box.frame < index; };
    const auto here = std::lower_bound(track.boxes.begin(), track.boxes.end(), frame, earlier);
    if (here == track.boxes.end() || here->frame != frame) return std::nullopt;
    FollowedPose pose{here->box.centre, here->box.heading, here->box.length};
    cv::Point2d sum(0, 0);
    for (auto box = std::lower_bound(track.boxes.begin(), track.boxes.end(), frame - kHalfWindow, earlier);
         box != track.boxes.end() && box->frame <= frame + kHalfWindow; ++box) {
        const auto map = camera.map(box->frame, frame);
        if (!map) continue;
        const double heading = map->turned(box->box.centre, box->box.heading);
        const double weight = kHalfWindow + 1 - std::abs(box->frame - frame);
        sum += weight * cv::Point2d(std::cos(heading), std::sin(heading));
    }
    if (std::hypot(sum.x, sum.y) > 1e-9) pose.heading = std::atan2(sum.y, sum.x);
    return pose;
}

}  // namespace eyrie

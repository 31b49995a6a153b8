#include "tracking/pictures/end_follower.h"

#include <algorithm>
#include <cmath>

namespace eyrie {
namespace {

constexpr double kSureLooks = 0.78;         ///< certainty below which the pictures do not surely show it any more
constexpr double kFairLooks = 0.55;         ///< that will do where many corners agree
constexpr double kNearBy = 32;              ///< px, root of the area: so large a vehicle carries many corners …
constexpr int kManyCorners = 12;            ///< … which are so many
constexpr double kSurelyMoves = 1.5;        ///< px/frame over the ground
constexpr double kFollowedInImage = 0.9;    ///< share of the box that must lie in the image
constexpr double kHardestBraking = 10;      ///< m/s²; a box that slides off onto the ground brakes harder
constexpr double kBrakingSeconds = 0.4;     ///< over which that is measured …
constexpr double kBrakingFewestFrames = 3;  ///< … and frames, at least
constexpr double kUsualSeconds = 0.28;      ///< in which a vehicle's motion changes little
constexpr double kStandingPerSecond = 10;   ///< px; up to that it waits
constexpr double kBend = 0.5;               ///< cosine of the turn in that time up to which it is a bend
constexpr double kPlaceError = 1;           ///< px by which both ends of that may be off
constexpr double kJumpShare = 0.25;  ///< of a vehicle's size by which its speed may change in 0.04 s, or in a frame

FollowOptions followOptions(double frame_rate_hz) {
    FollowOptions options;
    options.usual_share = std::min(1 / (kUsualSeconds * frame_rate_hz), 0.5);
    options.max_standing_px = std::min(options.max_standing_px, kStandingPerSecond / frame_rate_hz);
    options.corners_to_grow = kManyCorners;
    options.size_to_grow_px = kNearBy;
    options.max_speed_change_share = kJumpShare * std::clamp(1 / (0.04 * frame_rate_hz), 1.0, 2.0);
    return options;
}

/// On a bend a vehicle keeps its speed.
double changeBetween(cv::Point2d before, cv::Point2d after) {
    const double speed = std::hypot(before.x, before.y);
    const double new_speed = std::hypot(after.x, after.y);
    if (before.dot(after) >= kBend * speed * new_speed) return std::abs(new_speed - speed);
    return std::hypot(after.x - before.x, after.y - before.y);
}

}  // namespace

EndFollower::EndFollower(const TimedPathState& from, int way, const cv::Mat& gray, const SceneScale& scale)
    : way_(way),
      state_(from.second),
      frame_(from.first),
      follower_(from.second.box, gray, followOptions(scale.frame_rate_hz)) {
    const cv::Point2d velocity = cv::Point2d(from.second.velocity) * way;
    follower_.startsWith(velocity);
    const SceneScale here = scale.at(from.first, from.second.box.centre);
    const double frames = std::max(kBrakingFewestFrames, std::round(kBrakingSeconds * here.frame_rate_hz));
    allowed_change_ = here.pxPerFrame(kHardestBraking) / here.frame_rate_hz * frames + kPlaceError / frames;
    window_ = static_cast<std::size_t>(frames);
    steps_.assign(window_, velocity);
}

std::optional<TimedPathState> EndFollower::next(const HeldPictures& pictures, const GroundMotion& ground,
                                                const TrackOccupancy& taken) {
    const FrameIndex to = frame_ + way_;
    const cv::Matx33d* step = ground.step(frame_, to, false);
    const cv::Mat* current = pictures.at(frame_);
    const cv::Mat* picture = pictures.at(to);
    if (!step || !current || !picture || current->size() != picture->size()) return std::nullopt;
    Homography map;
    map.matrix = *step;
    if (ground.elapsed(frame_, to) > 0) {
        const BoxFollower::Step moved = follower_.advance(*current, *picture, map);
        const bool drives = drivesBySight(moved, map);
        if (moved.end || moved.certainty < (drives ? kFairLooks : kSureLooks)) return std::nullopt;
        braked_ = brakesTooHard(moved.box, map) && !drives;
        if (braked_) return std::nullopt;
        state_.box = moved.box;
        state_.velocity = follower_.usualVelocity() * way_;
    }
    if (areaInImage(state_.box, picture->size()) < kFollowedInImage * state_.box.area()) return std::nullopt;
    met_ = !taken.isFree(to, state_.box);
    if (met_) return std::nullopt;
    state_.origin = StateOrigin::reconstructed;
    if (way_ < 0) state_.hits = 0;
    frame_ = to;
    return TimedPathState{to, state_};
}

/// Many corners that move together over the ground are the vehicle's, however its looks and its way change on a
/// bend or near by; what has slid off onto the ground moves with it.
bool EndFollower::drivesBySight(const BoxFollower::Step& moved, const Homography& map) const {
    const cv::Point2d before = map.applyToVector(state_.box.centre, cv::Point2d(state_.velocity) * way_);
    const cv::Point2d way = moved.box.centre - map.apply(state_.box.centre);
    return moved.by_corners && std::hypot(way.x, way.y) >= std::max(kSurelyMoves, 0.5 * std::hypot(before.x, before.y));
}

/// A box that lost its vehicle sticks to the ground, or is taken along by another.
bool EndFollower::brakesTooHard(const OrientedBox& box, const Homography& map) {
    const cv::Point2d before = state_.box.centre;
    for (cv::Point2d& step : steps_) step = map.applyToVector(before, step);
    allowed_change_ *= map.scaleAt(before);
    steps_.push_back(box.centre - map.apply(before));
    if (steps_.size() > 2 * window_) steps_.pop_front();
    return changeBetween(meanStep(0, window_), meanStep(steps_.size() - window_, steps_.size())) > allowed_change_;
}

cv::Point2d EndFollower::meanStep(std::size_t begin, std::size_t end) const {
    cv::Point2d sum(0, 0);
    for (std::size_t i = begin; i < end; ++i) sum += steps_[i];
    return sum * (1.0 / static_cast<double>(end - begin));
}

}  // namespace eyrie

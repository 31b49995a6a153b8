#include "correction/drawn_vehicle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "annotation/keyframes/interpolation.h"
#include "core/geometry/angle.h"

namespace eyrie {
namespace {

constexpr double kUsualShape = 2.2;  ///< length to width, where the box does not tell

/// Length and width of a vehicle whose upright bounding box, turned by `turn` from its heading, has these sides.
cv::Size2d sidesWithin(double along, double across, double turn) {
    const double c = std::abs(std::cos(turn)), s = std::abs(std::sin(turn));
    const double sum = (along + across) / (c + s);
    double length = sum * kUsualShape / (1 + kUsualShape);
    constexpr double kTells = 0.3;  // near the diagonal, every shape fills the same box
    if (std::abs(c - s) > kTells) length = (sum + (along - across) / (c - s)) / 2;
    // Neither needles nor what drives sideways.
    length = std::clamp(length, sum * 0.5, sum * 0.8);
    return {length, sum - length};
}

}  // namespace

std::vector<Sighting> turnedIntoMotion(std::vector<Sighting> sightings, const CameraMotion& camera) {
    if (sightings.size() < 2) return sightings;
    // Over a box length, jitter no longer tells a direction.
    const double reach = std::max(sightings.front().box.length, sightings.front().box.width);
    cv::Point2d turn(0, 0);
    for (std::size_t from = 0, to = 0; to < sightings.size(); ++to) {
        const Sighting &a = sightings[from], &b = sightings[to];
        if (!camera.connects(a.frame, b.frame)) {
            from = to;
            continue;
        }
        const cv::Point2d way = b.box.centre - carriedPoint(a.box.centre, a.frame, b.frame, camera);
        const double far = std::hypot(way.x, way.y);
        if (far < reach) continue;
        const double angle = std::atan2(way.y, way.x) - b.box.heading;
        turn += cv::Point2d(std::cos(angle), std::sin(angle)) * far;
        from = to;
    }
    if (turn == cv::Point2d(0, 0)) return sightings;
    const double angle = std::atan2(turn.y, turn.x);
    for (Sighting& each : sightings) {
        const cv::Size2d sides = sidesWithin(each.box.length, each.box.width, angle);
        each.box.length = sides.width;
        each.box.width = sides.height;
        each.box.heading = wrapPi(each.box.heading + angle);
    }
    return sightings;
}

DrawnVehicle followBothWays(const OrientedBox& box, FrameIndex frame, FrameIndex first, FrameIndex last,
                            const GrayFrames& gray, const CameraMotion& camera,
                            const std::function<void(const DrawnVehicleAdvance&)>& progress,
                            const std::stop_token& stop) {
    int done = 0;
    const FollowProgress told = [&](const FollowedBox& followed) {
        const bool backwards = followed.frame < frame;
        const int forwards_left = backwards ? 0 : last - followed.frame;
        const int backwards_left = std::min(followed.frame, frame) - first;
        if (progress) progress({followed.frame, backwards, ++done, forwards_left + backwards_left});
    };
    const FollowResult after = followBox(box, frame, last, gray, camera, {}, told, stop);
    const FollowResult before = followBox(box, frame, first, gray, camera, {}, told, stop);
    DrawnVehicle vehicle;
    for (auto each = before.boxes.rbegin(); each != before.boxes.rend(); ++each)
        vehicle.sightings.push_back({each->frame, each->box});
    vehicle.sightings.push_back({frame, box});
    for (const FollowedBox& each : after.boxes) vehicle.sightings.push_back({each.frame, each.box});
    vehicle.sightings = turnedIntoMotion(std::move(vehicle.sightings), camera);
    vehicle.ended_before = before.reason;
    vehicle.ended_after = after.reason;
    return vehicle;
}

}  // namespace eyrie

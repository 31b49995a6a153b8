#include <algorithm>

#include "core/geometry/oriented_box.h"
#include "scene/portable_math.h"
#include "scene/traffic/traffic.h"

namespace eyrie {
namespace {

constexpr FrameIndex kLookEvery = 4;  ///< frames
constexpr double kTouching = 0.2;     ///< m²

/// The footprint at a frame; false before and after its life.
bool footprintAt(const MovingObject& object, FrameIndex frame, OrientedBox& box) {
    const FrameIndex place = frame - object.first_frame;
    if (!isVehicle(object.look.kind) || place < 0 || place >= static_cast<FrameIndex>(object.poses.size()))
        return false;
    const ObjectPose& pose = object.poses[static_cast<std::size_t>(place)];
    box = {pose.position, object.look.length, object.look.width,
           portable::arcTangent(pose.direction.y, pose.direction.x)};
    return true;
}

bool collide(const MovingObject& a, const MovingObject& b) {
    const FrameIndex from = std::max(a.first_frame, b.first_frame);
    const FrameIndex to = std::min(a.first_frame + static_cast<FrameIndex>(a.poses.size()),
                                   b.first_frame + static_cast<FrameIndex>(b.poses.size()));
    for (FrameIndex frame = from; frame < to; frame += kLookEvery) {
        OrientedBox mine;
        OrientedBox other;
        if (!footprintAt(a, frame, mine) || !footprintAt(b, frame, other)) continue;
        const cv::Point2d way = other.centre - mine.centre;
        const double reach = mine.length + other.length;
        if (way.dot(way) < reach * reach && intersectionArea(mine, other) > kTouching) return true;
    }
    return false;
}

}  // namespace

void dropColliding(std::vector<MovingObject>& objects) {
    std::vector<MovingObject> kept;
    for (MovingObject& object : objects) {
        const bool clear =
            std::none_of(kept.begin(), kept.end(), [&](const MovingObject& other) { return collide(object, other); });
        if (clear) kept.push_back(std::move(object));
    }
    objects = std::move(kept);
}

std::vector<MovingObject> everyNth(const std::vector<MovingObject>& objects, int step) {
    std::vector<MovingObject> seen;
    for (const MovingObject& object : objects) {
        MovingObject coarse;
        coarse.id = object.id;
        coarse.look = object.look;
        coarse.first_frame = (object.first_frame + step - 1) / step;
        const int first = coarse.first_frame * step - object.first_frame;
        for (int i = first; i < static_cast<int>(object.poses.size()); i += step)
            coarse.poses.push_back(object.poses[static_cast<std::size_t>(i)]);
        if (!coarse.poses.empty()) seen.push_back(std::move(coarse));
    }
    return seen;
}

}  // namespace eyrie

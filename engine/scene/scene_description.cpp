#include "scene/scene_description.h"

#include <algorithm>
#include <cmath>

#include "scene/random.h"

namespace eyrie {

const char* nameOf(ObjectKind kind) {
    switch (kind) {
        case ObjectKind::car:
            return "car";
        case ObjectKind::van:
            return "van";
        case ObjectKind::truck:
            return "truck";
        case ObjectKind::bus:
            return "bus";
        case ObjectKind::motorcycle:
            return "motorcycle";
        case ObjectKind::bicycle:
            return "bicycle";
        case ObjectKind::person:
            return "person";
    }
    return "other";
}

bool isVehicle(ObjectKind kind) {
    return kind == ObjectKind::car || kind == ObjectKind::van || kind == ObjectKind::truck || kind == ObjectKind::bus;
}

void loseFrames(SceneDescription& scene, double share) {
    Random random(scene.seed * 7919U + 17U);
    const FrameIndex last = scene.frame_count - 1;
    scene.shown.clear();
    FrameIndex clock = 0;
    int frozen = 0;
    FrameIndex late = 0;
    for (FrameIndex frame = 0; frame < scene.frame_count; ++frame) {
        if (frame > 0 && frozen == 0) {
            ++clock;
            // Events last two frames on average.
            if (random.chance(share / 2)) {
                const int length = 1 + random.below(3);
                if (random.chance(0.5)) {
                    frozen = length;
                } else {
                    clock += length;
                }
            }
            clock += late;
            late = 0;
        } else if (frozen > 0) {
            // The link was cut, not the clock: the picture jumps when it comes back.
            --frozen;
            ++late;
        }
        scene.shown.push_back(std::min(clock, last));
    }
}

cv::Rect2d mapArea(const SceneDescription& scene) {
    cv::Rect2d area = groundSeen(scene.camera, scene.frame_count);
    area.x -= scene.map_margin;
    area.y -= scene.map_margin;
    area.width += 2 * scene.map_margin;
    area.height += 2 * scene.map_margin;
    return area;
}

FrameIndex clockFrame(const SceneDescription& scene, FrameIndex frame) {
    if (scene.shown.empty()) return frame;
    return scene.shown[static_cast<std::size_t>(std::clamp(frame, 0, static_cast<int>(scene.shown.size()) - 1))];
}

bool poseAt(const MovingObject& object, double frame, ObjectPose& pose) {
    const double place = frame - object.first_frame;
    const double last = static_cast<double>(object.poses.size()) - 1;
    // Half a frame beyond the ends still belongs to the exposure of the first and last picture.
    if (object.poses.empty() || place < -0.5 || place > last + 0.5) return false;
    const double inside = std::clamp(place, 0.0, last);
    const auto from = static_cast<std::size_t>(inside);
    const std::size_t to = std::min(from + 1, object.poses.size() - 1);
    const double share = inside - static_cast<double>(from);
    const ObjectPose& a = object.poses[from];
    const ObjectPose& b = object.poses[to];
    pose.position = a.position * (1 - share) + b.position * share;
    const cv::Point2d mixed = a.direction * (1 - share) + b.direction * share;
    const double norm = std::sqrt(mixed.x * mixed.x + mixed.y * mixed.y);
    pose.direction = norm > 1e-9 ? mixed * (1 / norm) : a.direction;
    pose.speed = a.speed * (1 - share) + b.speed * share;
    return true;
}

}  // namespace eyrie

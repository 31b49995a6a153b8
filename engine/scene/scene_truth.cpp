#include "scene/scene_truth.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/homography.h"
#include "scene/traffic/vehicle_shape.h"

namespace eyrie {
namespace {

constexpr double kStandingSpeed = 0.3;  ///< m/s
constexpr int kSpeedReach = 10;         ///< frames before and after
constexpr double kLeastInside = 0.6;
constexpr double kLeastVisible = 0.4;

/// Whether a ball of leaves lies on the line of sight.
bool hides(const Ball& ball, cv::Point3d from, cv::Point3d direction) {
    const cv::Point3d offset = ball.centre - from;
    const double along = offset.dot(direction);
    if (along <= 0) return false;
    return offset.dot(offset) - along * along < ball.radius * ball.radius;
}

/// Whether a face that looks to the camera is pierced by the line of sight.
bool hides(const Face& face, cv::Point3d from, cv::Point3d direction) {
    const cv::Point3d& normal = face.normal;
    const double slope = normal.dot(direction);
    if (slope <= 1e-9) return false;
    const double along = normal.dot(face.corners.front() - from) / slope;
    if (along <= 1e-6) return false;
    const cv::Point3d hit = from + direction * along;
    for (std::size_t i = 0; i < face.corners.size(); ++i) {
        const cv::Point3d& a = face.corners[i];
        const cv::Point3d edge = face.corners[(i + 1) % face.corners.size()] - a;
        const cv::Point3d to_hit = hit - a;
        if (edge.cross(to_hit).dot(normal) < 0) return false;
    }
    return true;
}

/// Whether the line of sight passes the ball around a whole thing.
bool comesNear(const StandingThing& thing, cv::Point3d from, cv::Point3d direction) {
    const cv::Point3d offset = cv::Point3d(thing.centre.x, thing.centre.y, thing.height / 2) - from;
    const double along = offset.dot(direction);
    const double radius_squared = thing.reach * thing.reach + thing.height * thing.height / 4;
    return offset.dot(offset) - along * along <= radius_squared;
}

bool hides(const StandingThing& thing, cv::Point3d from, cv::Point3d direction) {
    if (!comesNear(thing, from, direction)) return false;
    return std::any_of(thing.balls.begin(), thing.balls.end(),
                       [&](const Ball& ball) { return hides(ball, from, direction); }) ||
           std::any_of(thing.mesh.faces.begin(), thing.mesh.faces.end(),
                       [&](const Face& face) { return hides(face, from, direction); });
}

/// Mean speed around a frame, m/s.
double speedAround(const MovingObject& object, FrameIndex clock, double frame_rate) {
    const FrameIndex last = object.first_frame + static_cast<FrameIndex>(object.poses.size()) - 1;
    const FrameIndex from = std::max(object.first_frame, clock - kSpeedReach);
    const FrameIndex to = std::min(last, clock + kSpeedReach);
    if (to <= from) return 0;
    ObjectPose a;
    ObjectPose b;
    poseAt(object, from, a);
    poseAt(object, to, b);
    const cv::Point2d way = b.position - a.position;
    return std::sqrt(way.dot(way)) * frame_rate / (to - from);
}

}  // namespace

SceneTruth::SceneTruth(const SceneDescription& scene, const std::vector<StandingThing>& things)
    : scene_(scene), things_(things) {
    for (const MovingObject& object : scene.objects) {
        std::vector<cv::Point3d> corners;
        for (const Face& face : bodyOf(object.look).faces)
            corners.insert(corners.end(), face.corners.begin(), face.corners.end());
        bodies_.push_back(std::move(corners));
    }
}

std::vector<SceneObject> SceneTruth::objects(FrameIndex frame) const {
    return collect(clockFrame(scene_, frame), true);
}

std::vector<SceneObject> SceneTruth::objectsOnOpenGround(FrameIndex clock) const {
    return collect(clock, false);
}

std::vector<SceneObject> SceneTruth::collect(FrameIndex clock, bool with_visibility) const {
    const CameraPose camera = scene_.camera.at(clock);
    Homography image_from_ground;
    image_from_ground.matrix = camera.imageFromGround();
    std::vector<SceneObject> found;
    for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
        const MovingObject& object = scene_.objects[i];
        ObjectPose pose;
        // Only whole frames of its life count; the half frames beyond serve motion blur.
        if (clock < object.first_frame || clock >= object.first_frame + static_cast<FrameIndex>(object.poses.size()))
            continue;
        if (!poseAt(object, clock, pose)) continue;
        if (camera.depth({pose.position.x, pose.position.y, 0}) < 1) continue;
        const cv::Point2d heading = image_from_ground.applyToVector(pose.position, pose.direction);
        std::vector<cv::Point2d> seen;
        seen.reserve(bodies_[i].size());
        for (const cv::Point3d& corner : bodies_[i]) seen.push_back(camera.project(placed(corner, pose)));

        SceneObject truth;
        truth.id = object.id;
        truth.kind = object.look.kind;
        truth.box = boxAround(seen, std::atan2(heading.y, heading.x));
        const double area = truth.box.area();
        truth.inside = area > 0 ? areaInImage(truth.box, scene_.image_size) / area : 0;
        if (truth.inside < 0.02) continue;
        truth.speed = speedAround(object, clock, scene_.frame_rate_hz);
        truth.velocity = heading * (pose.speed / scene_.frame_rate_hz);
        if (with_visibility) truth.visibility = visibilityOf(object, pose, camera.position);
        truth.ignore = truth.speed < kStandingSpeed || truth.inside < kLeastInside ||
                       truth.visibility < kLeastVisible ||
                       std::max(truth.box.length, truth.box.width) < scene_.least_length_px;
        found.push_back(truth);
    }
    std::sort(found.begin(), found.end(), [](const SceneObject& a, const SceneObject& b) { return a.id < b.id; });
    return found;
}

double SceneTruth::visibilityOf(const MovingObject& object, const ObjectPose& pose, cv::Point3d camera) const {
    // Only what stands near the line of sight can hide the object.
    const cv::Point2d away = cv::Point2d(camera.x, camera.y) - pose.position;
    const double lean = std::sqrt(away.dot(away)) / camera.z;
    std::vector<const StandingThing*> near;
    for (const StandingThing& thing : things_) {
        if (thing.height <= object.look.height) continue;
        const cv::Point2d offset = thing.centre - pose.position;
        if (std::sqrt(offset.dot(offset)) < thing.reach + object.look.length + lean * thing.height)
            near.push_back(&thing);
    }
    if (near.empty()) return 1;
    constexpr int kAlong = 11;
    constexpr int kAcross = 5;
    int hidden = 0;
    for (int i = 0; i < kAlong; ++i) {
        for (int k = 0; k < kAcross; ++k) {
            const cv::Point3d local(((i + 0.5) / kAlong - 0.5) * object.look.length,
                                    ((k + 0.5) / kAcross - 0.5) * object.look.width, object.look.height * 0.75);
            const cv::Point3d from = placed(local, pose);
            cv::Point3d direction = camera - from;
            direction *= 1 / std::sqrt(direction.dot(direction));
            const bool covered = std::any_of(
                near.begin(), near.end(), [&](const StandingThing* thing) { return hides(*thing, from, direction); });
            hidden += covered ? 1 : 0;
        }
    }
    return 1 - static_cast<double>(hidden) / (kAlong * kAcross);
}

}  // namespace eyrie

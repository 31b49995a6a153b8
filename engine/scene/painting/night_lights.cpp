#include "scene/painting/night_lights.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/traffic/path.h"
#include "scene/traffic/vehicle_shape.h"

namespace eyrie {

cv::Point2d lightOf(const LampPost& post) {
    return post.position + post.arm * post.arm_length;
}

double lampLight(cv::Point2d away, double height) {
    const double squared = away.dot(away);
    if (squared > kLampReach * kLampReach) return 0;
    // A lamp that shines alike to all sides below it, fading out towards its reach.
    const double share = 1 / (1 + squared / (height * height));
    return share * std::sqrt(share) * (1 - squared / (kLampReach * kLampReach));
}

double lampLightAt(const SceneDescription& scene, cv::Point2d point) {
    double light = 0;
    for (const LampPost& post : scene.posts) light += lampLight(point - lightOf(post), post.height);
    return std::min(1.0, light * scene.night.lamp_strength);
}

std::vector<Ball> lampsOf(const ObjectLook& look, const ObjectPose& pose) {
    std::vector<Ball> lamps;
    if (look.kind == ObjectKind::person) return lamps;
    const bool two = isVehicle(look.kind);
    const double front = look.length / 2;
    for (const double side : {-1.0, 1.0}) {
        const double across = two ? side * look.width * 0.36 : 0;
        const double head_size = look.kind == ObjectKind::bicycle ? 0.06 : 0.2;
        lamps.push_back({placed(cv::Point3d(front + 0.1, across, 0.68), pose), head_size, {255, 250, 240}, true});
        // Every third driver brakes.
        const float red = look.seed % 3 == 0 ? 255.0F : 170.0F;
        lamps.push_back({placed(cv::Point3d(-front - 0.08, across, 0.85), pose), 0.13, {40, 40, red}, true});
        if (!two) break;
    }
    return lamps;
}

std::vector<std::pair<std::vector<cv::Point2d>, double>> beamsOf(const ObjectLook& look, const ObjectPose& pose) {
    std::vector<std::pair<std::vector<cv::Point2d>, double>> beams;
    if (!isVehicle(look.kind) && look.kind != ObjectKind::motorcycle) return beams;
    static constexpr std::array<double, 7> reaches{5, 7.5, 10.5, 14, 18, 23, 29};
    for (const double reach : reaches) {
        const double near = look.length / 2 + 0.6 + 0.03 * reach;
        const double far = look.length / 2 + reach;
        const double half = look.width * 0.42;
        const double wide = half + 0.13 * reach;
        std::vector<cv::Point2d> outline;
        for (const cv::Point2d p :
             {cv::Point2d(near, -half), cv::Point2d(near + 0.55 * reach, -wide), cv::Point2d(far, -wide * 0.6),
              cv::Point2d(far, wide * 0.6), cv::Point2d(near + 0.55 * reach, wide), cv::Point2d(near, half)}) {
            outline.push_back(pose.position + pose.direction * p.x + rightOf(pose.direction) * p.y);
        }
        beams.emplace_back(std::move(outline), 1.0 / reaches.size());
    }
    return beams;
}

}  // namespace eyrie

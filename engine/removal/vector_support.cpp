#include "removal/vector_support.h"

#include <algorithm>
#include <cmath>

namespace eyrie {
namespace {

/// px; a box drawn around vectors ends exactly on the outermost ones, which rotations must not push out.
constexpr double kRounding = 1e-3;

}  // namespace

bool similarVelocity(cv::Point2d a, cv::Point2d b, double floor, double share) {
    const double difference = std::hypot(a.x - b.x, a.y - b.y);
    return difference <= std::max(floor, share * std::max(std::hypot(a.x, a.y), std::hypot(b.x, b.y)));
}

void measureSupport(Detection& detection, const FrameMotion& motion, const SupportRule& rule) {
    const double speed = std::hypot(detection.velocity.x, detection.velocity.y);
    const double allowed = std::max(rule.velocity_floor_px, rule.velocity_share * speed);
    const double reach = std::hypot(detection.box.length, detection.box.width) / 2 + 2 * rule.margin_px;
    detection.vectors.clear();
    cv::Point2d sum(0, 0);
    for (std::size_t i = 0; i < motion.motion_vectors.size(); ++i) {
        const MotionVector& vector = motion.motion_vectors[i];
        const cv::Point2d position = vector.position;
        if (std::abs(position.x - detection.box.centre.x) > reach) continue;
        if (std::abs(position.y - detection.box.centre.y) > reach) continue;
        if (!detection.box.contains(position, std::max(rule.margin_px, kRounding))) continue;
        const cv::Point2d velocity = vector.velocity;
        if (rule.compare_velocity &&
            std::hypot(velocity.x - detection.velocity.x, velocity.y - detection.velocity.y) > allowed)
            continue;
        detection.vectors.push_back(static_cast<int>(i));
        sum += velocity;
    }
    if (!detection.vectors.empty()) detection.velocity = sum / static_cast<double>(detection.vectors.size());
}

}  // namespace eyrie

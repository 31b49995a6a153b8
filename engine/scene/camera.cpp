#include "scene/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/error.h"
#include "core/geometry/angle.h"
#include "scene/portable_math.h"
#include "scene/random.h"

namespace eyrie {
namespace {

/// Cubic through four keys' values with slopes from their neighbours (Catmull–Rom for uneven times).
double smooth(const std::array<double, 4>& times, const std::array<double, 4>& values, double time) {
    const double span = times[2] - times[1];
    const double share = (time - times[1]) / span;
    const double slope_from = times[2] > times[0] ? (values[2] - values[0]) / (times[2] - times[0]) : 0;
    const double slope_to = times[3] > times[1] ? (values[3] - values[1]) / (times[3] - times[1]) : 0;
    const double s2 = share * share;
    const double s3 = s2 * share;
    return (2 * s3 - 3 * s2 + 1) * values[1] + (s3 - 2 * s2 + share) * span * slope_from +
           (3 * s2 - 2 * s3) * values[2] + (s3 - s2) * span * slope_to;
}

CameraKey between(const std::vector<CameraKey>& keys, double frame) {
    if (keys.empty()) throw Error(ErrorKind::internal, "A camera path needs at least one key.");
    if (frame <= keys.front().frame) return keys.front();
    if (frame >= keys.back().frame) return keys.back();
    std::size_t next = 1;
    while (keys[next].frame < frame) ++next;
    const std::array<const CameraKey*, 4> around{&keys[next >= 2 ? next - 2 : 0], &keys[next - 1], &keys[next],
                                                 &keys[std::min(next + 1, keys.size() - 1)]};
    const auto value = [&](auto member) {
        std::array<double, 4> times{};
        std::array<double, 4> values{};
        for (std::size_t i = 0; i < 4; ++i) {
            times[i] = around[i]->frame;
            values[i] = member(*around[i]);
        }
        return smooth(times, values, frame);
    };
    CameraKey key;
    key.frame = frame;
    key.target.x = value([](const CameraKey& k) { return k.target.x; });
    key.target.y = value([](const CameraKey& k) { return k.target.y; });
    key.height = value([](const CameraKey& k) { return k.height; });
    key.heading = value([](const CameraKey& k) { return k.heading; });
    key.tilt = value([](const CameraKey& k) { return k.tilt; });
    key.focal_px = value([](const CameraKey& k) { return k.focal_px; });
    return key;
}

/// Sum of sines with random phases in a band of frequencies; deviation 1.
double bandNoise(double seconds, double low_hz, double high_hz, std::uint32_t seed) {
    constexpr int waves = 7;
    double sum = 0;
    double power = 0;
    for (std::uint32_t i = 0; i < waves; ++i) {
        const double u = hashOf(i, 1, seed) / 4294967296.0;
        const double phase = hashOf(i, 2, seed) / 4294967296.0 * 2 * kPi;
        const double frequency = low_hz + (high_hz - low_hz) * (i + u) / waves;
        const double height = 1 / (1 + frequency / low_hz);
        sum += height * portable::sine(2 * kPi * frequency * seconds + phase);
        power += height * height / 2;
    }
    return sum / std::sqrt(power);
}

cv::Matx33d turnAbout(int axis, double angle) {
    const double c = portable::cosine(angle);
    const double s = portable::sine(angle);
    cv::Matx33d turn = cv::Matx33d::eye();
    const int a = (axis + 1) % 3;
    const int b = (axis + 2) % 3;
    turn(a, a) = c;
    turn(b, b) = c;
    turn(a, b) = -s;
    turn(b, a) = s;
    return turn;
}

}  // namespace

cv::Point2d CameraPose::project(cv::Point3d point) const {
    const cv::Vec3d seen = camera_from_world_turn * cv::Vec3d(point - position);
    return {principal.x + focal_px * seen[0] / seen[2], principal.y + focal_px * seen[1] / seen[2]};
}

double CameraPose::depth(cv::Point3d point) const {
    const cv::Vec3d offset(point - position);
    return camera_from_world_turn.row(2).dot(offset.t());
}

cv::Matx33d CameraPose::imageFromGround() const {
    const cv::Matx33d intrinsics(focal_px, 0, principal.x, 0, focal_px, principal.y, 0, 0, 1);
    const cv::Vec3d shift = camera_from_world_turn * cv::Vec3d(-position);
    cv::Matx33d columns = camera_from_world_turn;
    for (int row = 0; row < 3; ++row) columns(row, 2) = shift[row];
    return intrinsics * columns;
}

CameraPose CameraPath::at(double frame) const {
    const CameraKey key = between(keys, frame);
    const double c = portable::cosine(key.heading);
    const double s = portable::sine(key.heading);
    const cv::Vec3d right(c, s, 0);
    const cv::Vec3d back(-s, c, 0);
    const cv::Vec3d down(0, 0, -1);
    const double ct = portable::cosine(key.tilt);
    const double st = portable::sine(key.tilt);
    const cv::Vec3d view = down * ct - back * st;
    const cv::Vec3d image_down = back * ct + down * st;
    const cv::Matx33d turn(right[0], right[1], right[2], image_down[0], image_down[1], image_down[2], view[0], view[1],
                           view[2]);

    const double seconds = frame / frame_rate_hz;
    const auto wobble = [&](std::uint32_t axis) {
        return (shake.sway_px * bandNoise(seconds, 0.2, 1.0, shake.seed * 16 + axis) +
                shake.vibration_px * bandNoise(seconds, 2.0, 9.0, shake.seed * 16 + 8 + axis)) /
               key.focal_px;
    };
    CameraPose pose;
    pose.camera_from_world_turn = turnAbout(0, wobble(0)) * turnAbout(1, wobble(1)) *
                                  turnAbout(2, shake.roll * bandNoise(seconds, 0.3, 4.0, shake.seed * 16 + 2)) * turn;
    const double reach = key.height * st / ct;
    pose.position = {key.target.x + back[0] * reach, key.target.y + back[1] * reach, key.height};
    pose.focal_px = key.focal_px;
    pose.principal = {(image_size.width - 1) / 2.0, (image_size.height - 1) / 2.0};
    return pose;
}

cv::Rect2d groundSeen(const CameraPath& path, int frame_count) {
    double left = 1e300;
    double top = 1e300;
    double right = -1e300;
    double bottom = -1e300;
    for (int frame = 0; frame < frame_count; ++frame) {
        const cv::Matx33d ground_from_image = path.at(frame).imageFromGround().inv();
        for (const double x : {-1.0, static_cast<double>(path.image_size.width)}) {
            for (const double y : {-1.0, static_cast<double>(path.image_size.height)}) {
                const cv::Vec3d p = ground_from_image * cv::Vec3d(x, y, 1);
                left = std::min(left, p[0] / p[2]);
                right = std::max(right, p[0] / p[2]);
                top = std::min(top, p[1] / p[2]);
                bottom = std::max(bottom, p[1] / p[2]);
            }
        }
    }
    return {left, top, right - left, bottom - top};
}

}  // namespace eyrie

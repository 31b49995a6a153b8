#pragma once

#include <cmath>
#include <functional>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "annotation/keyframes/camera_motion.h"
#include "core/labels/annotation.h"

/// A flat ground seen by a moving camera, for the tests of labelling.
namespace eyrie::test {

/// A ground or a roof with something to follow on it; the larger `blur` (px), the coarser. `darkest` … `brightest`:
/// grey.
inline cv::Mat groundTexture(cv::Size size, int seed, double blur, double darkest = 40, double brightest = 200) {
    cv::Mat picture(size, CV_8UC1);
    cv::RNG dice(static_cast<std::uint64_t>(seed));
    dice.fill(picture, cv::RNG::UNIFORM, 0, 256);
    cv::GaussianBlur(picture, picture, {}, blur);
    cv::normalize(picture, picture, darkest, brightest, cv::NORM_MINMAX);
    return picture;
}

/// frame_from_ground: similarity that pans, turns and zooms.
inline cv::Matx33d flyingView(double frame) {
    const double angle = 0.004 * frame;
    const double scale = 1 + 0.002 * frame;
    const double c = scale * std::cos(angle);
    const double s = scale * std::sin(angle);
    return {c, -s, 3.0 * frame, s, c, -2.0 * frame + 20 * std::sin(frame / 7), 0, 0, 1};
}

/// Steps between the frames [0, last] of a camera that sees the ground as `view` says.
inline std::vector<Homography> stepsOf(const std::function<cv::Matx33d(double)>& view, int last) {
    std::vector<Homography> steps;
    for (int frame = 1; frame <= last; ++frame) {
        Homography step;
        step.matrix = view(frame) * view(frame - 1).inv();
        step.matrix = step.matrix * (1 / step.matrix(2, 2));
        step.from_frame = frame - 1;
        step.to_frame = frame;
        steps.push_back(step);
    }
    return steps;
}

/// The camera of homography.csv, from maps of each frame into one common frame.
inline CameraMotion cameraOf(const std::vector<Homography>& common_from_frame) {
    std::vector<Homography> steps;
    for (std::size_t i = 1; i < common_from_frame.size(); ++i) {
        Homography step;
        step.matrix = common_from_frame[i].matrix.inv() * common_from_frame[i - 1].matrix;
        step.from_frame = common_from_frame[i - 1].from_frame;
        step.to_frame = common_from_frame[i].from_frame;
        steps.push_back(step);
    }
    return CameraMotion(steps);
}

/// A box on the ground as a frame shows it.
inline OrientedBox seen(const OrientedBox& on_ground, const cv::Matx33d& frame_from_ground) {
    Homography map;
    map.matrix = frame_from_ground;
    OrientedBox box;
    box.centre = map.apply(on_ground.centre);
    const double scale = map.scaleAt(on_ground.centre);
    box.length = on_ground.length * scale;
    box.width = on_ground.width * scale;
    box.heading = map.turned(on_ground.centre, on_ground.heading);
    return box;
}

inline Keyframe keyframe(FrameIndex frame, const OrientedBox& box, bool heading_set = false) {
    Keyframe result;
    result.frame = frame;
    result.box = box;
    result.heading_set = heading_set;
    return result;
}

inline LabelledObject object(ObjectId id, std::vector<Keyframe> keyframes, FrameIndex last_frame) {
    LabelledObject result;
    result.id = id;
    result.keyframes = std::move(keyframes);
    result.last_frame = last_frame;
    return result;
}

/// Largest distance between corresponding corners.
inline double cornerDistance(const OrientedBox& a, const OrientedBox& b) {
    double worst = 0;
    const auto p = a.corners();
    const auto q = b.corners();
    for (std::size_t i = 0; i < 4; ++i) worst = std::max(worst, std::hypot(p[i].x - q[i].x, p[i].y - q[i].y));
    return worst;
}

}  // namespace eyrie::test

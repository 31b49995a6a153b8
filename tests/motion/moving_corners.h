#pragma once

#include <cmath>
#include <opencv2/core.hpp>
#include <random>
#include <vector>

#include "core/values/corner.h"
#include "core/values/frame.h"

namespace eyrie::test {

/// A patch of corners that moves over the ground.
struct MovingPatch {
    cv::Point2d centre{0, 0};    ///< ground px in frame 0
    cv::Point2d velocity{0, 0};  ///< px/frame
    double length = 20;          ///< px along x
    double width = 10;           ///< px along y
    int corners = 24;
    double turn = 0;  ///< radians/frame by which the velocity turns

    /// Way over the ground since frame 0.
    cv::Point2d way(int frames) const {
        cv::Point2d sum(0, 0);
        for (int t = 0; t < frames; ++t) sum += velocityAt(t);
        return sum;
    }
    /// From frame t to the next.
    cv::Point2d velocityAt(int t) const {
        const double c = std::cos(turn * t);
        const double s = std::sin(turn * t);
        return {c * velocity.x - s * velocity.y, s * velocity.x + c * velocity.y};
    }
};

/// Corners of a synthetic scene with known motion under a camera that shifts, turns and zooms; ids ascend: background
/// first, then the patches in order.
class MovingCorners {
 public:
    MovingCorners(std::vector<MovingPatch> patches, double noise, unsigned seed = 1, int background = 1500)
        : patches_(std::move(patches)), noise_(0, noise), random_(seed) {
        std::uniform_real_distribution<double> x(-50, 690);
        std::uniform_real_distribution<double> y(-50, 530);
        for (int i = 0; i < background; ++i) ground_.emplace_back(x(random_), y(random_));
        for (const MovingPatch& patch : patches_) {
            std::uniform_real_distribution<double> u(-patch.length / 2, patch.length / 2);
            std::uniform_real_distribution<double> v(-patch.width / 2, patch.width / 2);
            std::vector<cv::Point2d> points;
            for (int i = 0; i < patch.corners; ++i)
                points.push_back(patch.centre + cv::Point2d(u(random_), v(random_)));
            points_.push_back(points);
        }
    }

    /// Image from ground of frame t.
    static cv::Matx33d camera(int t) {
        const double turn = 0.004 * t;
        const double zoom = 1 + 0.001 * t;
        const double c = zoom * std::cos(turn);
        const double s = zoom * std::sin(turn);
        return {c, -s, 1.7 * t, s, c, -0.9 * t, 2e-6 * t, -1e-6 * t, 1};
    }
    static cv::Point2d mapped(const cv::Matx33d& m, cv::Point2d p) {
        const cv::Vec3d q = m * cv::Vec3d(p.x, p.y, 1);
        return {q[0] / q[2], q[1] / q[2]};
    }

    /// The frame after the last; true homographies.
    RegisteredFrame next() {
        RegisteredFrame frame;
        frame.frame = t_;
        if (t_ > 0) {
            Homography& step = frame.registration.current_from_previous;
            step.matrix = camera(t_) * camera(t_ - 1).inv();
            step.matrix = step.matrix * (1 / step.matrix(2, 2));
            step.from_frame = t_ - 1;
            step.to_frame = t_;
            frame.registration.state = RegistrationState::registered;
        }
        CornerId id = 1;
        for (const cv::Point2d& p : ground_) add(frame, id++, p, true);
        for (std::size_t k = 0; k < patches_.size(); ++k) {
            for (const cv::Point2d& p : points_[k]) add(frame, id++, p + patches_[k].way(t_), false);
        }
        ++t_;
        return frame;
    }

    int backgroundCount() const { return static_cast<int>(ground_.size()); }

 private:
    void add(RegisteredFrame& frame, CornerId id, cv::Point2d ground, bool background) {
        const cv::Point2d p = mapped(camera(t_), ground) + cv::Point2d(noise_(random_), noise_(random_));
        Corner corner;
        corner.id = id;
        corner.current = p;
        corner.age = t_;
        corner.on_background = background;
        frame.corners.push_back(corner);
    }

    std::vector<MovingPatch> patches_;
    std::vector<cv::Point2d> ground_;
    std::vector<std::vector<cv::Point2d>> points_;
    std::normal_distribution<double> noise_;
    std::mt19937 random_;
    int t_ = 0;
};

/// A grey frame of even brightness.
inline Frame flatFrame(int index, cv::Size size = {640, 480}, int grey = 100) {
    Frame frame;
    frame.index = index;
    frame.time_us = index * 40000;
    frame.gray = cv::Mat(size, CV_8UC1, cv::Scalar(grey));
    return frame;
}

}  // namespace eyrie::test

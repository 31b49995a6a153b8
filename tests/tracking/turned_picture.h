#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/geometry/angle.h"
#include "core/geometry/homography.h"
#include "core/geometry/oriented_box.h"
#include "core/values/detection.h"
#include "core/values/motion_vector.h"

namespace eyrie::test {

/// A picture turned by a quarter, clockwise, or mirrored left to right: where things are then. The methods of both are
/// those of any rigid map of the picture onto another one.
struct RigidMap {
    cv::Size before;
    cv::Matx22d linear;  ///< of directions
    cv::Point2d offset;  ///< px, added after it
    cv::Size after;
    bool mirrors = false;

    cv::Point2d operator()(cv::Point2d p) const { return vector(p) + offset; }
    cv::Point2d vector(cv::Point2d v) const {
        return {linear(0, 0) * v.x + linear(0, 1) * v.y, linear(1, 0) * v.x + linear(1, 1) * v.y};
    }
    OrientedBox operator()(const OrientedBox& box) const {
        const cv::Point2d ahead = vector(box.direction());
        return {(*this)(box.centre), box.length, box.width, std::atan2(ahead.y, ahead.x)};
    }
    cv::Size image() const { return after; }
    cv::Matx33d matrix() const {
        return {linear(0, 0), linear(0, 1), offset.x, linear(1, 0), linear(1, 1), offset.y, 0, 0, 1};
    }
    /// A map between two pictures, when both are turned.
    Homography operator()(const Homography& map) const {
        Homography turned = map;
        turned.matrix = matrix() * map.matrix * matrix().inv();
        turned.matrix = turned.matrix * (1 / turned.matrix(2, 2));
        return turned;
    }
    Detection operator()(const Detection& detection) const {
        Detection turned = detection;
        turned.box = (*this)(detection.box);
        turned.velocity = vector(detection.velocity);
        return turned;
    }
    FrameMotion operator()(const FrameMotion& motion) const {
        FrameMotion turned = motion;
        turned.image_size = after;
        turned.registration.current_from_previous = (*this)(motion.registration.current_from_previous);
        for (MotionVector& v : turned.motion_vectors) {
            v.position = cv::Point2f((*this)(cv::Point2d(v.position)));
            v.velocity = cv::Point2f(vector(v.velocity));
        }
        return turned;
    }
    cv::Mat operator()(const cv::Mat& picture) const {
        cv::Mat result;
        if (mirrors) {
            cv::flip(picture, result, 1);
        } else {
            cv::rotate(picture, result, cv::ROTATE_90_CLOCKWISE);
        }
        return result;
    }
};

struct QuarterTurn : RigidMap {
    explicit QuarterTurn(cv::Size size)
        : RigidMap{size, {0, -1, 1, 0}, {size.height - 1.0, 0}, {size.height, size.width}, false} {}
};

struct Mirror : RigidMap {
    explicit Mirror(cv::Size size) : RigidMap{size, {-1, 0, 0, 1}, {size.width - 1.0, 0}, size, true} {}
};

inline void expectAlike(const OrientedBox& a, const OrientedBox& b, double tolerance) {
    EXPECT_NEAR(a.centre.x, b.centre.x, tolerance);
    EXPECT_NEAR(a.centre.y, b.centre.y, tolerance);
    EXPECT_NEAR(a.length, b.length, tolerance);
    EXPECT_NEAR(a.width, b.width, tolerance);
    EXPECT_NEAR(turnBetween(a.heading, b.heading), 0, tolerance);
}

}  // namespace eyrie::test

#pragma once

#include <cmath>
#include <functional>
#include <opencv2/core.hpp>
#include <random>
#include <vector>

#include "core/geometry/angle.h"
#include "core/values/detection.h"
#include "core/values/motion_vector.h"
#include "core/values/scene_scale.h"
#include "core/values/track_state.h"

namespace eyrie::test {

/// An object on the ground (coordinates of the ground are those of frame 0).
struct SceneObject {
    cv::Point2d start;
    cv::Point2d velocity;
    double length = 20;
    double width = 10;
    int first_vector = 0;  ///< its corners have the ids first_vector … first_vector + 5
};

/// A similarity camera: what maps the ground into the image of a frame.
struct Camera {
    std::function<double(int)> turn = [](int) { return 0.0; };
    std::function<double(int)> zoom = [](int) { return 1.0; };
    std::function<cv::Point2d(int)> shift = [](int) { return cv::Point2d(0, 0); };

    cv::Matx33d imageFromGround(int frame) const {
        const double c = std::cos(turn(frame)) * zoom(frame);
        const double s = std::sin(turn(frame)) * zoom(frame);
        const cv::Point2d t = shift(frame);
        // About the centre of a 640 × 480 image.
        const cv::Matx33d to_centre(1, 0, -320, 0, 1, -240, 0, 0, 1);
        const cv::Matx33d turned(c, -s, 320 + t.x, s, c, 240 + t.y, 0, 0, 1);
        return turned * to_centre;
    }
};

/// Objects with constant velocity seen by a moving camera, with exact truth, detections and motion vectors.
struct MovingScene {
    std::vector<SceneObject> objects;
    Camera camera;
    SceneScale scale{0.25, 25, true};
    cv::Size image{640, 480};

    Homography map(int frame) const {
        Homography h;
        h.matrix = camera.imageFromGround(frame);
        return h;
    }

    OrientedBox box(std::size_t object, int frame) const {
        const SceneObject& o = objects[object];
        const cv::Point2d ground = o.start + o.velocity * double(frame);
        const Homography h = map(frame);
        const double zoom = h.scaleAt(ground);
        const double heading = h.turned(ground, std::atan2(o.velocity.y, o.velocity.x));
        return {h.apply(ground), o.length * zoom, o.width * zoom, heading};
    }

    cv::Point2d velocity(std::size_t object, int frame) const {
        const SceneObject& o = objects[object];
        return map(frame).applyToVector(o.start + o.velocity * double(frame), o.velocity);
    }

    FrameMotion motion(int frame) const {
        FrameMotion result;
        result.frame = frame;
        result.image_size = image;
        result.background_speed_sigma = 0.02;
        if (frame > 0) {
            result.registration.state = RegistrationState::registered;
            Homography& h = result.registration.current_from_previous;
            h.matrix = camera.imageFromGround(frame) * camera.imageFromGround(frame - 1).inv();
            h.matrix = h.matrix * (1 / h.matrix(2, 2));
            h.from_frame = frame - 1;
            h.to_frame = frame;
        }
        for (std::size_t i = 0; i < objects.size(); ++i) {
            const OrientedBox here = box(i, frame);
            const cv::Point2d v = velocity(i, frame);
            int id = objects[i].first_vector;
            for (const double along : {-0.4, 0.0, 0.4}) {
                for (const double across : {-0.3, 0.3}) {
                    const cv::Point2d p = here.toImage({along * here.length, across * here.width});
                    result.motion_vectors.push_back({id++, cv::Point2f(p), cv::Point2f(v), 10});
                }
            }
        }
        std::sort(result.motion_vectors.begin(), result.motion_vectors.end(),
                  [](const MotionVector& a, const MotionVector& b) { return a.id < b.id; });
        return result;
    }

    Detection detection(std::size_t object, int frame) const {
        return {box(object, frame), 1, velocity(object, frame), 0, {}, Rejection::none};
    }

    std::vector<Detection> detections(int frame) const {
        std::vector<Detection> all;
        for (std::size_t i = 0; i < objects.size(); ++i) all.push_back(detection(i, frame));
        return all;
    }
};

/// The state that overlaps a box most, by more than 0.3; null: none.
inline const TrackState* nearest(const std::vector<TrackState>& states, const OrientedBox& box) {
    const TrackState* best = nullptr;
    for (const TrackState& state : states) {
        if (overlap(state.box, box) > 0.3 && (!best || overlap(state.box, box) > overlap(best->box, box))) {
            best = &state;
        }
    }
    return best;
}

inline MovingScene twoCars() {
    MovingScene scene;
    scene.objects = {{{100, 100}, {2, 0}, 20, 10, 0}, {{100, 200}, {2, 0.5}, 24, 11, 100}};
    return scene;
}

/// Side by side with equal speed.
inline MovingScene neighbours() {
    MovingScene scene;
    scene.objects = {{{100, 100}, {2, 0}, 20, 10, 0}, {{102, 113}, {2, 0}, 20, 10, 100}};
    return scene;
}

}  // namespace eyrie::test

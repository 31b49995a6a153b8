#pragma once

#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/values/corner.h"
#include "core/values/frame.h"
#include "support/textured_ground.h"

namespace eyrie::test {

/// Textured ground with plain or textured rectangles that drive over it, under a camera that shifts, turns, zooms and
/// tilts a little. Everything is a function of real coordinates.
struct DrivenGround {
    struct Vehicle {
        cv::Point2d start;     ///< its middle in frame 0, px of the ground
        cv::Point2d velocity;  ///< px/frame over the ground
        cv::Size2d size{14, 7};
        double grey = 200;
        double texture = 0.8;  ///< contrast of what is on it
    };
    cv::Size size{150, 120};
    double ground_contrast = 0.5;
    double noise = 1;
    std::vector<Vehicle> vehicles;
    double camera_per_frame = 1;  ///< how far it goes; below 0 the other way

    cv::Matx33d pictureFromGround(int index) const {
        const double frame = camera_per_frame * index;
        cv::Matx33d m = cameraMotion(size, 1.1 * frame, -0.6 * frame, 0.35 * frame, 1 + 0.002 * frame);
        m(2, 0) = 2e-6 * frame;
        m(2, 1) = -3e-6 * frame;
        return m;
    }
    cv::Mat draw(int frame) const {
        static const TexturedGround on_vehicles(81);
        const TexturedGround ground(82, ground_contrast);
        const cv::Matx33d back = pictureFromGround(frame).inv();
        cv::Mat gray(size, CV_8UC1);
        cv::RNG random(static_cast<std::uint64_t>(frame) + 7);
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const cv::Vec3d p = back * cv::Vec3d(x, y, 1);
                const cv::Point2d at(p[0] / p[2], p[1] / p[2]);
                double value = ground.at(at.x, at.y);
                for (const Vehicle& vehicle : vehicles) {
                    const cv::Point2d on = at - vehicle.start - vehicle.velocity * frame;
                    if (std::abs(on.x) < vehicle.size.width / 2 && std::abs(on.y) < vehicle.size.height / 2)
                        value = vehicle.grey + vehicle.texture * (on_vehicles.at(on.x, on.y) - 118);
                }
                gray.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(value + random.gaussian(noise));
            }
        }
        return gray;
    }
    Frame frame(int index) const { return frameOf(index, draw(index)); }
    Registration registration(int index) const {
        Registration registration;
        registration.state = index == 0 ? RegistrationState::first : RegistrationState::registered;
        Homography& step = registration.current_from_previous;
        step.from_frame = std::max(0, index - 1);
        step.to_frame = index;
        if (index > 0) {
            const cv::Matx33d m = pictureFromGround(index) * pictureFromGround(index - 1).inv();
            step.matrix = m * (1 / m(2, 2));
        }
        return registration;
    }
    /// The way from the picture of one frame to that of another.
    cv::Matx33d path(int from, int to) const {
        const cv::Matx33d m = pictureFromGround(to) * pictureFromGround(from).inv();
        return m * (1 / m(2, 2));
    }
};

}  // namespace eyrie::test

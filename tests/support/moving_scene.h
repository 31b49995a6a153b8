#pragma once

#include <functional>
#include <map>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "core/error.h"
#include "io/video/frame_source.h"

namespace eyrie::test {

/// A small world in memory: a textured ground seen by a camera that pans, and textured rectangles that drive over it.
/// Exact, quick to draw, and independent of the scene renderer.
struct MovingScene {
    cv::Size size{320, 240};
    int frames = 40;
    cv::Point2d camera_per_frame{1.3, 0.6};
    struct Vehicle {
        cv::Point2d start;     ///< centre in frame 0, px of the ground
        cv::Point2d velocity;  ///< px/frame over the ground
        cv::Size2d size{22, 10};
    };
    std::vector<Vehicle> vehicles{{{100, 120}, {2.0, 0}, {24, 11}}, {{220, 60}, {0, 1.6}, {22, 10}}};

    cv::Point2d cameraAt(int frame) const { return camera_per_frame * frame; }
    /// Centre of a vehicle in image coordinates.
    cv::Point2d vehicleAt(const Vehicle& vehicle, int frame) const {
        return vehicle.start + vehicle.velocity * frame - cameraAt(frame);
    }

    cv::Mat draw(int frame) const {
        cv::Mat image = sampled(ground(), cameraAt(frame), size);
        for (std::size_t i = 0; i < vehicles.size(); ++i) {
            const auto& vehicle = vehicles[i];
            const double heading = std::atan2(vehicle.velocity.y, vehicle.velocity.x);
            const cv::Mat body = bodyOf(vehicle, static_cast<int>(i));
            const cv::Point2d centre = vehicleAt(vehicle, frame);
            cv::Mat image_from_body = (cv::Mat_<double>(2, 3) << std::cos(heading), -std::sin(heading), 0,
                                       std::sin(heading), std::cos(heading), 0);
            const cv::Point2d middle((body.cols - 1) / 2.0, (body.rows - 1) / 2.0);
            image_from_body.at<double>(0, 2) = centre.x - std::cos(heading) * middle.x + std::sin(heading) * middle.y;
            image_from_body.at<double>(1, 2) = centre.y - std::sin(heading) * middle.x - std::cos(heading) * middle.y;
            cv::Mat drawn, mask;
            cv::warpAffine(body, drawn, image_from_body, size, cv::INTER_CUBIC);
            cv::warpAffine(cv::Mat(body.size(), CV_8U, cv::Scalar(255)), mask, image_from_body, size, cv::INTER_LINEAR);
            drawn.copyTo(image, mask > 127);
        }
        cv::Mat noise(size, CV_16S);
        cv::RNG random(static_cast<std::uint64_t>(frame) + 99);
        random.fill(noise, cv::RNG::NORMAL, 0, 1.5);
        cv::add(image, noise, image, {}, CV_8U);
        return image;
    }

 private:
    static cv::Mat texture(cv::Size size, std::uint64_t seed, double blur, double mean, double contrast) {
        cv::Mat picture(size, CV_32F);
        cv::RNG random(seed);
        random.fill(picture, cv::RNG::UNIFORM, -1.0, 1.0);
        cv::GaussianBlur(picture, picture, {}, blur);
        cv::Scalar average, deviation;
        cv::meanStdDev(picture, average, deviation);
        cv::Mat bytes;
        picture.convertTo(bytes, CV_8U, contrast / deviation[0], mean - average[0] * contrast / deviation[0]);
        return bytes;
    }
    cv::Mat ground() const {
        if (ground_.empty()) {
            const cv::Size whole(size.width + 60 + int(std::abs(camera_per_frame.x) * frames),
                                 size.height + 60 + int(std::abs(camera_per_frame.y) * frames));
            ground_ = texture(whole, 1, 1.4, 110, 22);
        }
        return ground_;
    }
    static cv::Mat bodyOf(const Vehicle& vehicle, int index) {
        cv::Mat body = texture({cvRound(vehicle.size.width), cvRound(vehicle.size.height)},
                               static_cast<std::uint64_t>(index) + 7, 1.0, 190, 35);
        cv::rectangle(body, {0, 0, body.cols, body.rows}, cv::Scalar(235), 1);
        return body;
    }
    static cv::Mat sampled(const cv::Mat& ground, cv::Point2d offset, cv::Size size) {
        const cv::Mat image_from_ground = (cv::Mat_<double>(2, 3) << 1, 0, -offset.x - 20, 0, 1, -offset.y - 20);
        cv::Mat image;
        cv::warpAffine(ground, image, image_from_ground, size, cv::INTER_CUBIC, cv::BORDER_REFLECT);
        return image;
    }
    mutable cv::Mat ground_;
};

/// Frames made by a function, as a FrameSource.
class MemorySource : public FrameSource {
 public:
    using Draw = std::function<cv::Mat(int)>;
    MemorySource(int frames, cv::Size size, Draw draw) : draw_(std::move(draw)) {
        info_.path = "memory";
        info_.size = size;
        info_.frame_count = frames;
        info_.codec = "memory";
    }
    /// Draws each frame once.
    explicit MemorySource(const MovingScene& scene)
        : MemorySource(scene.frames, scene.size, [scene, drawn = std::map<int, cv::Mat>()](int index) mutable {
              cv::Mat& picture = drawn[index];
              if (picture.empty()) picture = scene.draw(index);
              return picture.clone();
          }) {}

    const VideoInfo& info() const override { return info_; }
    std::int64_t timeOf(FrameIndex index) const override { return index * 40000LL; }
    Frame read(FrameIndex index, bool with_colour) override {
        Frame frame;
        frame.index = index;
        frame.time_us = timeOf(index);
        frame.gray = draw_(index);
        if (with_colour) cv::cvtColor(frame.gray, frame.colour, cv::COLOR_GRAY2BGR);
        return frame;
    }

 private:
    VideoInfo info_;
    Draw draw_;
};

}  // namespace eyrie::test

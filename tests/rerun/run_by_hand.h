#pragma once

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <set>
#include <vector>

#include "chain/chain.h"
#include "rerun/replay.h"

namespace eyrie::test {

/// A stored run of which every number is known: a camera that stands, and bright vehicles, each with eight motion
/// vectors in a box of 15 × 6 px, that drive to the right. Nothing is registered and nothing looked for in pictures, so
/// that a frame costs next to nothing.
struct RunByHand {
    struct Vehicle {
        cv::Point2f start;  ///< px, in frame 0
        float speed = 2;    ///< px/frame
    };
    std::vector<Vehicle> vehicles{{{20, 30}}};
    int frames = 40;
    ChainOptions options = plain();
    std::set<FrameIndex> frozen{};   ///< pictures that repeat the one before
    std::set<FrameIndex> missing{};  ///< frames that the run has not
    std::vector<FrameIndex> pictures_read{};
    int results_read = 0;

    static ChainOptions plain() {
        ChainOptions plain;
        plain.detection.method = DetectionMethod::clusters;
        plain.outliers.min_vectors = 0;
        plain.outliers.min_density_share = 0;
        plain.tracking.appearance = AppearanceUse::none;
        plain.clustering.across_m = 1.5;
        plain.difference.gap = 1;
        plain.difference.opening_m = 0.25;
        plain.difference.min_area_m2 = 0.25;
        plain.difference.min_area_px = 4;
        return plain;
    }
    static SceneScale scale() { return {0.25, 25, true, {}}; }

    OrientedBox boxOf(std::size_t vehicle, FrameIndex frame) const {
        const cv::Point2f centre = placeOf(vehicles[vehicle], frame);
        return {centre, 15, 6, 0};
    }
    Frame picture(FrameIndex frame) const {
        Frame picture;
        picture.index = frame;
        picture.time_us = std::int64_t{frame} * 40'000;
        picture.gray = cv::Mat(80, 200, CV_8UC1, cv::Scalar(60));
        for (const Vehicle& vehicle : vehicles) {
            const cv::Point corner(placeOf(vehicle, frame) - cv::Point2f(8, 4));
            cv::rectangle(picture.gray, cv::Rect(corner, cv::Size(16, 8)), cv::Scalar(200), cv::FILLED);
        }
        return picture;
    }
    FrameMotion motion(FrameIndex frame) const {
        FrameMotion motion;
        motion.frame = frame;
        motion.time_us = std::int64_t{frame} * 40'000;
        motion.image_size = {200, 80};
        motion.registration.state = frozen.count(frame) > 0 ? RegistrationState::frozen
                                    : frame > 0             ? RegistrationState::registered
                                                            : RegistrationState::first;
        motion.registration.current_from_previous.from_frame = std::max(0, frame - 1);
        motion.registration.current_from_previous.to_frame = frame;
        CornerId id = 0;
        for (const Vehicle& vehicle : vehicles) {
            for (const float x : {-7.F, -2.5F, 2.5F, 7.F}) {
                for (const float y : {-2.5F, 2.5F}) {
                    const cv::Point2f place = placeOf(vehicle, frame) + cv::Point2f(x, y);
                    motion.motion_vectors.push_back({++id, place, {vehicle.speed, 0}, 20});
                }
            }
        }
        return motion;
    }
    /// What a run with these parameters of the second half finds.
    std::vector<FrameResult> runWith(const ChainOptions& other) const {
        TrackHalf half(other, scale());
        std::vector<FrameResult> results;
        for (FrameIndex frame = 0; frame < frames; ++frame)
            results.push_back(half.next(picture(frame), motion(frame), {}));
        return results;
    }
    ReplaySource source() {
        ReplaySource source;
        source.options = options;
        source.scale = scale();
        source.pixels = [this](FrameIndex frame) {
            pictures_read.push_back(frame);
            return picture(frame);
        };
        const auto has = [this](FrameIndex frame) { return frame >= 0 && frame < frames && missing.count(frame) == 0; };
        source.motion_of = [this, has](FrameIndex frame) {
            return has(frame) ? std::optional(motion(frame)) : std::nullopt;
        };
        source.result_of = [this, has, stored = runWith(options)](FrameIndex frame) {
            ++results_read;
            return has(frame) ? std::optional(stored[static_cast<std::size_t>(frame)]) : std::nullopt;
        };
        return source;
    }

 private:
    cv::Point2f placeOf(const Vehicle& vehicle, FrameIndex frame) const {
        int repeated = 0;
        for (const FrameIndex f : frozen) repeated += f <= frame;
        return vehicle.start + cv::Point2f(vehicle.speed * static_cast<float>(frame - repeated), 0);
    }
};

}  // namespace eyrie::test

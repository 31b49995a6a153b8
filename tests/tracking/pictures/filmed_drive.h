#pragma once

#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <set>
#include <vector>

#include "tracking/finishing/track_paths.h"
#include "tracking/frame_summaries.h"

namespace eyrie::test {

/// A patterned car on patterned ground under a camera at rest, 5 px a metre, and what a tracker knows of it.
struct FilmedDrive {
    static inline const cv::Size kSize{640, 200};
    static inline const SceneScale kScale{.gsd_m_per_px = 0.2, .frame_rate_hz = 25, .gsd_known = true};

    int frames = 60;
    double speed = 4;                                                                    ///< px/frame, to the right
    std::function<double(double)> place = [this](double f) { return 100 + speed * f; };  ///< x in a frame
    std::function<double(double)> growth = [](double) { return 1.0; };                   ///< of the car, by its place
    std::function<bool(FrameIndex)> there = [](FrameIndex) { return true; };  ///< whether the picture shows it
    std::set<FrameIndex> frozen;                                              ///< frames that repeat the one before
    std::vector<FrameIndex> asked;                                            ///< whose pictures were read

    FilmedDrive() = default;
    FilmedDrive(const FilmedDrive&) = delete;
    FilmedDrive& operator=(const FilmedDrive&) = delete;

    OrientedBox boxAt(FrameIndex frame) const {
        const double x = place(frame);
        return {{x, 100}, 24 * growth(x), 12 * growth(x), 0};
    }

    cv::Mat pictureOf(FrameIndex frame) {
        asked.push_back(frame);
        static const cv::Mat bare = grain(kSize, 1, 3.5);
        cv::Mat picture = bare.clone();
        if (!there(frame)) return picture;
        static const cv::Mat car = grain({24, 12}, 2, 1.6);
        const OrientedBox box = boxAt(frame);
        const double scale = box.length / car.cols;
        const cv::Matx23d onto(scale, 0, box.centre.x - scale * 11.5, 0, scale, box.centre.y - scale * 5.5);
        cv::warpAffine(car, picture, onto, kSize, cv::INTER_LINEAR, cv::BORDER_TRANSPARENT);
        return picture;
    }

    GroundMotion ground(cv::Size size = kSize) const {
        GroundMotion motion;
        for (FrameIndex frame = 0; frame < frames; ++frame) {
            FrameMotionSummary summary = summaryOfFrame(frame);
            summary.image_size = size;
            if (frozen.contains(frame)) summary.registration.state = RegistrationState::frozen;
            motion.add(summary);
        }
        return motion;
    }

    /// As it was detected from one frame to another.
    TrackPath path(FrameIndex first, FrameIndex last, TrackId id = 1, double score = 0.9) const {
        TrackPath result{id, {}};
        for (FrameIndex frame = first; frame <= last; ++frame) {
            TrackState state;
            state.id = id;
            state.box = boxAt(frame);
            state.velocity = {place(frame + 0.5) - place(frame - 0.5), 0};
            state.status = TrackStatus::confirmed;
            state.hits = frame - first + 1;
            state.score = score;
            result.states.emplace_back(frame, PathState(state));
        }
        return result;
    }

    GrayOfFrame grayAt() {
        return [this](FrameIndex frame) { return pictureOf(frame); };
    }

 private:
    static cv::Mat grain(cv::Size size, std::uint64_t seed, double blur) {
        cv::Mat picture(size, CV_8UC1);
        cv::RNG(seed).fill(picture, cv::RNG::UNIFORM, 0, 256);
        cv::GaussianBlur(picture, picture, {}, blur);
        return picture;
    }
};

}  // namespace eyrie::test

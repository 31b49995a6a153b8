#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/parameter.h"
#include "core/values/frame.h"
#include "core/values/motion_vector.h"
#include "core/values/scene_scale.h"
#include "motion/differences/registered_frames.h"

namespace eyrie {

/// Parameters of moving areas.
struct MovingAreaOptions {
    bool areas = true;
    double area_max_corners = 6;        ///< on a car at the mean density; with more of them corners do without
    double area_few_corners = 3;        ///< … and from so many on areas must be sure
    double area_gap_s = 0.12;           ///< time between the pictures that are compared
    double area_noise_factor = 8;       ///< pixels move from this many deviations of the frame's own differences on …
    double area_contrast = 6;           ///< … and from this difference on, grey values
    double area_min_size_m2 = 1;        ///< smaller areas are no vehicle …
    int area_min_size_px = 8;           ///< … whatever the scale
    double area_max_length_m = 20;      ///< longer ones neither
    double area_min_shift = 1.5;        ///< between two of the pictures; smaller shifts may be misregistration
    double area_min_correlation = 0.8;  ///< of an area's pixels with where they went …
    double area_sure_correlation = 0.93;      ///< … where corners nearly suffice
    double area_low_rate_hz = 8;              ///< below, areas are used whatever the corners …
    double area_low_rate_correlation = 0.6;   ///< … from this correlation on …
    double area_low_rate_noise_factor = 2.5;  ///< … and at ever lower differences, down to this factor

    /// Frames between two of the three pictures that are compared.
    int gapFrames(const SceneScale& scale) const;
    void describe(ParameterVisitor& visitor);
};

/// Pixels of a halved picture that hang together and differ from those before.
struct DifferingArea {
    std::vector<cv::Point> pixels;
    cv::Rect bounds;
};

/// Motion where corners starve. A vehicle of 14×7 px carries a corner or two, in poor pictures none; but registered
/// pictures differ where it drives (3-frame difference, Teutsch §2.2, eq. 2.2). Each area that differs is laid over the
/// newest picture and the oldest: where it went shows its velocity, and that it is the same thing in all three. What
/// stands and only seems to differ, at edges, does not go anywhere. Areas that hold vectors of corners already get
/// none. Below `area_low_rate_hz` a vehicle goes too far for its corners to be followed, so that areas are looked at
/// whatever it carries, and the ways to both pictures are looked for together, since much is in reach; grey vehicles on
/// grey roads differ little, so that lower thresholds are tried where nothing moved above them.
class MovingAreas {
 public:
    MovingAreas(const MovingAreaOptions& options, const SceneScale& scale);

    /// Takes the next frame, failed and repeated ones, too; without a picture everything is forgotten. Nothing moves
    /// where `graphics` are drawn into the pictures.
    void add(const Frame& frame, const Registration& registration, const PictureMask& graphics = {});
    void clear() { frames_.clear(); }
    /// Sets the scale of the frames from now on; the frame rate stays.
    void setScale(const SceneScale& scale) { scale_ = scale; }
    /// Vectors in the areas of the newest frame, with ids above those of all corners and silhouettes, and of age 0;
    /// none where corners suffice. `motion` is what is known of the frame already. `min_speed`: px/frame at a place.
    std::vector<MotionVector> infer(const FrameMotion& motion, const std::function<double(cv::Point2d)>& min_speed);

    /// What is remembered of the frames so far, written or read; see core/state_archive.h. To be read into one of the
    /// same options.
    template <class Archive>
    void transfer(Archive& archive);

 private:
    /// How the newest picture, the one before and the one long before differ, halved, as seen in the newest, at the
    /// places of the one before.
    struct Difference {
        cv::Mat gray;      ///< CV_8UC1, 0 where one of them shows nothing
        double noise = 0;  ///< grey values
    };
    Difference difference() const;
    std::vector<DifferingArea> areasFrom(const Difference& difference, double threshold) const;
    bool isLowRate() const { return scale_.frame_rate_hz < options_.area_low_rate_hz; }
    /// Grey values from which on pixels differ; several, the highest first, at a low rate.
    std::vector<double> thresholds(double noise) const;
    /// Lowest correlation that an area at a place of a frame needs; nothing where corners suffice.
    std::optional<double> correlationNeeded(const FrameMotion& motion, cv::Point2d place) const;
    /// px from the picture before to the newest, over the ground; nothing where the area is not one thing that moves.
    /// `long_before`: as seen in the newest, at a low rate.
    std::optional<cv::Point2d> shiftOf(const DifferingArea& area, double min_correlation,
                                       const cv::Mat& long_before) const;
    /// The same of all areas, where they are faster than `min_speed`.
    std::vector<std::optional<cv::Point2d>> shiftsOf(const std::vector<DifferingArea>& areas, const FrameMotion& motion,
                                                     const std::function<double(cv::Point2d)>& min_speed,
                                                     const cv::Mat& long_before) const;
    /// Vectors on an area that moved by `shift`, but where the frame has enough already.
    void addVectors(const DifferingArea& area, cv::Point2d shift, const FrameMotion& motion,
                    std::vector<MotionVector>& inferred);

    MovingAreaOptions options_;
    SceneScale scale_;
    int gap_;
    RegisteredFrames frames_;
    PictureMask graphics_;  ///< in the newest frame
    CornerId next_id_;
};

}  // namespace eyrie

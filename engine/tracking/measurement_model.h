#pragma once

#include <opencv2/core/types.hpp>

#include "core/values/detection.h"
#include "core/values/scene_scale.h"
#include "tracking/association/split_merge.h"
#include "tracking/box_kalman_filter.h"
#include "tracking/tracker_options.h"

namespace eyrie {

/// A detection at the image border whose hidden part was completed with a known size.
struct CompletedBox {
    OrientedBox box;
    bool length_cut = false;  ///< an end of the box lies at the border
    bool width_cut = false;   ///< a side of the box lies at the border
};

/// Completes a detection whose end or side lies within `margin` px of the image border to at least the given length and
/// width; the ends that are visible stay where they are.
CompletedBox completeAtBorder(const OrientedBox& detection, double length, double width, cv::Size image, double margin);

/// Turns detections and reconstructed boxes into measurements with noise, in pixels of this scene.
class MeasurementModel {
 public:
    MeasurementModel(const TrackerOptions& options, const SceneScale& scale);

    /// Sets what depends on the frame: the image's size and the deviation of the background's speed, px/frame.
    void startFrame(cv::Size image, double background_speed_sigma);

    /// A detection that starts a track.
    BoxMeasurement first(const Detection& detection) const;

    /// A measurement of a track, and what it says about the size.
    struct Update {
        BoxMeasurement measurement;
        double size_growth = 0;     ///< px by which a box that comes in over the border is larger than before
        cv::Point2d shift{0, 0};    ///< px by which such a box's centre may lag behind the prediction
        bool size_differs = false;  ///< beyond the size gate
        double grows_front = 0;     ///< px by which the box reaches beyond the predicted one, if believable, else 0
        double grows_rear = 0;
        double grows_left = 0;
        double grows_right = 0;
        bool by_ends = false;  ///< the ends were measured one by one
        /// Whether any end reaches beyond the prediction by more than noise does.
        bool grows = false;
    };
    /// `detection` with `box` in place of its own; `size_known`: the size gate applies.
    Update update(const OrientedBox& box, const Detection& detection, const OrientedBox& predicted,
                  bool size_known) const;
    BoxMeasurement reconstructed(const Reconstruction& reconstruction) const;
    /// A place alone; size, heading and velocity are not measured.
    BoxMeasurement placed(const OrientedBox& box) const;
    /// Of what is at a place of the picture.
    BoxProcessNoise processNoise(cv::Point2d place) const { return lengthsAt(place).process; }

    /// Speed below which a velocity tells no direction in this frame, px/frame.
    double slowSpeed() const { return slow_speed_; }
    /// Deviation of a detection's length and width at a place, px.
    double sizeDeviation(cv::Point2d place) const { return lengthsAt(place).size; }
    double backgroundSpeedSigma() const { return sigma_; }

 private:
    /// What the options declare in metres, in pixels of a place.
    struct Lengths {
        Lengths(const TrackerOptions& options, const SceneScale& here);
        BoxProcessNoise process;
        double position;
        double car_length;
        double car_width;
        double size;
        double velocity;
    };
    Lengths lengthsAt(cv::Point2d place) const {
        return scale_.slope.isFlat() ? everywhere_ : Lengths(options_, scale_.at(place));
    }
    bool atBorder(const OrientedBox& box) const;
    void measureEnds(const OrientedBox& predicted, double size, Update& update) const;
    double headingDeviation(double speed) const;
    double velocityDeviation(const Lengths& here) const;

    TrackerOptions options_;
    SceneScale scale_;
    Lengths everywhere_;  ///< where the scale is the same everywhere
    double position_floor_ = 1;
    VehicleLimit one_vehicle_;
    double heading_ = 0.1;
    double velocity_floor_ = 0.05;
    double size_gate_ = 0;
    double slow_speed_sigmas_ = 5;
    bool complete_at_border_ = true;
    bool adapt_size_ = true;
    bool measure_velocity_ = true;
    cv::Size image_;
    double sigma_ = 0.02;
    double slow_speed_ = 0.1;
};

/// Whether a detection carries a velocity at all.
bool velocityKnown(const Detection& detection);

}  // namespace eyrie

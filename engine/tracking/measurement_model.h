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
    BoxProcessNoise processNoise() const { return process_; }

    /// Speed below which a velocity tells no direction in this frame, px/frame.
    double slowSpeed() const { return slow_speed_; }
    /// Deviation of a detection's length and width, px.
    double sizeDeviation() const { return size_; }
    double backgroundSpeedSigma() const { return sigma_; }

 private:
    bool atBorder(const OrientedBox& box) const;
    void measureEnds(const OrientedBox& predicted, Update& update) const;
    double completeDeviation(double length) const;
    double headingDeviation(double speed) const;
    double velocityDeviation() const;

    BoxProcessNoise process_;
    double position_ = 1;
    double position_floor_ = 1;
    double car_length_ = 0;
    double car_width_ = 0;
    VehicleLimit one_vehicle_;
    double size_ = 1;
    double heading_ = 0.1;
    double velocity_ = 0.1;
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

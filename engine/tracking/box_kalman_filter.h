#pragma once

#include <Eigen/Core>
#include <limits>

#include "core/geometry/homography.h"
#include "core/geometry/oriented_box.h"

namespace eyrie {

/// What a box filter does not know about the next frame, one deviation each, px and radians per frame.
struct BoxProcessNoise {
    double acceleration = 0.02;  ///< px/frame²
    double position = 0.05;      ///< px: registration error
    double size = 0.05;          ///< px
    double heading = 0.02;       ///< radians
};

/// A measured box with its deviations (px, radians, px/frame). An infinite deviation: not measured.
struct BoxMeasurement {
    static constexpr double kUnknown = std::numeric_limits<double>::infinity();
    OrientedBox box;
    cv::Point2d velocity{0, 0};  ///< px/frame relative to the ground
    double along = 1;            ///< of the centre along the box's heading
    double across = 1;           ///< of the centre across the box's heading
    double length = kUnknown;
    double width = kUnknown;
    double heading = kUnknown;
    double speed = kUnknown;       ///< of each component of the velocity
    double along_with_length = 0;  ///< px²: covariance of the centre along the heading with the length
    double across_with_width = 0;  ///< px²: the same across the heading, with the width

    /// Sets centre and size deviations from those of the box's four ends, px. An end that is badly seen, because a part
    /// of the object is missing there, then moves the other one as little as the truth does.
    void setEnds(double front, double rear, double left, double right);
};

/// Kalman filter of one object: centre, velocity relative to the ground, length, width and heading in the current
/// image (Teutsch §6.5; the velocity is our addition). The camera's motion enters the prediction, so the velocity of an
/// object that stands on the ground stays zero whatever the camera does.
class BoxKalmanFilter {
 public:
    static constexpr int kSize = 7;
    /// x, y, vx, vy, length, width, heading
    using State = Eigen::Matrix<double, kSize, 1>;
    using Covariance = Eigen::Matrix<double, kSize, kSize>;

    /// Starts from a measurement; what it does not measure starts with a wide deviation.
    explicit BoxKalmanFilter(const BoxMeasurement& first);

    /// Moves the object by its velocity over the ground and maps everything into the new image. False, and nothing
    /// but the object's own motion is applied, when the map is degenerate at the object.
    bool predict(const Homography& current_from_previous, const BoxProcessNoise& noise);

    /// Folds a measurement in. The heading is compared as an axis, for a box is the same when front and rear are
    /// exchanged; `pointForward` decides between them. False and unchanged when the result would not be finite.
    bool update(const BoxMeasurement& measurement);

    /// Turns the heading by half a circle when it points against a velocity of at least `slow_speed` px/frame.
    void pointForward(double slow_speed);
    /// Multiplies the velocity, for objects that are taken to stop.
    void slowDown(double factor);
    /// Makes the size as uncertain as the given deviation, px.
    void forgetSize(double deviation);
    /// Adds uncertainty to each end of the box, px.
    void loosenEnds(double front, double rear, double left, double right);
    /// Adds uncertainty to the centre along a displacement, px.
    void smear(cv::Point2d displacement);

    OrientedBox box() const;
    cv::Point2d velocity() const { return {state_(2), state_(3)}; }
    double speed() const;
    /// Deviation of the centre along a unit direction, px.
    double positionDeviation(cv::Point2d direction) const;

    const State& state() const { return state_; }
    const Covariance& covariance() const { return covariance_; }

    /// What is remembered of the frames so far, written or read; see core/state_archive.h. To be read into one of the
    /// same options.
    template <class Archive>
    void transfer(Archive& archive);

 private:
    void keepSane();

    State state_;
    Covariance covariance_;
};

}  // namespace eyrie

#include "tracking/measurement_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/angle.h"

namespace eyrie {
namespace {

constexpr double kSmallestSigma = 0.01;  ///< px/frame; no registration is better
constexpr double kLengthStep = 0.1;      ///< deviation of a classifier's few lengths, relative
constexpr double kBorderMargin = 4;      ///< px; corners cannot be tracked up to the very edge

bool nearBorder(cv::Point2d point, cv::Size image, double margin) {
    return point.x < margin || point.y < margin || point.x > image.width - 1 - margin ||
           point.y > image.height - 1 - margin;
}

/// Length of one axis after completion; `shift` moves the centre along the axis so that the visible end stays.
double completedSide(double seen, double known, bool low_cut, bool high_cut, double& shift) {
    if (seen >= known || low_cut == high_cut) return std::max(seen, low_cut || high_cut ? known : seen);
    shift = (known - seen) / 2 * (high_cut ? 1 : -1);
    return known;
}

/// Of an end of a box that a classifier took for a whole vehicle; `size`: of a size, px.
double completeDeviation(double length, double size) {
    return std::hypot(size / 2, kLengthStep * length / std::numbers::sqrt2);
}

/// The box of equal second moments with its axes along another heading.
OrientedBox inHeading(const OrientedBox& box, double heading) {
    const double turn = turnBetween(heading, box.heading);
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    return {box.centre, std::hypot(box.length * c, box.width * s), std::hypot(box.length * s, box.width * c), heading};
}

}  // namespace

bool velocityKnown(const Detection& detection) {
    return !detection.vectors.empty() || detection.velocity.x != 0 || detection.velocity.y != 0;
}

CompletedBox completeAtBorder(const OrientedBox& detection, double length, double width, cv::Size image,
                              double margin) {
    CompletedBox result;
    result.box = detection;
    if (image.area() == 0) return result;
    const auto cut = [&](cv::Point2d in_box) { return nearBorder(detection.toImage(in_box), image, margin); };
    const bool rear = cut({-detection.length / 2, 0});
    const bool front = cut({detection.length / 2, 0});
    const bool left = cut({0, -detection.width / 2});
    const bool right = cut({0, detection.width / 2});
    cv::Point2d shift(0, 0);
    result.length_cut = rear || front;
    result.width_cut = left || right;
    result.box.length = completedSide(detection.length, length, rear, front, shift.x);
    result.box.width = completedSide(detection.width, width, left, right, shift.y);
    result.box.centre = detection.toImage(shift);
    return result;
}

MeasurementModel::Lengths::Lengths(const TrackerOptions& options, const SceneScale& here)
    : position(std::hypot(options.position_noise_px, here.px(options.position_noise_m))),
      car_length(here.px(options.car_length_m)),
      car_width(here.px(options.car_width_m)),
      size(std::hypot(options.size_noise_px, here.px(options.size_noise_m))),
      velocity(here.pxPerFrame(options.velocity_noise_m_s)) {
    process.acceleration = std::max(0.004, here.pxPerFrame(options.acceleration_m_s2) / here.frame_rate_hz);
    process.position = 0.05;
    process.size = std::max(0.01, here.px(options.size_rate_m));
    process.heading = radiansFromDegrees(options.turn_rate_deg) / here.frame_rate_hz;
}

MeasurementModel::MeasurementModel(const TrackerOptions& options, const SceneScale& scale)
    : options_(options),
      scale_(scale),
      everywhere_(options, scale),
      position_floor_(options.position_noise_px),
      one_vehicle_(VehicleLimit::of(options, scale)),
      heading_(radiansFromDegrees(options.heading_noise_deg)),
      velocity_floor_(options.velocity_noise_px),
      size_gate_(options.size_gate),
      slow_speed_sigmas_(options.slow_speed_sigmas),
      complete_at_border_(options.complete_at_border),
      adapt_size_(options.adapt_size),
      measure_velocity_(options.measure_velocity) {}

void MeasurementModel::startFrame(cv::Size image, double background_speed_sigma) {
    image_ = image;
    sigma_ = std::isfinite(background_speed_sigma) ? std::max(background_speed_sigma, kSmallestSigma) : kSmallestSigma;
    slow_speed_ = slow_speed_sigmas_ * sigma_;
}

bool MeasurementModel::atBorder(const OrientedBox& box) const {
    const CompletedBox completed = completeAtBorder(box, box.length, box.width, image_, 2 * kBorderMargin);
    return completed.length_cut || completed.width_cut;
}

double MeasurementModel::headingDeviation(double speed) const {
    return std::hypot(heading_, std::atan2(sigma_, speed));
}

double MeasurementModel::velocityDeviation(const Lengths& here) const {
    return std::hypot(std::max(velocity_floor_, sigma_), here.velocity);
}

BoxMeasurement MeasurementModel::first(const Detection& detection) const {
    const Lengths here = lengthsAt(detection.box.centre);
    BoxMeasurement m;
    m.box = detection.box;
    m.along = m.across = here.position;
    if (!adapt_size_) {
        m.length = m.width = here.size;
    } else if (detection.complete) {
        const double end = completeDeviation(detection.box.length, here.size);
        m.setEnds(end, end, here.size / 2, here.size / 2);
    } else {
        // The first box is often a part of the object only, and either end may be missing.
        const double end =
            std::hypot(here.size / 2, std::max(detection.box.length / 6, (here.car_length - detection.box.length) / 2));
        const double side =
            std::hypot(here.size / 2, std::max(detection.box.width / 6, (here.car_width - detection.box.width) / 2));
        m.setEnds(end, end, side, side);
    }
    m.heading = headingDeviation(std::hypot(detection.velocity.x, detection.velocity.y));
    if (velocityKnown(detection)) {
        m.velocity = detection.velocity;  // where to begin, even if it is not measured
        if (measure_velocity_) m.speed = velocityDeviation(here);
    }
    return m;
}

MeasurementModel::Update MeasurementModel::update(const OrientedBox& box, const Detection& detection,
                                                  const OrientedBox& predicted, bool size_known) const {
    const Lengths here = lengthsAt(predicted.centre);
    Update result;
    BoxMeasurement& m = result.measurement;
    const cv::Point2d velocity = detection.velocity;
    const bool velocity_known = velocityKnown(detection);
    const double speed = std::hypot(velocity.x, velocity.y);
    const bool heading_known = !velocity_known || speed >= slow_speed_;
    const OrientedBox seen = heading_known ? box : inHeading(box, predicted.heading);
    CompletedBox completed;
    completed.box = seen;
    if (complete_at_border_)
        completed = completeAtBorder(seen, predicted.length, predicted.width, image_, kBorderMargin);
    m.box = completed.box;
    if (heading_known) m.heading = velocity_known ? headingDeviation(speed) : 2 * heading_;
    if (velocity_known && measure_velocity_) {
        m.velocity = velocity;
        m.speed = velocityDeviation(here);
    }

    const double longer = m.box.length - predicted.length;
    const double wider = m.box.width - predicted.width;
    const double ratio = seen.area() / predicted.area();
    const bool at_border = completed.length_cut || completed.width_cut;
    // A box that comes in over the border grows; any other one that grows is merged with something.
    const bool comes_in = at_border && atBorder(predicted);
    const bool larger = ratio > size_gate_ && !comes_in;
    const bool smaller = ratio * size_gate_ < 1 && !at_border;
    result.size_differs = size_gate_ > 1 && (larger || smaller);
    const bool size_measured = !(size_known && result.size_differs);
    // What lies outside the image cannot be measured.
    // Parts of one vehicle miss an end; a box that may hold several vehicles may as well be merged or fall apart.
    if (adapt_size_ && size_measured && !at_border && detection.complete) {
        const double end = completeDeviation(m.box.length, here.size);
        m.setEnds(end, end, here.size / 2, here.size / 2);
        result.by_ends = true;
    } else if (adapt_size_ && size_measured && !at_border && one_vehicle_.holds(predicted) &&
               one_vehicle_.holds(m.box)) {
        measureEnds(predicted, here.size, result);
    } else {
        if (size_measured && !(completed.length_cut && longer <= 0)) m.length = here.size;
        if (size_measured && !(completed.width_cut && wider <= 0)) m.width = here.size;
        // A box too short by d misses either end: its centre is off by up to d / 2.
        const bool as_good_as_any = comes_in || !adapt_size_;
        m.along = as_good_as_any ? here.position : std::hypot(here.position, longer / 2);
        m.across = as_good_as_any ? here.position : std::hypot(here.position, wider / 2);
    }
    const cv::Point2d along = m.box.direction();
    if (comes_in && completed.length_cut && longer > 0) {
        result.size_growth = longer;
        result.shift += along * longer;
    }
    if (comes_in && completed.width_cut && wider > 0) {
        result.size_growth = std::max(result.size_growth, wider);
        result.shift += cv::Point2d(-along.y, along.x) * wider;
    }
    return result;
}

void MeasurementModel::measureEnds(const OrientedBox& predicted, double size, Update& update) const {
    const OrientedBox& box = update.measurement.box;
    const cv::Point2d centre = predicted.toBox(box.centre);
    const double noise = size / std::numbers::sqrt2;
    // An end that was not seen this time is still there; one that reaches further is new knowledge.
    const auto deviation = [&](double beyond) { return beyond >= 0 ? noise : std::hypot(noise, beyond); };
    const double front = centre.x + (box.length - predicted.length) / 2;
    const double rear = -centre.x + (box.length - predicted.length) / 2;
    const double right = centre.y + (box.width - predicted.width) / 2;
    const double left = -centre.y + (box.width - predicted.width) / 2;
    update.measurement.setEnds(deviation(front), deviation(rear), deviation(left), deviation(right));
    update.by_ends = true;
    update.grows_front = std::max(0.0, front);
    update.grows_rear = std::max(0.0, rear);
    update.grows_left = std::max(0.0, left);
    update.grows_right = std::max(0.0, right);
    update.grows = std::max({front, rear, left, right}) > 2 * noise;
}

BoxMeasurement MeasurementModel::reconstructed(const Reconstruction& reconstruction) const {
    const Lengths here = lengthsAt(reconstruction.box.centre);
    BoxMeasurement m;
    m.box = reconstruction.box;
    m.along = m.across = position_floor_;
    if (measure_velocity_) {
        m.velocity = reconstruction.velocity;
        m.speed = velocityDeviation(here);
    }
    if (reconstruction.heading_known) {
        m.heading = 2 * headingDeviation(std::hypot(reconstruction.velocity.x, reconstruction.velocity.y));
    }
    if (reconstruction.size_known) {
        // As good as any detection.
        m.along = m.across = here.position;
        m.length = m.width = here.size;
        m.heading /= 2;
    }
    return m;
}

BoxMeasurement MeasurementModel::placed(const OrientedBox& box) const {
    BoxMeasurement m;
    m.box = box;
    m.along = m.across = position_floor_;
    return m;
}

}  // namespace eyrie

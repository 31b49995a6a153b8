#include "metadata/sensor_attitude.h"

#include <cmath>
#include <opencv2/core/matx.hpp>

#include "core/geometry/angle.h"

namespace eyrie {
namespace {

constexpr double kLeastDip = 0.0175;  ///< sine of the angle below the horizon: flatter rays end nowhere certain

// Axes of aviation: x ahead, y to the right, z down.

cv::Matx33d yaw(double degrees) {
    const double c = std::cos(radiansFromDegrees(degrees)), s = std::sin(radiansFromDegrees(degrees));
    return {c, -s, 0, s, c, 0, 0, 0, 1};
}

cv::Matx33d pitch(double degrees) {
    const double c = std::cos(radiansFromDegrees(degrees)), s = std::sin(radiansFromDegrees(degrees));
    return {c, 0, s, 0, 1, 0, -s, 0, c};
}

cv::Matx33d roll(double degrees) {
    const double c = std::cos(radiansFromDegrees(degrees)), s = std::sin(radiansFromDegrees(degrees));
    return {1, 0, 0, 0, c, -s, 0, s, c};
}

std::optional<double> firstOf(const MetadataState& state, std::initializer_list<int> tags) {
    for (const int number : tags)
        if (const auto value = state.number(number)) return value;
    return std::nullopt;
}

/// From the axes of the sensor to north, east and down.
std::optional<cv::Matx33d> attitudeOf(const MetadataState& state) {
    const auto heading = state.number(tag::kPlatformHeading);
    const auto azimuth = state.number(tag::kSensorAzimuth);
    const auto elevation = state.number(tag::kSensorElevation);
    if (!heading || !azimuth || !elevation) return std::nullopt;
    const double platform_pitch = firstOf(state, {tag::kPlatformPitchFull, tag::kPlatformPitch}).value_or(0);
    const double platform_roll = firstOf(state, {tag::kPlatformRollFull, tag::kPlatformRoll}).value_or(0);
    return yaw(*heading) * pitch(platform_pitch) * roll(platform_roll) * yaw(*azimuth) * pitch(*elevation) *
           roll(state.number(tag::kSensorRoll).value_or(0));
}

}  // namespace

std::optional<FieldOfView> fieldOfView(const MetadataState& state, cv::Size size) {
    const auto horizontal = state.number(tag::kHorizontalView);
    if (!horizontal || *horizontal <= 0 || *horizontal >= 170 || size.empty()) return std::nullopt;
    FieldOfView view;
    view.horizontal_deg = *horizontal;
    const auto vertical = state.number(tag::kVerticalView);
    if (vertical && *vertical > 0 && *vertical < 170) {
        view.vertical_deg = *vertical;
    } else {
        const double half = std::tan(radiansFromDegrees(*horizontal / 2)) * size.height / size.width;
        view.vertical_deg = 2 * std::atan(half) * 180 / kPi;
    }
    return view;
}

std::optional<double> heightAboveGround(const MetadataState& state) {
    const auto difference = [&](std::optional<double> sensor, std::optional<double> ground) {
        return sensor && ground && *sensor > *ground ? std::optional(*sensor - *ground) : std::nullopt;
    };
    // Heights over the sea and over the ellipsoid differ by up to 100 m: never one against the other.
    if (const auto height = difference(state.number(tag::kSensorAltitude), state.number(tag::kCentreElevation)))
        return height;
    return difference(firstOf(state, {tag::kSensorEllipsoidHeightExtended, tag::kSensorEllipsoidHeight}),
                      state.number(tag::kCentreEllipsoidHeight));
}

std::optional<CastCorners> castCorners(const MetadataState& state, cv::Size size) {
    const auto latitude = state.number(tag::kSensorLatitude);
    const auto longitude = state.number(tag::kSensorLongitude);
    const auto view = fieldOfView(state, size);
    const auto attitude = attitudeOf(state);
    if (!latitude || !longitude || !view || !attitude) return std::nullopt;
    const double dip = (*attitude)(2, 0);  // of the line of sight
    const auto range = state.number(tag::kSlantRange);
    auto height = heightAboveGround(state);
    if (!height && range && *range > 0 && dip > 0) height = *range * dip;
    if (!height) return std::nullopt;
    CastCorners cast;
    cast.sensor = {*latitude, *longitude};
    const double half_x = std::tan(radiansFromDegrees(view->horizontal_deg / 2));
    const double half_y = std::tan(radiansFromDegrees(view->vertical_deg / 2));
    const std::array<cv::Point2d, 4> corners{cv::Point2d(-1, -1), {1, -1}, {1, 1}, {-1, 1}};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const cv::Vec3d ray = *attitude * cv::Vec3d(1, half_x * corners[i].x, half_y * corners[i].y);
        if (ray[2] < kLeastDip * cv::norm(ray)) return std::nullopt;
        cast.corners_m[i] = {ray[1] * *height / ray[2], ray[0] * *height / ray[2]};
    }
    return cast;
}

}  // namespace eyrie

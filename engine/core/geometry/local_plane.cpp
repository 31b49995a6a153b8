#include "core/geometry/local_plane.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.h"

namespace eyrie {
namespace {

constexpr double kEquatorRadius = 6378137.0;  ///< m, WGS 84
constexpr double kEccentricitySquared = 6.69437999014e-3;
constexpr double kSmallestCosine = 1e-6;  ///< at the poles east is no direction

}  // namespace

LocalPlane::LocalPlane(const GeoPoint& origin) : origin_(origin) {
    const double latitude = radiansFromDegrees(origin.latitude_deg);
    const double w = 1 - kEccentricitySquared * std::sin(latitude) * std::sin(latitude);
    const double across = kEquatorRadius / std::sqrt(w);
    const double along = kEquatorRadius * (1 - kEccentricitySquared) / (w * std::sqrt(w));
    east_m_per_deg_ = radiansFromDegrees(across * std::max(std::cos(latitude), kSmallestCosine));
    north_m_per_deg_ = radiansFromDegrees(along);
}

cv::Point2d LocalPlane::metresOf(const GeoPoint& place) const {
    const double east_deg = std::remainder(place.longitude_deg - origin_.longitude_deg, 360.0);
    return {east_deg * east_m_per_deg_, (place.latitude_deg - origin_.latitude_deg) * north_m_per_deg_};
}

GeoPoint LocalPlane::placeOf(cv::Point2d metres) const {
    return {origin_.latitude_deg + metres.y / north_m_per_deg_,
            std::remainder(origin_.longitude_deg + metres.x / east_m_per_deg_, 360.0)};
}

}  // namespace eyrie

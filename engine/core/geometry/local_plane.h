#pragma once

#include <opencv2/core/types.hpp>

namespace eyrie {

/// A place on the ellipsoid WGS 84.
struct GeoPoint {
    double latitude_deg = 0;   ///< north of the equator
    double longitude_deg = 0;  ///< east of Greenwich

    bool operator==(const GeoPoint&) const = default;
};

/// Metres east (x) and north (y) of an origin, on the plane that touches the ellipsoid there: right to some parts in a
/// thousand within 20 km.
class LocalPlane {
 public:
    LocalPlane() : LocalPlane(GeoPoint()) {}
    explicit LocalPlane(const GeoPoint& origin);

    cv::Point2d metresOf(const GeoPoint& place) const;
    GeoPoint placeOf(cv::Point2d metres) const;
    const GeoPoint& origin() const { return origin_; }

 private:
    GeoPoint origin_;
    double east_m_per_deg_ = 0;
    double north_m_per_deg_ = 0;
};

}  // namespace eyrie

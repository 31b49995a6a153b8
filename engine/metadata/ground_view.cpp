#include "metadata/ground_view.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/geometry/angle.h"
#include "core/geometry/homography_jacobian.h"
#include "core/geometry/outline_map.h"
#include "io/tables/number_text.h"
#include "metadata/sensor_attitude.h"

namespace eyrie {
namespace {

constexpr double kShortestSide = 0.05;    ///< m, of a footprint
constexpr double kFarthest = 200'000.0;   ///< m; beyond, the ground is no plane
constexpr double kFinestScale = 0.001;    ///< m/px
constexpr double kCoarsestScale = 100.0;  ///< m/px
constexpr double kAgreement = 2;          ///< ratio of two scales that are taken for the same

using Quad = std::array<cv::Point2d, 4>;

cv::Point2d middleOf(cv::Size size) {
    return {(size.width - 1) / 2.0, (size.height - 1) / 2.0};
}

/// Why four corners on the ground, metres east and north, cannot be those of a picture; nothing where they can.
const char* disbelief(const Quad& quad) {
    int clockwise = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const cv::Point2d side = quad[(i + 1) % 4] - quad[i];
        const cv::Point2d next = quad[(i + 2) % 4] - quad[(i + 1) % 4];
        const double length = cv::norm(side);
        if (!(length >= kShortestSide)) return "a side has no length";
        if (length > kFarthest) return "a side is longer than 200 km";
        // Three corners almost in line have no area between them.
        const double turn = side.cross(next) / (length * std::max(cv::norm(next), kShortestSide));
        if (turn < -1e-4) ++clockwise;
        if (turn > 1e-4) --clockwise;
    }
    if (clockwise == 4) return nullptr;
    return clockwise == -4 ? "the picture would be mirrored" : "they enclose no convex area";
}

/// Lays the image onto the ground by its corners; answers why not.
const char* lay(GroundView& view, const LocalPlane& plane, const Quad& quad, const MetadataState& state, cv::Size size,
                GroundSource source) {
    if (const char* why = disbelief(quad)) return why;
    const cv::Matx33d map = outlineOnto(quad, size);
    const HomographyJacobian middle(map, middleOf(size));
    const auto latitude = state.number(tag::kCentreLatitude);
    const auto longitude = state.number(tag::kCentreLongitude);
    if (latitude && longitude) {
        const double diagonal = std::max(cv::norm(quad[2] - quad[0]), cv::norm(quad[3] - quad[1]));
        if (cv::norm(plane.metresOf({*latitude, *longitude}) - middle.point()) > diagonal)
            return "the frame centre lies far outside";
    }
    view.source = view.scale_source = source;
    view.plane = plane;
    view.to_plane = map;
    view.footprint.emplace();
    std::transform(quad.begin(), quad.end(), view.footprint->begin(),
                   [&](cv::Point2d corner) { return plane.placeOf(corner); });
    view.gsd_x_m_per_px = cv::norm(middle.vector({1, 0}));
    view.gsd_y_m_per_px = cv::norm(middle.vector({0, 1}));
    const cv::Point2d x = middle.vector({1, 0}), y = middle.vector({0, 1});
    // The step in the image that leads straight north: the inverse of the local map, times (0, 1), but for its length.
    // The picture is not mirrored, so that the map's determinant is negative.
    const cv::Point2d north(y.x, -x.x);
    view.north_deg = degreesFromRadians(std::atan2(north.y, north.x));
    return nullptr;
}

std::optional<std::array<GeoPoint, 4>> statedCorners(const MetadataState& state, int first_tag, GeoPoint origin) {
    std::array<GeoPoint, 4> corners;
    for (int i = 0; i < 4; ++i) {
        const auto latitude = state.number(first_tag + 2 * i);
        const auto longitude = state.number(first_tag + 2 * i + 1);
        if (!latitude || !longitude) return std::nullopt;
        const GeoPoint corner{origin.latitude_deg + *latitude, origin.longitude_deg + *longitude};
        if (std::abs(corner.latitude_deg) > 90 || std::abs(corner.longitude_deg) > 360) return std::nullopt;
        corners[static_cast<std::size_t>(i)] = corner;
    }
    return corners;
}

/// Tries one way of stating corners; answers whether it did.
bool layByStated(GroundView& view, const MetadataState& state, cv::Size size, GroundSource source) {
    GeoPoint origin;
    int first_tag = tag::kCorners;
    if (source == GroundSource::corner_offsets) {
        const auto latitude = state.number(tag::kCentreLatitude);
        const auto longitude = state.number(tag::kCentreLongitude);
        if (!latitude || !longitude) return false;
        origin = {*latitude, *longitude};
        first_tag = tag::kCornerOffsets;
    }
    const auto corners = statedCorners(state, first_tag, origin);
    if (!corners) return false;
    const LocalPlane plane(source == GroundSource::corner_offsets ? origin : (*corners)[0]);
    Quad quad;
    std::transform(corners->begin(), corners->end(), quad.begin(),
                   [&](const GeoPoint& corner) { return plane.metresOf(corner); });
    const char* why = lay(view, plane, quad, state, size, source);
    if (why != nullptr) view.remarks.push_back(std::string(nameOf(source)) + " are not believed: " + why);
    return why == nullptr;
}

void layByAttitude(GroundView& view, const MetadataState& state, cv::Size size) {
    const auto cast = castCorners(state, size);
    if (!cast) return;
    const char* why = lay(view, LocalPlane(cast->sensor), cast->corners_m, state, size, GroundSource::attitude);
    if (why != nullptr)
        view.remarks.push_back(std::string(nameOf(GroundSource::attitude)) + " is not believed: " + why);
}

bool isScale(double gsd) {
    return gsd >= kFinestScale && gsd <= kCoarsestScale;
}

/// Metres per pixel across the picture by the stated width of what it shows.
std::optional<double> scaleByWidth(const MetadataState& state, cv::Size size) {
    auto width = state.number(tag::kTargetWidth);
    if (!width) width = state.number(tag::kTargetWidthExtended);
    if (!width || !isScale(*width / size.width)) return std::nullopt;
    return *width / size.width;
}

void scaleByRange(GroundView& view, const MetadataState& state, cv::Size size) {
    const auto range = state.number(tag::kSlantRange);
    const auto field = fieldOfView(state, size);
    if (!range || !field) return;
    const double across = 2 * *range * std::tan(radiansFromDegrees(field->horizontal_deg / 2)) / size.width;
    if (!isScale(across)) return;
    view.scale_source = GroundSource::slant_range;
    view.gsd_x_m_per_px = across;
    const auto height = heightAboveGround(state);
    if (!height || *height > *range || *height < 0.02 * *range) return;
    const double along = 2 * *range * std::tan(radiansFromDegrees(field->vertical_deg / 2)) / size.height;
    view.gsd_y_m_per_px = along * *range / *height;
}

}  // namespace

const char* nameOf(GroundSource source) {
    switch (source) {
        case GroundSource::corners:
            return "the frame corners";
        case GroundSource::corner_offsets:
            return "the corner offsets";
        case GroundSource::attitude:
            return "the attitude of the sensor";
        case GroundSource::target_width:
            return "the target width";
        case GroundSource::slant_range:
            return "slant range and field of view";
        case GroundSource::none:
            break;
    }
    return "nothing";
}

std::optional<double> GroundView::gsd() const {
    if (gsd_x_m_per_px && gsd_y_m_per_px) return std::sqrt(*gsd_x_m_per_px * *gsd_y_m_per_px);
    return gsd_x_m_per_px ? gsd_x_m_per_px : gsd_y_m_per_px;
}

std::optional<GeoPoint> GroundView::placeOf(cv::Point2d px) const {
    if (!to_plane) return std::nullopt;
    const cv::Vec3d at = *to_plane * cv::Vec3d(px.x, px.y, 1);
    // The map is scaled to be 1 at the upper left corner of the outline, so it is positive all over the picture.
    if (!(at[2] > 1e-9)) return std::nullopt;
    const cv::Point2d metres(at[0] / at[2], at[1] / at[2]);
    if (!(cv::norm(metres) <= 10 * kFarthest)) return std::nullopt;
    return plane.placeOf(metres);
}

std::optional<cv::Point2d> GroundView::pixelOf(const GeoPoint& place) const {
    if (!to_plane) return std::nullopt;
    bool is_regular = false;
    const cv::Matx33d back = to_plane->inv(cv::DECOMP_LU, &is_regular);
    if (!is_regular) return std::nullopt;
    const cv::Point2d metres = plane.metresOf(place);
    const cv::Vec3d at = back * cv::Vec3d(metres.x, metres.y, 1);
    if (at[2] == 0) return std::nullopt;
    const cv::Point2d px(at[0] / at[2], at[1] / at[2]);
    // What lies behind the camera comes out on the wrong side of the horizon.
    return placeOf(px) ? std::optional(px) : std::nullopt;
}

GroundView groundViewOf(const MetadataState& state, cv::Size size) {
    GroundView view;
    if (size.width < 2 || size.height < 2) return view;
    if (!layByStated(view, state, size, GroundSource::corners) &&
        !layByStated(view, state, size, GroundSource::corner_offsets))
        layByAttitude(view, state, size);
    if (view.gsd() && !isScale(*view.gsd())) {
        view.remarks.push_back("a scale of " + fixedText(*view.gsd(), 4) + " m/px is not believed");
        view.gsd_x_m_per_px = view.gsd_y_m_per_px = std::nullopt;
        view.scale_source = GroundSource::none;
    }
    const auto by_width = scaleByWidth(state, size);
    if (!view.gsd_x_m_per_px && by_width) {
        view.gsd_x_m_per_px = by_width;
        view.scale_source = GroundSource::target_width;
    } else if (by_width) {
        const double ratio = *by_width / *view.gsd_x_m_per_px;
        if (ratio > kAgreement || ratio * kAgreement < 1)
            view.remarks.push_back("the target width says " + fixedText(*by_width, 4) + " m/px across, " +
                                   nameOf(view.scale_source) + " say " + fixedText(*view.gsd_x_m_per_px, 4));
    }
    if (!view.gsd_x_m_per_px) scaleByRange(view, state, size);
    return view;
}

}  // namespace eyrie

#include "georeference/geo_reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/geometry/angle.h"
#include "core/geometry/outline_map.h"
#include "georeference/control_fit.h"
#include "io/tables/number_text.h"

namespace eyrie {
namespace {

constexpr double kStep_s = 0.5;
constexpr double kReach_s = 5;
constexpr double kCompared_s = 2;
constexpr double kDoubt = 0.05;          ///< of the picture's diagonal
constexpr double kFarOutside = 1;        ///< widths of the picture: a corner farther out of another frame is no measure
constexpr double kFarFromControl = 100;  ///< the same, where a person said what lies where
constexpr double kHorizon = 1e-9;        ///< denominators of projective maps
constexpr double kFarthest_m = 200'000;  ///< of any corner from the middle of the video

/// Where a projective map takes a point; nothing on or behind the horizon.
std::optional<cv::Point2d> mapped(const cv::Matx33d& map, cv::Point2d point) {
    const cv::Vec3d at = map * cv::Vec3d(point.x, point.y, 1);
    if (!(at[2] > kHorizon)) return std::nullopt;
    return cv::Point2d(at[0] / at[2], at[1] / at[2]);
}

double medianOf(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

/// Whether four corners turn one way all around, so that they are the outline of a picture.
bool isConvex(const std::array<cv::Point2d, 4>& quad) {
    int turns = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const cv::Point2d a = quad[(i + 1) % 4] - quad[i], b = quad[(i + 2) % 4] - quad[(i + 1) % 4];
        turns += a.cross(b) > 0 ? 1 : -1;
    }
    return std::abs(turns) == 4;
}

}  // namespace

GeoReference::GeoReference(const MetadataTimeline& timeline, GeoFootage footage) : footage_(std::move(footage)) {
    const int step = std::max(1, static_cast<int>(std::lround(kStep_s * footage_.frame_rate_hz)));
    reach_ = std::max(1, static_cast<int>(std::lround(kReach_s * footage_.frame_rate_hz)));
    std::map<GroundSource, int> sources;
    bool begun = false;
    for (FrameIndex frame = footage_.first_frame; frame <= footage_.last_frame; frame += step) {
        const MetadataState state = timeline.at(footage_.time_us(frame));
        const GroundView view = groundViewOf(state, footage_.image_size);
        if (!view.footprint) continue;
        if (!begun) plane_ = LocalPlane((*view.footprint)[0]);
        begun = true;
        std::array<cv::Point2d, 4> quad;
        std::transform(view.footprint->begin(), view.footprint->end(), quad.begin(),
                       [&](const GeoPoint& corner) { return plane_.metresOf(corner); });
        if (cv::norm(quad[0]) > kFarthest_m) continue;
        Statement statement{outlineOnto(quad, footage_.image_size), std::nullopt};
        if (const auto height = state.number(tag::kCentreEllipsoidHeight)) {
            statement.elevation = Elevation{*height, true};
        } else if (const auto above_sea = state.number(tag::kCentreElevation)) {
            statement.elevation = Elevation{*above_sea, false};
        }
        views_.emplace(frame, statement);
        ++sources[view.source];
    }
    const auto most = std::max_element(sources.begin(), sources.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    if (most != sources.end()) source_ = most->first;
    measureDisagreement();
    footage_.time_us = {};  // its source need not live on
}

GeoReference GeoReference::byControl(GeoFootage footage, std::vector<std::string>* why_not) {
    GeoReference reference;
    if (footage.control.empty()) return reference;
    reference.plane_ = LocalPlane(footage.control.front().place);
    const std::array<cv::Point2d, 4> corners = outlineOf(footage.image_size);
    for (const ControlFit& fit : fitControlPoints(footage.control, footage.camera, reference.plane_, why_not)) {
        // By points that lie beyond the horizon of the others nothing can be placed.
        if (!std::all_of(corners.begin(), corners.end(),
                         [&](const cv::Point2d& corner) { return mapped(fit.plane_from_image, corner); })) {
            if (why_not != nullptr)
                why_not->push_back("from frame " + std::to_string(fit.frame) + " on there are " +
                                   std::to_string(fit.points) +
                                   " control points, but by them the horizon crosses the picture; check them, and "
                                   "choose some nearer to its corners");
            continue;
        }
        reference.views_.emplace(fit.frame, Statement{fit.plane_from_image, std::nullopt});
        reference.control_fits_.push_back(fit);
    }
    reference.footage_ = std::move(footage);
    reference.footage_.time_us = {};
    constexpr int kAnyDistance = 1 << 28;
    reference.reach_ = kAnyDistance;
    return reference;
}

void GeoReference::measureDisagreement() {
    const int apart = std::max(1, static_cast<int>(std::lround(kCompared_s * footage_.frame_rate_hz)));
    const cv::Size size = footage_.image_size;
    const cv::Point2d middle((size.width - 1) / 2.0, (size.height - 1) / 2.0);
    std::vector<double> distances, diagonals;
    for (const auto& [frame, statement] : views_) {
        const auto later = views_.lower_bound(frame + apart);
        if (later == views_.end()) break;
        const auto there = footage_.camera.map(frame, later->first);
        const auto px = there ? mapped(there->matrix, middle) : std::nullopt;
        const auto here = mapped(statement.plane_from_image, middle);
        const auto found = px ? mapped(later->second.plane_from_image, *px) : std::nullopt;
        const auto a = mapped(statement.plane_from_image, {0, 0});
        const auto b = mapped(statement.plane_from_image, {size.width - 1.0, size.height - 1.0});
        if (!here || !found || !a || !b) continue;
        distances.push_back(cv::norm(*found - *here));
        diagonals.push_back(cv::norm(*b - *a));
    }
    if (distances.empty()) return;
    disagreement_m_ = medianOf(distances);
    doubtful_ = *disagreement_m_ > kDoubt * medianOf(diagonals);
}

std::string GeoReference::origin() const {
    if (!known()) return {};
    if (isByHand()) {
        int points = 0;
        double squares = 0;
        for (const ControlFit& fit : control_fits_) {
            points += fit.points;
            squares += fit.points * fit.rms_m * fit.rms_m;
        }
        return std::to_string(points) + " control points placed by hand (" + fixedText(std::sqrt(squares / points), 1) +
               " m off their places, root mean square), carried by the registration";
    }
    std::string text = std::string(nameOf(source_)) + " in the metadata, steadied by the registration";
    if (!disagreement_m_) return text;
    const std::string apart =
        fixedText(*disagreement_m_, *disagreement_m_ < 10 ? 1 : 0) + " m within " + fixedText(kCompared_s, 0) + " s";
    text += doubtful_ ? "; the metadata contradict the pictures by " + apart +
                            ", so places of different moments cannot be compared"
                      : "; both agree to " + apart;
    return text;
}

std::optional<cv::Matx33d> GeoReference::mapOf(FrameIndex frame) const {
    if (frame == mapped_frame_) return mapped_;
    mapped_frame_ = frame;
    mapped_.reset();
    const std::array<cv::Point2d, 4> corners = outlineOf(footage_.image_size);
    std::array<std::vector<double>, 4> east;
    std::array<std::vector<double>, 4> north;
    const double margin = (isByHand() ? kFarFromControl : kFarOutside) * footage_.image_size.width;
    const cv::Rect2d about(-margin, -margin, footage_.image_size.width + 2 * margin,
                           footage_.image_size.height + 2 * margin);
    for (auto view = views_.lower_bound(frame - reach_); view != views_.end() && view->first <= frame + reach_;
         ++view) {
        const auto there = footage_.camera.map(frame, view->first);
        if (!there) continue;
        std::array<cv::Point2d, 4> places;
        bool whole = true;
        for (std::size_t i = 0; i < 4 && whole; ++i) {
            const auto px = mapped(there->matrix, corners[i]);
            const auto place = px && about.contains(*px) ? mapped(view->second.plane_from_image, *px) : std::nullopt;
            whole = place.has_value();
            if (whole) places[i] = *place;
        }
        if (!whole) continue;
        for (std::size_t i = 0; i < 4; ++i) {
            east[i].push_back(places[i].x);
            north[i].push_back(places[i].y);
        }
    }
    if (east[0].empty()) return std::nullopt;
    std::array<cv::Point2d, 4> quad;
    for (std::size_t i = 0; i < 4; ++i) quad[i] = {medianOf(east[i]), medianOf(north[i])};
    if (isConvex(quad)) mapped_ = outlineOnto(quad, footage_.image_size);
    return mapped_;
}

std::optional<cv::Point2d> GeoReference::metresOf(FrameIndex frame, cv::Point2d px) const {
    const auto map = mapOf(frame);
    return map ? mapped(*map, px) : std::nullopt;
}

std::optional<GeoPoint> GeoReference::placeOf(FrameIndex frame, cv::Point2d px) const {
    const auto metres = metresOf(frame, px);
    if (!metres || cv::norm(*metres) > 2 * kFarthest_m) return std::nullopt;
    return plane_.placeOf(*metres);
}

std::optional<cv::Matx22d> GeoReference::metresPerPixel(FrameIndex frame) const {
    const cv::Point2d middle((footage_.image_size.width - 1) / 2.0, (footage_.image_size.height - 1) / 2.0);
    const auto left = metresOf(frame, middle - cv::Point2d(0.5, 0)),
               right = metresOf(frame, middle + cv::Point2d(0.5, 0));
    const auto above = metresOf(frame, middle - cv::Point2d(0, 0.5)),
               below = metresOf(frame, middle + cv::Point2d(0, 0.5));
    if (!left || !right || !above || !below) return std::nullopt;
    const cv::Point2d across = *right - *left, down = *below - *above;
    return cv::Matx22d(across.x, down.x, across.y, down.y);
}

std::optional<double> GeoReference::northOf(FrameIndex frame) const {
    const auto metres = metresPerPixel(frame);
    if (!metres || cv::determinant(*metres) == 0) return std::nullopt;
    const cv::Vec2d north = metres->inv() * cv::Vec2d(0, 1);
    return degreesFromRadians(std::atan2(north[1], north[0]));
}

std::optional<double> GeoReference::courseOf(FrameIndex frame) const {
    const auto metres = metresPerPixel(frame);
    if (!metres) return std::nullopt;
    const cv::Vec2d up = *metres * cv::Vec2d(0, -1);
    return degreesFromRadians(std::atan2(up[0], up[1]));
}

std::optional<double> GeoReference::gsdOf(FrameIndex frame) const {
    const auto metres = metresPerPixel(frame);
    return metres ? std::optional(std::sqrt(std::abs(cv::determinant(*metres)))) : std::nullopt;
}

const GeoReference::Statement* GeoReference::nearest(FrameIndex frame) const {
    const auto after = views_.lower_bound(frame);
    const Statement* best = nullptr;
    int distance = reach_ + 1;
    if (after != views_.end() && after->first - frame < distance) {
        distance = after->first - frame;
        best = &after->second;
    }
    if (after != views_.begin() && frame - std::prev(after)->first < distance) best = &std::prev(after)->second;
    return best;
}

std::optional<GeoReference::Elevation> GeoReference::elevationOf(FrameIndex frame) const {
    const Statement* statement = nearest(frame);
    return statement != nullptr ? statement->elevation : std::nullopt;
}

}  // namespace eyrie

#include "georeference/control_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/core.hpp>

#include "io/tables/number_text.h"

namespace eyrie {
namespace {

constexpr double kWorstCondition =
    1e-5;  ///< second smallest singular value over the largest: below it points lie on a line

/// Moves points to their middle and makes their mean distance √2 (Hartley).
cv::Matx33d normalising(const std::vector<cv::Point2d>& points) {
    cv::Point2d middle(0, 0);
    for (const cv::Point2d& point : points) middle += point;
    middle /= static_cast<double>(points.size());
    double distance = 0;
    for (const cv::Point2d& point : points) distance += cv::norm(point - middle);
    const double scale = std::sqrt(2.0) * static_cast<double>(points.size()) / std::max(distance, 1e-12);
    return {scale, 0, -scale * middle.x, 0, scale, -scale * middle.y, 0, 0, 1};
}

constexpr double kDoubtful = 0.02;           ///< of the largest distance between points: a worse fit has a wrong point
constexpr double kStandsOut = 1.0 / 3;       ///< of the error is left without a point that stands out
constexpr std::size_t kFewestToSuspect = 6;  ///< without one of five, four are left, which always agree

cv::Point2d applied(const cv::Matx33d& map, cv::Point2d point) {
    const cv::Vec3d at = map * cv::Vec3d(point.x, point.y, 1);
    return {at[0] / at[2], at[1] / at[2]};
}

}  // namespace

std::optional<cv::Matx33d> projectiveMap(const std::vector<cv::Point2d>& image, const std::vector<cv::Point2d>& plane) {
    if (image.size() < static_cast<std::size_t>(kFewestControlPoints) || image.size() != plane.size())
        return std::nullopt;
    const cv::Matx33d from = normalising(image), to = normalising(plane);
    cv::Mat equations(static_cast<int>(2 * image.size()), 9, CV_64F, cv::Scalar(0));
    for (std::size_t i = 0; i < image.size(); ++i) {
        const cv::Point2d a = applied(from, image[i]), b = applied(to, plane[i]);
        const int row = static_cast<int>(2 * i);
        const double first[9] = {a.x, a.y, 1, 0, 0, 0, -b.x * a.x, -b.x * a.y, -b.x};
        const double second[9] = {0, 0, 0, a.x, a.y, 1, -b.y * a.x, -b.y * a.y, -b.y};
        for (int k = 0; k < 9; ++k) {
            equations.at<double>(row, k) = first[k];
            equations.at<double>(row + 1, k) = second[k];
        }
    }
    const cv::SVD svd(equations, cv::SVD::FULL_UV);
    // The null space must be one line: else more than one map fits.
    if (svd.w.at<double>(7) < kWorstCondition * svd.w.at<double>(0)) return std::nullopt;
    cv::Matx33d map;
    for (int k = 0; k < 9; ++k) map.val[k] = svd.vt.at<double>(8, k);
    map = to.inv() * map * from;
    // Positive where the points lie, all on one side of the horizon.
    double sign = 0;
    for (const cv::Point2d& point : image) {
        const double depth = map(2, 0) * point.x + map(2, 1) * point.y + map(2, 2);
        if (depth * sign < 0 || std::abs(depth) < 1e-15) return std::nullopt;
        sign = depth;
    }
    map = map * (sign < 0 ? -1.0 : 1.0);
    const double scale = std::abs(map(2, 2)) > 1e-12 ? std::abs(map(2, 2)) : 1;
    map = map * (1 / scale);
    if (std::abs(cv::determinant(map)) < 1e-15) return std::nullopt;
    return map;
}

namespace {

/// Points of one stretch, in the image of one frame and on the ground.
struct ControlPairs {
    std::vector<std::size_t> points;  ///< places in the list
    std::vector<cv::Point2d> image, ground;
};

double rootMeanSquare(const std::vector<ControlResidual>& residuals) {
    double squares = 0;
    for (const ControlResidual& residual : residuals) squares += residual.metres * residual.metres;
    return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, residuals.size())));
}

std::vector<ControlResidual> residualsOf(const ControlPairs& pairs, const cv::Matx33d& map) {
    std::vector<ControlResidual> residuals;
    for (std::size_t i = 0; i < pairs.points.size(); ++i)
        residuals.push_back({pairs.points[i], cv::norm(applied(map, pairs.image[i]) - pairs.ground[i])});
    return residuals;
}

/// Whether x, which goes right, and y, which goes down, do not lie on the ground as a camera sees them from above. In
/// front of the horizon a projective map turns areas over by the sign of its determinant.
bool isMirrored(const cv::Matx33d& map) {
    return cv::determinant(map) > 0;
}

std::optional<std::size_t> suspectAmong(const ControlPairs& pairs, double rms_m) {
    if (pairs.points.size() < kFewestToSuspect) return std::nullopt;
    std::optional<std::size_t> suspect;
    double least_m = kStandsOut * rms_m;
    for (std::size_t out = 0; out < pairs.points.size(); ++out) {
        ControlPairs others = pairs;
        const auto at = static_cast<std::ptrdiff_t>(out);
        others.points.erase(others.points.begin() + at);
        others.image.erase(others.image.begin() + at);
        others.ground.erase(others.ground.begin() + at);
        const auto map = projectiveMap(others.image, others.ground);
        if (!map) continue;
        const double without_m = rootMeanSquare(residualsOf(others, *map));
        if (without_m >= least_m) continue;
        least_m = without_m;
        suspect = pairs.points[out];
    }
    return suspect;
}

void judge(ControlFit& fit, const ControlPairs& pairs) {
    double span_m = 0;
    for (const cv::Point2d& a : pairs.ground)
        for (const cv::Point2d& b : pairs.ground) span_m = std::max(span_m, cv::norm(a - b));
    fit.doubtful = fit.rms_m > kDoubtful * span_m;
    if (fit.doubtful) fit.suspect = suspectAmong(pairs, fit.rms_m);
}

}  // namespace

std::string remarkOn(const ControlFit& fit) {
    if (!fit.doubtful) return {};
    const std::string off = "the points contradict each other by " + fixedText(fit.rms_m, 1) + " m";
    if (fit.suspect)
        return off + "; without point " + std::to_string(*fit.suspect + 1) +
               " the others agree, so that one is probably wrong";
    return off + (static_cast<std::size_t>(fit.points) < kFewestToSuspect
                      ? "; one of them is probably wrong, and a sixth point would tell which"
                      : "; several are probably wrong");
}

std::vector<ControlFit> fitControlPoints(const std::vector<ControlPoint>& points, const CameraMotion& camera,
                                         const LocalPlane& plane, std::vector<std::string>* why_not) {
    std::vector<std::size_t> left(points.size());
    std::iota(left.begin(), left.end(), std::size_t{0});
    std::stable_sort(left.begin(), left.end(),
                     [&](std::size_t a, std::size_t b) { return points[a].frame < points[b].frame; });
    std::vector<ControlFit> fits;
    while (!left.empty()) {
        ControlFit fit;
        fit.frame = points[left.front()].frame;
        ControlPairs pairs;
        std::vector<std::size_t> others;
        for (const std::size_t index : left) {
            const ControlPoint& point = points[index];
            const auto there = camera.map(point.frame, fit.frame);
            if (point.frame != fit.frame && !there) {
                others.push_back(index);
                continue;
            }
            pairs.points.push_back(index);
            pairs.image.push_back(point.frame == fit.frame ? point.px : there->apply(point.px));
            pairs.ground.push_back(plane.metresOf(point.place));
        }
        left = std::move(others);
        const auto tell = [&](const std::string& what) {
            if (why_not != nullptr)
                why_not->push_back("from frame " + std::to_string(fit.frame) + " on there are " + what);
        };
        fit.points = static_cast<int>(pairs.image.size());
        if (fit.points < kFewestControlPoints) {
            tell(std::to_string(fit.points) + " control points that the registration connects; four are needed");
            continue;
        }
        const auto map = projectiveMap(pairs.image, pairs.ground);
        if (!map) {
            tell(std::to_string(fit.points) + " control points, but they lie on a line or contradict each other");
            continue;
        }
        if (isMirrored(*map)) {
            tell(
                std::to_string(fit.points) +
                " control points, but by them the picture is a mirror image; two of them may be exchanged, or latitude "
                "and longitude");
            continue;
        }
        fit.plane_from_image = *map;
        fit.residuals = residualsOf(pairs, *map);
        fit.rms_m = rootMeanSquare(fit.residuals);
        judge(fit, pairs);
        fits.push_back(std::move(fit));
    }
    return fits;
}

}  // namespace eyrie

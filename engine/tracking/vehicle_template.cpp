#include "tracking/vehicle_template.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace eyrie {
namespace {

constexpr double kLookContrast = 4;    ///< grey levels, deviation of a chip that can be recognised
constexpr double kLargestZoom = 2;     ///< between taking and finding
constexpr int kSmallestLook = 4;       ///< px
constexpr double kMostSamples = 450;   ///< about as many pixels a chip has at most; more cost and tell no more
constexpr double kStrip = 0.1;         ///< share of the size that is taken of the ground on each side …
constexpr double kNarrowestStrip = 1;  ///< … and px, at least
constexpr double kLargestReach = 64;   ///< px

/// A turned and scaled part of the image around a centre, heading up.
cv::Mat sampled(const cv::Mat& gray, const OrientedBox& at, double step, cv::Size size) {
    const cv::Point2d ahead = at.direction() * step;
    const cv::Point2d right(-ahead.y, ahead.x);
    const cv::Point2d origin = at.centre + ahead * ((size.height - 1) / 2.0) - right * ((size.width - 1) / 2.0);
    const cv::Matx23d image_from_chip(right.x, -ahead.x, origin.x, right.y, -ahead.y, origin.y);
    cv::Mat chip;
    cv::warpAffine(gray, chip, image_from_chip, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
    return chip;
}

bool liesInside(const OrientedBox& box, cv::Size image) {
    return std::isfinite(box.centre.x) && std::isfinite(box.centre.y) && std::isfinite(box.heading) &&
           areaInImage(box, image) >= 0.999 * box.area();
}

struct Agreement {
    double correlation = 0;
    double contrast = 0;  ///< deviation of the part of the area, grey levels
};

Agreement agreementAt(const cv::Mat& chip, const cv::Mat& area, cv::Point corner) {
    int sum_a = 0, sum_b = 0, sum_aa = 0, sum_bb = 0, sum_ab = 0;
    for (int y = 0; y < chip.rows; ++y) {
        const uchar* a = chip.ptr<uchar>(y);
        const uchar* b = area.ptr<uchar>(corner.y + y) + corner.x;
        for (int x = 0; x < chip.cols; ++x) {
            sum_a += a[x];
            sum_b += b[x];
            sum_aa += a[x] * a[x];
            sum_bb += b[x] * b[x];
            sum_ab += a[x] * b[x];
        }
    }
    const auto n = static_cast<double>(chip.total());
    const double spread_a = n * sum_aa - 1.0 * sum_a * sum_a;
    const double spread_b = n * sum_bb - 1.0 * sum_b * sum_b;
    if (!(spread_a > 0 && spread_b > 0)) return {};
    return {(n * sum_ab - 1.0 * sum_a * sum_b) / std::sqrt(spread_a * spread_b), std::sqrt(spread_b) / n};
}

/// Where the top of a parabola through three neighbours lies, −0.5 … 0.5.
double topOf(double before, double at, double after) {
    const double bend = before - 2 * at + after;
    return bend < 0 ? std::clamp((before - after) / (2 * bend), -0.5, 0.5) : 0;
}

cv::Point2d peakAround(const cv::Mat1d& scores, cv::Point best) {
    cv::Point2d peak(best);
    if (best.x > 0 && best.x + 1 < scores.cols)
        peak.x += topOf(scores(best.y, best.x - 1), scores(best), scores(best.y, best.x + 1));
    if (best.y > 0 && best.y + 1 < scores.rows)
        peak.y += topOf(scores(best.y - 1, best.x), scores(best), scores(best.y + 1, best.x));
    return peak;
}

}  // namespace

std::optional<VehicleTemplate> VehicleTemplate::of(const cv::Mat& gray, const OrientedBox& box) {
    if (gray.empty() || !(std::min(box.length, box.width) >= kSmallestLook)) return std::nullopt;
    if (!liesInside(box, gray.size())) return std::nullopt;
    VehicleTemplate look;
    look.box_ = box;
    look.step_ = std::max(1.0, std::sqrt(box.area() / kMostSamples));
    const double length = box.length + 2 * std::max(kNarrowestStrip, kStrip * box.length);
    const double width = box.width + 2 * std::max(kNarrowestStrip, kStrip * box.width);
    look.chip_ = sampled(gray, box, look.step_, {cvRound(width / look.step_), cvRound(length / look.step_)});
    if (agreementAt(look.chip_, look.chip_, {0, 0}).contrast < kLookContrast) return std::nullopt;
    return look;
}

std::optional<LookMatch> VehicleTemplate::find(const cv::Mat& gray, const OrientedBox& expected, double reach) const {
    const double zoom = std::sqrt(expected.area() / box_.area());
    if (gray.empty() || !(zoom < kLargestZoom && zoom * kLargestZoom > 1)) return std::nullopt;
    if (!liesInside(expected, gray.size())) return std::nullopt;
    const double step = step_ * zoom;
    const auto radius = static_cast<int>(std::ceil(std::clamp(reach, 1.0, kLargestReach) / step));
    const cv::Point half(std::max(1, cvRound(expected.width / 2 / step)),
                         std::max(1, cvRound(expected.length / 2 / step)));
    const cv::Point margin(radius + half.x, radius + half.y);
    const cv::Mat area = sampled(gray, expected, step, chip_.size() + cv::Size(2 * margin.x, 2 * margin.y));

    cv::Mat1d scores(2 * radius + 1, 2 * radius + 1);
    for (int y = 0; y < scores.rows; ++y) {
        for (int x = 0; x < scores.cols; ++x)
            scores(y, x) = agreementAt(chip_, area, {half.x + x, half.y + y}).correlation;
    }
    LookMatch match;
    cv::Point place;
    cv::minMaxLoc(scores, nullptr, &match.agreement, nullptr, &place);
    const cv::Point corner = half + place;
    if (agreementAt(chip_, area, corner).contrast < kLookContrast) return std::nullopt;
    match.beside = -1;
    for (const cv::Point off : {cv::Point(half.x, 0), cv::Point(-half.x, 0), {0, half.y}, {0, -half.y}})
        match.beside = std::max(match.beside, agreementAt(chip_, area, corner + off).correlation);
    const cv::Point2d off = (peakAround(scores, place) - cv::Point2d(radius, radius)) * step;
    const cv::Point2d ahead = expected.direction();
    match.centre = expected.centre - ahead * off.y + cv::Point2d(-ahead.y, ahead.x) * off.x;
    return match;
}

}  // namespace eyrie

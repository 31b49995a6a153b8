#include "motion/area_matching.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace eyrie {
namespace {

constexpr double kPlain = 2;  ///< grey values; areas that deviate less have nothing to be found by

/// Where the parabola through three equidistant values has its top, −½ … ½ around the middle one.
double topOf(double before, double middle, double after) {
    const double bend = before - 2 * middle + after;
    return bend < 0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0;
}

}  // namespace

std::optional<AreaMatch> matchArea(const std::vector<cv::Point>& pixels, const cv::Mat& from, const cv::Mat& to,
                                   cv::Point around, int reach) {
    const cv::Rect bounds = cv::boundingRect(pixels);
    const cv::Rect searched(bounds.x + around.x - reach - 1, bounds.y + around.y - reach - 1,
                            bounds.width + 2 * reach + 2, bounds.height + 2 * reach + 2);
    if (pixels.empty() || (searched & cv::Rect({0, 0}, to.size())) != searched) return std::nullopt;
    const auto count = static_cast<double>(pixels.size());
    double sum = 0;
    double squares = 0;
    for (const cv::Point& p : pixels) {
        const double value = from.at<uchar>(p);
        sum += value;
        squares += value * value;
    }
    const double own = squares - sum * sum / count;
    if (own < kPlain * kPlain * count) return std::nullopt;

    const int side = 2 * reach + 3;  // one more on every side, for the fraction of a pixel
    cv::Mat1d found(side, side);
    for (int dy = 0; dy < side; ++dy) {
        for (int dx = 0; dx < side; ++dx) {
            const cv::Point shift(around.x + dx - reach - 1, around.y + dy - reach - 1);
            double there = 0;
            double there_squares = 0;
            double product = 0;
            for (const cv::Point& p : pixels) {
                const double a = from.at<uchar>(p);
                const double b = to.at<uchar>(p + shift);
                there += b;
                there_squares += b * b;
                product += a * b;
            }
            const double other = there_squares - there * there / count;
            found(dy, dx) = other > 0 ? (product - sum * there / count) / std::sqrt(own * other) : 0;
        }
    }
    cv::Point best;
    AreaMatch match;
    cv::minMaxLoc(found(cv::Rect(1, 1, side - 2, side - 2)), nullptr, &match.correlation, nullptr, &best);
    best += cv::Point(1, 1);
    match.shift = cv::Point2d(around + best - cv::Point(reach + 1, reach + 1)) +
                  cv::Point2d(topOf(found(best.y, best.x - 1), found(best), found(best.y, best.x + 1)),
                              topOf(found(best.y - 1, best.x), found(best), found(best.y + 1, best.x)));
    return match;
}

}  // namespace eyrie

#include "motion/area_matching.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

namespace eyrie {
namespace {

constexpr double kPlain = 2;  ///< grey values; areas that deviate less have nothing to be found by

constexpr int kFineReach = 2;           ///< px around the best of every other shift
constexpr std::size_t kFewPixels = 48;  ///< that every other shift is tried with

/// Where the parabola through three equidistant values has its top, −½ … ½ around the middle one.
double topOf(double before, double middle, double after) {
    const double bend = before - 2 * middle + after;
    return bend < 0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0;
}

/// Pixels with their grey values, ready to be laid over another picture.
class Pattern {
 public:
    Pattern(const std::vector<cv::Point>& pixels, std::size_t step, const cv::Mat& from) {
        for (std::size_t i = 0; i < pixels.size(); i += step) {
            pixels_.push_back(pixels[i]);
            const int value = from.at<uchar>(pixels[i]);
            values_.push_back(value);
            sum_ += value;
            squares_ += static_cast<std::int64_t>(value) * value;
        }
    }
    /// Sum of squared deviations from the mean.
    double spread() const { return spreadOf(sum_, squares_); }
    double correlation(const cv::Mat& to, cv::Point shift) const {
        std::int64_t there = 0;
        std::int64_t there_squares = 0;
        std::int64_t product = 0;
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            const int value = to.ptr<uchar>(pixels_[i].y + shift.y)[pixels_[i].x + shift.x];
            there += value;
            there_squares += value * value;
            product += value * values_[i];
        }
        const double both = spread() * spreadOf(there, there_squares);
        const double common =
            static_cast<double>(product) - static_cast<double>(sum_) * static_cast<double>(there) / count();
        return both > 0 ? common / std::sqrt(both) : 0;
    }
    double count() const { return static_cast<double>(pixels_.size()); }

 private:
    double spreadOf(std::int64_t sum, std::int64_t squares) const {
        return static_cast<double>(squares) - static_cast<double>(sum) * static_cast<double>(sum) / count();
    }
    std::vector<cv::Point> pixels_;
    std::vector<int> values_;
    std::int64_t sum_ = 0;
    std::int64_t squares_ = 0;
};

/// The shift with the best correlation among those `step` px apart within `reach` of `around`.
cv::Point bestShift(const Pattern& pattern, const cv::Mat& to, cv::Point around, int reach, int step) {
    cv::Point best = around;
    double highest = -2;
    for (int dy = -reach; dy <= reach; dy += step) {
        for (int dx = -reach; dx <= reach; dx += step) {
            const double correlation = pattern.correlation(to, around + cv::Point(dx, dy));
            if (correlation <= highest) continue;
            highest = correlation;
            best = around + cv::Point(dx, dy);
        }
    }
    return best;
}

}  // namespace

std::optional<AreaMatch> matchArea(const std::vector<cv::Point>& pixels, const cv::Mat& from, const cv::Mat& to,
                                   cv::Point around, int reach) {
    const cv::Rect bounds = cv::boundingRect(pixels);
    const int margin = reach + kFineReach + 1;
    const cv::Rect searched(bounds.x + around.x - margin, bounds.y + around.y - margin, bounds.width + 2 * margin,
                            bounds.height + 2 * margin);
    if (pixels.empty() || (searched & cv::Rect({0, 0}, to.size())) != searched) return std::nullopt;
    const Pattern pattern(pixels, 1, from);
    if (pattern.spread() < kPlain * kPlain * pattern.count()) return std::nullopt;
    cv::Point best = around;
    if (reach > 2 * kFineReach) {
        // Every other shift with some of the pixels shows where to look closely.
        const Pattern some(pixels, std::max<std::size_t>(1, pixels.size() / kFewPixels), from);
        best = bestShift(some, to, around, reach, 2);
        best = bestShift(pattern, to, best, kFineReach, 1);
    } else {
        best = bestShift(pattern, to, around, reach, 1);
    }
    const auto at = [&](int dx, int dy) { return pattern.correlation(to, best + cv::Point(dx, dy)); };
    AreaMatch match;
    match.correlation = at(0, 0);
    match.shift = cv::Point2d(best) + cv::Point2d(topOf(at(-1, 0), match.correlation, at(1, 0)),
                                                  topOf(at(0, -1), match.correlation, at(0, 1)));
    return match;
}

}  // namespace eyrie

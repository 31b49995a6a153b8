#include "motion/differences/area_matching.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

namespace eyrie {
namespace {

constexpr double kPlain = 2;  ///< grey values; areas that deviate less have nothing to be found by

constexpr int kFineReach = 2;           ///< px around the best of every other shift
constexpr std::size_t kFewPixels = 48;  ///< that every other shift is tried with
constexpr std::size_t kMostPixels = 65'000;
constexpr int kGiveCells = 2;  ///< shifts that lie so many steps of the coarse search apart may be one way
constexpr int kWaysTried = 4;  ///< the best of the coarse search

/// Where the parabola through three equidistant values has its top, −½ … ½ around the middle one.
double topOf(double before, double middle, double after) {
    const double bend = before - 2 * middle + after;
    return bend < 0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0;
}

/// Pixels with their grey values, ready to be laid over another picture.
class Pattern {
 public:
    /// `to`: the picture it will be laid over; it must outlive the pattern.
    Pattern(const std::vector<cv::Point>& pixels, std::size_t step, const cv::Mat& from, const cv::Mat& to) : to_(to) {
        for (std::size_t i = 0; i < pixels.size(); i += step) {
            const auto value = from.at<uchar>(pixels[i]);
            pixels_.push_back({offsetOf(pixels[i]), value});
            sum_ += value;
            squares_ += std::uint32_t{value} * value;
        }
    }
    /// Sum of squared deviations from the mean.
    double spread() const { return spreadOf(sum_, squares_); }
    double correlation(cv::Point shift) const {
        const uchar* shifted = to_.data + offsetOf(shift);
        std::uint32_t there = 0;
        std::uint32_t there_squares = 0;
        std::uint32_t product = 0;
        for (const Pixel& pixel : pixels_) {
            const std::uint32_t value = shifted[pixel.offset];
            there += value;
            there_squares += value * value;
            product += value * pixel.value;
        }
        const double both = spread() * spreadOf(there, there_squares);
        const double common = product - static_cast<double>(sum_) * there / count();
        return both > 0 ? common / std::sqrt(both) : 0;
    }
    double count() const { return static_cast<double>(pixels_.size()); }

 private:
    struct Pixel {
        std::ptrdiff_t offset;  ///< in the picture it is laid over
        std::uint32_t value;
    };
    std::ptrdiff_t offsetOf(cv::Point p) const { return p.y * static_cast<std::ptrdiff_t>(to_.step[0]) + p.x; }
    double spreadOf(double sum, double squares) const { return squares - sum * sum / count(); }

    const cv::Mat& to_;
    std::vector<Pixel> pixels_;
    std::uint32_t sum_ = 0;  ///< like all sums here below 2³² for areas of up to kMostPixels
    std::uint32_t squares_ = 0;
};

/// The shift with the best correlation among those of `allowed` that lie `step` px apart within `reach` of `around`.
cv::Point bestShift(const Pattern& pattern, cv::Point around, int reach, int step, const cv::Rect& allowed) {
    cv::Point best = around;
    double highest = -2;
    for (int dy = -reach; dy <= reach; dy += step) {
        for (int dx = -reach; dx <= reach; dx += step) {
            const cv::Point shift = around + cv::Point(dx, dy);
            if (!allowed.contains(shift)) continue;
            const double correlation = pattern.correlation(shift);
            if (correlation <= highest) continue;
            highest = correlation;
            best = shift;
        }
    }
    return best;
}

/// Shifts that keep an area inside a picture, with a pixel around it for the fraction. Nothing where `around` is none
/// of them, or the area is empty or too large to be looked for.
std::optional<cv::Rect> shiftsInside(const std::vector<cv::Point>& pixels, cv::Size picture, cv::Point around) {
    if (pixels.empty() || pixels.size() > kMostPixels) return std::nullopt;
    const cv::Rect bounds = cv::boundingRect(pixels);
    const cv::Rect allowed(cv::Point(1, 1) - bounds.tl(), picture - bounds.size() - cv::Size(1, 1));
    return allowed.contains(around) ? std::optional(allowed) : std::nullopt;
}

bool isPlain(const Pattern& pattern) {
    return pattern.spread() < kPlain * kPlain * pattern.count();
}

/// The match at a shift, to a fraction of a pixel.
AreaMatch matchAt(const Pattern& pattern, cv::Point shift) {
    const auto at = [&](int dx, int dy) { return pattern.correlation(shift + cv::Point(dx, dy)); };
    AreaMatch match;
    match.correlation = at(0, 0);
    match.shift = cv::Point2d(shift) + cv::Point2d(topOf(at(-1, 0), match.correlation, at(1, 0)),
                                                   topOf(at(0, -1), match.correlation, at(0, 1)));
    return match;
}

/// Every how many of an area's pixels a coarse search looks at.
std::size_t coarseStep(const std::vector<cv::Point>& pixels) {
    return std::max<std::size_t>(1, pixels.size() / kFewPixels);
}

/// Correlations at every other shift up to `cells` of them around `around`, in rows and columns, or at the opposite
/// ones where `way` is −1; −2 where the area would not stay inside.
cv::Mat1f coarseCorrelations(const Pattern& pattern, cv::Point around, int cells, int way, const cv::Rect& allowed) {
    cv::Mat1f all(2 * cells + 1, 2 * cells + 1, -2.0F);
    for (int y = 0; y < all.rows; ++y) {
        for (int x = 0; x < all.cols; ++x) {
            const cv::Point shift = around + 2 * way * cv::Point(x - cells, y - cells);
            if (allowed.contains(shift)) all(y, x) = static_cast<float>(pattern.correlation(shift));
        }
    }
    return all;
}

}  // namespace

std::optional<AreaMatch> matchArea(const std::vector<cv::Point>& pixels, const cv::Mat& from, const cv::Mat& to,
                                   cv::Point around, int reach) {
    const auto allowed = shiftsInside(pixels, to.size(), around);
    if (!allowed) return std::nullopt;
    const Pattern pattern(pixels, 1, from, to);
    if (isPlain(pattern)) return std::nullopt;
    cv::Point best = around;
    if (reach > 2 * kFineReach) {
        // Every other shift with some of the pixels shows where to look closely.
        const Pattern some(pixels, coarseStep(pixels), from, to);
        best = bestShift(some, around, reach, 2, *allowed);
        best = bestShift(pattern, best, kFineReach, 1, *allowed);
    } else {
        best = bestShift(pattern, around, reach, 1, *allowed);
    }
    return matchAt(pattern, best);
}

std::optional<AreaWay> matchWay(const std::vector<cv::Point>& pixels, const cv::Mat& from, const cv::Mat& later,
                                const cv::Mat& earlier, cv::Point around, int reach, double give) {
    const auto allowed = shiftsInside(pixels, later.size(), around);
    if (!allowed) return std::nullopt;
    const Pattern on(pixels, 1, from, later);
    if (isPlain(on)) return std::nullopt;
    const Pattern came(pixels, 1, from, earlier);

    const int cells = reach / 2;
    const std::size_t step = coarseStep(pixels);
    cv::Mat1f both = coarseCorrelations(Pattern(pixels, step, from, earlier), around, cells, -1, *allowed);
    const cv::Size about(2 * kGiveCells + 1, 2 * kGiveCells + 1);
    cv::dilate(both, both, cv::Mat1b::ones(about));
    both += coarseCorrelations(Pattern(pixels, step, from, later), around, cells, 1, *allowed);

    std::optional<AreaWay> best;
    for (int tried = 0; tried < kWaysTried; ++tried) {
        double sum = 0;
        cv::Point cell;
        cv::minMaxLoc(both, nullptr, &sum, nullptr, &cell);
        if (!(sum > 0)) break;
        const cv::Rect near(cell - cv::Point(kGiveCells, kGiveCells), about);
        both(near & cv::Rect({}, both.size())) = -4;
        const cv::Point there = bestShift(on, around + 2 * (cell - cv::Point(cells, cells)), kFineReach, 1, *allowed);
        const cv::Point shift = there - around;
        const int differs = std::max(kFineReach, cvRound(give * std::hypot(shift.x, shift.y)));
        if (!allowed->contains(around - shift)) continue;
        const cv::Point whence = bestShift(came, around - shift, differs, 1, *allowed);
        const AreaWay way{matchAt(on, there), matchAt(came, whence)};
        if (!best || way.correlation() > best->correlation()) best = way;
    }
    return best;
}

}  // namespace eyrie

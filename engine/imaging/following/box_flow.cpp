#include "imaging/following/box_flow.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <vector>

#include "core/geometry/angle.h"
#include "core/robust_statistics.h"

namespace eyrie {
namespace {

using Points = std::vector<cv::Point2f>;

/// A turn, a scale and a shift: x' = a·x − b·y + s, y' = b·x + a·y + t.
struct Similarity {
    double a = 1;
    double b = 0;
    cv::Point2d shift;
    cv::Point2d apply(cv::Point2d p) const { return {a * p.x - b * p.y + shift.x, b * p.x + a * p.y + shift.y}; }
};

struct Fit {
    Similarity map;
    int agreeing = 0;
};

/// Least squares over the chosen pairs; a shift only for fewer than `least_for_turn`.
Similarity leastSquares(const std::vector<cv::Point2d>& from, const std::vector<cv::Point2d>& to,
                        const std::vector<char>& chosen, int least_for_turn) {
    cv::Point2d mean_from(0, 0);
    cv::Point2d mean_to(0, 0);
    int count = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        if (!chosen[i]) continue;
        mean_from += from[i];
        mean_to += to[i];
        ++count;
    }
    Similarity map;
    if (count == 0) return map;
    mean_from *= 1.0 / count;
    mean_to *= 1.0 / count;
    double dot = 0;
    double cross = 0;
    double spread = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        if (!chosen[i]) continue;
        const cv::Point2d p = from[i] - mean_from;
        const cv::Point2d q = to[i] - mean_to;
        dot += p.dot(q);
        cross += p.x * q.y - p.y * q.x;
        spread += p.dot(p);
    }
    if (count >= least_for_turn && spread > 1e-6) {
        map.a = dot / spread;
        map.b = cross / spread;
    }
    map.shift =
        mean_to - cv::Point2d(map.a * mean_from.x - map.b * mean_from.y, map.b * mean_from.x + map.a * mean_from.y);
    return map;
}

/// Starts from the median shift and drops what does not agree to within `near` px or two.
Fit robustFit(const std::vector<cv::Point2d>& from, const std::vector<cv::Point2d>& to, int least_for_turn,
              double near = 1) {
    Fit fit;
    if (from.empty()) return fit;
    std::vector<double> x;
    std::vector<double> y;
    for (std::size_t i = 0; i < from.size(); ++i) {
        x.push_back(to[i].x - from[i].x);
        y.push_back(to[i].y - from[i].y);
    }
    fit.map.shift = {medianOf(x), medianOf(y)};
    constexpr int kRounds = 3;
    std::vector<char> chosen(from.size());
    for (int round = 0; round < kRounds; ++round) {
        std::vector<double> residuals;
        for (std::size_t i = 0; i < from.size(); ++i) {
            const cv::Point2d off = fit.map.apply(from[i]) - to[i];
            residuals.push_back(std::hypot(off.x, off.y));
        }
        const double limit = std::clamp(2.5 * medianOf(residuals), near / 2, 2 * near);
        fit.agreeing = 0;
        for (std::size_t i = 0; i < from.size(); ++i) {
            chosen[i] = residuals[i] <= limit;
            fit.agreeing += chosen[i];
        }
        fit.map = leastSquares(from, to, chosen, least_for_turn);
    }
    return fit;
}

/// The part of a picture that matters, so that large pictures cost no more than small ones.
cv::Rect windowAround(const cv::Mat& picture, const OrientedBox& a, const OrientedBox& b, double margin) {
    std::vector<cv::Point2d> corners;
    for (const auto& corner : a.corners()) corners.push_back(corner);
    for (const auto& corner : b.corners()) corners.push_back(corner);
    const OrientedBox both = boxAround(corners, 0);
    const cv::Rect around(static_cast<int>(both.centre.x - both.length / 2 - margin),
                          static_cast<int>(both.centre.y - both.width / 2 - margin),
                          static_cast<int>(both.length + 2 * margin), static_cast<int>(both.width + 2 * margin));
    return around & cv::Rect(0, 0, picture.cols, picture.rows);
}

void fill(cv::Mat& mask, const OrientedBox& box, cv::Point offset, double factor, unsigned char value) {
    std::vector<cv::Point> polygon;
    for (const cv::Point2d& corner : box.scaled(factor, factor).corners()) {
        polygon.emplace_back(cvRound(corner.x) - offset.x, cvRound(corner.y) - offset.y);
    }
    cv::fillConvexPoly(mask, polygon, cv::Scalar(value));
}

/// Tracks points there and back; `guess` are first guesses in the next picture. Keeps those that come back.
void trackBothWays(const cv::Mat& current, const cv::Mat& next, Points& points, Points& guess, double max_error) {
    if (points.empty()) return;
    const cv::Size window(9, 9);
    constexpr int kLevels = 2;
    const cv::TermCriteria stop(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 20, 0.01);
    Points there = guess;
    std::vector<unsigned char> found;
    std::vector<unsigned char> found_back;
    std::vector<float> error;
    cv::calcOpticalFlowPyrLK(current, next, points, there, found, error, window, kLevels, stop,
                             cv::OPTFLOW_USE_INITIAL_FLOW);
    Points back(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) back[i] = there[i] - (guess[i] - points[i]);
    cv::calcOpticalFlowPyrLK(next, current, there, back, found_back, error, window, kLevels, stop,
                             cv::OPTFLOW_USE_INITIAL_FLOW);
    Points kept_from;
    Points kept_to;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const cv::Point2f off = back[i] - points[i];
        if (!found[i] || !found_back[i] || !(std::hypot(off.x, off.y) <= static_cast<float>(max_error))) continue;
        kept_from.push_back(points[i]);
        kept_to.push_back(there[i]);
    }
    points = std::move(kept_from);
    guess = std::move(kept_to);
}

constexpr double kQuality = 0.02;
constexpr double kSpacingPx = 2;

}  // namespace

BoxFlow flowOf(const cv::Mat& current, const cv::Mat& next, const OrientedBox& box, const OrientedBox& predicted,
               const BoxFlowOptions& options) {
    BoxFlow flow;
    flow.box = predicted;
    constexpr double kMargin = 40;
    const cv::Rect window = windowAround(current, box, predicted, kMargin);
    if (window.width < 16 || window.height < 16) return flow;
    cv::Mat mask = cv::Mat::zeros(window.size(), CV_8UC1);
    fill(mask, box, window.tl(), 0.95, 255);
    Points points;
    cv::goodFeaturesToTrack(current(window), points, options.max_corners, kQuality, kSpacingPx, mask, 3);
    const cv::Point2d offset = window.tl();
    // The box's own movement as a first guess for each of its points.
    const auto asPredicted = [&](cv::Point2d point) {
        const cv::Point2d inside = box.toBox(point);
        const double scale = box.length > 0 ? predicted.length / box.length : 1;
        return predicted.toImage(inside * scale);
    };
    Points guess;
    for (const cv::Point2f& point : points) guess.push_back(asPredicted(cv::Point2d(point) + offset) - offset);
    trackBothWays(current(window), next(window), points, guess, options.max_forward_backward_px);
    flow.corners = static_cast<int>(points.size());
    if (points.empty()) return flow;
    // What is left over the prediction.
    std::vector<cv::Point2d> expected;
    std::vector<cv::Point2d> found;
    for (std::size_t i = 0; i < points.size(); ++i) {
        expected.push_back(asPredicted(cv::Point2d(points[i]) + offset));
        found.push_back(cv::Point2d(guess[i]) + offset);
    }
    constexpr int kLeastForTurn = 5;
    constexpr double kLargestTurn = 0.12;
    constexpr double kNearShare = 0.02;  // of the box's size: what is seen from near by does not move as one plane
    const Fit fit = robustFit(expected, found, kLeastForTurn, std::max(1.0, kNearShare * std::sqrt(box.area())));
    flow.agreeing = fit.agreeing;
    flow.growth = std::hypot(fit.map.a, fit.map.b);
    flow.box.centre = fit.map.apply(predicted.centre);
    flow.box.heading =
        wrapPi(predicted.heading + std::clamp(std::atan2(fit.map.b, fit.map.a), -kLargestTurn, kLargestTurn));
    return flow;
}

Homography cameraAround(const cv::Mat& current, const cv::Mat& next, const OrientedBox& box) {
    Homography map;
    constexpr double kMargin = 80;
    const cv::Rect window = windowAround(current, box, box, kMargin);
    if (window.width < 32 || window.height < 32) return map;
    cv::Mat mask(window.size(), CV_8UC1, cv::Scalar(255));
    fill(mask, box, window.tl(), 1.3, 0);
    Points points;
    constexpr int kCorners = 150;
    cv::goodFeaturesToTrack(current(window), points, kCorners, kQuality, 4, mask, 3);
    Points found = points;
    trackBothWays(current(window), next(window), points, found, 0.7);
    constexpr std::size_t kLeast = 12;
    if (points.size() < kLeast) return map;
    const cv::Point2d offset = window.tl();
    std::vector<cv::Point2d> from;
    std::vector<cv::Point2d> to;
    for (std::size_t i = 0; i < points.size(); ++i) {
        from.push_back(cv::Point2d(points[i]) + offset);
        to.push_back(cv::Point2d(found[i]) + offset);
    }
    const Similarity fit = robustFit(from, to, static_cast<int>(kLeast)).map;
    map.matrix = {fit.a, -fit.b, fit.shift.x, fit.b, fit.a, fit.shift.y, 0, 0, 1};
    return map;
}

}  // namespace eyrie

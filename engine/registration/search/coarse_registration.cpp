#include "registration/search/coarse_registration.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "registration/estimation/point_jacobian.h"
#include "registration/search/feature_search.h"
#include "registration/search/thumbnail_search.h"

namespace eyrie {
namespace {

constexpr int kPoints = 320;
constexpr int kWindow = 11;
constexpr int kWideWindow = 15;
constexpr double kMaxResidual = 0.4;
/// A level counts as registered when this share of the points that could be tracked agrees.
constexpr double kGoodShare = 0.5;
constexpr int kFewestPoints = 8;

/// About `kPoints` corners, the best of each cell of a grid: old ones of the background, then sharp ones.
std::vector<cv::Point2f> spreadPoints(const CornerSet& set, cv::Size image) {
    const double cell = std::max(1.0, std::sqrt(double(image.width) * image.height / kPoints));
    const int across = static_cast<int>(image.width / cell) + 1;
    const int down = static_cast<int>(image.height / cell) + 1;
    std::vector<int> best(std::size_t(across * down), -1);
    const auto better = [&](const TrackedCorner& a, const TrackedCorner& b) {
        if (a.on_background != b.on_background) return a.on_background;
        return a.position_variance < b.position_variance;
    };
    for (int i = 0; i < set.size(); ++i) {
        const TrackedCorner& corner = set.corners[std::size_t(i)];
        const int x = std::clamp(static_cast<int>(corner.position.x / cell), 0, across - 1);
        const int y = std::clamp(static_cast<int>(corner.position.y / cell), 0, down - 1);
        int& winner = best[std::size_t(y * across + x)];
        if (winner < 0 || better(corner, set.corners[std::size_t(winner)])) winner = i;
    }
    std::vector<cv::Point2f> points;
    for (const int i : best) {
        if (i >= 0) points.push_back(set.corners[std::size_t(i)].position);
    }
    return points;
}

/// Points tracked on one pyramid level, in full-size px.
Correspondences trackLevel(const std::vector<cv::Point2f>& points, const ImagePyramid& from, const ImagePyramid& to,
                           int level, int window, const cv::Matx33d& guess, double noise) {
    struct Step {
        bool found = false;
        cv::Point2f to;
    };
    std::vector<Step> steps(points.size());
    // The means of 2×2 pixels have half the noise.
    const double noise_here = noise / double(1 << level);
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, points.size(), 64), [&](const tbb::blocked_range<std::size_t>& range) {
            PatchTemplate patch(window);
            std::vector<std::int16_t> samples(std::size_t(patchSamples(window)));
            AlignmentLimits limits;
            limits.max_shift_px = float(window);
            limits.max_iterations = level == 0 ? 10 : 15;
            limits.converged_px = 0.02F;
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                const cv::Point2f here = ImagePyramid::toLevel(points[i], level);
                if (!patchFits(from.level(level), here, window)) continue;
                cutPatch(from.level(level), here, window, samples.data());
                if (!patch.prepare(samples.data())) continue;
                const cv::Point2f start = ImagePyramid::toLevel(PointJacobian(guess, points[i]).point, level);
                const Alignment found = align(patch, to.level(level), start, limits);
                const double acceptable =
                    std::max(4 * noise_here * noise_here, kMaxResidual * double(patch.contrast()));
                if (!found.found || double(found.residual) > acceptable) continue;
                steps[i] = {true, ImagePyramid::fromLevel(found.position, level)};
            }
        });
    Correspondences result;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (steps[i].found) result.add(points[i], steps[i].to);
    }
    return result;
}

/// How many points a level shows at all.
int trackable(const std::vector<cv::Point2f>& points, const ImagePyramid& from, int level, int window) {
    int count = 0;
    for (const cv::Point2f& point : points)
        count += patchFits(from.level(level), ImagePyramid::toLevel(point, level), window);
    return count;
}

}  // namespace

std::optional<HomographyFit> CoarseRegistration::find(const CornerSet& corners, const ImagePyramid& from,
                                                      const ImagePyramid& to,
                                                      const std::vector<cv::Matx33d>& predictions, double noise) const {
    const std::vector<cv::Point2f> points = spreadPoints(corners, from.size());
    const int enough = std::max(kFewestPoints, static_cast<int>(points.size()) / 8);

    // Registers level after level; each starts where the one above ended.
    const auto descend = [&](int top, int window, cv::Matx33d guess) -> std::optional<HomographyFit> {
        std::optional<HomographyFit> fit;
        for (int level = top; level >= 0; --level) {
            // Level 1 adds nothing once level 2 has brought the guess to a fraction of a pixel.
            if (level == 1 && top > 1 && fit && fit->sigma_px < 0.7) continue;
            const int side = level == 0 ? kWindow : window;
            const int shown = trackable(points, from, level, side);
            if (shown < kFewestPoints) continue;
            const Correspondences found = trackLevel(points, from, to, level, side, guess, noise);
            if (found.size() < kFewestPoints) return std::nullopt;
            // Tight, lest a motion between the ground's and that of a crowd of vehicles pleases both.
            const double tolerance = 0.5 * double(1 << level);
            const auto model = level > 0 ? MotionModel::similarity : MotionModel::homography;
            const auto sampled = estimator_.search(found, model, tolerance);
            if (!sampled) return std::nullopt;
            fit = estimator_.refine(found, *sampled, double(1 << level), (level > 0 ? 8 : 2.5) * tolerance);
            if (!fit || !plausibleMotion(fit->matrix, from.size())) return std::nullopt;
            guess = fit->matrix;
        }
        if (!fit || fit->inliers < enough || fit->inlier_share < 0.3) return std::nullopt;
        return fit;
    };
    const auto good = [&](const std::optional<HomographyFit>& fit) {
        return fit && fit->inlier_share >= kGoodShare && fit->inliers >= static_cast<int>(points.size()) / 3;
    };

    std::optional<HomographyFit> best;
    const auto attempt = [&](int top, int window, const cv::Matx33d& guess) {
        auto fit = descend(std::min(top, from.levels() - 1), window, guess);
        if (fit && (!best || fit->inliers > best->inliers)) best = fit;
        return good(best);
    };
    if (static_cast<int>(points.size()) < kFewestPoints) return std::nullopt;
    for (const cv::Matx33d& prediction : predictions) {
        if (attempt(2, kWindow, prediction)) return best;
    }
    for (const cv::Matx33d& prediction : predictions) {
        if (attempt(from.levels() - 1, kWideWindow, prediction)) return best;
    }
    if (const auto searched = searchThumbnails(from, to, graphics_))
        attempt(std::max(2, from.levels() - 2), kWideWindow, *searched);
    if (!best && feature_search_) {
        // Over relief few corners agree to half a pixel; then what features agree on is the best start there is.
        const auto searched = searchFeatures(from, to, estimator_, graphics_);
        if (searched && !attempt(1, kWideWindow, searched->matrix) && !best) best = searched;
    }
    return best;
}

}  // namespace eyrie

// The searches for the camera's motion against slow ones made of other parts.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "registration/corners/patch_alignment.h"
#include "registration/estimation/point_jacobian.h"
#include "registration/flight.h"
#include "registration/search/coarse_registration.h"
#include "registration/search/feature_search.h"
#include "registration/search/thumbnail_search.h"

namespace eyrie::slow_search_test {
namespace {

ImagePyramid pyramidOf(cv::Size size, const cv::Matx33d& picture_from_ground, unsigned ground, double noise = 2) {
    ImagePyramid pyramid;
    pyramid.build(test::TexturedGround(ground, 1.5).picture(size, picture_from_ground.inv(), noise, ground));
    return pyramid;
}

cv::Mat grayOf(const PaddedPicture& picture) {
    cv::Mat gray(picture.height(), picture.width(), CV_8UC1);
    for (int y = 0; y < gray.rows; ++y) std::copy(picture.row(y), picture.row(y) + gray.cols, gray.ptr(y));
    return gray;
}

/// The first level whose longer side is no more than `side`.
int levelOf(const ImagePyramid& pyramid, int side) {
    for (int level = 0; level < pyramid.levels(); ++level) {
        if (std::max(pyramid.level(level).width(), pyramid.level(level).height()) <= side) return level;
    }
    return pyramid.levels() - 1;
}

/// Every shift up to 40 % of every turn, by correlation times the root of the overlap.
std::optional<cv::Matx33d> slowThumbnails(const ImagePyramid& from, const ImagePyramid& to) {
    const int level = levelOf(from, 72);
    const auto withoutSlowChanges = [&](const ImagePyramid& pyramid) {
        cv::Mat values, mean;
        grayOf(pyramid.level(level)).convertTo(values, CV_32F);
        cv::blur(values, mean, {9, 9}, {-1, -1}, cv::BORDER_REFLECT_101);
        return cv::Mat(values - mean);
    };
    const cv::Mat a = withoutSlowChanges(from), b = withoutSlowChanges(to);
    const cv::Rect all(0, 0, a.cols, a.rows);
    const cv::Point2f middle(float(a.cols - 1) / 2, float(a.rows - 1) / 2);
    double best = 0.35;
    std::optional<cv::Matx33d> found;
    for (const double degrees : {-10.0, -7.5, -5.0, -2.5, 0.0, 2.5, 5.0, 7.5, 10.0}) {
        // OpenCV's angles count the other way.
        const cv::Mat turn = cv::getRotationMatrix2D(middle, -degrees, 1);
        cv::Mat turned;
        cv::warpAffine(a, turned, turn, a.size());
        for (int dy = -int(0.4 * a.rows); dy <= int(0.4 * a.rows); ++dy) {
            for (int dx = -int(0.4 * a.cols); dx <= int(0.4 * a.cols); ++dx) {
                const cv::Rect there = (all + cv::Point(dx, dy)) & all;
                const cv::Mat u = turned(there - cv::Point(dx, dy)), v = b(there);
                const double norm = cv::norm(u) * cv::norm(v);
                if (norm <= 0) continue;
                const double correlation = u.dot(v) / norm * std::sqrt(double(there.area()) / all.area());
                if (correlation <= best) continue;
                best = correlation;
                const cv::Mat_<double> t = turn;
                const double scale = 1 << level;
                // A pixel of the thumbnail is the middle of a square of the picture.
                const cv::Matx33d full(scale, 0, scale / 2 - 0.5, 0, scale, scale / 2 - 0.5, 0, 0, 1);
                found = full * cv::Matx33d(t(0, 0), t(0, 1), t(0, 2) + dx, t(1, 0), t(1, 1), t(1, 2) + dy, 0, 0, 1) *
                        full.inv();
            }
        }
    }
    return found;
}

void expectSame(const std::optional<cv::Matx33d>& found, const std::optional<cv::Matx33d>& slow, cv::Size size,
                const std::string& what) {
    ASSERT_EQ(found.has_value(), slow.has_value()) << what;
    if (found) {
        EXPECT_LT(test::gridError(*found, *slow, size), 1e-3) << what;
    }
}

std::optional<HomographyFit> slowFeatures(const ImagePyramid& from, const ImagePyramid& to,
                                          const HomographyEstimator& estimator) {
    const int level = levelOf(from, 1100);
    if (std::min(from.level(level).width(), from.level(level).height()) < 64) return std::nullopt;
    const double scale = 1 << level;
    const auto detector = cv::AKAZE::create(cv::AKAZE::DESCRIPTOR_MLDB, 0, 3, 1e-4F, 3, 3);
    std::vector<cv::KeyPoint> points[2];
    cv::Mat descriptors[2];
    for (const int i : {0, 1}) {
        const cv::Mat gray = grayOf((i == 0 ? from : to).level(level));
        detector->detect(gray, points[i]);
        cv::KeyPointsFilter::retainBest(points[i], 3000);
        detector->compute(gray, points[i], descriptors[i]);
        if (points[i].size() < 20) return std::nullopt;
    }
    Correspondences pairs;
    const auto apart = [&](int i, int k) {
        return cv::norm(descriptors[0].row(i), descriptors[1].row(k), cv::NORM_HAMMING);
    };
    for (int i = 0; i < descriptors[0].rows; ++i) {
        int best = -1;
        double nearest = 1e9, second = 1e9;
        for (int k = 0; k < descriptors[1].rows; ++k) {
            const double distance = apart(i, k);
            if (distance < nearest) {
                second = nearest;
                nearest = distance;
                best = k;
            } else {
                second = std::min(second, distance);
            }
        }
        if (nearest > double(0.85F * float(second))) continue;
        bool mutual = true;
        for (int other = 0; other < descriptors[0].rows; ++other) {
            const double distance = apart(other, best);
            if (distance < nearest || (distance == nearest && other < i)) mutual = false;
        }
        if (!mutual) continue;
        const auto full = [&](cv::Point2f p) {
            return (p + cv::Point2f(0.5F, 0.5F)) * float(scale) - cv::Point2f(0.5F, 0.5F);
        };
        pairs.add(full(points[0][std::size_t(i)].pt), full(points[1][std::size_t(best)].pt));
    }
    if (pairs.size() < 20) return std::nullopt;
    const HomographyEstimator free = estimator.anyPerspective();
    std::optional<HomographyFit> best;
    for (const MotionModel model : {MotionModel::similarity, MotionModel::homography}) {
        const auto start = free.search(pairs, model, 3 * scale);
        const auto fit = start ? free.refine(pairs, *start, 2 * scale, 6 * scale) : std::nullopt;
        if (fit && fit->inliers >= 20 && fit->inlier_share >= 0.35 && fit->sigma_px <= 2.5 * scale &&
            plausibleMotion(fit->matrix, from.size()) && (!best || fit->inliers > best->inliers)) {
            best = fit;
        }
    }
    return best;
}

}  // namespace

TEST(SlowSearch, ThumbnailsAreThoseOfAllShiftsAndTurns) {
    // Sides whose thumbnails are just small enough, odd, or stop at the smallest level.
    const std::pair<cv::Size, cv::Vec3d> cases[] = {
        {{288, 100}, {0.25, -0.1, 6}},  {{292, 180}, {-0.35, 0.3, -9}}, {{100, 150}, {0.05, 0.38, 3}},
        {{83, 101}, {-0.1, -0.2, -2}},  {{80, 96}, {0, 0, 0}},          {{60, 50}, {0.39, 0.1, 10}},
        {{49, 47}, {-0.38, -0.1, 0.5}},
    };
    for (const auto& [size, motion] : cases) {
        const cv::Matx33d truth = test::cameraMotion(size, motion[0] * size.width, motion[1] * size.height, motion[2]);
        const ImagePyramid from = pyramidOf(size, cv::Matx33d::eye(), 52), to = pyramidOf(size, truth, 52);
        expectSame(searchThumbnails(from, to), slowThumbnails(from, to), size, std::to_string(motion[2]));
    }
}

TEST(SlowSearch, ThumbnailsThatHardlyCorrelateAreACut) {
    // The second picture is more and more another one.
    const cv::Size size(80, 64);
    const cv::Mat here = test::TexturedGround(53, 1.5).picture(size, cv::Matx33d::eye(), 0, 1);
    const cv::Mat there = test::TexturedGround(54, 1.5).picture(size, cv::Matx33d::eye(), 0, 1);
    ImagePyramid from;
    from.build(here);
    int some = 0, none = 0;
    for (double share = 0.5; share < 0.9; share += 0.035) {
        cv::Mat mixed;
        cv::addWeighted(here, 1 - share, there, share, 0, mixed);
        ImagePyramid to;
        to.build(mixed);
        const auto slow = slowThumbnails(from, to);
        ++(slow ? some : none);
        expectSame(searchThumbnails(from, to), slow, size, std::to_string(share));
    }
    EXPECT_GT(some, 2);
    EXPECT_GT(none, 2);
}

TEST(SlowSearch, FeaturesAreThoseThatAreMutuallyNearest) {
    const struct {
        cv::Size size;
        cv::Vec3d motion;
        double noise;
    } cases[] = {{{200, 150}, {20, -12, 31}, 2}, {{200, 150}, {20, -12, 31}, 9}, {{200, 150}, {20, -12, 31}, 16},
                 {{200, 150}, {60, 30, -17}, 2}, {{200, 150}, {90, 60, 5}, 2},   {{120, 100}, {10, 6, 12}, 2},
                 {{150, 64}, {4, 6, 3}, 1},      {{150, 63}, {4, 6, 3}, 1},      {{1101, 130}, {9, 3, 1}, 0},
                 {{1100, 64}, {9, 3, 1}, 0},     {{200, 150}, {500, 0, 0}, 2},   {{64, 900}, {2, 1, 0.2}, 0},
                 {{63, 900}, {2, 1, 0.2}, 0}};
    int found_some = 0;
    for (const auto& one : cases) {
        const HomographyEstimator estimator({}, one.size);
        const ImagePyramid from = pyramidOf(one.size, cv::Matx33d::eye(), 55, one.noise);
        const ImagePyramid to = pyramidOf(
            one.size, test::cameraMotion(one.size, one.motion[0], one.motion[1], one.motion[2], 1.02), 55, one.noise);
        const auto found = searchFeatures(from, to, estimator), slow = slowFeatures(from, to, estimator);
        ASSERT_EQ(found.has_value(), slow.has_value()) << one.size << one.motion;
        EXPECT_TRUE(found || one.size != cv::Size(64, 900));
        if (!found) continue;
        ++found_some;
        EXPECT_LT(test::gridError(found->matrix, slow->matrix, one.size), 0.05) << one.size << one.motion;
        EXPECT_NEAR(found->inliers, slow->inliers, 2);
    }
    EXPECT_GE(found_some, 5);
}

namespace {

TrackedCorner cornerAt(CornerId id, cv::Point2f at, bool on_background, float variance) {
    TrackedCorner corner;
    corner.id = id;
    corner.position = at;
    corner.on_background = on_background;
    corner.position_variance = variance;
    return corner;
}

/// Every third was never of the background.
CornerSet cornersOf(const ImagePyramid& pyramid) {
    const auto places = CornerDetector({}, test::scaleOf(0.12)).detect(pyramid.level(0), {});
    CornerSet corners;
    for (std::size_t i = 0; i < places.size(); ++i)
        corners.corners.push_back(cornerAt(CornerId(i + 1), places[i], i % 3 > 0, float(i * 7 % 10) * 0.01F));
    return corners;
}

/// Coarse registration told once more, with every place looked at one by one.
struct SlowCoarse {
    const HomographyEstimator& estimator;
    const CornerSet& corners;
    const ImagePyramid& from;
    const ImagePyramid& to;
    double noise;
    bool features;

    /// The best corner of each of 320 squares: of the background, then the sharpest, then the first.
    std::vector<cv::Point2f> points() const {
        const double cell = std::sqrt(from.size().area() / 320.0);
        std::map<std::pair<int, int>, const TrackedCorner*> best;
        for (const TrackedCorner& corner : corners.corners) {
            auto& held = best[{int(corner.position.y / cell), int(corner.position.x / cell)}];
            const auto rank = [](const TrackedCorner& c) { return std::pair(!c.on_background, c.position_variance); };
            if (held == nullptr || rank(corner) < rank(*held)) held = &corner;
        }
        std::vector<cv::Point2f> result;
        for (const auto& [place, corner] : best) result.push_back(corner->position);
        return result;
    }

    std::optional<HomographyFit> descend(int top, int window, cv::Matx33d guess) const {
        std::optional<HomographyFit> fit;
        const std::vector<cv::Point2f> all = points();
        for (int level = std::min(top, from.levels() - 1); level >= 0; --level) {
            const double scale = 1 << level;
            if (level == 1 && top > 1 && from.levels() > 2 && fit && fit->sigma_px < 0.7) continue;
            PatchTemplate patch(level == 0 ? 11 : window);
            std::vector<std::int16_t> samples(std::size_t(patchSamples(patch.window())));
            Correspondences found;
            int shown = 0;
            for (const cv::Point2f& point : all) {
                const cv::Point2f here = ImagePyramid::toLevel(point, level);
                if (!patchFits(from.level(level), here, patch.window())) continue;
                ++shown;
                cutPatch(from.level(level), here, patch.window(), samples.data());
                if (!patch.prepare(samples.data())) continue;
                AlignmentLimits limits;
                limits.max_shift_px = float(patch.window());
                limits.max_iterations = level == 0 ? 10 : 15;
                limits.converged_px = 0.02F;
                const cv::Vec3d there = guess * cv::Vec3d(double(point.x), double(point.y), 1);
                const cv::Point2f start(float(there[0] / there[2]), float(there[1] / there[2]));
                const Alignment moved = align(patch, to.level(level), ImagePyramid::toLevel(start, level), limits);
                const double most = std::max(4 * std::pow(noise / scale, 2), 0.4 * double(patch.contrast()));
                if (moved.found && double(moved.residual) <= most)
                    found.add(point, ImagePyramid::fromLevel(moved.position, level));
            }
            if (shown < 8) continue;
            if (found.size() < 8) return std::nullopt;
            const auto sampled =
                estimator.search(found, level > 0 ? MotionModel::similarity : MotionModel::homography, 0.5 * scale);
            if (!sampled) return std::nullopt;
            fit = estimator.refine(found, *sampled, scale, (level > 0 ? 4 : 1.25) * scale);
            if (!fit || !plausibleMotion(fit->matrix, from.size())) return std::nullopt;
            guess = fit->matrix;
        }
        const int enough = std::max(8, int(all.size()) / 8);
        if (!fit || fit->inliers < enough || fit->inlier_share < 0.3) return std::nullopt;
        return fit;
    }

    std::optional<HomographyFit> find(const std::vector<cv::Matx33d>& predictions) const {
        const int count = int(points().size());
        if (count < 8) return std::nullopt;
        std::optional<HomographyFit> best;
        const auto good = [&](const std::optional<HomographyFit>& fit) {
            if (fit && (!best || fit->inliers > best->inliers)) best = fit;
            return best && best->inlier_share >= 0.5 && best->inliers >= count / 3;
        };
        for (const auto& prediction : predictions) {
            if (good(descend(2, 11, prediction))) return best;
        }
        for (const auto& prediction : predictions) {
            if (good(descend(from.levels() - 1, 15, prediction))) return best;
        }
        if (const auto searched = searchThumbnails(from, to))
            good(descend(std::max(2, from.levels() - 2), 15, *searched));
        if (best || !features) return best;
        const auto searched = searchFeatures(from, to, estimator);
        if (searched && !good(descend(1, 15, searched->matrix)) && !best) best = searched;
        return best;
    }
};

}  // namespace

TEST(SlowSearch, CoarseRegistrationDescendsThePyramid) {
    int found_some = 0, found_none = 0;
    for (const cv::Size size : {cv::Size(256, 192), cv::Size(90, 120), cv::Size(40, 46)}) {
        const ImagePyramid from = pyramidOf(size, cv::Matx33d::eye(), 56);
        const CornerSet corners = cornersOf(from);
        for (const auto& motion : {cv::Vec3d(1, -1, 0.3), cv::Vec3d(5, -3, 1), cv::Vec3d(18, 12, 4),
                                   cv::Vec3d(-30, 40, -8), cv::Vec3d(12, 9, 35), cv::Vec3d(900, 0, 0)}) {
            const ImagePyramid to =
                pyramidOf(size, test::cameraMotion(size, motion[0], motion[1], motion[2], 1.004), 56, 4);
            const HomographyEstimator estimator({}, size);
            for (const bool features : {true, false}) {
                for (const double noise : {0.5, 4.0}) {
                    if (features && noise < 1) continue;
                    const std::vector<cv::Matx33d> predictions{cv::Matx33d::eye(), test::cameraMotion(size, 5, -3, 0)};
                    const auto found =
                        CoarseRegistration(estimator, features).find(corners, from, to, predictions, noise);
                    const auto slow = SlowCoarse{estimator, corners, from, to, noise, features}.find(predictions);
                    ASSERT_EQ(found.has_value(), slow.has_value()) << size << motion << features;
                    ++(found ? found_some : found_none);
                    if (!found) continue;
                    EXPECT_LT(test::gridError(found->matrix, slow->matrix, size), 2e-3) << size << motion << features;
                    EXPECT_NEAR(found->inliers, slow->inliers, 1) << size << motion << features;
                    EXPECT_NEAR(found->inlier_share, slow->inlier_share, 0.02) << size << motion << features;
                }
            }
        }
    }
    EXPECT_GT(found_some, 20);
    EXPECT_GT(found_none, 5);
}

TEST(SlowSearch, WhatAThirdOfThePlacesAgreeOnIsNotLookedFurtherFor) {
    // The upper part of the picture goes with the first prediction, the rest with the second.
    const cv::Size size(256, 192);
    const ImagePyramid from = pyramidOf(size, cv::Matx33d::eye(), 56);
    const CornerSet corners = cornersOf(from);
    const cv::Matx33d first = test::cameraMotion(size, 1, -1, 0), second = test::cameraMotion(size, 22, 12, 0);
    const cv::Mat other = grayOf(pyramidOf(size, second, 56).level(0));
    const HomographyEstimator estimator({}, size);
    int stayed = 0, looked_further = 0;
    for (int rows = 44; rows <= 100; rows += 4) {
        cv::Mat picture = other.clone();
        const cv::Rect upper(0, 0, size.width, rows);
        grayOf(pyramidOf(size, first, 56).level(0))(upper).copyTo(picture(upper));
        ImagePyramid to;
        to.build(picture);
        const std::vector<cv::Matx33d> predictions{first, second};
        const auto found = CoarseRegistration(estimator, false).find(corners, from, to, predictions, 2);
        const auto slow = SlowCoarse{estimator, corners, from, to, 2, false}.find(predictions);
        ASSERT_TRUE(found && slow) << rows;
        EXPECT_LT(test::gridError(found->matrix, slow->matrix, size), 2e-3) << rows;
        (test::gridError(found->matrix, first, size) < 1 ? stayed : looked_further)++;
    }
    EXPECT_GE(stayed, 3);
    EXPECT_GE(looked_further, 3);
}

TEST(SlowSearch, AMotionBetweenThatOfTwoCrowdsPleasesNeither) {
    // Bands of the picture move by a pixel or so more than the others.
    const cv::Size size(256, 192);
    const ImagePyramid from = pyramidOf(size, cv::Matx33d::eye(), 56);
    const CornerSet corners = cornersOf(from);
    const cv::Matx33d ground = test::cameraMotion(size, 1, -1, 0);
    const HomographyEstimator estimator({}, size);
    for (const double apart : {0.9, 1.1, 1.3, 1.5, 1.8, 2.2}) {
        const cv::Mat crowd = grayOf(pyramidOf(size, test::cameraMotion(size, 1 + apart, -1, 0), 56).level(0));
        cv::Mat picture = grayOf(pyramidOf(size, ground, 56).level(0)).clone();
        for (const int row : {30, 110}) {
            const cv::Rect band(0, row, size.width, 42);
            crowd(band).copyTo(picture(band));
        }
        ImagePyramid to;
        to.build(picture);
        const auto found = CoarseRegistration(estimator, false).find(corners, from, to, {ground}, 2);
        const auto slow = SlowCoarse{estimator, corners, from, to, 2, false}.find({ground});
        ASSERT_EQ(found.has_value(), slow.has_value()) << apart;
        if (!found) continue;
        EXPECT_LT(test::gridError(found->matrix, slow->matrix, size), 2e-3) << apart;
        EXPECT_LT(test::gridError(found->matrix, ground, size), apart > 1.2 ? 0.35 : 1) << apart;
    }
}

}  // namespace eyrie::slow_search_test

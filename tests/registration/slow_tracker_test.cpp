// The tracker of corners against a slow one that does one corner after the other, by the words of its description.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <random>

#include "registration/corners/corner_grid.h"
#include "registration/corners/corner_tracker.h"
#include "registration/corners/neighbourhood_mask.h"
#include "registration/estimation/point_jacobian.h"
#include "registration/flight.h"

namespace eyrie::slow_tracker_test {
namespace {

const cv::Size kScene(170, 130);

double squareOf(cv::Point2f d) {
    return double(d.x) * double(d.x) + double(d.y) * double(d.y);
}

/// Ground with a vehicle's worth of other ground that has moved by (2.6, -1) in the second picture.
cv::Mat seen(const cv::Matx33d& picture_from_ground, cv::Point2d vehicle, double noise, unsigned seed) {
    cv::Mat gray = test::TexturedGround(71, 1.3).picture(kScene, picture_from_ground.inv(), noise, seed);
    const test::TexturedGround other(72, 1.3);
    const cv::Matx33d back = picture_from_ground.inv();
    for (int y = 0; y < gray.rows; ++y) {
        for (int x = 0; x < gray.cols; ++x) {
            const cv::Vec3d p = back * cv::Vec3d(x, y, 1);
            const cv::Point2d at = cv::Point2d(p[0] / p[2], p[1] / p[2]) - vehicle;
            if (cv::Rect2d(60, 40, 44, 36).contains(at))
                gray.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(other.at(at.x, at.y));
        }
    }
    return gray;
}

/// A set of corners with a past of our choice.
struct Scene {
    explicit Scene(const TrackingOptions& options_, double gsd = 0.12)
        : options(options_), tracker(options_, test::scaleOf(gsd)), set(tracker.window()) {
        from.build(seen(cv::Matx33d::eye(), {0, 0}, 1.5, 1));
        CornerSurroundings surroundings;
        surroundings.margin = tracker.margin();
        CornerId next = 1;
        tracker.add(set, CornerDetector({}, test::scaleOf(gsd)).detect(from.level(0), surroundings), from.smooth(),
                    next);
        std::mt19937 random(5);
        for (TrackedCorner& corner : set.corners) {
            const bool on_vehicle = cv::Rect2f(62, 42, 40, 32).contains(corner.position);
            corner.age = int(random() % 8);
            corner.patch_age = corner.age;
            if (on_vehicle && corner.age > 1) corner.velocity = {2.4F, -0.9F};
            if (!on_vehicle) corner.velocity = {0.01F * float(random() % 40), 0.2F};
            corner.drift = corner.velocity * 0.3F;
        }
    }

    TrackingOptions options;
    CornerTracker tracker;
    CornerSet set;
    ImagePyramid from;
};

struct SlowFollower {
    const Scene& scene;
    const ImagePyramid& to;
    const cv::Matx33d& to_from;
    double noise;
    int frames;
    double max_step;

    TrackedPosition follow(const TrackedCorner& corner) const {
        TrackedPosition result;
        const int window = scene.tracker.window();
        const cv::Point2f centre = corner.position - corner.offset;
        const PointJacobian map(to_from, centre);
        result.offset = map.vector(corner.offset);
        PatchTemplate patch(window);
        if (!patch.prepare(scene.set.patch(corner))) return result;
        result.contrast = patch.contrast();
        result.position_variance = patch.positionVariance();
        const double acceptable = std::max(5 * noise * noise, scene.options.max_residual * double(patch.contrast()));
        const double good = std::max(3 * noise * noise, 0.4 * acceptable);
        Alignment best;
        best.residual = 1e30F;
        const auto settled = [&](cv::Point2f start) {
            AlignmentLimits limits;
            limits.max_shift_px = float(window) / 2 + 1.5F;
            const Alignment found = align(patch, to.smooth(), start, limits);
            if (found.found && found.residual < best.residual && cv::norm(found.position - map.point) <= max_step)
                best = found;
            return double(best.residual) <= good;
        };
        const cv::Point2f own = map.vector(corner.velocity) * float(frames);
        const bool moves = cv::norm(own) > 0.3;
        const auto tried = [&] {
            if (moves && settled(map.point + own)) return;
            if (settled(map.point)) return;
            if (corner.age < 4) {
                // The nearest that is known to move, from the cells around it.
                std::vector<cv::Point2f> places, velocities;
                for (const TrackedCorner& other : scene.set.corners) {
                    if (other.age < 4 || squareOf(other.velocity) < 0.09F) continue;
                    places.push_back(other.position);
                    velocities.push_back(other.velocity);
                }
                const int nearest = CornerGrid(kScene, float(std::max(8, 2 * window)), places).nearest(corner.position);
                if (nearest >= 0 && settled(map.point + map.vector(velocities[std::size_t(nearest)]) * float(frames)))
                    return;
            }
            for (int top = 1; top <= std::min(2, to.levels() - 1); ++top) {
                cv::Point2f start = map.point + (moves ? own : cv::Point2f());
                bool whole = true;
                for (int level = top; level >= 1 && whole; --level) {
                    // Half the window, rounded up to odd, and two more.
                    PatchTemplate coarse(std::clamp(window / 4 * 2 + 3, 5, 9));
                    const cv::Point2f there = ImagePyramid::toLevel(centre, level);
                    std::vector<std::int16_t> samples(std::size_t(patchSamples(coarse.window())));
                    whole = patchFits(scene.from.level(level), there, coarse.window());
                    if (!whole) break;
                    cutPatch(scene.from.level(level), there, coarse.window(), samples.data());
                    whole = coarse.prepare(samples.data());
                    if (!whole) break;
                    AlignmentLimits limits;
                    limits.max_shift_px = float(coarse.window()) / 2 + 1;
                    limits.converged_px = 0.03F;
                    const Alignment found = align(coarse, to.level(level), ImagePyramid::toLevel(start, level), limits);
                    whole = found.found;
                    start = ImagePyramid::fromLevel(found.position, level);
                }
                if (whole && settled(start)) return;
            }
        };
        tried();
        if (double(best.residual) > acceptable) return result;
        result.found = true;
        result.position = best.position + result.offset;
        result.residual = best.residual;
        return result;
    }
};

/// Four deviations of the known drifts, by their median, at least 0.08 px.
double slowMoverThreshold(const CornerSet& set, const std::vector<TrackedPosition>& found) {
    std::vector<double> drifts;
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i].found && set.corners[i].age >= 4) drifts.push_back(std::sqrt(squareOf(set.corners[i].drift)));
    }
    if (drifts.empty()) return 1e9;
    std::sort(drifts.begin(), drifts.end());
    return std::max(0.08, 4 * drifts[drifts.size() / 2] / 1.1774);
}

}  // namespace

TEST(SlowTracker, CornersAreTriedWhereTheyMayHaveGone) {
    int found_some = 0, lost_some = 0;
    for (const char* window : {"0.6", "0.9", "1.3"}) {
        TrackingOptions options;
        options.window_m = std::stod(window);
        for (const auto& motion : {cv::Vec4d(0.4, -0.3, 0.2, 1), cv::Vec4d(1.5, 0.8, 0.4, 1),
                                   cv::Vec4d(3.7, -2.2, 1, 2), cv::Vec4d(-6, 5, 0, 3)}) {
            const int frames = int(motion[3]);
            const cv::Matx33d truth = test::cameraMotion(kScene, motion[0], motion[1], motion[2], 1.003);
            Scene scene(options);
            ImagePyramid to;
            to.build(seen(truth, cv::Point2d(2.6, -1) * frames, 1.5, 2));
            // The first guess is a pixel or so beside it.
            const cv::Matx33d guess = test::cameraMotion(kScene, motion[0] + 1.2, motion[1] - 0.5, motion[2]);
            for (const double noise : {0.3, 2.0}) {
                const auto found = scene.tracker.track(scene.set, scene.from, to, guess, noise, frames);
                ASSERT_EQ(found.size(), scene.set.corners.size());
                const double step = std::max(4.0, test::scaleOf(0.12).pxPerFrame(options.max_speed_m_s)) * frames;
                const SlowFollower slow{scene, to, guess, noise, frames, step};
                for (std::size_t i = 0; i < found.size(); ++i) {
                    const TrackedPosition expected = slow.follow(scene.set.corners[i]);
                    ASSERT_EQ(found[i].found, expected.found) << i << motion;
                    EXPECT_EQ(found[i].contrast, expected.contrast);
                    EXPECT_EQ(found[i].position_variance, expected.position_variance);
                    EXPECT_LT(cv::norm(found[i].offset - expected.offset), 1e-5);
                    ++(found[i].found ? found_some : lost_some);
                    if (!found[i].found) continue;
                    EXPECT_LT(cv::norm(found[i].position - expected.position), 1e-3) << i << motion;
                    EXPECT_NEAR(found[i].residual, expected.residual, 1e-2F);
                }
            }
        }
    }
    EXPECT_GT(found_some, 1000);
    EXPECT_GT(lost_some, 100);
}

TEST(SlowTracker, NothingIsFoundFartherThanItsFastest) {
    // The vehicle drives by 2.8 px beside a ground that stands; 4 px may be gone in any case.
    for (const double speed : {1.0, 40.0}) {
        TrackingOptions options;
        options.max_speed_m_s = speed;
        Scene scene(options);
        for (TrackedCorner& corner : scene.set.corners) corner.velocity = {6.2F, 0};
        ImagePyramid to;
        to.build(seen(cv::Matx33d::eye(), {6.2, 0}, 0.5, 2));
        const auto found = scene.tracker.track(scene.set, scene.from, to, cv::Matx33d::eye(), 0.5, 1);
        int far = 0;
        for (std::size_t i = 0; i < found.size(); ++i)
            far += found[i].found && cv::norm(found[i].position - scene.set.corners[i].position) > 4.05;
        EXPECT_EQ(far > 0, speed > 10) << far;
    }
}

TEST(SlowTracker, WeightsAreThoseOfNoiseAndCrowds) {
    for (const int share : {1, 3, 9}) {
        Scene scene({});
        std::mt19937 random(6);
        std::vector<TrackedPosition> found(scene.set.corners.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            found[i].found = random() % 8 != 0;
            found[i].position = scene.set.corners[i].position + cv::Point2f(1, 2);
            found[i].position_variance = 1e-5F * float(random() % 400);
            scene.set.corners[i].drift = {0.01F * float(random() % 4), int(random() % 10) < share ? 0.4F : 0.02F};
        }
        const double threshold = slowMoverThreshold(scene.set, found);
        const double cell = 170.0 / 16;
        std::map<std::pair<int, int>, int> crowds;
        const auto cellOf = [&](cv::Point2f p) { return std::pair(int(p.y / cell), int(p.x / cell)); };
        const auto stands = [&](const TrackedCorner& corner) {
            return corner.age < 4 || std::sqrt(squareOf(corner.drift)) < threshold;
        };
        int usable = 0, standing = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            if (!found[i].found) continue;
            ++usable;
            standing += stands(scene.set.corners[i]);
            ++crowds[cellOf(scene.set.corners[i].position)];
        }
        std::vector<int> counts;
        for (const auto& [place, count] : crowds) counts.push_back(count);
        std::sort(counts.begin(), counts.end());
        const double usual = counts[counts.size() / 2];
        for (const double noise : {0.5, 3.0}) {
            const Correspondences pairs = scene.tracker.correspondences(scene.set, found, kScene, noise);
            ASSERT_EQ(std::size_t(pairs.size()), found.size());
            for (std::size_t i = 0; i < found.size(); ++i) {
                const TrackedCorner& corner = scene.set.corners[i];
                double expected = 0;
                if (found[i].found && (2 * standing <= usable || stands(corner))) {
                    const double crowd = usual / crowds[cellOf(corner.position)];
                    const double variance = 2 * noise * noise * double(found[i].position_variance);
                    expected = std::min(1.0, 2 * crowd) * 0.0025 / (0.0025 + variance);
                }
                EXPECT_NEAR(double(pairs.weight[i]), expected, 1e-5) << share << " " << i;
            }
        }
    }
}

namespace {

/// What becomes of one corner, but for running into others; nothing where it is lost.
std::optional<TrackedCorner> slowlyAdvanced(TrackedCorner corner, const TrackedPosition& now, const HomographyFit& fit,
                                            const TrackingOptions& options, int window, const PaddedPicture& to,
                                            int frames, double threshold) {
    if (!now.found) return std::nullopt;
    const PointJacobian map(fit.matrix, corner.position);
    const cv::Point2f expected = map.vector(corner.velocity);
    const cv::Point2f shift = now.position - map.point;
    const cv::Point2f velocity = shift / float(frames);
    if (corner.age > 0 &&
        cv::norm(velocity - expected) > std::max(options.max_jerk, 4 * fit.sigma_px) + cv::norm(expected) / 2)
        return std::nullopt;
    corner.velocity = corner.age == 0 ? velocity : 0.4F * expected + 0.6F * velocity;
    const float share = std::max(0.12F, 1 / float(corner.age + 1));
    corner.drift = (1 - share) * map.vector(corner.drift) + share * velocity;
    corner.on_background = cv::norm(shift) <= fit.inlier_distance_px;
    corner.position = now.position;
    corner.offset = now.offset;
    corner.residual = now.residual;
    corner.position_variance = now.position_variance;
    const cv::Matx22f turn = cv::Matx22f(map.xx, map.xy, map.yx, map.yy) *
                             cv::Matx22f(corner.turn.xx, corner.turn.xy, corner.turn.yx, corner.turn.yy);
    corner.turn = {turn(0, 0), turn(0, 1), turn(1, 0), turn(1, 1)};
    corner.age += frames;
    corner.patch_age += frames;
    corner.moves = corner.age >= 4 && std::sqrt(squareOf(corner.drift)) > threshold;
    if (!patchFits(to, corner.position - corner.offset, window)) return std::nullopt;
    const auto away = [&](const LocalTurn& a, const LocalTurn& b) {
        return std::max(std::abs(a.xx - b.xx) + std::abs(a.xy - b.xy), std::abs(a.yx - b.yx) + std::abs(a.yy - b.yy));
    };
    bool renewed = double(now.residual) > 0.5 * options.max_residual * double(now.contrast) ||
                   corner.patch_age >= options.patch_life;
    if (!renewed && double(window) / 2 * double(away(corner.turn, corner.patch_turn)) > options.patch_deformation) {
        // What the surrounding does not reach is cut anew.
        std::vector<std::int16_t> any(std::size_t(surroundingSamples(window))),
            patch(std::size_t(patchSamples(window)));
        renewed = !turnPatch(any.data(), window, corner.turn, patch.data());
        corner.patch_turn = corner.turn;
    }
    if (renewed) {
        const cv::Point2f centre(std::round(corner.position.x), std::round(corner.position.y));
        if (!patchFits(to, centre, window)) return std::nullopt;
        corner.offset = corner.position - centre;
        corner.turn = corner.patch_turn = {};
        corner.patch_age = 0;
    }
    return corner;
}

}  // namespace

TEST(SlowTracker, ASetMovesOnAsItsCornersDo) {
    for (const int frames : {1, 3}) {
        for (const double turn : {0.4, 8.0, 70.0}) {
            TrackingOptions options;
            options.patch_life = 6;
            Scene scene(options);
            const int window = scene.tracker.window();
            HomographyFit fit;
            fit.matrix = test::cameraMotion(kScene, 3, -2, turn, turn > 9 ? 1.7 : 1.01);
            fit.matrix(2, 0) = 1e-5;
            fit.sigma_px = turn > 1 ? 0.2 : 0.02;
            fit.inlier_distance_px = 0.7;
            std::mt19937 random(7);
            std::vector<TrackedPosition> found(scene.set.corners.size());
            for (std::size_t i = 0; i < found.size(); ++i) {
                const TrackedCorner& corner = scene.set.corners[i];
                const PointJacobian map(fit.matrix, corner.position);
                const auto some = [&](double most) { return float(most * (double(random() % 2001) / 1000 - 1)); };
                found[i].found = random() % 9 != 0;
                found[i].position =
                    map.point + float(frames) * (map.vector(corner.velocity) + cv::Point2f(some(0.7), some(0.7)));
                found[i].offset = corner.offset + cv::Point2f(some(0.3), some(0.3));
                found[i].residual = float(random() % 200) / 10;
                found[i].contrast = 100;
                found[i].position_variance = float(random() % 100) / 1e4F;
            }
            ImagePyramid to;
            to.build(seen(fit.matrix, {0, 0}, 1, 3));
            const double threshold = slowMoverThreshold(scene.set, found);
            std::vector<TrackedCorner> expected;
            NeighbourhoodMask claimed(kScene, 1.5);
            for (std::size_t i = 0; i < found.size(); ++i) {
                const auto corner = slowlyAdvanced(scene.set.corners[i], found[i], fit, options, window, to.smooth(),
                                                   frames, threshold);
                if (!corner || claimed.contains(corner->position)) continue;
                claimed.add(corner->position);
                expected.push_back(*corner);
            }
            const int before = scene.set.size();
            scene.tracker.advance(scene.set, found, fit, to.smooth(), frames, 1.5);
            ASSERT_EQ(scene.set.corners.size(), expected.size()) << frames << " " << turn;
            EXPECT_LT(scene.set.size(), before);
            EXPECT_GT(scene.set.size(), before / 9);
            for (std::size_t i = 0; i < expected.size(); ++i) {
                const TrackedCorner& corner = scene.set.corners[i];
                const TrackedCorner& slow = expected[i];
                ASSERT_EQ(corner.id, slow.id);
                EXPECT_EQ(corner.age, slow.age);
                EXPECT_EQ(corner.patch_age, slow.patch_age);
                EXPECT_EQ(corner.on_background, slow.on_background);
                EXPECT_EQ(corner.moves, slow.moves) << corner.age;
                EXPECT_EQ(corner.residual, slow.residual);
                EXPECT_EQ(corner.position_variance, slow.position_variance);
                EXPECT_EQ(corner.position, slow.position);
                EXPECT_LT(cv::norm(corner.offset - slow.offset), 1e-5);
                EXPECT_LT(cv::norm(corner.velocity - slow.velocity), 1e-4);
                EXPECT_LT(cv::norm(corner.drift - slow.drift), 1e-4);
                EXPECT_NEAR(corner.turn.xy, slow.turn.xy, 1e-5);
                EXPECT_NEAR(corner.turn.yx, slow.turn.yx, 1e-5);
                EXPECT_NEAR(corner.turn.xx, slow.turn.xx, 1e-5);
                EXPECT_NEAR(corner.turn.yy, slow.turn.yy, 1e-5);
                EXPECT_NEAR(corner.patch_turn.xy, slow.patch_turn.xy, 1e-5);
                EXPECT_NEAR(corner.patch_turn.xx, slow.patch_turn.xx, 1e-5);
                // Patches are what turning the surrounding gives, or were cut about a whole pixel.
                std::vector<std::int16_t> patch(std::size_t(patchSamples(window)));
                if (corner.patch_age == 0) {
                    cutPatch(to.smooth(), corner.position - corner.offset, window, patch.data());
                } else if (corner.patch_turn.xy != 0) {
                    ASSERT_TRUE(turnPatch(scene.set.surrounding(scene.set.corners[i]), window, corner.patch_turn,
                                          patch.data()));
                } else {
                    continue;
                }
                const std::int16_t* held = scene.set.patch(corner);
                EXPECT_TRUE(std::equal(patch.begin(), patch.end(), held)) << i;
            }
        }
    }
}

TEST(SlowTracker, WindowsAreOddAndWithinWhatPixelsAllow) {
    const auto window = [](double metres) {
        TrackingOptions options;
        options.window_m = metres;
        return CornerTracker(options, test::scaleOf(0.1)).window();
    };
    // Metres over 0.1 m: the nearest odd number.
    EXPECT_EQ(window(0.1), 5);
    EXPECT_EQ(window(0.59), 5);
    EXPECT_EQ(window(0.61), 7);
    EXPECT_EQ(window(0.79), 7);
    EXPECT_EQ(window(0.81), 9);
    EXPECT_EQ(window(1.39), 13);
    EXPECT_EQ(window(1.41), 15);
    EXPECT_EQ(window(3), 15);
    TrackingOptions options;
    options.window_m = 0.9;
    EXPECT_EQ(CornerTracker(options, test::scaleOf(0.1)).margin(), 8);
}

}  // namespace eyrie::slow_tracker_test

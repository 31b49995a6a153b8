#include "registration/corners/corner_tracker.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "registration/corners/corner_grid.h"
#include "registration/corners/neighbourhood_mask.h"
#include "registration/estimation/point_jacobian.h"

namespace eyrie {
namespace {

constexpr int kGrain = 256;
/// A residual of noise alone is about twice its variance; with the scatter of a small window, up to this many times.
constexpr double kNoiseResidual = 5;
/// From this age on a corner's mean motion tells whether it moves by itself.
constexpr int kSettledAge = 4;
constexpr float kMovingPx = 0.3F;
/// A corner that stays so near to its place in the picture, px, for so many frames, while the ground goes so far, px,
/// belongs to the picture. A vehicle that the camera follows wanders farther.
constexpr float kHeldPx = 1.5F;
constexpr int kHeldFrames = 24;
constexpr float kGroundGonePx = 12;

int oddWindow(double px) {
    const int odd = static_cast<int>(std::lround((px - 1) / 2)) * 2 + 1;
    return std::clamp(odd, kSmallestWindow, kLargestWindow);
}

float squareOf(cv::Point2f d) {
    return d.x * d.x + d.y * d.y;
}

/// Notes for how long a corner has stayed where it is in the picture. `map`: of the ground into the new picture.
/// `may_stick`: whether it is to be left out for that.
void noteStay(TrackedCorner& corner, cv::Point2f position, const cv::Matx33d& map, int frames, bool may_stick) {
    if (corner.age == 0) corner.held = corner.ground = corner.position;
    if (squareOf(position - corner.held) > kHeldPx * kHeldPx) {
        corner.held = corner.ground = position;
        corner.held_frames = 0;
        corner.sticks = false;
        return;
    }
    if (corner.sticks) return;  // where its ground has gone meanwhile says no more
    corner.held_frames += frames;
    if (!may_stick) return;
    corner.ground = PointJacobian(map, corner.ground).point;
    corner.sticks =
        corner.held_frames >= kHeldFrames && squareOf(corner.ground - corner.held) > kGroundGonePx * kGroundGonePx;
}

/// The turn so far, followed by that of one more step.
LocalTurn composed(const PointJacobian& map, const LocalTurn& turn) {
    return {map.xx * turn.xx + map.xy * turn.yx, map.xx * turn.xy + map.xy * turn.yy,
            map.yx * turn.xx + map.yy * turn.yx, map.yx * turn.xy + map.yy * turn.yy};
}

/// How far two turns take a point at distance 1 (in either axis) apart.
float difference(const LocalTurn& a, const LocalTurn& b) {
    return std::max(std::abs(a.xx - b.xx) + std::abs(a.xy - b.xy), std::abs(a.yx - b.yx) + std::abs(a.yy - b.yy));
}

/// Tracks one corner after the other; one for each thread's stretch, as it holds the work space.
class Follower {
 public:
    Follower(const CornerSet& set, const ImagePyramid& from, const ImagePyramid& to, const cv::Matx33d& to_from,
             const CornerGrid& movers, const std::vector<cv::Point2f>& mover_velocities)
        : set_(set),
          from_(from),
          to_(to),
          to_from_(to_from),
          movers_(movers),
          mover_velocities_(mover_velocities),
          fine_(set.window()),
          coarse_(set.window() / 4 * 2 + 3),  // 5 … 9 px
          coarse_samples_(std::size_t(patchSamples(coarse_.window()))) {}

    TrackedPosition follow(const TrackedCorner& corner, double noise, double max_residual, double max_step_px,
                           int frames) {
        TrackedPosition result;
        const cv::Point2f centre = corner.position - corner.offset;
        const PointJacobian map(to_from_, centre);
        result.offset = map.vector(corner.offset);
        if (!fine_.prepare(set_.patch(corner))) return result;
        result.contrast = fine_.contrast();
        result.position_variance = fine_.positionVariance();
        const auto acceptable =
            static_cast<float>(std::max(kNoiseResidual * noise * noise, max_residual * double(fine_.contrast())));
        // Good enough to look no further.
        const auto good = static_cast<float>(std::max(3 * noise * noise, 0.4 * double(acceptable)));

        Alignment best;
        best.residual = std::numeric_limits<float>::max();
        AlignmentLimits limits;
        limits.max_shift_px = float(set_.window()) * 0.5F + 1.5F;
        const auto attempt = [&](cv::Point2f start) {
            const Alignment found = align(fine_, to_.smooth(), start, limits);
            if (found.found && found.residual < best.residual &&
                squareOf(found.position - map.point) <= max_step_px * max_step_px) {
                best = found;
            }
            return best.residual <= good;
        };
        const cv::Point2f own = map.vector(corner.velocity) * float(frames);
        const bool moving = squareOf(own) > kMovingPx * kMovingPx;
        bool done = moving && attempt(map.point + own);
        done = done || attempt(map.point);
        if (!done && corner.age < kSettledAge) {
            const int mover = movers_.nearest(corner.position);
            done = mover >= 0 && attempt(map.point + map.vector(mover_velocities_[std::size_t(mover)]) * float(frames));
        }
        for (int level = 1; level <= 2 && !done && level < to_.levels(); ++level) {
            cv::Point2f start = map.point + (moving ? own : cv::Point2f(0, 0));
            if (descend(level, centre, start)) done = attempt(start);
        }
        if (best.residual > acceptable) return result;
        result.found = true;
        result.position = best.position + result.offset;
        result.residual = best.residual;
        return result;
    }

 private:
    /// Aligns at a coarse level and at those between it and full size; `start` becomes a better start at full size.
    bool descend(int level, cv::Point2f centre, cv::Point2f& start) {
        for (int l = level; l >= 1; --l) {
            const cv::Point2f there = ImagePyramid::toLevel(centre, l);
            if (!patchFits(from_.level(l), there, coarse_.window())) return false;
            cutPatch(from_.level(l), there, coarse_.window(), coarse_samples_.data());
            if (!coarse_.prepare(coarse_samples_.data())) return false;
            AlignmentLimits limits;
            limits.max_shift_px = float(coarse_.window()) * 0.5F + 1;
            limits.converged_px = 0.03F;
            const Alignment found = align(coarse_, to_.level(l), ImagePyramid::toLevel(start, l), limits);
            if (!found.found) return false;
            start = ImagePyramid::fromLevel(found.position, l);
        }
        return true;
    }

    const CornerSet& set_;
    const ImagePyramid& from_;
    const ImagePyramid& to_;
    const cv::Matx33d& to_from_;
    const CornerGrid& movers_;
    const std::vector<cv::Point2f>& mover_velocities_;
    PatchTemplate fine_;
    PatchTemplate coarse_;
    std::vector<std::int16_t> coarse_samples_;
};

/// Squared drift from which a corner counts as moving by itself: well above what the background shows.
float moverThreshold(const CornerSet& set, const std::vector<TrackedPosition>& found) {
    constexpr double kSmallestPx = 0.08;
    std::vector<float> squares;
    for (int i = 0; i < set.size(); ++i) {
        const TrackedCorner& corner = set.corners[std::size_t(i)];
        if (found[std::size_t(i)].found && corner.age >= kSettledAge) squares.push_back(squareOf(corner.drift));
    }
    if (squares.empty()) return std::numeric_limits<float>::max();
    const auto middle = squares.begin() + std::ptrdiff_t(squares.size() / 2);
    std::nth_element(squares.begin(), middle, squares.end());
    const double sigma = std::sqrt(double(*middle)) / 1.1774;
    const double limit = std::max(kSmallestPx, 4 * sigma);
    return static_cast<float>(limit * limit);
}

/// Cuts the patch about the whole pixel nearest to the corner, so that it need not be interpolated.
bool storePatch(CornerSet& set, TrackedCorner& corner, const PaddedPicture& picture) {
    const cv::Point2f centre(std::round(corner.position.x), std::round(corner.position.y));
    if (!patchFits(picture, centre, set.window())) return false;
    corner.offset = corner.position - centre;
    corner.turn = {};
    corner.patch_turn = {};
    corner.patch_age = 0;
    cutPatch(picture, centre, set.window(), set.patch(corner));
    cutSurrounding(picture, centre, set.window(), set.surrounding(corner));
    return true;
}

}  // namespace

void TrackingOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::registration);
    declare.real(
        "registration.window", window_m, 0.1, 20,
        {"m",
         "Side of the window that is tracked, a third to a half of a car's width; 5 … 15 px. Larger windows are "
         "less noisy but drag corners off small vehicles.",
         "Teutsch §4.2"});
    declare.real("registration.max_residual", max_residual, 0.02, 2,
                 {"", "A corner is lost when its grey levels differ by more than this share of its own contrast.", ""});
    declare.real("registration.max_speed", max_speed_m_s, 1, 500,
                 {"m/s", "Nothing on the ground is faster; a corner that seems to be is lost.", ""});
    declare.real(
        "registration.max_jerk", max_jerk, 0.2, 50,
        {"px/frame",
         "A corner whose motion over the ground changes by more than this (and half its speed) in one frame has "
         "slipped and is lost.",
         ""});
    declare.integer(
        "registration.patch_life", patch_life, 1, 10000,
        {"frames",
         "A corner is compared with the patch stored this many frames ago at most. Longer: less drift; 1: from "
         "frame to frame.",
         ""});
    declare.real("registration.patch_deformation", patch_deformation, 0.01, 5,
                 {"px", "The patch is turned and scaled with the picture whenever this moves its border by more.", ""});
    declare.flag(
        "registration.leave_out_stuck", leave_out_stuck,
        {"",
         "Corners that stay where they are in the picture while the ground moves away under them (dirt on the "
         "lens, vignette, compression) count neither as ground nor as moving. What the camera follows to a pixel and a "
         "half is left out, too.",
         ""});
}

CornerTracker::CornerTracker(const TrackingOptions& options, const SceneScale& scale)
    : options_(options), window_(oddWindow(scale.px(options.window_m))) {
    setFastest(scale);
}

void CornerTracker::setFastest(const SceneScale& scale) {
    max_step_px_ = std::max(4.0, scale.pxPerFrame(options_.max_speed_m_s));
}

void CornerTracker::add(CornerSet& set, const std::vector<cv::Point2f>& positions, const PaddedPicture& picture,
                        CornerId& next_id) const {
    set.corners.reserve(set.corners.size() + positions.size());
    for (const cv::Point2f& position : positions) {
        TrackedCorner corner;
        corner.position = position;
        corner.slot = set.takeSlot();
        if (!storePatch(set, corner, picture)) {
            set.giveBack(corner.slot);
            continue;
        }
        corner.id = next_id++;
        set.corners.push_back(corner);
    }
}

std::vector<TrackedPosition> CornerTracker::track(const CornerSet& set, const ImagePyramid& from,
                                                  const ImagePyramid& to, const cv::Matx33d& to_from, double noise,
                                                  int frames) const {
    std::vector<cv::Point2f> movers;
    std::vector<cv::Point2f> velocities;
    for (const TrackedCorner& corner : set.corners) {
        if (corner.age < kSettledAge || squareOf(corner.velocity) < kMovingPx * kMovingPx) continue;
        movers.push_back(corner.position);
        velocities.push_back(corner.velocity);
    }
    const CornerGrid grid(to.size(), float(std::max(8, 2 * window_)), movers);
    std::vector<TrackedPosition> result(set.corners.size());
    tbb::parallel_for(tbb::blocked_range<int>(0, set.size(), kGrain), [&](const tbb::blocked_range<int>& range) {
        Follower follower(set, from, to, to_from, grid, velocities);
        for (int i = range.begin(); i < range.end(); ++i) {
            // Patches lie scattered; fetch one while its predecessors are worked on.
            if (i + 3 < range.end()) set.prefetchPatch(set.corners[std::size_t(i) + 3]);
            result[std::size_t(i)] = follower.follow(set.corners[std::size_t(i)], noise, options_.max_residual,
                                                     max_step_px_ * frames, frames);
        }
    });
    return result;
}

Correspondences CornerTracker::correspondences(const CornerSet& set, const std::vector<TrackedPosition>& found,
                                               cv::Size image, double noise) const {
    constexpr int kCellsAcross = 16;
    constexpr double kFloorVariance = 0.05 * 0.05;  // what even a perfect corner scatters, px²
    const double cell = std::max({image.width, image.height, 1}) / double(kCellsAcross);
    const auto cellOf = [&](cv::Point2f p) {
        return static_cast<int>(p.y / cell) * (kCellsAcross + 1) + static_cast<int>(p.x / cell);
    };
    const float moving = moverThreshold(set, found);
    std::vector<float> in_cell(std::size_t((kCellsAcross + 1) * (kCellsAcross + 1)), 0.0F);
    int usable = 0;
    int standing = 0;
    for (int i = 0; i < set.size(); ++i) {
        if (!found[std::size_t(i)].found) continue;
        const TrackedCorner& corner = set.corners[std::size_t(i)];
        if (corner.sticks) continue;
        ++usable;
        standing += corner.age < kSettledAge || squareOf(corner.drift) < moving;
        in_cell[std::size_t(cellOf(corner.position))] += 1;
    }
    // When most corners seem to move, it is rather the ground that was mistaken.
    const bool trust_drift = standing * 2 > usable;
    std::vector<float> counts;
    for (const float count : in_cell) {
        if (count > 0) counts.push_back(count);
    }
    float usual = 1;
    if (!counts.empty()) {
        std::nth_element(counts.begin(), counts.begin() + std::ptrdiff_t(counts.size() / 2), counts.end());
        usual = counts[counts.size() / 2];
    }
    Correspondences result;
    result.reserve(set.corners.size());
    for (int i = 0; i < set.size(); ++i) {
        const TrackedCorner& corner = set.corners[std::size_t(i)];
        const TrackedPosition& now = found[std::size_t(i)];
        double weight = 0;
        const bool stands =
            !corner.sticks && (!trust_drift || corner.age < kSettledAge || squareOf(corner.drift) < moving);
        if (now.found && stands) {
            const double variance = 2 * noise * noise * double(now.position_variance);
            const double crowd = double(usual) / double(in_cell[std::size_t(cellOf(corner.position))]);
            weight = std::min(1.0, 2 * crowd) * kFloorVariance / (kFloorVariance + variance);
        }
        result.add(corner.position, now.found ? now.position : corner.position, static_cast<float>(weight));
    }
    return result;
}

void CornerTracker::advance(CornerSet& set, const std::vector<TrackedPosition>& found, const HomographyFit& fit,
                            const PaddedPicture& to, int frames, double merge_distance_px) const {
    constexpr float kFollow = 0.6F;  // share of the newest measurement in the velocity
    const auto half = float(window_) * 0.5F;
    const auto background = static_cast<float>(fit.inlier_distance_px * fit.inlier_distance_px);
    const float moving = moverThreshold(set, found);
    std::vector<unsigned char> lives(set.corners.size(), 0);
    tbb::parallel_for(tbb::blocked_range<int>(0, set.size(), kGrain), [&](const tbb::blocked_range<int>& range) {
        for (int i = range.begin(); i < range.end(); ++i) {
            TrackedCorner& corner = set.corners[std::size_t(i)];
            const TrackedPosition& now = found[std::size_t(i)];
            if (!now.found) continue;
            const PointJacobian map(fit.matrix, corner.position);
            const cv::Point2f expected = map.vector(corner.velocity);
            const cv::Point2f shift = now.position - map.point;
            const cv::Point2f velocity = shift * (1.0F / float(frames));
            if (corner.age > 0) {
                const double allowed =
                    std::max(options_.max_jerk, 4 * fit.sigma_px) + 0.5 * std::sqrt(double(squareOf(expected)));
                if (squareOf(velocity - expected) > allowed * allowed) continue;
            }
            corner.velocity = corner.age == 0 ? velocity : expected + kFollow * (velocity - expected);
            const float share = std::max(0.12F, 1.0F / float(corner.age + 1));
            const cv::Point2f drift = map.vector(corner.drift);
            corner.drift = drift + share * (velocity - drift);
            corner.on_background = squareOf(shift) <= background;
            noteStay(corner, now.position, fit.matrix, frames, options_.leave_out_stuck);
            corner.position = now.position;
            corner.offset = now.offset;
            corner.residual = now.residual;
            corner.position_variance = now.position_variance;
            corner.turn = composed(map, corner.turn);
            corner.age += frames;
            corner.moves = corner.age >= kSettledAge && squareOf(corner.drift) > moving;
            corner.patch_age += frames;
            if (!patchFits(to, corner.position - corner.offset, window_)) continue;
            lives[std::size_t(i)] = 1;
            const bool faded = now.residual > 0.5 * options_.max_residual * now.contrast;
            bool renew = faded || corner.patch_age >= options_.patch_life;
            if (!renew && half * difference(corner.turn, corner.patch_turn) > options_.patch_deformation) {
                renew = !turnPatch(set.surrounding(corner), window_, corner.turn, set.patch(corner));
                corner.patch_turn = corner.turn;
            }
            if (renew) lives[std::size_t(i)] = storePatch(set, corner, to);
        }
    });

    // Where two run together the older one stays: ids ascend with age, so earlier corners claim their place first.
    NeighbourhoodMask claimed(cv::Size(to.width(), to.height()), merge_distance_px);
    for (int i = 0; i < set.size(); ++i) {
        if (lives[std::size_t(i)] == 0) continue;
        const cv::Point2f place = set.corners[std::size_t(i)].position;
        if (claimed.contains(place)) {
            lives[std::size_t(i)] = 0;
        } else {
            claimed.add(place);
        }
    }

    std::size_t kept = 0;
    for (int i = 0; i < set.size(); ++i) {
        const auto at = std::size_t(i);
        if (lives[at] == 0) {
            set.giveBack(set.corners[at].slot);
        } else {
            set.corners[kept++] = set.corners[at];
        }
    }
    set.corners.resize(kept);
}

}  // namespace eyrie

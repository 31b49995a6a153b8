#include "imaging/following/box_follower.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.h"

namespace eyrie {
namespace {

constexpr int kUsualSpeedSteps = 6;  ///< until the usual speed is known
constexpr double kAtHome = 0.25;     ///< of its length

double stepLength(cv::Point2d v) {
    return std::hypot(v.x, v.y);
}

/// A box on the ground, which moves by `way` in the current picture, in the next one.
OrientedBox carried(OrientedBox box, cv::Point2d way, const Homography& map) {
    const double scale = std::clamp(map.scaleAt(box.centre), 0.8, 1.25);
    box.length *= scale;
    box.width *= scale;
    box.heading = map.turned(box.centre, box.heading);
    box.centre = map.apply(box.centre + way);
    return box;
}

/// Corners at the edge of what grows agree less at first, so it is followed in part from step to step.
double growthOf(const BoxFlow& flow) {
    constexpr double kLargest = 1.15;
    return std::clamp(flow.growth, 1 / kLargest, kLargest);
}

bool growsWith(const BoxFlow& flow, const FollowOptions& options) {
    constexpr double kAgreeingShare = 0.6;
    return options.corners_to_grow > 0 && flow.box.area() >= options.size_to_grow_px * options.size_to_grow_px &&
           flow.agreeing >= std::max<double>(options.corners_to_grow, kAgreeingShare * flow.corners);
}

}  // namespace

BoxFollower::BoxFollower(const OrientedBox& box, const cv::Mat& gray, const FollowOptions& options)
    : options_(options),
      box_(box),
      sure_box_(box),
      home_(box),
      samples_(BoxPatch::samplesFor(box)),
      start_(gray, box, samples_),
      recent_(start_) {}

void BoxFollower::startsWith(cv::Point2d velocity) {
    velocity_ = usual_velocity_ = velocity;
    steps_ = kUsualSpeedSteps;
}

BoxFollower::Step BoxFollower::advance(const cv::Mat& current, const cv::Mat& next, const Homography& map) {
    OrientedBox predicted = carried(box_, velocity_, map);
    predicted.length *= growth_;
    predicted.width *= growth_;
    sure_box_ = carried(sure_box_, {0, 0}, map);
    home_ = carried(home_, {0, 0}, map);
    const BoxFlow flow =
        flowOf(current, next, box_, predicted, {options_.max_corners, options_.max_forward_backward_px});
    Step step;
    step.box = bestMatch(next, flow, predicted);
    step.by_corners = growsWith(flow, options_);
    const double growth = step.by_corners ? growthOf(flow) : 1;
    step.box.length *= growth;
    step.box.width *= growth;
    // What nothing speaks for any more dies away.
    growth_ = step.by_corners ? growth_ * std::sqrt(growth) : std::sqrt(growth_);
    const Likeness likeness = likenessOf(next, step.box);
    const double corners = std::min(1.0, flow.agreeing / 4.0);
    step.certainty = std::clamp(
        0.55 * std::max(0.0, likeness.recent) + 0.25 * std::max(0.0, likeness.start) + 0.2 * corners, 0.0, 1.0);
    step.end = judged(step, flow, likeness, map);
    if (!step.end)
        accept(step, likeness, next, map);
    else if (stood_)
        stay(step, next);
    return step;
}

// What waits is where it was while others pass in front of it. Their corners would take the box with them.
void BoxFollower::stay(Step& step, const cv::Mat& next) {
    // As it was drawn: what it looked like lately may have become that of the ground.
    const double seen = BoxPatch(next, sure_box_, samples_).seenOf(start_);
    step.hidden = seen < options_.min_seen;
    step.box = box_ = sure_box_;
    velocity_ = {0, 0};
    if (step.hidden) return;
    step.certainty = seen;
    step.end.reset();
}

BoxFollower::Likeness BoxFollower::likenessOf(const cv::Mat& gray, const OrientedBox& box) const {
    const BoxPatch patch(gray, box, samples_);
    return {patch.correlation(start_), patch.correlation(recent_)};
}

// The look decides between corners and prediction, and corrects what both drift.
OrientedBox BoxFollower::bestMatch(const cv::Mat& gray, const BoxFlow& flow, const OrientedBox& predicted) const {
    constexpr int kEnoughCorners = 3;
    const bool by_corners = flow.agreeing >= kEnoughCorners;
    const OrientedBox centre = by_corners ? flow.box : predicted;
    // Without corners, and before the speed is known, look further.
    OrientedBox best = refined(gray, centre, by_corners ? 1.0 : steps_ == 0 ? 6.0 : 3.0);
    if (by_corners && steps_ > 0) {
        const OrientedBox other = refined(gray, predicted, 2.0);
        if (likenessOf(gray, other).score() > likenessOf(gray, best).score() + 0.05) best = other;
    }
    return best;
}

// Climbs the likeness from a box, in ever smaller steps of place and heading.
OrientedBox BoxFollower::refined(const cv::Mat& gray, const OrientedBox& from, double reach) const {
    OrientedBox best = from;
    double most = penalised(gray, best, from);
    double step = 2 * reach;
    while ((step /= 2) >= 0.12) {
        bool better = true;
        for (int i = 0; i < 4 && better; ++i) {
            better = false;
            const OrientedBox centre = best;
            const double turn = std::min(0.06, step / std::max(4.0, centre.length / 2));
            for (const cv::Point3d& move :
                 {cv::Point3d(step, 0, 0), cv::Point3d(-step, 0, 0), cv::Point3d(0, step, 0), cv::Point3d(0, -step, 0),
                  cv::Point3d(0, 0, turn), cv::Point3d(0, 0, -turn)}) {
                OrientedBox candidate = centre;
                candidate.centre = centre.toImage({move.x, move.y});
                candidate.heading = wrapPi(centre.heading + move.z);
                const double score = penalised(gray, candidate, from);
                if (score <= most + 1e-6) continue;
                most = score;
                best = candidate;
                better = true;
            }
        }
    }
    return best;
}

// Likeness less a little for every pixel and turn away from where it starts, so that flat looks do not wander.
double BoxFollower::penalised(const cv::Mat& gray, const OrientedBox& box, const OrientedBox& from) const {
    const double away = stepLength(box.centre - from.centre);
    const double turn = std::abs(turnBetween(from.heading, box.heading));
    return likenessOf(gray, box).score() - 0.004 * away * away - 1.0 * turn * turn;
}

// Movement against the ground, in the next picture.
cv::Point2d BoxFollower::movementTo(const OrientedBox& box, const Homography& map) const {
    return box.centre - map.apply(box_.centre);
}

std::optional<FollowEnd> BoxFollower::judged(const Step& step, const BoxFlow& flow, const Likeness& likeness,
                                             const Homography& map) const {
    constexpr int kKnownSpeedSteps = 2;
    const double most =
        std::max(options_.max_speed_change_px, options_.max_speed_change_share * std::sqrt(step.box.area()));
    const cv::Point2d expected = map.applyToVector(box_.centre, velocity_);
    if (steps_ >= kKnownSpeedSteps && stepLength(movementTo(step.box, map) - expected) > most) {
        return FollowEnd::jump;
    }
    // A vehicle does not stop or set off at once; a box that sticks to the ground does. Near by a turn looks like that,
    // too, but many corners see it.
    const cv::Point2d usual = map.applyToVector(box_.centre, usual_velocity_);
    const double change = stepLength((movementTo(step.box, map) + expected) * 0.5 - usual);
    if (!step.by_corners && steps_ >= kUsualSpeedSteps && change > std::max(most * 0.35, 0.5 * stepLength(usual))) {
        return FollowEnd::jump;
    }
    if (likeness.start < options_.min_start_likeness) return FollowEnd::appearance;
    if (likeness.recent < 0.5) return flow.agreeing < 2 ? FollowEnd::few_corners : FollowEnd::appearance;
    if (step.certainty < options_.min_certainty) {
        return flow.agreeing < 2 ? FollowEnd::few_corners : FollowEnd::appearance;
    }
    return std::nullopt;
}

void BoxFollower::accept(const Step& step, const Likeness& likeness, const cv::Mat& next, const Homography& map) {
    const cv::Point2d movement = movementTo(step.box, map);
    const cv::Point2d before = map.applyToVector(box_.centre, velocity_);
    velocity_ = steps_ == 0 ? movement : before + (movement - before) * 0.5;
    const cv::Point2d usual = map.applyToVector(box_.centre, usual_velocity_);
    const double share = std::max(options_.usual_share, 1.0 / (steps_ + 1));
    usual_velocity_ = usual + (movement - usual) * share;
    box_ = step.box;
    ++steps_;
    // What is hidden in part must not become the look of the object.
    if (likeness.recent < 0.75) return;
    recent_.learn(BoxPatch(next, box_, samples_), 0.25);
    sure_box_ = box_;
    // A box that slid off what drives on sticks to the ground, too, but not where it was drawn.
    const bool at_home = stepLength(box_.centre - home_.centre) < kAtHome * box_.length;
    stood_ = at_home && steps_ >= kUsualSpeedSteps && stepLength(usual_velocity_) < options_.max_standing_px;
}

}  // namespace eyrie

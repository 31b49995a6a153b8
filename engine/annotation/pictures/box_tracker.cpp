#include "annotation/pictures/box_tracker.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "annotation/pictures/box_flow.h"
#include "annotation/pictures/box_patch.h"
#include "core/error.h"
#include "core/geometry/angle.h"

namespace eyrie {
namespace {

double stepLength(cv::Point2d v) {
    return std::hypot(v.x, v.y);
}

/// How much a box looks like it did.
struct Likeness {
    double start = 0;   ///< with the look at the keyframe
    double recent = 0;  ///< with the look lately
    double score() const { return 0.4 * start + 0.6 * recent; }
};

/// The object as it is known so far.
class Follower {
 public:
    Follower(const OrientedBox& box, const cv::Mat& gray, const FollowOptions& options)
        : options_(options),
          box_(box),
          samples_(BoxPatch::samplesFor(box)),
          start_(gray, box, samples_),
          recent_(start_) {}

    struct Step {
        OrientedBox box;
        double certainty = 0;
        std::optional<FollowEnd> end;
    };

    /// Follows from `current` to `next`, whose ground `map` joins.
    Step advance(const cv::Mat& current, const cv::Mat& next, const Homography& map) {
        OrientedBox predicted = box_;
        predicted.centre = map.apply(box_.centre + velocity_);
        const double scale = std::clamp(map.scaleAt(box_.centre), 0.8, 1.25);
        predicted.length *= scale;
        predicted.width *= scale;
        predicted.heading = map.turned(box_.centre, box_.heading);

        const BoxFlow flow =
            flowOf(current, next, box_, predicted, {options_.max_corners, options_.max_forward_backward_px});
        Step step;
        step.box = bestMatch(next, flow, predicted);
        const Likeness likeness = likenessOf(next, step.box);
        const double corners = std::min(1.0, flow.agreeing / 4.0);
        step.certainty = std::clamp(
            0.55 * std::max(0.0, likeness.recent) + 0.25 * std::max(0.0, likeness.start) + 0.2 * corners, 0.0, 1.0);
        step.end = judged(step, flow, likeness, map);
        if (!step.end) accept(step, likeness, next, map);
        return step;
    }

 private:
    Likeness likenessOf(const cv::Mat& gray, const OrientedBox& box) const {
        const BoxPatch patch(gray, box, samples_);
        return {patch.correlation(start_), patch.correlation(recent_)};
    }

    /// The look decides between corners and prediction, and corrects what both drift.
    OrientedBox bestMatch(const cv::Mat& gray, const BoxFlow& flow, const OrientedBox& predicted) const {
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

    /// Climbs the likeness from a box, in ever smaller steps of place and heading.
    OrientedBox refined(const cv::Mat& gray, const OrientedBox& from, double reach) const {
        OrientedBox best = from;
        double most = penalised(gray, best, from);
        for (double step = reach; step >= 0.12; step /= 2) {
            bool better = true;
            for (int i = 0; i < 4 && better; ++i) {
                better = false;
                const OrientedBox centre = best;
                const double turn = std::min(0.06, step / std::max(4.0, centre.length / 2));
                for (const cv::Point3d& move :
                     {cv::Point3d(step, 0, 0), cv::Point3d(-step, 0, 0), cv::Point3d(0, step, 0),
                      cv::Point3d(0, -step, 0), cv::Point3d(0, 0, turn), cv::Point3d(0, 0, -turn)}) {
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

    /// Likeness less a little for every pixel and turn away from where it starts, so that flat looks do not wander.
    double penalised(const cv::Mat& gray, const OrientedBox& box, const OrientedBox& from) const {
        const double away = stepLength(box.centre - from.centre);
        const double turn = std::abs(turnBetween(from.heading, box.heading));
        return likenessOf(gray, box).score() - 0.004 * away * away - 1.0 * turn * turn;
    }

    /// Movement against the ground, in the next picture.
    cv::Point2d movementTo(const OrientedBox& box, const Homography& map) const {
        return box.centre - map.apply(box_.centre);
    }

    std::optional<FollowEnd> judged(const Step& step, const BoxFlow& flow, const Likeness& likeness,
                                    const Homography& map) const {
        constexpr int kKnownSpeedSteps = 2;
        const cv::Point2d expected = map.applyToVector(box_.centre, velocity_);
        if (steps_ >= kKnownSpeedSteps &&
            stepLength(movementTo(step.box, map) - expected) > options_.max_speed_change_px) {
            return FollowEnd::jump;
        }
        // A vehicle does not stop or set off at once; a box that sticks to the ground does.
        const cv::Point2d usual = map.applyToVector(box_.centre, usual_velocity_);
        constexpr int kUsualSpeedSteps = 6;
        const double change = stepLength((movementTo(step.box, map) + expected) * 0.5 - usual);
        if (steps_ >= kUsualSpeedSteps &&
            change > std::max(options_.max_speed_change_px * 0.35, 0.5 * stepLength(usual))) {
            return FollowEnd::jump;
        }
        if (likeness.start < options_.min_start_likeness) return FollowEnd::appearance;
        if (likeness.recent < 0.5) return flow.agreeing < 2 ? FollowEnd::few_corners : FollowEnd::appearance;
        if (step.certainty < options_.min_certainty) {
            return flow.agreeing < 2 ? FollowEnd::few_corners : FollowEnd::appearance;
        }
        return std::nullopt;
    }

    void accept(const Step& step, const Likeness& likeness, const cv::Mat& next, const Homography& map) {
        const cv::Point2d movement = movementTo(step.box, map);
        const cv::Point2d before = map.applyToVector(box_.centre, velocity_);
        velocity_ = steps_ == 0 ? movement : before + (movement - before) * 0.5;
        const cv::Point2d usual = map.applyToVector(box_.centre, usual_velocity_);
        const double share = std::max(0.12, 1.0 / (steps_ + 1));
        usual_velocity_ = usual + (movement - usual) * share;
        box_ = step.box;
        ++steps_;
        // What is hidden in part must not become the look of the object.
        if (likeness.recent > 0.75) recent_.learn(BoxPatch(next, box_, samples_), 0.25);
    }

    const FollowOptions& options_;
    OrientedBox box_;
    cv::Size samples_;
    BoxPatch start_;
    BoxPatch recent_;
    cv::Point2d velocity_{0, 0};        ///< px per step against the ground, in the current picture
    cv::Point2d usual_velocity_{0, 0};  ///< the same over the last ten steps or so
    int steps_ = 0;
};

std::string reasonOf(FollowEnd end, FrameIndex frame, double certainty) {
    const std::string where = "stopped at frame " + std::to_string(frame) + ": ";
    char share[16];
    std::snprintf(share, sizeof share, " (%.2f)", certainty);
    switch (end) {
        case FollowEnd::end_of_range:
            return "followed to frame " + std::to_string(frame);
        case FollowEnd::left_image:
            return where + "it leaves the image";
        case FollowEnd::few_corners:
            return where + "hardly any corner of it could be tracked" + share;
        case FollowEnd::appearance:
            return where + "it does not look like the object any more" + share;
        case FollowEnd::jump:
            return where + "it would have jumped";
        case FollowEnd::no_picture:
            return where + "the frame could not be read";
        case FollowEnd::stopped:
            return where + "stopped by hand";
    }
    return where;
}

bool usable(const cv::Mat& gray) {
    return !gray.empty() && gray.type() == CV_8UC1;
}

}  // namespace

FollowResult followBox(const OrientedBox& box, FrameIndex start, FrameIndex last, const GrayFrames& gray,
                       const CameraMotion& camera, const FollowOptions& options, const FollowProgress& progress,
                       std::stop_token stop) {
    if (!(box.length >= 2) || !(box.width >= 2)) {
        throw Error(ErrorKind::parameter, "a box of less than 2 px cannot be followed; draw it larger");
    }
    FollowResult result;
    const auto finish = [&](FollowEnd end, FrameIndex frame, double certainty) {
        result.end = end;
        result.end_frame = frame;
        result.reason = reasonOf(end, frame, certainty);
        return result;
    };
    cv::Mat current = gray(start);
    if (!usable(current)) return finish(FollowEnd::no_picture, start, 0);
    if (areaInImage(box, current.size()) < 0.5 * box.area()) return finish(FollowEnd::left_image, start, 0);
    Follower follower(box, current, options);
    OrientedBox at = box;
    const int direction = last >= start ? 1 : -1;
    for (FrameIndex frame = start; frame != last;) {
        const FrameIndex target = frame + direction;
        if (stop.stop_requested()) return finish(FollowEnd::stopped, target, 0);
        const cv::Mat next = gray(target);
        if (!usable(next) || next.size() != current.size()) return finish(FollowEnd::no_picture, target, 0);
        auto map = camera.map(frame, target);
        if (!map) map = cameraAround(current, next, at);
        const Follower::Step step = follower.advance(current, next, *map);
        if (areaInImage(step.box, next.size()) < 0.5 * step.box.area()) {
            return finish(FollowEnd::left_image, target, step.certainty);
        }
        if (step.end) return finish(*step.end, target, step.certainty);
        result.boxes.push_back({target, step.box, step.certainty});
        if (progress) progress(result.boxes.back());
        at = step.box;
        current = next;
        frame = target;
    }
    return finish(FollowEnd::end_of_range, last, 0);
}

}  // namespace eyrie

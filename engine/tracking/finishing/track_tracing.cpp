#include <algorithm>
#include <cmath>
#include <deque>
#include <unordered_map>

#include "core/robust_statistics.h"
#include "tracking/finishing/track_occupancy.h"

namespace eyrie {
namespace {

constexpr int kPatience = 8;           ///< frames without a fitting vector after which the trace is lost
constexpr double kSpeedShare = 0.35;   ///< vectors may differ from the track's velocity by this share of its speed …
constexpr double kSpeedFloor = 0.08;   ///< … or by this, px/frame
constexpr double kMargin = 1;          ///< px by which a vector may lie outside the box
constexpr double kVelocityGain = 0.3;  ///< of a frame's vectors on the track's velocity
constexpr std::size_t kNewcomers = 2;  ///< vectors of other corners that together support the track
constexpr double kInImage = 0.5;       ///< share of a traced box that must lie in the image

cv::Point2d medianPoint(const std::vector<cv::Point2d>& points) {
    std::vector<double> x, y;
    for (const cv::Point2d& point : points) {
        x.push_back(point.x);
        y.push_back(point.y);
    }
    return {medianOf(std::move(x)), medianOf(std::move(y))};
}

/// Keeps the vectors of the frames used last: neighbouring tracks need the same ones.
class RecentVectors {
 public:
    explicit RecentVectors(const VectorsAt& source) : source_(source) {}
    /// Valid until the next but kFramesKept frames were asked for.
    const std::vector<MotionVector>& at(FrameIndex frame) {
        const auto [entry, is_new] = kept_.try_emplace(frame);
        if (!is_new) return entry->second;
        entry->second = source_(frame);
        order_.push_back(frame);
        if (order_.size() > kFramesKept) {
            kept_.erase(order_.front());
            order_.pop_front();
        }
        return entry->second;
    }

 private:
    static constexpr std::size_t kFramesKept = 256;
    const VectorsAt& source_;
    std::unordered_map<FrameIndex, std::vector<MotionVector>> kept_;
    std::deque<FrameIndex> order_;
};

/// Follows one track back in time, frame by frame, by the motion vectors in its box.
class Trace {
 public:
    Trace(const TrackPath& path, const GroundMotion& ground, RecentVectors& vectors)
        : ground_(ground), vectors_(vectors), state_(path.states.front().second), frame_(path.firstFrame()) {
        fitting_ = fittingVectors(vectors_.at(frame_), {state_.box, state_.velocity}, {});
    }

    /// One frame back; nothing where the track leaves the image, reaches another one or was not supported lately.
    std::optional<TimedPathState> back(const TrackOccupancy& taken) {
        const FrameIndex to = frame_ - 1;
        const auto mapped = ground_.carried({state_.box, {0, 0}}, frame_, to, false);
        auto moved = ground_.carried({state_.box, state_.velocity}, frame_, to, false);
        if (!mapped || !moved) return std::nullopt;
        const std::vector<MotionVector>& vectors = vectors_.at(to);
        const auto followed = shiftsOf(vectors, to);
        if (!followed.empty()) moved->box.centre = mapped->box.centre + medianPoint(followed);
        if (areaInImage(moved->box, ground_.imageSize(to)) < kInImage * moved->box.area()) return std::nullopt;
        if (!taken.isFree(to, moved->box)) return std::nullopt;
        fitting_ = fittingVectors(vectors, *moved, taken.in(to));
        const bool supported = !followed.empty() || fitting_.size() >= kNewcomers;
        unsupported_ = supported ? 0 : unsupported_ + 1;
        if (unsupported_ > kPatience) return std::nullopt;
        if (!fitting_.empty()) {
            std::vector<cv::Point2d> velocities;
            for (const MotionVector& vector : fitting_) velocities.emplace_back(vector.velocity);
            moved->velocity += (medianPoint(velocities) - moved->velocity) * kVelocityGain;
        }
        state_.box = moved->box;
        state_.velocity = moved->velocity;
        state_.origin = supported ? StateOrigin::reconstructed : StateOrigin::predicted;
        state_.hits = 0;
        frame_ = to;
        return TimedPathState{frame_, state_};
    }

 private:
    /// How far the corners that were in the box moved by themselves; only those that still move alike.
    std::vector<cv::Point2d> shiftsOf(const std::vector<MotionVector>& vectors, FrameIndex to) const {
        std::vector<cv::Point2d> shifts;
        for (const MotionVector& later : fitting_) {
            const auto earlier =
                std::lower_bound(vectors.begin(), vectors.end(), later.id,
                                 [](const MotionVector& vector, CornerId id) { return vector.id < id; });
            if (earlier == vectors.end() || earlier->id != later.id) continue;
            OrientedBox place = state_.box;
            place.centre = later.position;
            const auto stood = ground_.carried({place, {0, 0}}, frame_, to, false);
            if (stood) shifts.push_back(cv::Point2d(earlier->position) - stood->box.centre);
        }
        return shifts;
    }

    static std::vector<MotionVector> fittingVectors(const std::vector<MotionVector>& vectors, const MovingState& state,
                                                    const std::vector<OrientedBox>& taken) {
        const double allowed = std::max(kSpeedFloor, kSpeedShare * std::hypot(state.velocity.x, state.velocity.y));
        std::vector<MotionVector> fitting;
        for (const MotionVector& vector : vectors) {
            const cv::Point2d apart = cv::Point2d(vector.velocity) - state.velocity;
            if (std::hypot(apart.x, apart.y) > allowed || !state.box.contains(vector.position, kMargin)) continue;
            const bool free = std::none_of(taken.begin(), taken.end(),
                                           [&](const OrientedBox& other) { return other.contains(vector.position); });
            if (free) fitting.push_back(vector);
        }
        return fitting;
    }

    const GroundMotion& ground_;
    RecentVectors& vectors_;
    PathState state_;
    FrameIndex frame_;
    std::vector<MotionVector> fitting_;  ///< in `frame_`
    int unsupported_ = 0;
};

}  // namespace

void traceBack(std::vector<TrackPath>& paths, const GroundMotion& ground, const VectorsAt& vectors_at, int frames) {
    if (frames < 1 || !vectors_at) return;
    TrackOccupancy taken(paths);
    RecentVectors vectors(vectors_at);
    for (TrackPath& path : paths) {
        if (path.states.front().second.origin == StateOrigin::predicted) continue;
        Trace trace(path, ground, vectors);
        std::vector<TimedPathState> traced;
        const auto longest = std::min(static_cast<std::size_t>(frames), path.states.size() / 2);
        while (traced.size() < longest) {
            auto earlier = trace.back(taken);
            if (!earlier) break;
            traced.push_back(*earlier);
        }
        while (!traced.empty() && traced.back().second.origin == StateOrigin::predicted) traced.pop_back();
        prepend(path, traced);
        taken.extended(path);
    }
}

}  // namespace eyrie

#include <algorithm>
#include <cmath>
#include <map>

#include "core/geometry/angle.h"
#include "tracking/association/best_assignment.h"
#include "tracking/finishing/frames_of.h"
#include "tracking/finishing/shared_frames.h"
#include "tracking/finishing/track_paths.h"

namespace eyrie {
namespace {

constexpr double kAcceleration = 3;        ///< m/s² by which a vehicle may change its motion unseen
constexpr double kSizeRatio = 2.2;         ///< between the areas of fragments of one vehicle
constexpr double kJoinedSpeedShare = 0.4;  ///< difference of velocities, as a share of the speed
constexpr double kJoinedSpeedFloor = 0.3;  ///< px/frame
constexpr double kMaxTurn = kPi / 3;       ///< between the directions of fast fragments
constexpr double kMeetingGap = 0.3;        ///< s between tracks that were followed to one another
constexpr double kMeetingSizeRatio = 2.5;  ///< between their areas: who turns shows another side
constexpr double kMeetingShare = 0.4;      ///< of the smaller box that both must share
constexpr double kFastSpeed = 1;           ///< px/frame from which directions are compared

/// The last frame an earlier track may keep when a later one continues it; its unseen states from there on are cut.
FrameIndex usableEnd(const TrackPath& earlier, const TrackPath& later) {
    return std::min(earlier.lastFrame(), later.firstFrame() - 1);
}

FrameIndex lastDetected(const TrackPath& path) {
    for (auto state = path.states.rbegin(); state != path.states.rend(); ++state) {
        if (state->second.origin == StateOrigin::detected) return state->first;
    }
    return path.lastFrame();
}

class Joiner {
 public:
    Joiner(const GroundMotion& ground, const FinishingOptions& options, const SceneScale& scale)
        : ground_(ground),
          max_gap_(framesOf(options.join_gap_s, scale)),
          least_distance_(options.join_distance_px),
          distance_m_(options.join_distance_m),
          scale_(scale) {}

    /// Above 0 when `later` continues `earlier`, the more the better.
    double worth(const TrackPath& earlier, const TrackPath& later) const {
        const FrameIndex end = usableEnd(earlier, later);
        const int gap = later.firstFrame() - end;
        if (end < earlier.firstFrame() || gap > max_gap_ || lastDetected(earlier) > end) return 0;
        const TimedPathState* last = earlier.at(end);
        if (!last) return 0;
        const auto expected = ground_.carried(movingOf(last->second), end, later.firstFrame(), true);
        if (!expected) return 0;
        const MovingState found = movingOf(later.states.front().second);
        const SceneScale here = scale_.at(later.firstFrame(), found.box.centre);
        const double allowed = std::max(least_distance_, here.px(distance_m_));
        const double acceleration = here.pxPerFrame(kAcceleration) / here.frame_rate_hz;

        const double area_ratio = found.box.area() / expected->box.area();
        if (!(area_ratio <= kSizeRatio && area_ratio * kSizeRatio >= 1)) return 0;
        const double speed = std::hypot(expected->velocity.x, expected->velocity.y);
        const double found_speed = std::hypot(found.velocity.x, found.velocity.y);
        if (std::min(speed, found_speed) > kFastSpeed &&
            std::abs(turnBetween(std::atan2(expected->velocity.y, expected->velocity.x),
                                 std::atan2(found.velocity.y, found.velocity.x))) > kMaxTurn) {
            return 0;
        }
        const cv::Point2d faster = found.velocity - expected->velocity;
        const double speed_allowed =
            std::max(kJoinedSpeedFloor, kJoinedSpeedShare * std::max(speed, found_speed)) + acceleration * gap;
        const double speed_cost = std::hypot(faster.x, faster.y) / speed_allowed;
        const cv::Point2d apart = found.box.centre - expected->box.centre;
        const double distance_cost = std::hypot(apart.x, apart.y) / (allowed + acceleration * gap * gap / 2);
        if (!(speed_cost <= 1 && distance_cost <= 1)) return 0;
        return 2.5 - speed_cost - distance_cost;
    }

    /// Whether `later` begins just where `earlier` ends, wherever they drive.
    bool meet(const TrackPath& earlier, const TrackPath& later) const {
        const FrameIndex end = earlier.lastFrame();
        const FrameIndex begin = later.firstFrame();
        if (end >= begin) return false;
        const PathState& last = earlier.states.back().second;
        const PathState& first = later.states.front().second;
        const auto stood = ground_.carried({last.box, {0, 0}}, end, begin, false);
        const auto drove = ground_.carried(movingOf(last), end, begin, false);
        if (!stood || !drove) return false;
        const double smaller = std::min(stood->box.area(), first.box.area());
        const double larger = std::max(stood->box.area(), first.box.area());
        if (!(larger <= kMeetingSizeRatio * smaller)) return false;
        return std::max(intersectionArea(stood->box, first.box), intersectionArea(drove->box, first.box)) >=
               kMeetingShare * smaller;
    }

    /// Appends `later` to `earlier` and fills the gap.
    void append(TrackPath& earlier, TrackPath&& later) const {
        const FrameIndex end = usableEnd(earlier, later);
        while (earlier.lastFrame() > end) earlier.states.pop_back();
        const PathState before = earlier.states.back().second;
        const PathState after = later.states.front().second;
        const FrameIndex start = later.firstFrame();
        earlier.states.reserve(earlier.states.size() + static_cast<std::size_t>(start - end) + later.states.size());
        for (FrameIndex frame = end + 1; frame < start; ++frame) {
            const auto from_before = ground_.carried(movingOf(before), end, frame, true);
            const auto from_after = ground_.carried(movingOf(after), start, frame, true);
            if (!from_before || !from_after) continue;
            const double share = static_cast<double>(frame - end) / (start - end);
            PathState between = before;
            between.status = TrackStatus::coasting;
            between.origin = StateOrigin::predicted;
            const OrientedBox& a = from_before->box;
            const OrientedBox& b = from_after->box;
            between.box = OrientedBox{a.centre + (b.centre - a.centre) * share,
                                      a.length + (b.length - a.length) * share, a.width + (b.width - a.width) * share,
                                      wrapPi(a.heading + axisTurnBetween(a.heading, b.heading) * share)};
            between.velocity = from_before->velocity + (from_after->velocity - from_before->velocity) * share;
            earlier.states.emplace_back(frame, between);
        }
        for (TimedPathState& state : later.states) {
            state.second.hits += before.hits;
            earlier.states.push_back(state);
        }
    }

    int maxGap() const { return max_gap_; }

 private:
    const GroundMotion& ground_;
    int max_gap_;
    double least_distance_;  ///< px
    double distance_m_;
    SceneScale scale_;
};

/// Pairs of which the second may continue the first, by the second, then the first.
std::vector<WeightedPair> possiblePairs(const std::vector<TrackPath>& paths, const Joiner& joiner) {
    const LivingTracks living(paths);
    std::vector<WeightedPair> pairs;
    for (std::size_t later = 0; later < paths.size(); ++later) {
        const FrameIndex begin = paths[later].firstFrame();
        for (const std::size_t earlier : living.during(std::max(0, begin - joiner.maxGap()), begin)) {
            if (paths[earlier].firstFrame() >= begin) continue;
            const double worth = joiner.worth(paths[earlier], paths[later]);
            if (worth > 0) pairs.push_back({static_cast<int>(earlier), static_cast<int>(later), worth});
        }
    }
    return pairs;
}

/// For each earlier track the one that goes on at once where it ends; nothing where several do, or it goes on several.
std::map<std::size_t, std::size_t> meetingPairs(const std::vector<TrackPath>& paths, const FollowedEnds& followed,
                                                const Joiner& joiner, int max_gap) {
    const LivingTracks living(paths);
    std::map<std::size_t, std::vector<std::size_t>> earlier_of;
    std::map<std::size_t, int> continued;
    for (std::size_t later = 0; later < paths.size(); ++later) {
        const FrameIndex begin = paths[later].firstFrame();
        for (const std::size_t earlier : living.during(std::max(0, begin - max_gap), begin)) {
            const bool sought = followed.begins.contains(paths[later].id) || followed.ends.contains(paths[earlier].id);
            if (!sought || !joiner.meet(paths[earlier], paths[later])) continue;
            earlier_of[later].push_back(earlier);
            ++continued[earlier];
        }
    }
    std::map<std::size_t, std::size_t> pairs;
    for (const auto& [later, earlier] : earlier_of) {
        if (earlier.size() == 1 && continued[earlier.front()] == 1) pairs[earlier.front()] = later;
    }
    return pairs;
}

}  // namespace

std::vector<std::pair<TrackId, TrackId>> joinMeeting(std::vector<TrackPath>& paths, const FollowedEnds& followed,
                                                     const GroundMotion& ground, const FinishingOptions& options,
                                                     const SceneScale& scale) {
    std::vector<std::pair<TrackId, TrackId>> joined;
    if (!(options.join_gap_s > 0) || (followed.begins.empty() && followed.ends.empty())) return joined;
    const Joiner joiner(ground, options, scale);
    const int max_gap = std::max(2, framesOf(std::min(kMeetingGap, options.join_gap_s), scale));
    const auto pairs = meetingPairs(paths, followed, joiner, max_gap);
    // The latest first, so that each takes its own continuations along.
    std::vector<std::pair<std::size_t, std::size_t>> latest_first(pairs.begin(), pairs.end());
    std::sort(latest_first.begin(), latest_first.end(), [&](const auto& a, const auto& b) {
        const FrameIndex begin_a = paths[a.second].firstFrame();
        const FrameIndex begin_b = paths[b.second].firstFrame();
        return begin_a != begin_b ? begin_a > begin_b : a.second > b.second;
    });
    for (const auto& [earlier, later] : latest_first) {
        joined.emplace_back(paths[earlier].id, paths[later].id);
        joiner.append(paths[earlier], std::move(paths[later]));
        paths[later].states.clear();
    }
    std::erase_if(paths, [](const TrackPath& path) { return path.states.empty(); });
    return joined;
}

std::vector<TrackPath> joinFragments(std::vector<TrackPath> paths, const GroundMotion& ground,
                                     const FinishingOptions& options, const SceneScale& scale) {
    const Joiner joiner(ground, options, scale);
    if (joiner.maxGap() < 1) return paths;
    const std::vector<WeightedPair> pairs = possiblePairs(paths, joiner);
    std::vector<int> continued_by(paths.size(), -1);
    std::vector<char> is_continuation(paths.size(), 0);
    for (const int chosen : bestAssignment(pairs)) {
        const WeightedPair& pair = pairs[static_cast<std::size_t>(chosen)];
        continued_by[static_cast<std::size_t>(pair.row)] = pair.column;
        is_continuation[static_cast<std::size_t>(pair.column)] = 1;
    }
    std::vector<TrackPath> joined;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        if (is_continuation[i]) continue;
        TrackPath whole = std::move(paths[i]);
        for (int next = continued_by[i]; next >= 0; next = continued_by[static_cast<std::size_t>(next)]) {
            joiner.append(whole, std::move(paths[static_cast<std::size_t>(next)]));
        }
        joined.push_back(std::move(whole));
    }
    return joined;
}

}  // namespace eyrie

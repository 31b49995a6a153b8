#include "correction/joined_states.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "annotation/keyframes/interpolation.h"
#include "core/geometry/angle.h"

namespace eyrie {
namespace {

/// Frames on either side that tell a velocity.
constexpr int kVelocityReach = 2;

bool wasSeen(const TrackState& state) {
    return state.status != TrackStatus::coasting && state.origin != StateOrigin::predicted;
}

/// Between two boxes of one frame, `share` of the way from `a` to `b`.
OrientedBox between(const OrientedBox& a, const OrientedBox& b, double share) {
    OrientedBox box;
    box.centre = a.centre + (b.centre - a.centre) * share;
    box.length = a.length + (b.length - a.length) * share;
    box.width = a.width + (b.width - a.width) * share;
    box.heading = wrapPi(a.heading + turnBetween(a.heading, b.heading) * share);
    return box;
}

/// What lies between two states, on the ground; nothing where a frame is not connected with both.
std::vector<TrackFrame> filling(const TrackFrame& before, const TrackFrame& after, const CameraMotion& camera) {
    std::vector<TrackFrame> filled;
    const double frames = after.frame - before.frame;
    for (FrameIndex frame = before.frame + 1; frame < after.frame; ++frame) {
        const auto from = carriedBox(before.state.box, before.frame, frame, camera);
        const auto to = carriedBox(after.state.box, after.frame, frame, camera);
        if (!from || !to) return {};
        TrackFrame& made = filled.emplace_back();
        made.frame = frame;
        made.state.box = between(*from, *to, (frame - before.frame) / frames);
        made.state.velocity = (to->centre - from->centre) * (1 / frames);
        made.state.status = TrackStatus::coasting;
        made.state.origin = StateOrigin::predicted;
    }
    return filled;
}

cv::Point2d velocityAt(const std::vector<Sighting>& sightings, std::size_t i, const CameraMotion& camera) {
    const Sighting& here = sightings[i];
    // Only what is near in time tells it, and only from neighbours that are connected.
    const auto isNear = [&](std::size_t k) {
        return std::abs(sightings[k].frame - here.frame) <= kVelocityReach &&
               camera.connects(here.frame, sightings[k].frame);
    };
    std::size_t first = i, last = i;
    while (first > 0 && isNear(first - 1)) --first;
    while (last + 1 < sightings.size() && isNear(last + 1)) ++last;
    if (first == last) return {0, 0};
    const cv::Point2d from = carriedPoint(sightings[first].box.centre, sightings[first].frame, here.frame, camera);
    const cv::Point2d to = carriedPoint(sightings[last].box.centre, sightings[last].frame, here.frame, camera);
    return (to - from) * (1.0 / (sightings[last].frame - sightings[first].frame));
}

}  // namespace

std::vector<TrackFrame> joinedStates(const std::vector<TrackFrame>& one, const std::vector<TrackFrame>& other,
                                     const CameraMotion& camera, int longest_gap) {
    std::map<FrameIndex, TrackState> chosen;
    double score = 0;
    for (const TrackFrame& each : one) {
        chosen[each.frame] = each.state;
        score = std::max(score, each.state.score);
    }
    for (const TrackFrame& each : other) {
        score = std::max(score, each.state.score);
        const auto [there, fresh] = chosen.emplace(each.frame, each.state);
        if (!fresh && wasSeen(each.state) && !wasSeen(there->second)) there->second = each.state;
    }
    // Gaps that a track had before are left to it.
    const FrameIndex end = one.back().frame;
    const FrameIndex begin = other.front().frame;
    std::vector<TrackFrame> states;
    for (const auto& [frame, state] : chosen) {
        if (!states.empty() && states.back().frame == end && frame == begin && frame - end <= longest_gap + 1) {
            for (TrackFrame& made : filling(states.back(), {frame, state}, camera)) states.push_back(std::move(made));
        }
        states.push_back({frame, state});
    }
    for (TrackFrame& each : states) each.state.score = score;
    return states;
}

std::vector<TrackFrame> statesByHand(const std::vector<Sighting>& sightings, const CameraMotion& camera) {
    std::vector<TrackFrame> states;
    for (std::size_t i = 0; i < sightings.size(); ++i) {
        TrackFrame& made = states.emplace_back();
        made.frame = sightings[i].frame;
        made.state.box = sightings[i].box;
        made.state.velocity = velocityAt(sightings, i, camera);
        made.state.status = TrackStatus::confirmed;
        made.state.origin = StateOrigin::by_hand;
        made.state.score = 1;
    }
    return states;
}

void renumber(std::vector<TrackFrame>& states, TrackId id) {
    int hits = 0;
    for (TrackFrame& each : states) {
        hits += wasSeen(each.state) ? 1 : 0;
        each.state.id = id;
        each.state.age = each.frame - states.front().frame;
        each.state.hits = hits;
    }
}

}  // namespace eyrie

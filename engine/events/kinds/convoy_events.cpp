#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <span>

#include "events/kinds/event_scene.h"

namespace eyrie {
namespace {

constexpr double kSampled_s = 0.5;   ///< how often who follows whom is looked up
constexpr double kMissing_s = 2;     ///< for which a vehicle may seem not to follow
constexpr double kSameWayCos = 0.5;  ///< of the angle between the directions of two that follow each other
constexpr double kSameSpeed = 2;     ///< factor by which their speeds may differ

/// One path that follows another at one moment.
struct Following {
    FrameIndex frame = 0;
    double headway_s = 0;
};

/// For how long a path followed another at a steady distance.
struct FollowedFor {
    std::size_t follower = 0;
    std::size_t leader = 0;
    FrameIndex first = 0;
    FrameIndex last = 0;
};

/// No more than they lie apart, m, and quicker told.
double leastBetween(const GroundSample& a, const GroundSample& b) {
    return std::max(std::abs(b.at.x - a.at.x), std::abs(b.at.y - a.at.y)) * (a.by_place + b.by_place) / 2;
}

/// After which time `follower` passes the place where `leader` is at that moment; nothing when it does not.
std::optional<double> headwayOf(const EventScene& scene, const GroundPath& follower, std::size_t at,
                                const GroundSample& leader) {
    const EventOptions& o = scene.options;
    const GroundSample& now = follower.samples[at];
    if (now.speed > kSameSpeed * leader.speed || leader.speed > kSameSpeed * now.speed) return std::nullopt;
    const double furthest = o.convoy_headway_s * std::max(now.speed, leader.speed) * kSameSpeed;
    if (leastBetween(now, leader) > furthest || metresBetween(now, leader) > furthest) return std::nullopt;
    double nearest = o.convoy_lane_m;
    std::optional<double> headway;
    for (const GroundSample& then : std::span(follower.samples).subspan(at + 1)) {
        const double seconds = secondsBetween(now, then, scene.scale);
        if (seconds > o.convoy_headway_s) break;
        if (leastBetween(then, leader) >= nearest) continue;
        const double distance = metresBetween(then, leader);
        if (distance >= nearest) continue;
        if (then.velocity.dot(leader.velocity) < kSameWayCos * then.speed * leader.speed) continue;
        nearest = distance;
        headway = seconds;
    }
    return headway;
}

/// A path that moves at one moment.
struct Present {
    std::size_t path = 0;
    std::size_t sample = 0;  ///< of that moment
};

using Pair = std::pair<std::size_t, std::size_t>;  ///< follower, leader

/// Who drives right behind whom at one moment.
void lookUp(const EventScene& scene, FrameIndex frame, const std::vector<Present>& present,
            std::map<Pair, std::vector<Following>>& found) {
    for (const auto& [b, at] : present) {
        const GroundPath& follower = scene.paths[b];
        std::optional<double> least;
        std::size_t leader = b;
        for (const auto& [a, there] : present) {
            if (a == b || scene.paths[a].stretch != follower.stretch || scene.paths[a].id() == follower.id()) continue;
            const auto headway = headwayOf(scene, follower, at, scene.paths[a].samples[there]);
            if (headway && (!least || *headway < *least)) least = headway, leader = a;
        }
        if (least) found[{b, leader}].push_back({frame, *least});
    }
}

/// The parts of a sequence that are steady and long enough.
void addSteady(const EventScene& scene, const Pair& pair, const std::vector<Following>& sequence,
               std::vector<FollowedFor>& found) {
    const EventOptions& o = scene.options;
    const double rate = scene.scale.frame_rate_hz;
    const auto close = [&](std::size_t begin, std::size_t end) {
        if (end > begin && (sequence[end - 1].frame - sequence[begin].frame) / rate >= o.convoy_time_s)
            found.push_back({pair.first, pair.second, sequence[begin].frame, sequence[end - 1].frame});
    };
    std::size_t begin = 0;
    double least = 0, most = 0;
    for (std::size_t i = 0; i < sequence.size(); ++i) {
        const double headway = sequence[i].headway_s;
        const bool torn = i > begin && (sequence[i].frame - sequence[i - 1].frame) / rate > kMissing_s;
        const bool unsteady =
            i > begin && std::max(most, headway) - std::min(least, headway) >
                             o.convoy_spread * (std::max(most, headway) + std::min(least, headway)) / 2;
        if (torn || unsteady) {
            close(begin, i);
            begin = i;
        }
        least = i == begin ? headway : std::min(least, headway);
        most = i == begin ? headway : std::max(most, headway);
    }
    close(begin, sequence.size());
}

/// Links that share a vehicle for long enough, numbered alike.
std::vector<std::size_t> groupsOf(const std::vector<FollowedFor>& links, double frames) {
    std::vector<std::size_t> group(links.size());
    std::iota(group.begin(), group.end(), std::size_t{0});
    for (std::size_t i = 0; i < links.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            const FollowedFor &a = links[i], &b = links[k];
            const bool share =
                a.follower == b.follower || a.follower == b.leader || a.leader == b.follower || a.leader == b.leader;
            if (!share || std::min(a.last, b.last) - std::max(a.first, b.first) < frames) continue;
            const std::size_t from = group[i], to = group[k];
            if (from != to) std::replace(group.begin(), group.end(), from, to);
        }
    }
    return group;
}

void addConvoy(const EventScene& scene, const std::vector<FollowedFor>& links, std::vector<Event>& events) {
    std::vector<TrackId> ids;
    FrameIndex first = links.front().first, last = links.front().last;
    for (const FollowedFor& link : links) {
        ids.push_back(scene.paths[link.follower].id());
        ids.push_back(scene.paths[link.leader].id());
        first = std::min(first, link.first);
        last = std::max(last, link.last);
    }
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    if (ids.size() < static_cast<std::size_t>(scene.options.convoy_vehicles)) return;
    const FollowedFor& shown = links.front();
    const GroundPath& path = scene.paths[shown.follower];
    const std::size_t at = std::min(sampleAt(path, (shown.first + shown.last) / 2), path.samples.size() - 1);
    Event event = eventAt(scene, EventKind::convoy, path, {at, at}, at);
    event.tracks = ids;
    event.first_frame = first;
    event.last_frame = last;
    event.figure = static_cast<double>(ids.size());
    event.unit = FigureUnit::vehicles;
    events.push_back(event);
}

}  // namespace

void findConvoys(const EventScene& scene, std::vector<Event>& events) {
    const Footage& footage = scene.ground.footage();
    const int step = std::max(1, static_cast<int>(std::lround(kSampled_s * scene.scale.frame_rate_hz)));
    std::map<FrameIndex, std::vector<Present>> present;
    for (std::size_t p = 0; p < scene.paths.size(); ++p) {
        const GroundPath& path = scene.paths[p];
        if (!path.measured) continue;
        for (std::size_t i = 0; i < path.samples.size(); ++i) {
            const FrameIndex frame = path.samples[i].frame;
            if ((frame - footage.first_frame) % step == 0 && path.samples[i].moving) present[frame].push_back({p, i});
        }
    }
    std::map<Pair, std::vector<Following>> found;
    for (const auto& [frame, paths] : present) lookUp(scene, frame, paths, found);
    std::vector<FollowedFor> links;
    for (const auto& [pair, sequence] : found) addSteady(scene, pair, sequence, links);
    const std::vector<std::size_t> group = groupsOf(links, scene.options.convoy_time_s * scene.scale.frame_rate_hz);
    std::map<std::size_t, std::vector<FollowedFor>> groups;
    for (std::size_t i = 0; i < links.size(); ++i) groups[group[i]].push_back(links[i]);
    for (const auto& [number, members] : groups) addConvoy(scene, members, events);
}

}  // namespace eyrie

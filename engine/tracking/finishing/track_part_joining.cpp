#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/geometry/angle.h"
#include "core/robust_statistics.h"
#include "tracking/finishing/shared_frames.h"
#include "tracking/finishing/track_paths.h"

namespace eyrie {
namespace {

constexpr double kSharedSeconds = 0.8;     ///< two tracks must be seen together this long
constexpr double kPartOfShorter = 0.5;     ///< … and over this share of the shorter one's life
constexpr double kTravelled = 8;           ///< m over the ground meanwhile: standing things say nothing
constexpr double kSlowestForParts = 2.5;   ///< m/s; in slower traffic cars drive bumper to bumper
constexpr double kPartGap = 0.6;           ///< m between parts
constexpr double kAside = 1.0;             ///< m between the axes of parts
constexpr double kLoose = 0.35;            ///< m by which the distance of parts scatters
constexpr double kMostTurn = 0.35;         ///< radians
constexpr double kPart = 3.6;              ///< m; one of the two is shorter than any car
constexpr double kLongest = 20;            ///< m
constexpr double kWidest = 3.6;            ///< m
constexpr double kPixel = 1;               ///< px of tolerance, whatever the scale
constexpr double kCovered = 0.1;           ///< of the smaller part, where parts lie on each other …
constexpr double kTravelledCovered = 4;    ///< … m over the ground that say enough then …
constexpr double kCoveredOfLonger = 0.25;  ///< … share of the longer one's life, whose box grows throughout …
constexpr double kLooseCovered = 0.5;      ///< … and m by which their distance scatters
constexpr double kWholeAlone = 1.25;       ///< a part that is longer by this factor while alone is the whole then

/// What a whole box adds to one of its parts, in the part's own axes; px.
struct Growth {
    std::vector<double> front, rear, left, right;

    void add(const OrientedBox& part, const OrientedBox& whole) {
        const cv::Point2d centre = part.toBox(whole.centre);
        front.push_back(centre.x + (whole.length - part.length) / 2);
        rear.push_back(-centre.x + (whole.length - part.length) / 2);
        right.push_back(centre.y + (whole.width - part.width) / 2);
        left.push_back(-centre.y + (whole.width - part.width) / 2);
    }
    OrientedBox applied(const OrientedBox& part) const {
        const double f = medianOf(front);
        const double b = medianOf(rear);
        const double l = medianOf(left);
        const double r = medianOf(right);
        OrientedBox whole = part;
        whole.centre = part.toImage({(f - b) / 2, (r - l) / 2});
        whole.length = part.length + f + b;
        whole.width = part.width + l + r;
        return whole;
    }
};

struct Whole {
    Growth of_leader;
    Growth of_other;
};

/// How two tracks make one vehicle: they drive right behind or on each other as if fixed. Nothing if they do not.
std::optional<Whole> wholeOf(const TrackPath& leader, const TrackPath& other, const SceneScale& everywhere,
                             PartsOfVehicle wanted) {
    Whole whole;
    std::vector<double> along, across, gaps, covered, parts, lengths, widths;
    double travelled = 0;
    forSharedFrames(leader, other, [&](const MovingState& state, const MovingState& of_other) {
        const OrientedBox& part = of_other.box;
        if (std::abs(axisTurnBetween(state.box.heading, part.heading)) > kMostTurn) return;
        const cv::Point2d offset = state.box.toBox(part.centre);
        along.push_back(offset.x);
        across.push_back(std::abs(offset.y));
        gaps.push_back(std::abs(offset.x) - (state.box.length + part.length) / 2);
        covered.push_back(containment(state.box, part));
        parts.push_back(std::min(state.box.length, part.length));
        travelled += std::hypot(state.velocity.x, state.velocity.y);
        const OrientedBox both = unionBox(state.box, part);
        lengths.push_back(both.length);
        widths.push_back(both.width);
        whole.of_leader.add(state.box, both);
        whole.of_other.add(part, both);
    });
    const SceneScale scale = everywhere.at(middleOf(other));
    const auto frames = static_cast<double>(along.size());
    const auto [shorter, longer] =
        std::minmax({static_cast<double>(leader.states.size()), static_cast<double>(other.states.size())});
    const bool overlap = wanted == PartsOfVehicle::overlapping;
    if (frames < std::max(5.0, kSharedSeconds * scale.frame_rate_hz)) return {};
    if (frames < (overlap ? kCoveredOfLonger * longer : kPartOfShorter * shorter)) return {};
    if (overlap && medianOf(covered) < kCovered) return {};
    if (travelled < scale.px(overlap ? kTravelledCovered : kTravelled)) return {};
    if (travelled / frames < scale.pxPerFrame(kSlowestForParts)) return {};
    if (medianOf(gaps) > scale.px(kPartGap) + kPixel) return {};
    if (!overlap && medianOf(across) > scale.px(kAside) + kPixel) return {};
    if (spreadOf(along) > scale.px(overlap ? kLooseCovered : kLoose) + kPixel / 2) return {};
    const double metre = scale.px(overlap && !scale.gsd_known ? 1 / kEstimatedShare : 1);
    if (medianOf(parts) > kPart * metre) return {};
    if (medianOf(lengths) > kLongest * metre || medianOf(widths) > kWidest * metre + 2 * kPixel) return {};
    return whole;
}

/// Whether a track is a part of the vehicle also where the other part is not seen: it is no longer there than beside
/// it.
bool partThroughout(const TrackPath& path, const TrackPath& other) {
    std::vector<double> beside, alone;
    for (const auto& [frame, state] : path.states)
        (other.at(frame) != nullptr ? beside : alone).push_back(state.box.length);
    return beside.empty() || alone.empty() || medianOf(alone) < kWholeAlone * medianOf(beside);
}

void join(TrackPath& leader, const TrackPath& other, const Whole& whole) {
    const bool leader_throughout = partThroughout(leader, other);
    const bool other_throughout = partThroughout(other, leader);
    std::vector<TimedPathState> joined;
    joined.reserve(leader.states.size() + other.states.size());
    auto b = other.states.begin();
    const auto takeOther = [&] {
        joined.push_back(*b++);
        if (other_throughout) joined.back().second.box = whole.of_other.applied(joined.back().second.box);
    };
    for (TimedPathState& state : leader.states) {
        while (b != other.states.end() && b->first < state.first) takeOther();
        const bool beside = b != other.states.end() && b->first == state.first;
        if (beside) ++b;
        if (beside || leader_throughout) state.second.box = whole.of_leader.applied(state.second.box);
        joined.push_back(state);
    }
    while (b != other.states.end()) takeOther();
    leader.states = std::move(joined);
}

}  // namespace

void joinParts(std::vector<TrackPath>& paths, const SceneScale& scale, PartsOfVehicle wanted) {
    std::vector<std::size_t> order(paths.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return paths[a].states.size() > paths[b].states.size(); });
    LivingTracks living;  // by their place in the order
    for (std::size_t i = 0; i < order.size(); ++i) {
        const TrackPath& path = paths[order[i]];
        if (!path.states.empty()) living.add(i, path.firstFrame(), path.lastFrame());
    }
    for (std::size_t i = 0; i < order.size(); ++i) {
        TrackPath& leader = paths[order[i]];
        if (leader.states.empty()) continue;
        for (bool grown = true; grown;) {
            grown = false;
            std::vector<std::size_t> beside = living.during(leader.firstFrame(), leader.lastFrame());
            for (auto next = std::upper_bound(beside.begin(), beside.end(), i); next != beside.end();) {
                const std::size_t k = *next++;
                TrackPath& other = paths[order[k]];
                if (other.states.empty()) continue;
                const auto whole = wholeOf(leader, other, scale, wanted);
                if (!whole) continue;
                join(leader, other, *whole);
                other.states.clear();
                grown = true;
                // It lives longer now, beside others, too.
                beside = living.during(leader.firstFrame(), leader.lastFrame());
                next = std::upper_bound(beside.begin(), beside.end(), k);
            }
        }
    }
    std::erase_if(paths, [](const TrackPath& path) { return path.states.empty(); });
}

}  // namespace eyrie

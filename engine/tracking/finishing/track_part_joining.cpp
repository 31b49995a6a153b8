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
constexpr double kAsideApart = 2.8;        ///< … where their boxes may reach out over it
constexpr double kSureAlone = 0.8;         ///< score from which on a track is a vehicle, and no part of one
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

/// What a whole box adds to one of its parts, in the part's own axes; m, since it grows as the vehicle comes nearer.
struct Growth {
    std::vector<double> front, rear, left, right;

    /// `pixel`: m, at the part.
    void add(const OrientedBox& part, const OrientedBox& whole, double pixel) {
        const cv::Point2d centre = part.toBox(whole.centre);
        front.push_back((centre.x + (whole.length - part.length) / 2) * pixel);
        rear.push_back((-centre.x + (whole.length - part.length) / 2) * pixel);
        right.push_back((centre.y + (whole.width - part.width) / 2) * pixel);
        left.push_back((-centre.y + (whole.width - part.width) / 2) * pixel);
    }
    /// `metre`: px, at the part.
    OrientedBox applied(const OrientedBox& part, double metre) const {
        const double f = medianOf(front) * metre;
        const double b = medianOf(rear) * metre;
        const double l = medianOf(left) * metre;
        const double r = medianOf(right) * metre;
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
    std::vector<double> along, across, gaps, covered, parts, lengths, widths, pixels;  // m, but for the shares covered
    double travelled = 0;
    forSharedFrames(leader, other, [&](const MovingState& state, const MovingState& of_other) {
        const OrientedBox& part = of_other.box;
        if (std::abs(axisTurnBetween(state.box.heading, part.heading)) > kMostTurn) return;
        const double pixel = 1 / everywhere.at(part.centre).px(1);
        pixels.push_back(pixel);
        const cv::Point2d offset = state.box.toBox(part.centre);
        along.push_back(offset.x * pixel);
        across.push_back(std::abs(offset.y) * pixel);
        gaps.push_back((std::abs(offset.x) - (state.box.length + part.length) / 2) * pixel);
        covered.push_back(containment(state.box, part));
        parts.push_back(std::min(state.box.length, part.length) * pixel);
        travelled += std::hypot(state.velocity.x, state.velocity.y) * pixel;
        const OrientedBox both = unionBox(state.box, part);
        lengths.push_back(both.length * pixel);
        widths.push_back(both.width * pixel);
        whole.of_leader.add(state.box, both, pixel);
        whole.of_other.add(part, both, pixel);
    });
    const auto frames = static_cast<double>(along.size());
    const auto [shorter, longer] =
        std::minmax({static_cast<double>(leader.states.size()), static_cast<double>(other.states.size())});
    const bool overlap = wanted == PartsOfVehicle::overlapping;
    if (frames < std::max(5.0, kSharedSeconds * everywhere.frame_rate_hz)) return {};
    if (frames < (overlap ? kCoveredOfLonger * longer : kPartOfShorter * shorter)) return {};
    if (overlap && medianOf(covered) < kCovered) return {};
    if (travelled < (overlap ? kTravelledCovered : kTravelled)) return {};
    if (travelled / frames < kSlowestForParts / everywhere.frame_rate_hz) return {};
    const double tolerance = kPixel * medianOf(pixels);
    const bool apart = wanted == PartsOfVehicle::apart;
    if (!apart && medianOf(gaps) > kPartGap + tolerance) return {};
    if (wanted == PartsOfVehicle::in_line && medianOf(across) > kAside + tolerance) return {};
    if (apart && medianOf(across) > kAsideApart + tolerance) return {};
    if (spreadOf(along) > (wanted == PartsOfVehicle::in_line ? kLoose : kLooseCovered) + tolerance / 2) return {};
    const double metre = overlap && !everywhere.gsd_known ? 1 / kEstimatedShare : 1;
    if (!apart && medianOf(parts) > kPart * metre) return {};
    if (medianOf(lengths) > kLongest * metre) return {};
    if (!apart && medianOf(widths) > kWidest * metre + 2 * tolerance) return {};
    return whole;
}

/// Whether a track is a part of the vehicle also where the other part is not seen: it is no longer there than beside
/// it.
bool partThroughout(const TrackPath& path, const TrackPath& other, const SceneScale& everywhere) {
    std::vector<double> beside, alone;  // m
    for (const auto& [frame, state] : path.states) {
        const OrientedBox box = state.box;
        (other.at(frame) != nullptr ? beside : alone).push_back(box.length / everywhere.at(box.centre).px(1));
    }
    return beside.empty() || alone.empty() || medianOf(alone) < kWholeAlone * medianOf(beside);
}

void join(TrackPath& leader, const TrackPath& other, const Whole& whole, const SceneScale& scale) {
    const bool leader_throughout = partThroughout(leader, other, scale);
    const bool other_throughout = partThroughout(other, leader, scale);
    std::vector<TimedPathState> joined;
    joined.reserve(leader.states.size() + other.states.size());
    const auto grow = [&](PathState& state, const Growth& by) {
        const OrientedBox part = state.box;
        state.box = by.applied(part, scale.at(part.centre).px(1));
    };
    auto b = other.states.begin();
    const auto takeOther = [&] {
        joined.push_back(*b++);
        if (other_throughout) grow(joined.back().second, whole.of_other);
    };
    for (TimedPathState& state : leader.states) {
        while (b != other.states.end() && b->first < state.first) takeOther();
        const bool beside = b != other.states.end() && b->first == state.first;
        if (beside) ++b;
        if (beside || leader_throughout) grow(state.second, whole.of_leader);
        joined.push_back(state);
    }
    while (b != other.states.end()) takeOther();
    leader.states = std::move(joined);
}

}  // namespace

bool mayBePartOf(const TrackPath& vehicle, const TrackPath& part, const SceneScale& scale) {
    return part.id != vehicle.id && part.states.front().second.score < kSureAlone &&
           wholeOf(vehicle, part, scale, PartsOfVehicle::apart).has_value();
}

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
                join(leader, other, *whole, scale);
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

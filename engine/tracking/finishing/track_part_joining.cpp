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
constexpr double kAsideApart = 2.8;        ///< … of parts that lie anywhere, whose boxes may reach out over it
constexpr double kLoose = 0.35;            ///< m by which the distance of parts scatters
constexpr double kMostTurn = 0.35;         ///< radians
constexpr double kPart = 3.6;              ///< m; one of the two is shorter than any car
constexpr double kWidest = 3.6;            ///< m
constexpr double kPixel = 1;               ///< px of tolerance, whatever the scale
constexpr double kCovered = 0.1;           ///< of the smaller part, where parts lie on each other …
constexpr double kTravelledCovered = 4;    ///< … m over the ground that say enough then …
constexpr double kCoveredOfLonger = 0.25;  ///< … share of the longer one's life, whose box grows throughout …
constexpr double kLooseCovered = 0.5;      ///< … and m by which their distance scatters, and that of parts anywhere
constexpr double kFastForBus = 6;          ///< m/s at which front and rear of a bus are told from two cars …
constexpr double kNobodyFollows = 0.18;    ///< … by the time from the one's rear to the other's front, s
constexpr double kBusCovered = 1;          ///< m by which their boxes may reach over each other
constexpr double kBusLife = 0.75;          ///< of the longer one's life, in which both are followed
constexpr double kShortestBus = 8.5;       ///< m
constexpr double kLongestBus = 14;         ///< m
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

/// How two tracks drive in the frames they share, but those in which they are turned to each other; m, but for the
/// shares covered.
struct Together {
    std::vector<double> along, across;  ///< of the other's centre in the axes of the leader
    std::vector<double> gaps, covered, parts, lengths, widths, pixels;
    double travelled = 0;
    Whole whole;

    double frames() const { return static_cast<double>(along.size()); }
    double aside() const {
        std::vector<double> off;
        for (const double value : across) off.push_back(std::abs(value));
        return medianOf(std::move(off));
    }
    /// m/s.
    double speed(const SceneScale& scale) const { return travelled / frames() * scale.frame_rate_hz; }
    double tolerance() const { return kPixel * medianOf(pixels); }
    /// Whether they are seen together for long, and on their way: standing things and bumper to bumper traffic say
    /// nothing.
    bool saysSomething(double travelled_m, const SceneScale& scale) const {
        return frames() >= std::max(5.0, kSharedSeconds * scale.frame_rate_hz) && travelled >= travelled_m &&
               travelled / frames() >= kSlowestForParts / scale.frame_rate_hz;
    }
};

Together togetherOf(const TrackPath& leader, const TrackPath& other, const SceneScale& everywhere) {
    Together together;
    forSharedFrames(leader, other, [&](FrameIndex frame, const MovingState& state, const MovingState& of_other) {
        const OrientedBox& part = of_other.box;
        if (std::abs(axisTurnBetween(state.box.heading, part.heading)) > kMostTurn) return;
        const double pixel = 1 / everywhere.at(frame, part.centre).px(1);
        together.pixels.push_back(pixel);
        const cv::Point2d offset = state.box.toBox(part.centre);
        together.along.push_back(offset.x * pixel);
        together.across.push_back(offset.y * pixel);
        together.gaps.push_back((std::abs(offset.x) - (state.box.length + part.length) / 2) * pixel);
        together.covered.push_back(containment(state.box, part));
        together.parts.push_back(std::min(state.box.length, part.length) * pixel);
        together.travelled += std::hypot(state.velocity.x, state.velocity.y) * pixel;
        const OrientedBox both = unionBox(state.box, part);
        together.lengths.push_back(both.length * pixel);
        together.widths.push_back(both.width * pixel);
        together.whole.of_leader.add(state.box, both, pixel);
        together.whole.of_other.add(part, both, pixel);
    });
    return together;
}

/// Whether two tracks are front and rear of a bus: they drive so fast that no driver would follow another so closely.
/// Each may be as long as a car.
bool isBus(const Together& together, const SceneScale& everywhere) {
    const double speed = together.speed(everywhere);
    const double gap = medianOf(together.gaps);
    const double length = medianOf(together.lengths);
    return speed >= kFastForBus && gap >= -kBusCovered && gap <= kNobodyFollows * speed && length >= kShortestBus &&
           length <= kLongestBus;
}

/// How two tracks make one vehicle: they drive right behind or on each other as if fixed. Nothing if they do not.
std::optional<Whole> wholeOf(const TrackPath& leader, const TrackPath& other, const SceneScale& everywhere,
                             PartsOfVehicle wanted) {
    const Together together = togetherOf(leader, other, everywhere);
    const auto [shorter, longer] =
        std::minmax({static_cast<double>(leader.states.size()), static_cast<double>(other.states.size())});
    const bool overlap = wanted == PartsOfVehicle::overlapping;
    if (!together.saysSomething(overlap ? kTravelledCovered : kTravelled, everywhere)) return {};
    if (together.frames() < (overlap ? kCoveredOfLonger * longer : kPartOfShorter * shorter)) return {};
    if (overlap && medianOf(together.covered) < kCovered) return {};
    const double tolerance = together.tolerance();
    const bool bus = !overlap && together.frames() >= kBusLife * longer && isBus(together, everywhere);
    if (!bus && medianOf(together.gaps) > kPartGap + tolerance) return {};
    if (!overlap && together.aside() > kAside + tolerance) return {};
    if (spreadOf(together.along) > (overlap ? kLooseCovered : kLoose) + tolerance / 2) return {};
    const double metre = overlap && !everywhere.gsd_known ? 1 / kEstimatedShare : 1;
    if (!bus && medianOf(together.parts) > kPart * metre) return {};
    if (medianOf(together.lengths) > kLongestOfParts * metre) return {};
    if (medianOf(together.widths) > kWidest * metre + 2 * tolerance) return {};
    return together.whole;
}

/// Where a part of the vehicle of a track lies that may be anywhere on it, m from the middle of its box.
std::optional<cv::Point2d> placeOfPart(const TrackPath& vehicle, const TrackPath& part, const SceneScale& everywhere) {
    if (part.id == vehicle.id || part.states.front().second.score >= kSurelyVehicle) return {};
    const Together together = togetherOf(vehicle, part, everywhere);
    const auto shorter = static_cast<double>(std::min(vehicle.states.size(), part.states.size()));
    if (!together.saysSomething(kTravelled, everywhere) || together.frames() < kPartOfShorter * shorter) return {};
    const double tolerance = together.tolerance();
    if (together.aside() > kAsideApart + tolerance) return {};
    if (spreadOf(together.along) > kLooseCovered + tolerance / 2) return {};
    if (medianOf(together.lengths) > kLongestOfParts) return {};
    return cv::Point2d(medianOf(together.along), medianOf(together.across));
}

/// Whether a track is a part of the vehicle also where the other part is not seen: it is no longer there than beside
/// it.
bool partThroughout(const TrackPath& path, const TrackPath& other, const SceneScale& everywhere) {
    std::vector<double> beside, alone;  // m
    for (const auto& [frame, state] : path.states) {
        const OrientedBox box = state.box;
        (other.at(frame) != nullptr ? beside : alone).push_back(box.length / everywhere.at(frame, box.centre).px(1));
    }
    return beside.empty() || alone.empty() || medianOf(alone) < kWholeAlone * medianOf(beside);
}

void join(TrackPath& leader, const TrackPath& other, const Whole& whole, const SceneScale& scale) {
    const bool leader_throughout = partThroughout(leader, other, scale);
    const bool other_throughout = partThroughout(other, leader, scale);
    std::vector<TimedPathState> joined;
    joined.reserve(leader.states.size() + other.states.size());
    const auto grow = [&](TimedPathState& timed, const Growth& by) {
        auto& [frame, state] = timed;
        const OrientedBox part = state.box;
        state.box = by.applied(part, scale.at(frame, part.centre).px(1));
    };
    auto b = other.states.begin();
    const auto takeOther = [&] {
        joined.push_back(*b++);
        if (other_throughout) grow(joined.back(), whole.of_other);
    };
    for (TimedPathState& state : leader.states) {
        while (b != other.states.end() && b->first < state.first) takeOther();
        const bool beside = b != other.states.end() && b->first == state.first;
        if (beside) ++b;
        if (beside || leader_throughout) grow(state, whole.of_leader);
        joined.push_back(state);
    }
    while (b != other.states.end()) takeOther();
    leader.states = std::move(joined);
}

}  // namespace

PartsByTrack partsBeside(const std::vector<TrackPath>& paths, const SceneScale& scale) {
    const LivingTracks living(paths);
    PartsByTrack parts;
    for (const TrackPath& path : paths) {
        for (const std::size_t i : living.during(path.firstFrame(), path.lastFrame())) {
            if (const auto place = placeOfPart(path, paths[i], scale)) parts[path.id][paths[i].id] = *place;
        }
    }
    return parts;
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

#include "tracking/pictures/long_vehicles.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/robust_statistics.h"

namespace eyrie {
namespace {

constexpr std::size_t kFewestSeen = 5;
constexpr double kShareOfLooks = 0.5;    ///< in which it stands out
constexpr double kAgreeing = 1;          ///< m between ends on which looks agree …
constexpr double kShareAgreeing = 0.5;   ///< … as this share of them must
constexpr double kCab = 2.8;             ///< m: boxes of smaller things hold no part of a lorry
constexpr double kHoldsBox = 0.7;        ///< share of the box that belongs to the vehicle at least
constexpr double kHoldsBoxOfPart = 0.3;  ///< … where other parts of it are followed, too
constexpr double kLonger = 1.4;          ///< than the box: less is not worth a change …
constexpr double kLongerWithParts = 1;   ///< … but to take in other parts
constexpr double kLongerThanCars = 5.5;  ///< m
constexpr double kLongest = 18;          ///< m, where no other parts are followed
constexpr double kWidest = 4.2;          ///< m, of the silhouette, with the side that an oblique view shows …
constexpr double kBusSlender = 3;        ///< … or, of what is as high as a bus, wider if it is so many times as long
constexpr double kLorryWidth = 2.6;      ///< m, as wide as lorries may be
constexpr double kSlender = 2;           ///< times as long as wide
constexpr double kCutLooks = 0.25;       ///< share of looks in which it goes on beyond what was looked at
constexpr double kSurelyNoShadow = 0.3;  ///< share of what lies beyond the box that is no shadow
constexpr double kSharedLife = 0.5;      ///< of a part, in which it lies in the whole vehicle …
constexpr double kInside = 0.8;          ///< … in this share of the frames …
constexpr double kBeyond = 1.5;          ///< m: boxes of its ends reach out over it

/// What the looks at a track say of its vehicle, m from the middle of its box.
struct LooksAtLength {
    std::size_t all = 0;
    std::size_t cut = 0;
    std::vector<double> rear, front, left, right, width, box_length, box_width, no_shadow;
};

/// Where a vehicle lies about its box, in lengths and widths of that.
struct AboutBox {
    double ahead = 0;  ///< its middle
    double aside = 0;
    double length = 1;
    double width = 1;
};

std::map<TrackId, LooksAtLength> looksByTrack(const std::vector<SilhouetteLook>& looks,
                                              const std::vector<CastShadow>& shadows, const GroundTurns& turns,
                                              const SceneScale& scale) {
    std::map<TrackId, LooksAtLength> by_track;
    for (const SilhouetteLook& look : looks) {
        LooksAtLength& of_track = by_track[look.track];
        ++of_track.all;
        if (!look.extent) continue;
        const bool shadow_known = shadowIn(shadows, turns.at(look.frame).stretch) != nullptr;
        if (shadow_known && !look.extent->lit) continue;
        const BoxEdges& edges = shadow_known ? *look.extent->lit : look.extent->whole;
        const SceneScale here = scale.at(look.frame, look.box.centre);
        of_track.cut += look.extent->cut ? 1 : 0;
        of_track.rear.push_back(here.metres(edges.rear));
        of_track.front.push_back(here.metres(edges.front));
        of_track.left.push_back(here.metres(edges.left));
        of_track.right.push_back(here.metres(edges.right));
        of_track.width.push_back(here.metres(edges.width()));
        of_track.box_length.push_back(here.metres(look.box.length));
        of_track.box_width.push_back(here.metres(look.box.width));
        of_track.no_shadow.push_back(shadow_known ? 1 : look.extent->lit_beyond);
    }
    return by_track;
}

/// Whether most looks have both ends where they usually are: a vehicle is as long in all of them, what passes it is
/// not.
bool agree(const LooksAtLength& looks, double rear, double front) {
    std::size_t agreeing = 0;
    for (std::size_t i = 0; i < looks.rear.size(); ++i) {
        const double off = std::max(std::abs(looks.rear[i] - rear), std::abs(looks.front[i] - front));
        agreeing += off < kAgreeing ? 1 : 0;
    }
    return static_cast<double>(agreeing) >= kShareAgreeing * static_cast<double>(looks.rear.size());
}

/// Whether one of the parts beside a track lies in what looks usually show as the vehicle.
bool holdsOneOf(const std::map<TrackId, cv::Point2d>& parts, const LooksAtLength& looks) {
    const double rear = medianOf(looks.rear);
    const double front = medianOf(looks.front);
    const double left = medianOf(looks.left);
    const double right = medianOf(looks.right);
    return std::any_of(parts.begin(), parts.end(), [&](const auto& part) {
        const cv::Point2d place = part.second;
        return place.x > rear && place.x < front && place.y > left && place.y < right;
    });
}

/// What a long vehicle must be like, less where other tracks tell that there is one.
struct LongVehicleLimits {
    double holds_box = kHoldsBox;
    double longer = kLonger;
    double longest = kLongest;
};

std::optional<AboutBox> longVehicleIn(const LooksAtLength& looks, const LongVehicleLimits& limits) {
    const std::size_t seen = looks.rear.size();
    if (seen < kFewestSeen || static_cast<double>(seen) < kShareOfLooks * static_cast<double>(looks.all)) return {};
    if (static_cast<double>(looks.cut) > kCutLooks * static_cast<double>(seen)) return {};
    if (medianOf(looks.no_shadow) <= kSurelyNoShadow) return {};
    const double box_length = medianOf(looks.box_length);
    if (box_length < kCab) return {};
    const double rear = medianOf(looks.rear);
    const double front = medianOf(looks.front);
    if (!agree(looks, rear, front)) return {};
    const double of_box = std::min(front, box_length / 2) - std::max(rear, -box_length / 2);
    if (of_box <= limits.holds_box * box_length) return {};
    const double length = front - rear;
    const double width = medianOf(looks.width);
    if (length <= limits.longer * box_length || length <= kLongerThanCars || length >= limits.longest) return {};
    if (width >= std::max(kWidest, length / kBusSlender) || length <= kSlender * width) return {};
    const double box_width = medianOf(looks.box_width);
    const double whole_left = std::min(medianOf(looks.left), -box_width / 2);
    const double whole_right = std::max(medianOf(looks.right), box_width / 2);
    const double lorry = std::min(whole_right - whole_left, std::max(box_width, kLorryWidth));
    return AboutBox{(rear + front) / 2 / box_length, (whole_left + whole_right) / 2 / box_width, length / box_length,
                    lorry / box_width};
}

/// `parts`: where other tracks lie that may be of the same vehicle, m from the middle of the box.
std::optional<AboutBox> longVehicleIn(const LooksAtLength& looks, const std::map<TrackId, cv::Point2d>& parts) {
    if (!looks.rear.empty() && holdsOneOf(parts, looks))
        return longVehicleIn(looks, {kHoldsBoxOfPart, kLongerWithParts, kLongestOfParts});
    return longVehicleIn(looks, LongVehicleLimits());
}

OrientedBox placed(const AboutBox& vehicle, const OrientedBox& box) {
    return {box.toImage({vehicle.ahead * box.length, vehicle.aside * box.width}), vehicle.length * box.length,
            vehicle.width * box.width, box.heading};
}

/// Goes from a state of the whole vehicle to those of a fragment in their order from there, and makes them as long.
void reachOver(const TimedPathState& whole, const std::vector<TimedPathState*>& fragment, const GroundMotion& ground) {
    const auto carriedTo = [&](FrameIndex frame) {
        return ground.carried(movingOf(whole.second), whole.first, frame, true);
    };
    const auto seen = std::find_if(fragment.begin(), fragment.end(), [](const TimedPathState* state) {
        return state->second.origin != StateOrigin::predicted;
    });
    if (seen == fragment.end()) return;
    const auto vehicle = carriedTo((*seen)->first);
    const OrientedBox part = (*seen)->second.box;
    if (!vehicle || vehicle->box.length <= part.length) return;
    const cv::Point2d middle = part.toBox(vehicle->box.centre);
    const AboutBox about{middle.x / part.length, middle.y / part.width, vehicle->box.length / part.length,
                         vehicle->box.width / part.width};
    for (auto state = fragment.begin(); state != seen; ++state) {
        // What lies between fragments was guessed from both.
        if (const auto there = carriedTo((*state)->first)) (*state)->second.box = there->box;
    }
    for (auto state = seen; state != fragment.end(); ++state)
        (*state)->second.box = placed(about, (*state)->second.box);
}

/// Whether `part` lies in the box of `whole`, or, where it drives as if fixed to it, beside it.
bool isPartOf(const TrackPath& part, const TrackPath& whole, bool fixed, const SceneScale& scale) {
    int shared = 0;
    int inside = 0;
    for (const auto& [frame, state] : part.states) {
        const TimedPathState* there = whole.at(frame);
        if (there == nullptr) continue;
        const OrientedBox box = there->second.box;
        const cv::Point2d place = box.toBox(state.box.centre);
        const double ends = box.length / 2 + (fixed ? scale.at(frame, box.centre).px(kBeyond) : 0);
        const bool between_ends = std::abs(place.x) <= ends;
        ++shared;
        inside += between_ends && (fixed || std::abs(place.y) <= box.width / 2) ? 1 : 0;
    }
    return shared >= kSharedLife * static_cast<double>(part.states.size()) && inside >= kInside * shared;
}

}  // namespace

PartsByVehicle reachWholeVehicles(std::vector<TrackPath>& paths, const std::vector<SilhouetteLook>& looks,
                                  const std::vector<CastShadow>& shadows, const GroundTurns& turns,
                                  const SceneScale& scale) {
    const std::map<TrackId, LooksAtLength> by_track = looksByTrack(looks, shadows, turns, scale);
    const PartsByTrack parts = partsBeside(paths, scale);
    std::map<TrackId, AboutBox> long_ones;
    PartsByVehicle longer;
    for (const TrackPath& path : paths) {
        const auto of_track = by_track.find(path.id);
        if (of_track == by_track.end()) continue;
        const auto beside = parts.find(path.id);
        const auto vehicle =
            longVehicleIn(of_track->second, beside == parts.end() ? PartsByTrack::mapped_type() : beside->second);
        if (!vehicle) continue;
        long_ones[path.id] = *vehicle;
        std::set<TrackId>& of_vehicle = longer[path.id];
        if (beside == parts.end()) continue;
        for (const auto& [part, place] : beside->second) of_vehicle.insert(part);
    }
    for (TrackPath& path : paths) {
        const auto vehicle = long_ones.find(path.id);
        if (vehicle == long_ones.end()) continue;
        for (auto& [frame, state] : path.states) state.box = placed(vehicle->second, state.box);
    }
    return longer;
}

void reachAlong(TrackPath& path, const std::vector<FrameSpan>& whole, const GroundMotion& ground) {
    std::vector<TimedPathState*> fragment;
    const TimedPathState* last_whole = nullptr;
    auto span = whole.begin();
    for (TimedPathState& state : path.states) {
        while (span != whole.end() && state.first > span->second) ++span;
        if (span == whole.end() || state.first < span->first) {
            fragment.push_back(&state);
            continue;
        }
        if (last_whole != nullptr) {
            reachOver(*last_whole, fragment, ground);
        } else {
            std::reverse(fragment.begin(), fragment.end());
            reachOver(state, fragment, ground);
        }
        fragment.clear();
        last_whole = &state;
    }
    if (last_whole != nullptr) reachOver(*last_whole, fragment, ground);
}

void dropPartsOf(const PartsByVehicle& whole, std::vector<TrackPath>& paths, const SceneScale& scale,
                 DropList& dropped) {
    const auto rank = [](const TrackPath& path) { return std::pair(path.states.front().second.score, -path.id); };
    for (const TrackPath& vehicle : paths) {
        const auto parts = whole.find(vehicle.id);
        if (parts == whole.end()) continue;
        for (TrackPath& path : paths) {
            if (path.id == vehicle.id || path.states.empty() || vehicle.states.empty()) continue;
            // Of two that were made as long the surer one stays.
            if (whole.contains(path.id) && rank(path) > rank(vehicle)) continue;
            if (!isPartOf(path, vehicle, parts->second.contains(path.id), scale)) continue;
            drop(path, TrackDrop::shares_place, dropped, vehicle.id);
        }
    }
    std::erase_if(paths, [](const TrackPath& path) { return path.states.empty(); });
}

}  // namespace eyrie

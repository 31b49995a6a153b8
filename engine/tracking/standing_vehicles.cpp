#include "tracking/standing_vehicles.h"

#include <algorithm>
#include <cmath>

namespace eyrie {
namespace {

constexpr double kLeastReach = 2;  ///< px around the prediction in which a vehicle is looked for by its look

double between(cv::Point2d a, cv::Point2d b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

bool isNear(const OrientedBox& a, const OrientedBox& b) {
    return between(a.centre, b.centre) < (std::hypot(a.length, a.width) + std::hypot(b.length, b.width)) / 2;
}

}  // namespace

std::optional<OrientedBox> StandingVehicles::found(const Track& track, PictureWhenNeeded& picture,
                                                   const OrientedBox& expected, double reach) const {
    if (!track.look) return std::nullopt;
    const auto match = track.look->find(picture.gray(), expected, reach);
    if (!match || match->agreement < options_.appearance_agreement ||
        match->agreement < match->beside + options_.appearance_margin)
        return std::nullopt;
    OrientedBox box = expected;
    box.centre = match->centre;
    return box;
}

void StandingVehicles::lookAtPlaces(std::vector<Track>& tracks, const std::vector<MovingBox>& detected, int frames,
                                    PictureWhenNeeded& picture) const {
    for (Track& track : tracks) {
        Standstill& stands = track.standstill;
        if (!stands.certain) continue;
        const OrientedBox place = stands.place;
        const bool due = (frames + static_cast<int>(track.id)) % manager_.lookInterval() == 0 || !stands.agrees;
        const bool touched = std::any_of(detected.begin(), detected.end(),
                                         [&](const MovingBox& other) { return isNear(other.box, place); });
        if (!due && !touched) continue;
        const auto seen = found(track, picture, place, std::max(kLeastReach, TrackManager::reachOf(place) + 1));
        manager_.countStandstill(track, seen ? std::optional(between(seen->centre, place.centre)) : std::nullopt,
                                 seen.value_or(place));
    }
}

void StandingVehicles::lookAround(Track& track, PictureWhenNeeded& picture, double reach) const {
    track.recognised = false;
    if (options_.appearance == AppearanceUse::none) return;
    if (track.origin == StateOrigin::detected || track.origin == StateOrigin::reconstructed) {
        const bool detected = track.origin == StateOrigin::detected;
        // What stands keeps the look that it has been known by.
        if (detected && !track.standstill.certain &&
            manager_.worthRemembering(track, model_.slowSpeed(), classified_)) {
            if (auto look = VehicleTemplate::of(picture.gray(), track.filter.box())) track.look = std::move(look);
        }
        manager_.countDeparture(track);
        return;
    }
    if (track.standstill.certain) {
        keep(track);
        return;
    }
    if (!manager_.mayBeRecognised(track, model_.slowSpeed(), classified_)) return;
    const auto seen = found(track, picture, track.filter.box(), std::max(kLeastReach, reach));
    const double away = seen ? between(seen->centre, track.standstill.place.centre) : 0;
    manager_.countStandstill(track, seen ? std::optional(away) : std::nullopt, seen.value_or(track.filter.box()));
    track.recognised = seen && track.filter.update(model_.placed(*seen));
    if (track.standstill.certain) keep(track);
}

void StandingVehicles::keep(Track& track) const {
    Standstill& stands = track.standstill;
    ++stands.frames;
    track.filter.update(model_.placed(stands.place));
    track.recognised = stands.agrees;
    if (stands.agrees) {
        track.origin = StateOrigin::standing;
    } else {
        ++stands.hidden;
    }
}

}  // namespace eyrie

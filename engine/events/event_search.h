#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/review/zone.h"
#include "events/event.h"
#include "events/event_options.h"
#include "events/ground/ground_stretches.h"

namespace eyrie {

/// How fast a track is over the ground, smoothed as for events: m/s by the scale of the footage, be it known or
/// assumed; where it stands, 0.
struct SpeedRange {
    double lowest = 0;
    double highest = 0;
};

/// What a search tells.
struct TrackFindings {
    std::vector<Event> events;
    std::map<TrackId, SpeedRange> speeds;  ///< of tracks that were followed long enough to tell
    /// By event: how fast its tracks were from its first frame to its last, all of them together; nothing where none
    /// was followed long enough to tell.
    std::vector<std::optional<SpeedRange>> event_speeds;
};

/// All events of the tracks, by first frame, then kind. Directions, speeds and places are those on the ground; without
/// a known GSD figures are in px and px/frame. Zones must be without fault; arrows among them say which way is right.
/// The result depends on nothing but the arguments.
std::vector<Event> findEvents(const std::vector<EventTrack>& tracks, const Footage& footage,
                              const EventOptions& options = {}, const std::vector<Zone>& zones = {});
/// The same, with how fast the tracks were.
TrackFindings searchTracks(const std::vector<EventTrack>& tracks, const Footage& footage,
                           const EventOptions& options = {}, const std::vector<Zone>& zones = {});

}  // namespace eyrie

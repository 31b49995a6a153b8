#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/review/seen_frames.h"
#include "events/event.h"
#include "events/event_search.h"
#include "events/stored_events.h"

namespace eyrie::ui {

/// Directions are told in eighths of a circle, from right (0) over down (2), clockwise, as the ground lies in the first
/// frame of the track's ground.
inline constexpr int kEighths = 8;
/// The eighth of a heading (radians, clockwise from +x); nothing for none.
int eighthOf(double heading);

/// What is known of a track besides its summary, from its path and its events.
struct TrackDoings {
    std::optional<int> eighth;  ///< nothing: it went nowhere
    std::set<EventKind> events;
    std::set<std::string> zones;       ///< that it entered, left, crossed or drove against
    std::vector<FrameSpan> standing;   ///< when it stood, merged
    std::optional<SpeedRange> speeds;  ///< nothing: it was followed too shortly to tell
};
/// By track; tracks that are missing did nothing.
using DoingsByTrack = std::map<TrackId, TrackDoings>;
/// What a track did; nothing where that is not known (null) or it did nothing. Valid as long as the doings.
const TrackDoings& doingsIn(const DoingsByTrack* doings, TrackId track);
/// In how many frames it stood.
int framesStood(const TrackDoings& did);
/// Whether it stood in a frame.
bool standsIn(const TrackDoings& did, FrameIndex frame);

/// What the tracks of a run did: where they went over the ground and how fast, which events they had, which zones they
/// met.
DoingsByTrack doingsOf(const StoredTracks& run, const std::vector<Event>& events,
                       const std::map<TrackId, SpeedRange>& speeds = {});

}  // namespace eyrie::ui

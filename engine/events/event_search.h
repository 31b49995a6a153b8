#pragma once

#include <vector>

#include "core/review/zone.h"
#include "events/event.h"
#include "events/event_options.h"
#include "events/ground/ground_stretches.h"

namespace eyrie {

/// All events of the tracks, by first frame, then kind. Directions, speeds and places are those on the ground; without
/// a known GSD figures are in px and px/frame. Zones must be without fault;
/// arrows among them say which way is right. The result depends on nothing but the
/// arguments.
std::vector<Event> findEvents(const std::vector<EventTrack>& tracks, const Footage& footage,
                              const EventOptions& options = {}, const std::vector<Zone>& zones = {});

}  // namespace eyrie

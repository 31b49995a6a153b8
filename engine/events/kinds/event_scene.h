#pragma once

#include <vector>

#include "core/review/zone.h"
#include "events/event.h"
#include "events/event_options.h"
#include "events/ground/ground_path.h"
#include "events/ground/ground_stretches.h"

/// What the searches for the kinds of events share; inside of this room only.
namespace eyrie {

/// What kinds of events are searched in: paths on the ground, in metres. All must outlive the search.
struct EventScene {
    const GroundStretches& ground;
    const std::vector<GroundPath>& paths;
    const EventOptions& options;
    const SceneScale& scale;
};

/// An event of one path over some of its samples, to be looked at in one of them.
Event eventAt(const EventScene& scene, EventKind kind, const GroundPath& path, const SampleSpan& span,
              std::size_t sample);
/// Gives it a figure, in the units that may be shown.
void setSpeed(Event& event, const EventScene& scene, double metres_per_second);
void setLength(Event& event, const EventScene& scene, double metres);

/// The fastest of the samples within `seconds` of one, m/s; after it, or before it.
double fastestAfter(const EventScene& scene, const GroundPath& path, std::size_t sample, double seconds);
double fastestBefore(const EventScene& scene, const GroundPath& path, std::size_t sample, double seconds);

void findBorderEvents(const EventScene& scene, std::vector<Event>& events);   // appears, leaves, lost
void findStandstills(const EventScene& scene, std::vector<Event>& events);    // starts, stops, stands
void findTurnBacks(const EventScene& scene, std::vector<Event>& events);      // turns back
void findSpeeds(const EventScene& scene, std::vector<Event>& events);         // over and under speed
void findLoitering(const EventScene& scene, std::vector<Event>& events);      // loiters
void findFlowEvents(const EventScene& scene, const std::vector<Zone>& zones,  // against the flow, leaves the flow
                    std::vector<Event>& events);
void findConvoys(const EventScene& scene, std::vector<Event>& events);        // convoy
void findMeetings(const EventScene& scene, std::vector<Event>& events);       // meeting
void findZoneEvents(const EventScene& scene, const std::vector<Zone>& zones,  // enters, exits, crosses
                    std::vector<Event>& events);

}  // namespace eyrie

#include "events/event_search.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "events/kinds/event_scene.h"

namespace eyrie {

Event eventAt(const EventScene& scene, EventKind kind, const GroundPath& path, const SampleSpan& span,
              std::size_t sample) {
    const GroundStretch& stretch = scene.ground.all()[static_cast<std::size_t>(path.stretch)];
    Event event;
    event.kind = kind;
    event.tracks = {path.id()};
    event.first_frame = path.samples[span.first].frame;
    event.last_frame = path.samples[span.last].frame;
    event.frame = path.samples[sample].frame;
    event.place = path.box(sample).box.centre;
    event.ground_frame = stretch.first_frame;
    event.ground = path.samples[sample].at * (1 / stretch.metres_per_px);
    return event;
}

void setSpeed(Event& event, const EventScene& scene, double metres_per_second) {
    const bool known = scene.scale.gsd_known;
    event.figure = known ? metres_per_second * 3.6 : scene.scale.at(event.place).pxPerFrame(metres_per_second);
    event.unit = known ? FigureUnit::km_per_hour : FigureUnit::px_per_frame;
}

void setLength(Event& event, const EventScene& scene, double metres) {
    event.figure = scene.scale.gsd_known ? metres : scene.scale.at(event.place).px(metres);
    event.unit = scene.scale.gsd_known ? FigureUnit::metres : FigureUnit::px;
}

double fastestAfter(const EventScene& scene, const GroundPath& path, std::size_t sample, double seconds) {
    double fastest = 0;
    for (std::size_t i = sample; i < path.samples.size(); ++i) {
        if (secondsBetween(path, sample, i, scene.scale) > seconds) break;
        fastest = std::max(fastest, path.samples[i].speed);
    }
    return fastest;
}

double fastestBefore(const EventScene& scene, const GroundPath& path, std::size_t sample, double seconds) {
    double fastest = 0;
    for (std::size_t i = sample + 1; i-- > 0;) {
        if (secondsBetween(path, i, sample, scene.scale) > seconds) break;
        fastest = std::max(fastest, path.samples[i].speed);
    }
    return fastest;
}

namespace {

std::map<TrackId, SpeedRange> speedsOf(const std::vector<GroundPath>& paths) {
    std::map<TrackId, SpeedRange> speeds;
    for (const GroundPath& path : paths) {
        if (!path.measured) continue;
        for (const GroundSample& sample : path.samples) {
            const double speed = sample.moving ? sample.speed : 0;
            const auto [place, is_new] = speeds.try_emplace(path.id(), SpeedRange{speed, speed});
            if (is_new) continue;
            place->second.lowest = std::min(place->second.lowest, speed);
            place->second.highest = std::max(place->second.highest, speed);
        }
    }
    return speeds;
}

}  // namespace

std::vector<Event> findEvents(const std::vector<EventTrack>& tracks, const Footage& footage,
                              const EventOptions& options, const std::vector<Zone>& zones) {
    return searchTracks(tracks, footage, options, zones).events;
}

TrackFindings searchTracks(const std::vector<EventTrack>& tracks, const Footage& footage, const EventOptions& options,
                           const std::vector<Zone>& zones) {
    const GroundStretches ground(footage);
    const std::vector<GroundPath> paths = groundPaths(tracks, ground, options);
    const EventScene scene{ground, paths, options, footage.scale};
    std::vector<Event> events;
    findBorderEvents(scene, events);
    findStandstills(scene, events);
    findTurnBacks(scene, events);
    findSpeeds(scene, events);
    findLoitering(scene, events);
    findFlowEvents(scene, zones, events);
    findConvoys(scene, events);
    findMeetings(scene, events);
    findZoneEvents(scene, zones, events);
    std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
        return std::tie(a.first_frame, a.kind, a.tracks, a.zone) < std::tie(b.first_frame, b.kind, b.tracks, b.zone);
    });
    return {std::move(events), speedsOf(paths)};
}

}  // namespace eyrie

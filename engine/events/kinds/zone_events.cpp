#include <algorithm>
#include <optional>

#include "events/kinds/event_scene.h"
#include "events/kinds/placed_zone.h"

namespace eyrie {
namespace {

std::optional<cv::Point2d> placeOf(const EventScene& scene, const PlacedZone& zone, const GroundSample& sample) {
    if (!zone.in_image) return sample.at;
    return scene.ground.toImage(sample.frame, sample.at);
}

/// How far over the edge a vehicle must come, in the zone's own measure.
double marginOf(const EventScene& scene, const PlacedZone& zone, const GroundPath& path, std::size_t sample) {
    if (!zone.in_image) return scene.options.zone_margin_m / path.samples[sample].by_place;
    const TrackedBox& box = path.box(sample);
    return scene.options.zone_margin_m / scene.ground.metresHere(box.frame, box.box.centre);
}

Event passing(const EventScene& scene, EventKind kind, const GroundPath& path, std::size_t sample,
              const PlacedZone& zone) {
    Event event = eventAt(scene, kind, path, {sample, sample}, sample);
    event.zone = zone.zone->name;
    return event;
}

void passArea(const EventScene& scene, const GroundPath& path, const PlacedZone& zone, std::vector<Event>& events) {
    std::optional<bool> inside;  // beyond the margin
    std::size_t edge = 0;        // sample at which the edge itself was passed last
    std::size_t since = 0;       // sample of the entry
    bool last_side = false;
    for (std::size_t i = 0; i < path.samples.size(); ++i) {
        const auto place = placeOf(scene, zone, path.samples[i]);
        if (!place) continue;
        const bool side = isInside(zone.points, *place);
        if (i == 0 || side != last_side) edge = i;
        last_side = side;
        if (inside && side == *inside) continue;
        if (distanceTo(zone.points, true, *place) < marginOf(scene, zone, path, i)) continue;
        if (inside) {
            Event event = passing(scene, side ? EventKind::enters : EventKind::exits, path, edge, zone);
            if (side) {
                since = edge;
                if (path.measured) setSpeed(event, scene, path.samples[edge].speed);
            } else {
                event.figure = secondsBetween(path, since, edge, scene.scale);
                event.unit = FigureUnit::seconds;
            }
            events.push_back(event);
        }
        inside = side;
    }
}

void passLine(const EventScene& scene, const GroundPath& path, const PlacedZone& zone, std::vector<Event>& events) {
    bool armed = false;  // it has been beyond the margin since it passed the line last
    int sum = 0;         // of the crossings since then
    std::size_t crossed = 0;
    std::optional<cv::Point2d> before;
    for (std::size_t i = 0; i < path.samples.size(); ++i) {
        const auto place = placeOf(scene, zone, path.samples[i]);
        if (before && place && armed) {
            const int sense = crossing(zone.points, *before, *place);
            if (sense != 0) crossed = i;
            sum += sense;
        }
        before = place;
        if (!place || distanceTo(zone.points, false, *place) < marginOf(scene, zone, path, i)) continue;
        if (armed && sum != 0) {
            Event event = passing(scene, EventKind::crosses, path, crossed, zone);
            event.sense = sum > 0 ? CrossingSense::to_right : CrossingSense::to_left;
            if (path.measured) setSpeed(event, scene, path.samples[crossed].speed);
            events.push_back(event);
        }
        armed = true;
        sum = 0;
    }
}

}  // namespace

void findZoneEvents(const EventScene& scene, const std::vector<Zone>& zones, std::vector<Event>& events) {
    for (const Zone& zone : zones) {
        if (zone.shape == ZoneShape::arrow) continue;  // nobody enters or crosses it
        int stretch = -1;
        std::optional<PlacedZone> here;
        for (const GroundPath& path : scene.paths) {
            if (path.stretch != stretch) {
                stretch = path.stretch;
                here = placed(scene, zone, stretch);
            }
            if (!here) continue;
            zone.shape == ZoneShape::area ? passArea(scene, path, *here, events) : passLine(scene, path, *here, events);
        }
    }
}

}  // namespace eyrie

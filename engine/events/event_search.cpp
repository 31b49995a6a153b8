#include "events/event_search.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <opencv2/core/utility.hpp>
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
    event.figure =
        known ? metres_per_second * 3.6 : scene.scale.at(event.frame, event.place).pxPerFrame(metres_per_second);
    event.unit = known ? FigureUnit::km_per_hour : FigureUnit::px_per_frame;
}

void setLength(Event& event, const EventScene& scene, double metres) {
    event.figure = scene.scale.gsd_known ? metres : scene.scale.at(event.frame, event.place).px(metres);
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

/// Widens a range by what a path tells from one frame to another.
void addSpeeds(const GroundPath& path, FrameIndex first, FrameIndex last, std::optional<SpeedRange>& range) {
    if (!path.measured) return;
    for (std::size_t i = sampleAt(path, first); i < path.samples.size() && path.samples[i].frame <= last; ++i) {
        const double speed = path.samples[i].moving ? path.samples[i].speed : 0;
        if (!range) range = SpeedRange{speed, speed};
        range->lowest = std::min(range->lowest, speed);
        range->highest = std::max(range->highest, speed);
    }
}

std::map<TrackId, SpeedRange> speedsOf(const std::vector<GroundPath>& paths) {
    std::map<TrackId, std::optional<SpeedRange>> ranges;
    for (const GroundPath& path : paths)
        if (!path.samples.empty())
            addSpeeds(path, path.samples.front().frame, path.samples.back().frame, ranges[path.id()]);
    std::map<TrackId, SpeedRange> speeds;
    for (const auto& [track, range] : ranges)
        if (range) speeds[track] = *range;
    return speeds;
}

std::vector<std::optional<SpeedRange>> speedsIn(const std::vector<Event>& events,
                                                const std::vector<GroundPath>& paths) {
    std::multimap<TrackId, const GroundPath*> paths_of;
    for (const GroundPath& path : paths) paths_of.emplace(path.id(), &path);
    std::vector<std::optional<SpeedRange>> speeds(events.size());
    for (std::size_t i = 0; i < events.size(); ++i)
        for (const TrackId track : events[i].tracks) {
            const auto [from, to] = paths_of.equal_range(track);
            for (auto path = from; path != to; ++path)
                addSpeeds(*path->second, events[i].first_frame, events[i].last_frame, speeds[i]);
        }
    return speeds;
}

/// Each search by itself, side by side, since an hour keeps one processor busy for a second; in a fixed order.
std::vector<Event> eventsIn(const EventScene& scene, const std::vector<Zone>& zones) {
    using Search = std::function<void(std::vector<Event>&)>;
    const std::vector<Search> searches{[&](auto& events) { findFlowEvents(scene, zones, events); },  // the longest
                                       [&](auto& events) { findConvoys(scene, events); },
                                       [&](auto& events) { findBorderEvents(scene, events); },
                                       [&](auto& events) { findStandstills(scene, events); },
                                       [&](auto& events) { findTurnBacks(scene, events); },
                                       [&](auto& events) { findSpeeds(scene, events); },
                                       [&](auto& events) { findLoitering(scene, events); },
                                       [&](auto& events) { findMeetings(scene, events); },
                                       [&](auto& events) { findZoneEvents(scene, zones, events); }};
    std::vector<std::vector<Event>> found(searches.size());
    const int count = static_cast<int>(searches.size());
    cv::parallel_for_(
        {0, count},
        [&](const cv::Range& range) {
            for (int i = range.start; i < range.end; ++i)
                searches[static_cast<std::size_t>(i)](found[static_cast<std::size_t>(i)]);
        },
        count);
    std::vector<Event> events;
    for (std::vector<Event>& each : found)
        events.insert(events.end(), std::make_move_iterator(each.begin()), std::make_move_iterator(each.end()));
    return events;
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
    std::vector<Event> events = eventsIn({ground, paths, options, footage.scale}, zones);
    std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
        return std::tie(a.first_frame, a.kind, a.tracks, a.zone) < std::tie(b.first_frame, b.kind, b.tracks, b.zone);
    });
    std::vector<std::optional<SpeedRange>> event_speeds = speedsIn(events, paths);
    return {std::move(events), speedsOf(paths), std::move(event_speeds)};
}

}  // namespace eyrie

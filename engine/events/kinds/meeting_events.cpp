#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/angle.h"
#include "events/kinds/event_scene.h"

namespace eyrie {
namespace {

/// A vehicle that stands.
struct Standstill {
    const GroundPath* path = nullptr;
    SampleSpan span;
    OrientedBox box;       ///< on the ground, m
    double by_place = 1;   ///< metres by the scale there, of one on the ground
    double direction = 0;  ///< from which it came; or into which it leaves, or how it stands
};

double distanceOutside(const OrientedBox& box, cv::Point2d place) {
    const cv::Point2d in_box = box.toBox(place);
    return std::hypot(std::max(0.0, std::abs(in_box.x) - box.length / 2),
                      std::max(0.0, std::abs(in_box.y) - box.width / 2));
}

/// Between two boxes, m; 0 where they touch.
double gapBetween(const OrientedBox& a, const OrientedBox& b) {
    if (intersectionArea(a, b) > 0) return 0;
    double least = std::numeric_limits<double>::infinity();
    for (const cv::Point2d& corner : a.corners()) least = std::min(least, distanceOutside(b, corner));
    for (const cv::Point2d& corner : b.corners()) least = std::min(least, distanceOutside(a, corner));
    return least;
}

Standstill standstillOf(const EventScene& scene, const GroundPath& path, const SampleSpan& span) {
    const std::size_t middle = (span.first + span.last) / 2;
    Standstill found{&path, span, scene.ground.toGround(path.samples[middle].frame, path.box(middle).box),
                     path.samples[middle].by_place, 0};
    found.box.centre = path.samples[middle].at;
    found.direction = found.box.heading;
    // Where it drove last, or drives next, at a speed whose direction can be trusted.
    const auto take = [&](std::size_t sample) {
        const cv::Point2d v = path.samples[sample].velocity;
        found.direction = std::atan2(v.y, v.x);
        return path.samples[sample].speed > 2 * scene.options.moving_speed_kmh / 3.6;
    };
    const double near_s = 5;
    for (std::size_t i = span.first; i-- > 0 && path.samples[i].moving;) {
        if (take(i) || secondsBetween(path, i, span.first, scene.scale) > near_s) return found;
    }
    if (span.first > 0) return found;
    for (std::size_t i = span.last + 1; i < path.samples.size() && path.samples[i].moving; ++i) {
        if (take(i) || secondsBetween(path, span.last, i, scene.scale) > near_s) break;
    }
    return found;
}

void addMeeting(const EventScene& scene, const Standstill& a, const Standstill& b, std::vector<Event>& events) {
    const EventOptions& o = scene.options;
    const auto firstOf = [](const Standstill& s) { return s.path->samples[s.span.first].frame; };
    const auto lastOf = [](const Standstill& s) { return s.path->samples[s.span.last].frame; };
    const FrameIndex first = std::max(firstOf(a), firstOf(b));
    const FrameIndex last = std::min(lastOf(a), lastOf(b));
    if ((last - first) / scene.scale.frame_rate_hz < o.meeting_time_s) return;
    const cv::Point2d apart = a.box.centre - b.box.centre;
    const double most = o.meeting_distance_m / ((a.by_place + b.by_place) / 2);  // on the ground
    const double reach = (a.box.length + a.box.width + b.box.length + b.box.width) / 2 + most;
    if (apart.dot(apart) > reach * reach) return;
    const double gap = gapBetween(a.box, b.box);
    if (gap > most) return;
    if (std::abs(turnBetween(a.direction, b.direction)) < radiansFromDegrees(o.meeting_angle_deg)) return;
    const std::size_t from = std::min(sampleAt(*a.path, first), a.path->samples.size() - 1);
    const std::size_t to = std::min(sampleAt(*a.path, last), a.path->samples.size() - 1);
    Event event = eventAt(scene, EventKind::meeting, *a.path, {from, to}, (from + to) / 2);
    event.first_frame = first;
    event.last_frame = last;
    event.tracks = {std::min(a.path->id(), b.path->id()), std::max(a.path->id(), b.path->id())};
    event.figure = (last - first) / scene.scale.frame_rate_hz;
    event.unit = FigureUnit::seconds;
    events.push_back(event);
}

}  // namespace

void findMeetings(const EventScene& scene, std::vector<Event>& events) {
    std::vector<Standstill> standing;
    for (const GroundPath& path : scene.paths) {
        for (const SampleSpan& span : spansOf(path, false)) {
            if (secondsBetween(path, span.first, span.last, scene.scale) >= scene.options.meeting_time_s)
                standing.push_back(standstillOf(scene, path, span));
        }
    }
    std::sort(standing.begin(), standing.end(), [](const Standstill& a, const Standstill& b) {
        return a.path->samples[a.span.first].frame < b.path->samples[b.span.first].frame;
    });
    for (std::size_t i = 0; i < standing.size(); ++i) {
        const FrameIndex until = standing[i].path->samples[standing[i].span.last].frame;
        for (std::size_t k = i + 1; k < standing.size(); ++k) {
            if (standing[k].path->samples[standing[k].span.first].frame > until) break;
            if (standing[k].path->stretch != standing[i].path->stretch) continue;
            if (standing[k].path->id() == standing[i].path->id()) continue;
            addMeeting(scene, standing[i], standing[k], events);
        }
    }
}

}  // namespace eyrie

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.h"
#include "events/kinds/event_scene.h"

namespace eyrie {
namespace {

constexpr double kSpeedAround_s = 3;  ///< how long before a stop or after a start the speed is looked for
constexpr double kKeepsDirection = kPi / 3;
constexpr double kLimitRelease = 0.9;  ///< share of a limit below which it is no longer exceeded

double directionOf(const GroundSample& sample) {
    return std::atan2(sample.velocity.y, sample.velocity.x);
}

/// How far the vehicle drives on in about the direction it has in a sample, m; at most `enough`.
double wayInDirection(const GroundPath& path, std::size_t sample, bool onwards, double enough) {
    const double direction = directionOf(path.samples[sample]);
    double way = 0;
    for (std::size_t i = sample; way < enough;) {
        if (onwards ? i + 1 >= path.samples.size() : i == 0) break;
        const std::size_t next = onwards ? i + 1 : i - 1;
        if (path.samples[next].moving) {
            if (std::abs(turnBetween(direction, directionOf(path.samples[next]))) > kKeepsDirection) break;
            way += metresBetween(path.samples[i], path.samples[next]);
        }
        i = next;
    }
    return way;
}

/// One change to the opposite direction.
struct TurnBack {
    std::size_t before = 0;  ///< last sample in the old direction
    std::size_t after = 0;   ///< first one in the new direction
};

/// `cosine` of the smallest angle that counts.
bool isTurnBack(const EventOptions& o, const GroundPath& path, std::size_t before, std::size_t after, double cosine) {
    const GroundSample& from = path.samples[before];
    const GroundSample& to = path.samples[after];
    if (from.velocity.dot(to.velocity) > cosine * from.speed * to.speed) return false;
    const cv::Point2d between = to.at - from.at;
    const double beside =
        std::abs(from.velocity.x * between.y - from.velocity.y * between.x) / from.speed * from.by_place;
    return beside <= o.turn_back_offset_m &&
           wayInDirection(path, before, false, o.turn_back_way_m) >= o.turn_back_way_m &&
           wayInDirection(path, after, true, o.turn_back_way_m) >= o.turn_back_way_m;
}

/// The turn back that ends first, from a sample on; before == after: none.
TurnBack nextTurnBack(const EventScene& scene, const GroundPath& path, const std::vector<std::size_t>& moving,
                      std::size_t from) {
    const double frames = scene.options.turn_back_time_s * scene.scale.frame_rate_hz;
    const double cosine = std::cos(radiansFromDegrees(scene.options.turn_back_angle_deg));
    for (std::size_t k = from; k < moving.size(); ++k) {
        for (std::size_t i = k; i-- > from;) {
            if (path.samples[moving[k]].frame - path.samples[moving[i]].frame > frames) break;
            if (isTurnBack(scene.options, path, moving[i], moving[k], cosine)) return {moving[i], moving[k]};
        }
    }
    return {};
}

/// The sample furthest along the old direction: where the vehicle turned.
std::size_t turningPoint(const GroundPath& path, const TurnBack& turn) {
    std::size_t furthest = turn.before;
    const GroundSample& from = path.samples[turn.before];
    double best = 0;
    for (std::size_t i = turn.before; i <= turn.after; ++i) {
        const double along = (path.samples[i].at - from.at).dot(from.velocity);
        if (along > best) furthest = i, best = along;
    }
    return furthest;
}

/// Spans of moving samples beyond a limit; within them the limit may be missed by a tenth.
std::vector<SampleSpan> beyond(const GroundPath& path, double limit, bool over) {
    std::vector<SampleSpan> spans;
    for (const SampleSpan& moving : spansOf(path, true)) {
        bool open = false;
        for (std::size_t i = moving.first; i <= moving.last; ++i) {
            const double speed = path.samples[i].speed;
            const bool enters = over ? speed > limit : speed < limit;
            const bool stays = over ? speed > limit * kLimitRelease : speed < limit / kLimitRelease;
            if (!open && enters) spans.push_back({i, i});
            open = open ? stays : enters;
            if (open) spans.back().last = i;
        }
    }
    return spans;
}

std::size_t extremeOf(const GroundPath& path, const SampleSpan& span, bool over) {
    std::size_t found = span.first;
    for (std::size_t i = span.first; i <= span.last; ++i) {
        const double ahead = path.samples[i].speed - path.samples[found].speed;
        if (over ? ahead > 0 : ahead < 0) found = i;
    }
    return found;
}

void findBeyond(const EventScene& scene, const GroundPath& path, bool over, std::vector<Event>& events) {
    const EventOptions& o = scene.options;
    for (const SampleSpan& span : beyond(path, (over ? o.over_kmh : o.under_kmh) / 3.6, over)) {
        const double lasts = secondsBetween(path, span.first, span.last, scene.scale);
        if (lasts < (over ? o.over_time_s : o.under_time_s)) continue;
        const std::size_t at = extremeOf(path, span, over);
        Event event = eventAt(scene, over ? EventKind::over_speed : EventKind::under_speed, path, span, at);
        setSpeed(event, scene, path.samples[at].speed);
        events.push_back(event);
    }
}

/// How far from `first` on the vehicle stays within a circle of about this diameter: the last sample of it.
std::size_t staysUntil(const GroundPath& path, std::size_t first, double diameter, std::size_t step) {
    double left = 1e300, right = -1e300, top = 1e300, bottom = -1e300;
    std::size_t last = first;
    diameter /= path.samples[first].by_place;
    for (std::size_t i = first; i < path.samples.size(); i += step) {
        const cv::Point2d at = path.samples[i].at;
        left = std::min(left, at.x), right = std::max(right, at.x);
        top = std::min(top, at.y), bottom = std::max(bottom, at.y);
        if (right - left > diameter || bottom - top > diameter) break;
        last = i;
    }
    return last;
}

}  // namespace

void findStandstills(const EventScene& scene, std::vector<Event>& events) {
    for (const GroundPath& path : scene.paths) {
        for (const SampleSpan& span : spansOf(path, false)) {
            if (span.first > 0) {
                Event stop = eventAt(scene, EventKind::stops, path, {span.first, span.first}, span.first);
                setSpeed(stop, scene, fastestBefore(scene, path, span.first, kSpeedAround_s));
                events.push_back(stop);
            }
            const double lasts = secondsBetween(path, span.first, span.last, scene.scale);
            if (lasts >= scene.options.stands_s) {
                Event stand = eventAt(scene, EventKind::stands, path, span, (span.first + span.last) / 2);
                stand.figure = lasts;
                stand.unit = FigureUnit::seconds;
                events.push_back(stand);
            }
            if (span.last + 1 < path.samples.size()) {
                const std::size_t first = span.last + 1;
                Event start = eventAt(scene, EventKind::starts, path, {first, first}, first);
                setSpeed(start, scene, fastestAfter(scene, path, first, kSpeedAround_s));
                events.push_back(start);
            }
        }
    }
}

void findTurnBacks(const EventScene& scene, std::vector<Event>& events) {
    for (const GroundPath& path : scene.paths) {
        // Smoothed directions need not be compared more often than a few times a window.
        const double stride = scene.options.smooth_s * scene.scale.frame_rate_hz / 4;
        std::vector<std::size_t> moving;
        for (std::size_t i = 0; path.measured && i < path.samples.size(); ++i) {
            if (!path.samples[i].moving || !(path.samples[i].speed > 0)) continue;
            if (moving.empty() || path.samples[i].frame - path.samples[moving.back()].frame >= stride)
                moving.push_back(i);
        }
        for (std::size_t from = 0; from < moving.size();) {
            const TurnBack turn = nextTurnBack(scene, path, moving, from);
            if (turn.before == turn.after) break;
            Event event =
                eventAt(scene, EventKind::turns_back, path, {turn.before, turn.after}, turningPoint(path, turn));
            event.figure =
                std::abs(turnBetween(directionOf(path.samples[turn.before]), directionOf(path.samples[turn.after]))) *
                180 / kPi;
            event.unit = FigureUnit::degrees;
            events.push_back(event);
            from =
                static_cast<std::size_t>(std::lower_bound(moving.begin(), moving.end(), turn.after) - moving.begin());
        }
    }
}

void findSpeeds(const EventScene& scene, std::vector<Event>& events) {
    for (const GroundPath& path : scene.paths) {
        findBeyond(scene, path, true, events);
        findBeyond(scene, path, false, events);
    }
}

void findLoitering(const EventScene& scene, std::vector<Event>& events) {
    const EventOptions& o = scene.options;
    const double diameter = 2 * o.loiter_radius_m;
    const auto step = static_cast<std::size_t>(std::max(1.0, scene.scale.frame_rate_hz / 2));
    for (const GroundPath& path : scene.paths) {
        if (!path.measured) continue;
        for (std::size_t i = 0; i < path.samples.size();) {
            const std::size_t last = staysUntil(path, i, diameter, step);
            const double lasts = secondsBetween(path, i, last, scene.scale);
            if (lasts < o.loiter_time_s || wayBetween(path, i, last) < 2 * diameter) {
                i += step;
                continue;
            }
            Event event = eventAt(scene, EventKind::loiters, path, {i, last}, (i + last) / 2);
            event.figure = lasts;
            event.unit = FigureUnit::seconds;
            events.push_back(event);
            i = last + step;
        }
    }
}

}  // namespace eyrie

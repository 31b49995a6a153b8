#include <algorithm>
#include <cmath>
#include <optional>

#include "core/geometry/angle.h"
#include "events/ground/flow_field.h"
#include "events/kinds/drawn_ways.h"
#include "events/kinds/event_scene.h"

namespace eyrie {
namespace {

constexpr double kLeastFlowTime_s = 1;  ///< for which a vehicle drives against the flow or off it

/// How a sample lies to what others do.
enum class FlowVerdict {
    none,     ///< it stands, or nothing can be told
    along,    ///< enough others go its way
    against,  ///< enough others go the other way, hardly one goes its way
    off       ///< nobody else comes near
};

/// The flow on one ground.
struct Flow {
    FlowField near;  ///< who passes a place
    FlowField wide;  ///< who comes near it
    DrawnWays drawn;
};

/// How the samples of a path lie, and the arrows that told, where one did.
struct PathVerdicts {
    std::vector<FlowVerdict> of_sample;
    std::vector<const Zone*> arrows;  ///< of each sample; null: others told
};

FlowVerdict verdictOn(double direction, const DrawnWay& right, double against) {
    const double turn = std::abs(turnBetween(direction, right.direction));
    if (turn > against) return FlowVerdict::against;
    return turn <= FlowField::kAlong ? FlowVerdict::along : FlowVerdict::none;
}

/// `near` are the votes of the path in flow.near.
PathVerdicts verdictsOn(const EventScene& scene, const GroundPath& path, const Flow& flow,
                        const FlowField::Votes& near) {
    const EventOptions& o = scene.options;
    std::optional<FlowField::Votes> wide;  // where nobody passes, which is rare
    const double against = radiansFromDegrees(o.against_angle_deg);
    PathVerdicts told{std::vector<FlowVerdict>(path.samples.size(), FlowVerdict::none),
                      std::vector<const Zone*>(path.samples.size(), nullptr)};
    std::vector<FlowVerdict>& verdicts = told.of_sample;
    for (std::size_t i = 0; i < path.samples.size(); ++i) {
        const GroundSample& sample = path.samples[i];
        if (!sample.moving) continue;
        const double direction = std::atan2(sample.velocity.y, sample.velocity.x);
        if (const auto right = flow.drawn.at(sample)) {  // a person knows better than what most do
            verdicts[i] = verdictOn(direction, *right, against);
            told.arrows[i] = right->arrow;
            continue;
        }
        const FlowField::Others others = flow.near.othersAt(sample.at, direction, against, near);
        if (others.against >= o.flow_tracks && others.along <= o.flow_share * others.all) {
            verdicts[i] = FlowVerdict::against;
        } else if (others.along >= o.flow_tracks) {
            verdicts[i] = FlowVerdict::along;
        } else if (others.all == 0) {
            if (!wide) wide = flow.wide.votesOf(path);
            if (flow.wide.othersAt(sample.at, direction, against, *wide).all == 0) verdicts[i] = FlowVerdict::off;
        }
    }
    return told;
}

/// Spans of one verdict that are long enough; short interruptions that say nothing else belong to them.
std::vector<SampleSpan> longSpans(const EventScene& scene, const GroundPath& path,
                                  const std::vector<FlowVerdict>& verdicts, FlowVerdict wanted) {
    std::vector<SampleSpan> spans;
    bool open = false;
    for (std::size_t i = 0; i < verdicts.size(); ++i) {
        if (verdicts[i] == wanted) {
            if (open)
                spans.back().last = i;
            else
                spans.push_back({i, i});
            open = true;
        } else if (open && (verdicts[i] != FlowVerdict::none ||
                            secondsBetween(path, spans.back().last, i, scene.scale) > kLeastFlowTime_s)) {
            open = false;
        }
    }
    std::erase_if(spans, [&](const SampleSpan& span) {
        return wayBetween(path, span.first, span.last) < scene.options.flow_way_m ||
               secondsBetween(path, span.first, span.last, scene.scale) < kLeastFlowTime_s;
    });
    return spans;
}

/// For how long a place on the ground was in the picture; counts no further than `enough`.
double secondsInPicture(const EventScene& scene, int stretch_index, cv::Point2d place, double enough) {
    const GroundStretch& stretch = scene.ground.all()[static_cast<std::size_t>(stretch_index)];
    const int step = std::max(1, static_cast<int>(scene.scale.frame_rate_hz / 2));
    double seconds = 0;
    for (FrameIndex frame = stretch.first_frame; frame <= stretch.last_frame && seconds < enough; frame += step) {
        const auto image = scene.ground.toImage(frame, place);
        if (image && scene.ground.inImage(*image)) seconds += step / scene.scale.frame_rate_hz;
    }
    return seconds;
}

/// The sample of a span that lies furthest beside the straight continuation of what came before, and how far, m.
std::pair<std::size_t, double> furthestBeside(const GroundPath& path, const GroundSample& from,
                                              const SampleSpan& span) {
    std::pair<std::size_t, double> furthest{span.first, 0};
    for (std::size_t i = span.first; i <= span.last; ++i) {
        const cv::Point2d way = path.samples[i].at - from.at;
        const double beside =
            std::abs(from.velocity.x * way.y - from.velocity.y * way.x) / from.speed * path.samples[i].by_place;
        if (beside > furthest.second) furthest = {i, beside};
    }
    return furthest;
}

void addAgainst(const EventScene& scene, const GroundPath& path, const PathVerdicts& verdicts,
                std::vector<Event>& events) {
    for (const SampleSpan& span : longSpans(scene, path, verdicts.of_sample, FlowVerdict::against)) {
        const std::size_t middle = (span.first + span.last) / 2;
        Event event = eventAt(scene, EventKind::against_flow, path, span, middle);
        setLength(event, scene, wayBetween(path, span.first, span.last));
        for (std::size_t i = span.first; i <= span.last && event.zone.empty(); ++i)
            if (verdicts.arrows[i] != nullptr && verdicts.of_sample[i] == FlowVerdict::against)
                event.zone = verdicts.arrows[i]->name;
        events.push_back(event);
    }
}

void addLeaving(const EventScene& scene, const GroundPath& path, const std::vector<FlowVerdict>& verdicts,
                std::vector<Event>& events) {
    const std::vector<SampleSpan> along = longSpans(scene, path, verdicts, FlowVerdict::along);
    for (const SampleSpan& span : longSpans(scene, path, verdicts, FlowVerdict::off)) {
        const auto after =
            std::find_if(along.rbegin(), along.rend(), [&](const SampleSpan& each) { return each.last < span.first; });
        if (after == along.rend()) continue;
        const auto [furthest, beside] = furthestBeside(path, path.samples[after->last], span);
        if (beside < scene.options.off_flow_m) continue;
        // A place that has hardly been seen may be full of traffic at other times.
        const double seen = scene.options.off_flow_seen_s;
        if (secondsInPicture(scene, path.stretch, path.samples[furthest].at, seen) < seen) continue;
        Event event = eventAt(scene, EventKind::leaves_flow, path, span, span.first);
        setLength(event, scene, wayBetween(path, span.first, span.last));
        events.push_back(event);
    }
}

/// Searches the paths on one ground.
void searchFlow(const EventScene& scene, const std::vector<const GroundPath*>& paths, Flow flow,
                std::vector<Event>& events) {
    std::vector<FlowField::Votes> near;
    for (const GroundPath* path : paths) {
        flow.near.add(near.emplace_back(flow.near.votesOf(*path)));
        flow.wide.add(flow.wide.votesOf(*path));
    }
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const auto verdicts = verdictsOn(scene, *paths[i], flow, near[i]);
        addAgainst(scene, *paths[i], verdicts, events);
        addLeaving(scene, *paths[i], verdicts.of_sample, events);
    }
}

}  // namespace

void findFlowEvents(const EventScene& scene, const std::vector<Zone>& zones, std::vector<Event>& events) {
    const EventOptions& o = scene.options;
    std::vector<std::vector<const GroundPath*>> on_ground(scene.ground.all().size());
    for (const GroundPath& path : scene.paths)
        if (path.measured) on_ground[static_cast<std::size_t>(path.stretch)].push_back(&path);
    for (std::size_t i = 0; i < on_ground.size(); ++i) {
        if (on_ground[i].empty()) continue;
        searchFlow(scene, on_ground[i],
                   {FlowField(o.flow_radius_m), FlowField(o.off_flow_m), DrawnWays(scene, zones, static_cast<int>(i))},
                   events);
    }
}

}  // namespace eyrie

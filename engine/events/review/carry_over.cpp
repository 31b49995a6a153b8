#include "events/review/carry_over.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "events/review/vehicle_distance.h"

namespace eyrie {
namespace {

/// Decides between events that are equally near otherwise.
constexpr double kStartWeight = 1e-3;

struct CarryPair {
    double cost = 0;
    int verdict = 0;
    std::size_t index = 0;  ///< of the event, or of the stretch
};

struct Lasting {
    double first_s = 0;
    double last_s = 0;
};

double gapOf(const Lasting& a, const Lasting& b) {
    return std::max({0.0, a.first_s - b.last_s, b.first_s - a.last_s});
}

/// Events of one kind in the order of their beginnings.
struct KindTimes {
    std::vector<std::size_t> events;
    std::vector<double> latest_end;  ///< of the events up to this one
};

/// Gives verdicts away, the nearest pairs first.
void give(std::vector<CarryPair>& pairs, std::vector<int>& verdict_of, std::map<int, bool>& met) {
    std::sort(pairs.begin(), pairs.end(), [](const CarryPair& a, const CarryPair& b) {
        return std::tie(a.cost, a.verdict, a.index) < std::tie(b.cost, b.verdict, b.index);
    });
    for (const CarryPair& pair : pairs) {
        bool& given = met[pair.verdict];  // met at least
        if (given || verdict_of[pair.index] != 0) continue;
        verdict_of[pair.index] = pair.verdict;
        given = true;
    }
}

bool isWithin(FrameIndex frame, const std::vector<FrameSpan>& spans) {
    return std::any_of(spans.begin(), spans.end(),
                       [frame](const FrameSpan& span) { return frame >= span.first && frame <= span.last; });
}

/// Whether events of a kind are the same one only by the same zone, or none. Who drives against the flow does so with
/// and without an arrow that says it.
bool isByZone(EventKind kind) {
    return kind != EventKind::against_flow;
}

bool isOfSameZone(const ReviewSubject& subject, const Event& event) {
    return !isByZone(event.kind) || event.zone == subject.zone;
}

class Carrier {
 public:
    Carrier(const std::vector<Event>& events, const std::vector<FrameSpan>& unsearched, const StoredTracks& run,
            const ReviewOptions& options)
        : events_(events), unsearched_(unsearched), run_(run), options_(options), distance_(run, options) {
        for (const Event& event : events) times_.push_back(lasting(event.first_frame, event.last_frame));
        for (std::size_t i = 0; i < events.size(); ++i) kinds_[events[i].kind].events.push_back(i);
        for (auto& [kind, times] : kinds_) {
            std::stable_sort(times.events.begin(), times.events.end(),
                             [&](std::size_t a, std::size_t b) { return times_[a].first_s < times_[b].first_s; });
            for (const std::size_t i : times.events) {
                const double end = times_[i].last_s;
                times.latest_end.push_back(times.latest_end.empty() ? end : std::max(end, times.latest_end.back()));
            }
        }
    }

    void pairEvents(const Verdict& verdict, std::vector<CarryPair>& pairs) const {
        const ReviewSubject& subject = verdict.subject;
        const auto kind = kinds_.find(*subject.kind);
        if (kind == kinds_.end() || !isOfRun(subject.frame)) return;
        const Lasting time = lasting(subject.first_frame, subject.last_frame);
        const KindTimes& times = kind->second;
        const auto first =
            std::lower_bound(times.latest_end.begin(), times.latest_end.end(), time.first_s - options_.carry_time_s) -
            times.latest_end.begin();
        for (auto i = static_cast<std::size_t>(first); i < times.events.size(); ++i) {
            const std::size_t index = times.events[i];
            const Event& event = events_[index];
            if (times_[index].first_s > time.last_s + options_.carry_time_s) break;
            if (!isOfSameZone(subject, event) || event.sense != subject.sense) continue;
            const auto late = inTime(time, times_[index]);
            if (!late) continue;
            const auto far = distance_.between(subject, event);
            if (far) pairs.push_back({*late + *far, verdict.id, index});
        }
    }

    void pairStretches(const Verdict& verdict, std::vector<CarryPair>& pairs) const {
        const Lasting time = lasting(verdict.subject.first_frame, verdict.subject.last_frame);
        for (std::size_t i = 0; i < unsearched_.size(); ++i) {
            const auto late = inTime(time, lasting(unsearched_[i].first, unsearched_[i].last));
            if (late) pairs.push_back({*late, verdict.id, i});
        }
    }

    CarryFault faultOf(const ReviewSubject& subject, bool met, const std::vector<Zone>& zones) const {
        if (met) return CarryFault::taken;
        const bool watched =
            subject.zone.empty() || (subject.kind && !isByZone(*subject.kind)) ||
            std::any_of(zones.begin(), zones.end(), [&](const Zone& zone) { return zone.name == subject.zone; });
        const bool searched =
            isOfRun(subject.frame) && (!subject.kind.has_value() || !isWithin(subject.frame, unsearched_));
        return watched && searched ? CarryFault::no_event : CarryFault::not_searched;
    }

 private:
    bool isOfRun(FrameIndex frame) const {
        return frame >= run_.footage.first_frame && frame <= run_.footage.last_frame;
    }
    Lasting lasting(FrameIndex first, FrameIndex last) const { return {run_.secondsOf(first), run_.secondsOf(last)}; }
    /// What the distance in time costs; nothing where it is too large.
    std::optional<double> inTime(const Lasting& verdict, const Lasting& other) const {
        const double gap = gapOf(verdict, other);
        if (gap > options_.carry_time_s) return std::nullopt;
        const double late = options_.carry_time_s > 0 ? gap / options_.carry_time_s : 0;
        return late + kStartWeight * std::abs(verdict.first_s - other.first_s);
    }

    const std::vector<Event>& events_;
    const std::vector<FrameSpan>& unsearched_;
    const StoredTracks& run_;
    const ReviewOptions& options_;
    VehicleDistance distance_;
    std::vector<Lasting> times_;
    std::map<EventKind, KindTimes> kinds_;
};

}  // namespace

const char* nameOf(CarryFault fault) {
    constexpr std::array<const char*, 3> kNames = {"no such event near", "the event near has another verdict",
                                                   "not searched by this run"};
    return kNames.at(static_cast<std::size_t>(fault));
}

CarriedVerdicts carryOver(const std::map<int, Verdict>& verdicts, const std::vector<Event>& events,
                          const std::vector<FrameSpan>& unsearched, const StoredTracks& run,
                          const std::vector<Zone>& zones, const ReviewOptions& options) {
    CarriedVerdicts carried;
    carried.of_event.assign(events.size(), 0);
    carried.of_stretch.assign(unsearched.size(), 0);
    const Carrier carrier(events, unsearched, run, options);
    std::vector<CarryPair> event_pairs;
    std::vector<CarryPair> stretch_pairs;
    for (const auto& [id, verdict] : verdicts) {
        if (verdict.subject.kind) {
            carrier.pairEvents(verdict, event_pairs);
        } else {
            carrier.pairStretches(verdict, stretch_pairs);
        }
    }
    std::map<int, bool> met;  // true: given to an event
    give(event_pairs, carried.of_event, met);
    give(stretch_pairs, carried.of_stretch, met);
    for (const auto& [id, verdict] : verdicts) {
        const auto found = met.find(id);
        if (found != met.end() && found->second) continue;
        carried.left.push_back({id, carrier.faultOf(verdict.subject, found != met.end(), zones)});
    }
    return carried;
}

}  // namespace eyrie

#pragma once

#include <map>
#include <vector>

#include "core/review/zone.h"
#include "events/review/review_subject.h"

namespace eyrie {

/// Why no event took a verdict up.
enum class CarryFault {
    no_event,     ///< there is none of this kind near
    taken,        ///< the one that is near has another verdict
    not_searched  ///< the run does not hold these frames, could not register them, or the zone is not watched
};
/// For people: "no such event near".
const char* nameOf(CarryFault fault);

/// A verdict that belongs to no event of a run, and why.
struct LeftVerdict {
    int verdict = 0;  ///< its id
    CarryFault fault = CarryFault::no_event;
};

/// Which event of a run has which verdict; at most one each.
struct CarriedVerdicts {
    std::vector<int> of_event;      ///< id of the verdict by event, 0 for none
    std::vector<int> of_stretch;    ///< the same by stretch that could not be searched
    std::vector<LeftVerdict> left;  ///< those that could not be carried over, ascending ids
};

/// Finds the events that verdicts were made on, in the run that was judged or in another of the same video. Kind, zone
/// and sense must be the same, the times near (`carry_time_s`), and the vehicle at the verdict's frame near the
/// verdict's place on the ground as this run registers it (`carry_distance_m`; `carry_picture` where it does not
/// connect the frames). Where its track does not reach that frame, the place of the event counts. The nearest pairs are
/// made first; the result depends on nothing but the arguments.
CarriedVerdicts carryOver(const std::map<int, Verdict>& verdicts, const std::vector<Event>& events,
                          const std::vector<FrameSpan>& unsearched, const StoredTracks& run,
                          const std::vector<Zone>& zones = {}, const ReviewOptions& options = {});

}  // namespace eyrie

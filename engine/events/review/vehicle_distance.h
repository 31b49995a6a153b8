#pragma once

#include <map>
#include <optional>

#include "core/review/verdict.h"
#include "events/ground/ground_stretches.h"
#include "events/review/review_options.h"
#include "events/stored_events.h"

namespace eyrie {

/// How far the vehicles of events of a run are from where verdicts saw theirs.
class VehicleDistance {
 public:
    /// `run` must outlive it.
    VehicleDistance(const StoredTracks& run, const ReviewOptions& options);

    /// 0 … 1, where 1 is as far as options allow; nothing beyond. The verdict's frame must be one of the run.
    std::optional<double> between(const ReviewSubject& subject, const Event& event) const;

 private:
    std::optional<double> ofTrack(const ReviewSubject& subject, const EventTrack& track) const;
    std::optional<double> ofPlace(const ReviewSubject& subject, const Event& event) const;
    std::optional<double> onGround(double metres) const;

    const StoredTracks& run_;
    const ReviewOptions& options_;
    GroundStretches ground_;
    std::map<TrackId, const EventTrack*> tracks_;
};

}  // namespace eyrie

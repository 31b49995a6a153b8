#pragma once

#include <vector>

#include "tracking/association/split_merge.h"
#include "tracking/association/vector_association.h"
#include "tracking/measurement_model.h"
#include "tracking/track.h"
#include "tracking/track_manager.h"
#include "tracking/tracker_options.h"

namespace eyrie {

/// Gives tracks motion vectors and carries them on by these, in one frame (Teutsch §6.2.2, §6.3). All it refers to must
/// outlive it; what is remembered is in the tracks.
class TrackVectors {
 public:
    TrackVectors(const TrackerOptions& options, const TrackManager& manager, const MeasurementModel& model,
                 const FrameVectors& vectors)
        : options_(options), manager_(manager), model_(model), vectors_(vectors) {}

    /// Before the update, by predicted boxes. Returns the vectors of each detection that is free to start a track.
    std::vector<std::vector<AssociatedVector>> associateByPrediction(std::vector<Track>& tracks,
                                                                     const std::vector<MovingBox>& detected,
                                                                     const std::vector<char>& used) const;
    /// Moves a track on to where its vectors say it is; answers whether they could.
    bool update(Track& track) const;
    void storePlacesOf(std::vector<Track>& tracks) const;
    /// After the update, by updated boxes.
    void associateByUpdate(std::vector<Track>& tracks) const;

 private:
    VectorLimits limits() const;

    const TrackerOptions& options_;
    const TrackManager& manager_;
    const MeasurementModel& model_;
    const FrameVectors& vectors_;
};

}  // namespace eyrie

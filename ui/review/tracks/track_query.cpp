#include "review/tracks/track_query.h"

#include <algorithm>
#include <utility>

namespace eyrie::ui {

TrackQuery::TrackQuery(const TrackFilter& filter, const std::vector<TrackSummary>& tracks, const SceneScale& scale,
                       Known known, const FrameOfDay& frame_of_day)
    : filter_(filter), frames_(framesOf(filter.time, frame_of_day)), scale_(scale), known_(std::move(known)) {
    filter_.time = {};
    for (const TrackSummary& track : tracks) tracks_.emplace(track.id, track);
}

bool TrackQuery::passes(const std::vector<TrackId>& tracks, FrameSpan frames, FrameIndex frame) const {
    if (!overlap(frames_, frames)) return false;
    const TrackFacts facts{.doings = known_.doings.get(), .likeness = known_.likeness.get(), .now = frame};
    return tracks.empty() || std::any_of(tracks.begin(), tracks.end(), [&](TrackId id) {
               const auto track = tracks_.find(id);
               return track == tracks_.end() || filter_.holds(track->second, scale_, facts);
           });
}

}  // namespace eyrie::ui

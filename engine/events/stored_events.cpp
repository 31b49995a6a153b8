#include "events/stored_events.h"

#include <algorithm>
#include <map>
#include <set>

namespace eyrie {

StoredTracks readTracks(const RunStore& store, const RunRecord& run) {
    StoredTracks found;
    found.footage.image_size = run.sequence.size;
    found.footage.scale = run.scale;
    found.footage.first_frame = run.first_frame;
    found.footage.last_frame = run.first_frame + run.frames_done - 1;
    std::vector<Homography> steps;
    store.visitRegistrations(run.id, [&](const Registration& registration) {
        const Homography& step = registration.current_from_previous;
        if (registration.reliable()) steps.push_back(step);
        if (registration.state == RegistrationState::failed) ++found.unregistered;
    });
    found.footage.camera = CameraMotion(steps);
    std::set<TrackId> confirmed;
    for (const TrackSummary& track : store.tracks(run.id)) {
        if (track.confirmed) confirmed.insert(track.id);
    }
    std::map<TrackId, EventTrack> tracks;
    store.visitTrackStates(run.id, [&](FrameIndex frame, const TrackState& state) {
        if (!confirmed.contains(state.id)) return;
        EventTrack& track = tracks[state.id];
        track.id = state.id;
        track.boxes.push_back({frame, state.box});
    });
    for (auto& [id, track] : tracks) found.tracks.push_back(std::move(track));
    return found;
}

}  // namespace eyrie

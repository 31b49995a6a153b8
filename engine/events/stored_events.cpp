#include "events/stored_events.h"

#include <algorithm>
#include <unordered_map>

#include "core/error.h"
#include "correction/corrected_run.h"

namespace eyrie {

double StoredTracks::secondsOf(FrameIndex frame) const {
    const int at = frame - footage.first_frame;
    if (at < 0 || at >= static_cast<int>(shown_s.size())) return frame / footage.scale.frame_rate_hz;
    return shown_s[static_cast<std::size_t>(at)];
}

StoredTracks readTracks(const RunStore& store, const RunRecord& run, CorrectedTracks corrected) {
    return readTracks(store, run, store.frameSummaries(run.id), std::move(corrected));
}

StoredTracks readTracks(const RunStore& store, const RunRecord& run, const std::vector<FrameSummary>& frames,
                        CorrectedTracks corrected) {
    StoredTracks found;
    Footage& footage = found.footage;
    footage.image_size = run.sequence.size;
    footage.scale = run.scale;
    footage.first_frame = run.first_frame;
    footage.last_frame = run.first_frame - 1;
    for (const FrameSummary& frame : frames) {
        // Frames follow each other; what a damaged file lacks is shown at the time of the frame before.
        while (footage.last_frame < frame.frame) {
            found.shown_s.push_back(static_cast<double>(frame.time_us) / 1e6);
            ++footage.last_frame;
        }
    }
    std::vector<Homography> steps;
    store.visitRegistrations(run.id, [&](const Registration& registration) {
        if (registration.reliable()) steps.push_back(registration.current_from_previous);
        if (registration.state == RegistrationState::failed) ++found.unregistered;
    });
    footage.camera = CameraMotion(steps);
    std::unordered_map<TrackId, std::size_t> numbers;  // an hour has a million boxes to be sorted by track
    for (const TrackSummary& track : trackSummaries(store, run.id, corrected)) {
        if (!track.confirmed) continue;
        numbers.emplace(track.id, found.tracks.size());
        EventTrack& added = found.tracks.emplace_back();
        added.id = track.id;
        added.seen_until = run.first_frame - 1;
        added.boxes.reserve(std::min(static_cast<std::size_t>(track.frames), found.shown_s.size()));
        found.scores[track.id] = track.score;
    }
    store.visitTrackPlaces(run.id, [&](FrameIndex frame, TrackId track, const OrientedBox& box, bool seen) {
        const auto number = numbers.find(track);
        if (number == numbers.end() || corrected.replaced.contains(track)) return;
        EventTrack& added = found.tracks[number->second];
        added.boxes.push_back({frame, box});
        if (seen) added.seen_until = frame;
    });
    for (const auto& [id, track] : corrected.tracks) {
        EventTrack& added = found.tracks[numbers.at(id)];
        for (const TrackFrame& each : track.states) {
            added.boxes.push_back({each.frame, each.state.box});
            if (each.state.origin != StateOrigin::predicted) added.seen_until = each.frame;
        }
    }
    std::erase_if(found.tracks, [&](const EventTrack& track) {
        if (track.boxes.empty()) found.scores.erase(track.id);
        return track.boxes.empty();
    });
    found.corrections = std::move(corrected);
    return found;
}

std::optional<CorrectionKind> correctionOf(const Event& event, const StoredTracks& stored) {
    for (const TrackId id : event.tracks) {
        if (const CorrectedTrack* track = stored.corrections.track(id)) return track->kind;
    }
    return std::nullopt;
}

std::string makerText(std::optional<CorrectionKind> corrected) {
    return corrected ? std::string("person: ") + nameOf(*corrected) : "machine";
}

namespace {

std::string notSearched(const Zone& zone, const Footage& footage) {
    return "zone \"" + zone.name + "\" is fixed to the ground of frame " + std::to_string(zone.frame) +
           ", but the run holds the frames " + std::to_string(footage.first_frame) + " to " +
           std::to_string(footage.last_frame);
}

bool isSearched(const Zone& zone, const Footage& footage) {
    return zone.anchor == ZoneAnchor::image || (zone.frame >= footage.first_frame && zone.frame <= footage.last_frame);
}

}  // namespace

void checkReach(const std::vector<Zone>& zones, const Footage& footage) {
    if (footage.last_frame < footage.first_frame) return;
    for (const Zone& zone : zones) {
        if (!isSearched(zone, footage)) throw Error(ErrorKind::input, notSearched(zone, footage));
    }
}

std::vector<std::string> remarksOn(const std::vector<Zone>& zones, const Footage& footage) {
    std::vector<std::string> remarks;
    if (footage.last_frame < footage.first_frame || zones.empty()) return remarks;
    const GroundStretches ground(footage);
    for (const Zone& zone : zones) {
        if (zone.anchor == ZoneAnchor::image) continue;
        const GroundStretch* stretch = ground.of(zone.frame);
        if (stretch == nullptr) {
            remarks.push_back(notSearched(zone, footage));
            continue;
        }
        if (ground.all().size() == 1) continue;
        remarks.push_back("zone \"" + zone.name + "\" counts in frames " + std::to_string(stretch->first_frame) +
                          " to " + std::to_string(stretch->last_frame) +
                          " only: the ground of other frames is not connected with that of frame " +
                          std::to_string(zone.frame));
    }
    return remarks;
}

}  // namespace eyrie

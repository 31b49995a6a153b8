#include <algorithm>

#include "explain/explanation_steps.h"

namespace eyrie::explaining {
namespace {

const char* kindText(AssociationKind kind) {
    switch (kind) {
        case AssociationKind::missed:
            return "no detection";
        case AssociationKind::matched:
            return "matched";
        case AssociationKind::split:
            return "split into parts";
        case AssociationKind::merged:
            break;
    }
    return "merged with other tracks";
}

const TrackState* unfinishedOf(const PlaceEvidence& evidence, TrackId id) {
    const auto found = std::find_if(evidence.unfinished.begin(), evidence.unfinished.end(),
                                    [id](const TrackState& state) { return state.id == id; });
    return found == evidence.unfinished.end() ? nullptr : &*found;
}

bool contains(const std::vector<int>& list, int value) {
    return std::find(list.begin(), list.end(), value) != list.end();
}

/// The row of the overlap matrix of each track at the place or claimed by its detections.
void tellRows(Story& story, const TrackingTrace& trace, const std::vector<int>& detections) {
    for (const TracedTrack& track : trace.tracks) {
        std::string row;
        bool concerns = atPlace(track.predicted, story.evidence.area);
        for (const TracedRelation& relation : trace.relations) {
            if (relation.track != track.id) continue;
            concerns = concerns || contains(detections, relation.detection);
            row += (row.empty() ? "" : ", ") + std::string("D") + std::to_string(relation.detection + 1) + " " +
                   numberText(relation.overlap) + (relation.accepted ? " ✓" : " ✗");
        }
        if (!concerns) continue;
        const std::string text = "track " + std::to_string(track.id) + ": " + kindText(track.kind) +
                                 (row.empty() ? ", overlaps no detection" : ", overlaps " + row) + " (T_tov " +
                                 numberText(trace.min_overlap) + ", gate " + numberText(track.gate_px) + " px)";
        if (track.kind == AssociationKind::missed)
            story.note("association", text, "tracking.min_overlap");
        else
            story.pass("association", text, "tracking.min_overlap");
        if (!track.ended_by.empty()) {
            const bool doubled = track.ended_by == "tracking.suppress_duplicates";
            const std::string end =
                doubled ? "track " + std::to_string(track.id) + " ends: it lies on another that moves alike"
                        : "track " + std::to_string(track.id) + " ends: " + numberText(track.ended_value) +
                              " against " + numberText(track.ended_limit);
            story.fail("tracks", end, track.ended_by);
        }
    }
}

/// The state of the tracker's own track at the place.
const TrackState* unfinishedAt(const PlaceEvidence& evidence) {
    return bestAt(evidence.unfinished, evidence.area, [](const TrackState&) { return true; });
}

/// The state at the place that was left out when the run's tracks were finished.
const DroppedState* droppedAt(const PlaceEvidence& evidence) {
    return bestAt(evidence.result.dropped, evidence.area,
                  [](const DroppedState& state) { return state.why != TrackDrop::unconfirmed; });
}

}  // namespace

void tellTracks(Story& story, const std::vector<int>& detections) {
    const PlaceEvidence& evidence = story.evidence;
    if (evidence.tracking) tellRows(story, *evidence.tracking, detections);
    const TrackState* stored = storedTrackAt(evidence);
    if (stored != nullptr) {
        story.pass("tracks", "track " + std::to_string(stored->id) + ": " + nameOf(stored->status) + ", " +
                                 nameOf(stored->origin) + ", detected in " + std::to_string(stored->hits) + " of " +
                                 std::to_string(stored->age + 1) + " frames");
        tellScore(story, stored->id);
        return;
    }
    if (const DroppedState* dropped = droppedAt(evidence)) {
        story.fail("tracks", "left out when the run's tracks were finished: " + textOf(*dropped),
                   parameterOf(dropped->why));
        tellScore(story, dropped->id);
        story.decide("Left out when the run's tracks were finished: " + textOf(*dropped), parameterOf(dropped->why));
        return;
    }
    if (!evidence.tracking) {
        story.fail("tracks", "no track here");
        story.decide("No track here", "");
        return;
    }
    const TrackingTrace& trace = *evidence.tracking;
    const TrackerOptions options = story.options.tracking.atRate(story.scale.frame_rate_hz);
    for (const TracedTrack& track : trace.tracks) {
        if (track.ended_by.empty() || !atPlace(track.predicted, evidence.area)) continue;
        if (track.ended_by == "tracking.suppress_duplicates") continue;
        story.decide("Track " + std::to_string(track.id) + " ended here: " + numberText(track.ended_value) +
                         (track.ended_by == "tracking.min_visible" ? " of its box is in the picture, more than "
                                                                   : " frames without evidence, at most ") +
                         numberText(track.ended_limit) +
                         (track.ended_by == "tracking.min_visible" ? " is needed" : " are allowed"),
                     track.ended_by);
    }
    for (const int index : detections) {
        if (!contains(trace.doubled, index)) continue;
        story.fail("tracks", "the detection starts no track: another that moves alike lies there",
                   "tracking.duplicate_overlap");
        story.decide("The detection starts no track because another that moves alike lies there",
                     "tracking.duplicate_overlap");
    }
    const TrackState* state = unfinishedAt(evidence);
    for (const auto& [index, id] : trace.started) {
        if (contains(detections, index)) state = unfinishedOf(evidence, id);
    }
    if (state == nullptr) {
        story.fail("tracks", "no track here");
        if (!detections.empty())
            story.decide("The detection here belongs to no track: a larger one claims it", "tracking.split_merge");
        else
            story.decide("Nothing was found here, and no track reaches here", "");
        return;
    }
    if (state->status == TrackStatus::tentative) {
        const std::string text = "track is tentative: detected in " + std::to_string(state->hits) + " of its " +
                                 std::to_string(state->age + 1) + " frames, " + std::to_string(options.confirm_hits) +
                                 " within " + std::to_string(options.confirm_window) + " are needed";
        story.fail("tracks", text, "tracking.confirm_hits");
        story.decide("The " + text, "tracking.confirm_hits");
        return;
    }
    story.pass("tracks", "track " + std::to_string(state->id) + " of the tracker: " + nameOf(state->status) + ", " +
                             nameOf(state->origin));
    if (state->origin == StateOrigin::predicted) {
        story.fail("tracks", "removed when the run's tracks were finished", "finishing.trim_predicted");
        story.decide("The track here was only predicted and was cut off when the run's tracks were finished",
                     "finishing.trim_predicted");
        return;
    }
    story.fail("tracks", "removed when the run's tracks were finished", "finishing.max_sharing");
    story.decide("The tracker had a track here; it was removed or moved when the run's tracks were finished",
                 "finishing.max_sharing");
}

}  // namespace eyrie::explaining

#include <algorithm>
#include <optional>

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

/// What the tracker counted of a track that is not confirmed; null where it is none of those.
const TracedTentative* tentativeOf(const PlaceEvidence& evidence, const TrackState* state) {
    if (state == nullptr || !evidence.tracking) return nullptr;
    const auto& all = evidence.tracking->tentative;
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const TracedTentative& one) { return one.id == state->id; });
    return found == all.end() ? nullptr : &*found;
}

std::string tentativeText(const TracedTentative& tentative) {
    std::string text = "track is tentative: detected in " + std::to_string(tentative.hits) + " of its last " +
                       countText(static_cast<std::size_t>(tentative.frames), "frame", "frames") + ", " +
                       std::to_string(tentative.needed) + " within " + std::to_string(tentative.window) + " are needed";
    if (tentative.whole_needed > 0)
        text += ", or " + std::to_string(tentative.whole_needed) +
                " detections that look like a whole vehicle (so far " + std::to_string(tentative.whole) + ")";
    return text;
}

/// Why a detection that was kept is in no track here.
void tellUnused(Story& story, const TrackingTrace& trace, const std::vector<int>& detections) {
    for (const int index : detections) {
        for (const TracedDouble& doubled : trace.doubled) {
            if (doubled.detection != index) continue;
            story.fail("tracks", "the detection starts no track: another that moves alike lies there",
                       doubled.parameter);
            story.decide("The detection starts no track because another that moves alike lies there",
                         doubled.parameter);
        }
    }
}

/// That nothing of the tracker is here, although detections may be.
void tellNoTrack(Story& story, const TrackingTrace& trace, const std::vector<int>& detections) {
    story.fail("tracks", "no track here");
    for (const TracedTrack& track : trace.tracks) {
        const bool owns = track.kind == AssociationKind::matched && track.detections.size() == 1 &&
                          contains(detections, track.detections.front());
        if (owns)
            story.decide("The detection here belongs to track " + std::to_string(track.id) + ", which lies elsewhere",
                         track.ended_by);
    }
    // Else it started a track, but where parts and merged boxes are told apart.
    if (!detections.empty())
        story.decide("The detection here belongs to no track: a larger one claims it", "tracking.split_merge");
    else
        story.decide("Nothing was found here, and no track reaches here", "");
}

}  // namespace

std::optional<DroppedState> leftOutAt(const PlaceEvidence& evidence) {
    if (storedTrackAt(evidence) != nullptr) return std::nullopt;
    const TrackState* tentative = bestAt(evidence.result.tracks, evidence.area, [](const TrackState& track) {
        return track.status == TrackStatus::tentative;
    });
    if (tentative != nullptr) return DroppedState{tentative->id, tentative->box, TrackDrop::unconfirmed, 0};
    const DroppedState* dropped =
        bestAt(evidence.result.dropped, evidence.area, [](const DroppedState&) { return true; });
    return dropped == nullptr ? std::nullopt : std::optional(*dropped);
}

void decideLeftOut(Story& story, const DroppedState& left_out) {
    const std::string parameter = parameterOf(left_out.why);
    const TracedTentative* counted =
        left_out.why == TrackDrop::unconfirmed ? tentativeOf(story.evidence, unfinishedAt(story.evidence)) : nullptr;
    const std::string sentence = counted != nullptr
                                     ? "The " + tentativeText(*counted)
                                     : "Left out when the run's tracks were finished: " + textOf(left_out);
    if (story.decide(sentence, parameter)) story.told.drop = left_out.why;
}

void tellTracks(Story& story, const std::vector<int>& detections, const std::optional<DroppedState>& left_out) {
    const PlaceEvidence& evidence = story.evidence;
    if (left_out && left_out->why == TrackDrop::shadow) tellShadowHere(story);
    if (evidence.tracking) tellRows(story, *evidence.tracking, detections);
    const TrackState* stored = storedTrackAt(evidence);
    if (stored != nullptr) {
        story.pass("tracks", "track " + std::to_string(stored->id) + ": " + nameOf(stored->status) + ", " +
                                 nameOf(stored->origin) + ", detected in " + std::to_string(stored->hits) + " of " +
                                 std::to_string(stored->age + 1) + " frames");
        tellTrim(story, stored->id);
        tellScore(story, stored->id, StepVerdict::passed);
        return;
    }
    if (left_out && left_out->why != TrackDrop::unconfirmed) {
        story.fail("tracks", "left out when the run's tracks were finished: " + textOf(*left_out),
                   parameterOf(left_out->why));
        tellScore(story, left_out->id, left_out->why == TrackDrop::unlikely ? StepVerdict::failed : StepVerdict::note);
        return;
    }
    if (!evidence.tracking) {
        story.fail("tracks", left_out ? textOf(*left_out) : std::string("no track here"),
                   left_out ? parameterOf(left_out->why) : "");
        story.decide("No track here", "");
        return;
    }
    const TrackingTrace& trace = *evidence.tracking;
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
    tellUnused(story, trace, detections);
    const TrackState* state = unfinishedAt(evidence);
    for (const auto& [index, id] : trace.started) {
        if (contains(detections, index)) state = unfinishedOf(evidence, id);
    }
    if (state == nullptr && left_out) {
        story.fail("tracks", textOf(*left_out), parameterOf(left_out->why));
        return;
    }
    if (state == nullptr) return tellNoTrack(story, trace, detections);
    if (const TracedTentative* tentative = tentativeOf(evidence, state)) {
        const std::string parameter = parameterOf(TrackDrop::unconfirmed);
        story.fail("tracks", tentativeText(*tentative), parameter);
        if (story.decide("The " + tentativeText(*tentative), parameter)) story.told.drop = TrackDrop::unconfirmed;
        return;
    }
    story.pass("tracks", "track " + std::to_string(state->id) + " of the tracker: " + nameOf(state->status) + ", " +
                             nameOf(state->origin));
    if (state->origin == StateOrigin::predicted && story.options.finishing.trim_predicted) {
        story.fail("tracks", "removed when the run's tracks were finished", "finishing.trim_predicted");
        story.decide("The track here was only predicted and was cut off when the run's tracks were finished",
                     "finishing.trim_predicted");
        return;
    }
    // What finishing drops it tells; what it joins or smooths it does not.
    story.fail("tracks", "joined or moved when the run's tracks were finished");
    story.decide(
        "The tracker had a track here; it was joined with another or moved when the run's tracks were finished", {});
}

}  // namespace eyrie::explaining

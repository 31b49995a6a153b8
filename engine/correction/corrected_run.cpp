#include "correction/corrected_run.h"
#include "correction/track_frames.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/labels/result_box.h"
#include "store/review/review_store.h"
#include "store/runs/class_rule.h"

namespace eyrie {
namespace {

/// Tracks of the run that lie on any box that a correction holds.
std::map<TrackId, std::vector<TrackFrame>> tracksMeant(const RunStore& store, const RunRecord& run,
                                                       const std::map<int, TrackCorrection>& corrections) {
    std::map<FrameIndex, std::vector<OrientedBox>> places;
    for (const auto& [id, correction] : corrections) {
        for (const std::vector<Sighting>* sightings : {&correction.track, &correction.other})
            for (const Sighting& each : comparedOf(*sightings)) places[each.frame].push_back(each.box);
    }
    std::set<TrackId> meant;
    for (const auto& [frame, boxes] : places) {
        for (const TrackFrame& each : store.trackStatesUpTo(run.id, frame, 1)) {
            const bool near = std::any_of(boxes.begin(), boxes.end(), [&](const OrientedBox& box) {
                return likenessOf(box, each.state.box).has_value();
            });
            if (near) meant.insert(each.state.id);
        }
    }
    std::map<TrackId, std::vector<TrackFrame>> tracks;
    for (const TrackId id : meant) tracks[id] = store.trackStates(run.id, id);
    return tracks;
}

TrackSummary summaryOf(TrackId id, const CorrectedTrack& track, const ClassRule& rule) {
    TrackSummary summary;
    summary.id = id;
    summary.first_frame = track.states.front().frame;
    summary.last_frame = track.states.back().frame;
    summary.frames = static_cast<int>(track.states.size());
    summary.confirmed = true;
    summary.corrected = track.kind;
    for (const TrackFrame& each : track.states) {
        summary.mean_speed_px += std::hypot(each.state.velocity.x, each.state.velocity.y) / summary.frames;
        summary.mean_length_px += each.state.box.length / summary.frames;
        summary.mean_width_px += each.state.box.width / summary.frames;
        summary.place += each.state.box.centre * (1.0 / summary.frames);
    }
    summary.score = track.states.back().state.score;
    summary.track_class = rule.of(summary);
    return summary;
}

/// Hands out the states of the run frame by frame, with what corrections make of them.
class MergedFrames {
 public:
    MergedFrames(const CorrectedTracks& corrected, const RunStore::StateVisitor& visitor)
        : corrected_(corrected), visitor_(visitor) {
        for (const auto& [id, track] : corrected.tracks)
            for (const TrackFrame& each : track.states) frames_.insert(each.frame);
    }
    void add(FrameIndex frame, const TrackState& state) {
        if (frame != frame_) flush(frame);
        frame_ = frame;
        states_.push_back(state);
    }
    void finish() { flush(std::numeric_limits<FrameIndex>::max()); }

 private:
    /// Hands over the frame gathered, and those without a state of the run before `next`.
    void flush(FrameIndex next) {
        if (frame_ >= 0) {
            frames_.erase(frame_);
            hand(frame_, std::exchange(states_, {}));
        }
        while (!frames_.empty() && *frames_.begin() < next) hand(frames_.extract(frames_.begin()).value(), {});
    }
    void hand(FrameIndex frame, std::vector<TrackState> states) {
        for (const TrackState& state : corrected_.in(frame, std::move(states))) visitor_(frame, state);
    }

    const CorrectedTracks& corrected_;
    const RunStore::StateVisitor& visitor_;
    std::set<FrameIndex> frames_;  ///< of corrected tracks, not handed over yet
    FrameIndex frame_ = -1;
    std::vector<TrackState> states_;
};

}  // namespace

CorrectedTracks correctedTracksOf(const RunStore& store, const RunRecord& run,
                                  const std::map<int, TrackCorrection>& corrections) {
    if (corrections.empty() || run.live || run.frames_done == 0) return {};
    TracksToCorrect work;
    work.tracks = tracksMeant(store, run, corrections);
    work.first_frame = run.first_frame;
    work.last_frame = run.first_frame + run.frames_done - 1;
    work.frame_rate_hz = run.scale.frame_rate_hz;
    work.last_id = store.lastTrackId(run.id);
    return correctTracks(work, corrections, CameraMotion::fromRegistrations(store.registrations(run.id)));
}

CorrectedTracks readCorrectedTracks(ProjectFile& project, const RunRecord& run) {
    return correctedTracksOf(RunStore(project), run, readReview(project, run.sequence.id).corrections);
}

std::vector<TrackSummary> trackSummaries(const RunStore& store, int run_id, const CorrectedTracks& corrected) {
    std::vector<TrackSummary> summaries = store.tracks(run_id);
    if (corrected.empty()) return summaries;
    std::erase_if(summaries, [&](const TrackSummary& each) { return corrected.replaced.contains(each.id); });
    const ClassRule rule = classRuleOf(store, run_id);
    for (const auto& [id, track] : corrected.tracks) summaries.push_back(summaryOf(id, track, rule));
    std::sort(summaries.begin(), summaries.end(),
              [](const TrackSummary& a, const TrackSummary& b) { return a.id < b.id; });
    return summaries;
}

std::vector<TrackSummary> rejectedSummaries(const RunStore& store, int run_id, const CorrectedTracks& corrected) {
    std::vector<TrackSummary> summaries;
    if (corrected.rejected.empty()) return summaries;
    const ClassRule rule = classRuleOf(store, run_id);
    for (const auto& [id, track] : corrected.rejected) {
        summaries.push_back(summaryOf(id, track, rule));
        summaries.back().confirmed = false;
    }
    return summaries;
}

std::vector<TrackFrame> trackStates(const RunStore& store, int run_id, TrackId track,
                                    const CorrectedTracks& corrected) {
    if (const CorrectedTrack* known = corrected.track(track)) return known->states;
    if (corrected.replaced.contains(track)) return {};
    return store.trackStates(run_id, track);
}

std::vector<TrackFrame> trackBeside(const RunStore& store, int run_id, const TrackCorrection& rejection,
                                    const std::set<TrackId>& but, const CorrectedTracks& corrected) {
    struct Met {
        std::size_t boxes = 0;
        double likeness = 0;
    };
    std::map<TrackId, Met> met;
    for (const Sighting& sighting : rejection.track) {
        for (const TrackFrame& each : trackStatesUpTo(store, run_id, sighting.frame, 1, corrected)) {
            const auto like = likenessOf(sighting.box, each.state.box);
            if (!like || but.contains(each.state.id)) continue;
            ++met[each.state.id].boxes;
            met[each.state.id].likeness += *like;
        }
    }
    std::vector<TrackFrame> best;
    double most = 0;
    for (const auto& [id, of_track] : met) {
        if (2 * of_track.boxes < rejection.track.size() || of_track.likeness <= most) continue;
        std::vector<TrackFrame> states = trackStates(store, run_id, id, corrected);
        if (!isOfResult(states)) continue;
        most = of_track.likeness;
        best = std::move(states);
    }
    return best;
}

std::vector<TrackFrame> trackStatesUpTo(const RunStore& store, int run_id, FrameIndex frame, int trail,
                                        const CorrectedTracks& corrected) {
    std::vector<TrackFrame> states = store.trackStatesUpTo(run_id, frame, trail);
    if (corrected.empty()) return states;
    std::erase_if(states, [&](const TrackFrame& each) { return corrected.replaced.contains(each.state.id); });
    for (const auto& [id, track] : corrected.tracks) {
        for (const TrackFrame& each : track.states)
            if (each.frame <= frame && each.frame > frame - trail) states.push_back(each);
    }
    std::sort(states.begin(), states.end(), [](const TrackFrame& a, const TrackFrame& b) {
        return std::pair(a.frame, a.state.id) < std::pair(b.frame, b.state.id);
    });
    return states;
}

void visitTrackStates(const RunStore& store, int run_id, const CorrectedTracks& corrected,
                      const RunStore::StateVisitor& visitor) {
    if (corrected.empty()) return store.visitTrackStates(run_id, visitor);
    MergedFrames frames(corrected, visitor);
    store.visitTrackStates(run_id, [&](FrameIndex frame, const TrackState& state) { frames.add(frame, state); });
    frames.finish();
}

void visitTrackBoxes(const RunStore& store, int run_id, const CorrectedTracks& corrected, const BoxVisitor& visitor) {
    if (corrected.empty()) return store.visitTrackBoxes(run_id, visitor);
    std::map<TrackId, const char*> classes;  // of what is part of the result
    for (const TrackSummary& track : trackSummaries(store, run_id, corrected))
        if (track.confirmed) classes[track.id] = wordOf(track.track_class);
    visitTrackStates(store, run_id, corrected, [&](FrameIndex frame, const TrackState& state) {
        const auto known = classes.find(state.id);
        if (known == classes.end()) return;
        BoxRecord record = boxOf(frame, state);
        record.object_class = known->second;
        visitor(frame, record);
    });
}

}  // namespace eyrie

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/measure_text.h"
#include "explain/explanation.h"

/// What the parts of explain() share. Not for others.
namespace eyrie::explaining {

/// Collects steps; the first sentence that decides is told.
struct Story {
    void pass(const char* stage, const std::string& text, const std::string& parameter = {});
    void note(const char* stage, const std::string& text, const std::string& parameter = {});
    void fail(const char* stage, const std::string& text, const std::string& parameter = {});
    /// The sentence: why nothing was found, with a capital. `parameter` may be empty. Whether it is the one that is
    /// told.
    bool decide(const std::string& sentence, const std::string& parameter);

    /// "0.25 px/frame" or, where the scale is known, "0.25 px/frame (1.6 m/s)".
    std::string speedText(double px_per_frame) const;
    std::string lengthText(double px) const;

    const PlaceEvidence& evidence;
    const ChainOptions& options;
    const SceneScale& scale;  ///< of the frame
    const SceneScale here;    ///< the scale at the place
    Explanation told{};
    bool decided = false;
};

/// The stages, in order. Each returns whether the story goes on.
bool tellRegistration(Story& story);
/// Corners and independent motion.
bool tellCorners(Story& story);
/// `clusters` receives the clusters at the place.
bool tellClusters(Story& story, std::vector<int>& clusters);
/// `detections` receives the positions of what the detector found there.
bool tellDetection(Story& story, const std::vector<int>& clusters, std::vector<int>& detections);
/// Duplicates and outliers; `detections` keeps those that stayed.
bool tellRemoval(Story& story, std::vector<int>& detections);
/// What speaks for a finished track, and against it; nothing where it has no score. `fate`: passed where the track is
/// in the result, failed where its score kept it out, note where something else did.
void tellScore(Story& story, TrackId track, StepVerdict fate);
/// What was taken out of the boxes of a finished track, and how shadows fall there; nothing where nothing was.
void tellTrim(Story& story, TrackId track);
/// How shadows fall where a track was left out as one; nothing where that is not known.
void tellShadowHere(Story& story);
/// What the tracker did with what is left in `detections`, or had there without any.
void tellTracks(Story& story, const std::vector<int>& detections, const std::optional<DroppedState>& left_out);
/// The track at the place that was left out of the result, or would be as it is not confirmed; nothing where one was
/// stored.
std::optional<DroppedState> leftOutAt(const PlaceEvidence& evidence);
/// That it was decides.
void decideLeftOut(Story& story, const DroppedState& left_out);
/// The reliable track at the place that was stored, if any.
const TrackState* storedTrackAt(const PlaceEvidence& evidence);

/// Of the states with a box at the place for which `counts` holds, the one that overlaps it most; null: none.
template <typename State, typename Counts>
const State* bestAt(const std::vector<State>& states, const OrientedBox& area, Counts counts) {
    const State* best = nullptr;
    double best_overlap = -1;
    for (const State& state : states) {
        if (!counts(state) || !atPlace(state.box, area)) continue;
        const double shared = overlap(state.box, area);
        if (shared <= best_overlap) continue;
        best = &state;
        best_overlap = shared;
    }
    return best;
}

}  // namespace eyrie::explaining

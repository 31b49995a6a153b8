#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "annotation/keyframes/camera_motion.h"
#include "core/review/track_correction.h"
#include "store/runs/run_store.h"

/// The tracks of a run as people corrected them: added, joined, split, rejected. What operators are shown and given;
/// what is measured against ground truth are the run's own.
namespace eyrie {

/// What became of a correction in a run.
enum class CorrectionState {
    applied,
    covered,       ///< the run has it so by itself
    no_track,      ///< no track of the run is where it was made
    apart,         ///< join: the two are in different places at one time
    not_searched,  ///< the run does not hold these frames
    absent,        ///< reject: the run has no such track, as the person wants it
    alone          ///< reject: of a vehicle that had two tracks, the run has one only
};
/// For people: "no such track near".
const char* nameOf(CorrectionState state);
/// Whether what the person wants is lost in this run.
bool isLeft(CorrectionState state);

/// A track that people made or changed.
struct CorrectedTrack {
    CorrectionKind kind = CorrectionKind::add;  ///< what was done to it last
    std::vector<int> corrections;               ///< all that took part, ascending
    std::vector<TrackFrame> states;             ///< ascending frames, never empty; those added are `by_hand`
};

/// What a run's tracks become.
struct CorrectedTracks {
    std::map<TrackId, CorrectedTrack> tracks;  ///< instead of those replaced, or new; ids may be those of replaced ones
    std::map<TrackId, CorrectedTrack> rejected;  ///< left out of all results; lists tell that they were
    std::set<TrackId> replaced;                  ///< tracks of the run that are no more what they were, or rejected
    std::map<int, CorrectionState> states;       ///< of every correction
    std::map<CorrectionKind, int> applied;       ///< how many of each kind were
    std::map<int, TrackId> covering;             ///< of covered ones: a track of the run that is there instead

    bool empty() const { return tracks.empty() && rejected.empty() && replaced.empty(); }
    /// The states of a frame, given those of the run; ascending ids.
    std::vector<TrackState> in(FrameIndex frame, std::vector<TrackState> of_run) const;
    const CorrectedTrack* track(TrackId id) const;
    /// The same, also of a rejected one: what a person did to a track that a list shows. Null: nothing.
    const CorrectedTrack* touched(TrackId id) const;
};

/// What corrections are applied to.
struct TracksToCorrect {
    std::map<TrackId, std::vector<TrackFrame>> tracks;  ///< those that may be meant; ascending frames, never empty
    FrameIndex first_frame = 0;                         ///< of the run
    FrameIndex last_frame = -1;
    double frame_rate_hz = 25;
    TrackId last_id = 0;  ///< the highest of the run; tracks that are made have higher ones
};

/// Applies corrections in the order of their numbers, each to what those before it made. Tracks are found by places and
/// times: the one that lies best on at least half of the boxes that a correction holds of its track. A join keeps the
/// id of the track that begins first; where both have a box, what was seen counts before what was predicted, then the
/// one that begins first; gaps of up to ten seconds are filled over the ground as far as `camera` connects the frames.
/// A split leaves the id to the earlier part. An added track of which most lies on tracks is covered by them. A
/// rejected track is one that lives for the most part while the one that was rejected did: a longer one may be of a
/// vehicle. Where another track on the same vehicle was kept, one that lies on the kept one, too, with no other there,
/// is the vehicle's. The result depends on nothing but the arguments.
CorrectedTracks correctTracks(const TracksToCorrect& run, const std::map<int, TrackCorrection>& corrections,
                              const CameraMotion& camera);

/// "2 tracks added, 1 join, 1 split, 3 tracks rejected; 1 correction could not be carried over"; empty where nobody
/// corrected anything.
std::string correctionsInWords(const CorrectedTracks& corrected);

/// Whether any of these states makes the track part of a result.
bool isOfResult(const std::vector<TrackFrame>& states);

/// Whether two boxes of one frame may be the same vehicle; higher is likelier, nothing: they are not.
std::optional<double> likenessOf(const OrientedBox& a, const OrientedBox& b);

}  // namespace eyrie

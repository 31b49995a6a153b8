#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/evidence/classified_box.h"
#include "core/evidence/light_finding.h"
#include "core/evidence/track_evidence.h"
#include "core/parameter.h"
#include "core/values/corner.h"
#include "core/values/detection.h"
#include "core/values/dropped_state.h"
#include "core/values/ids.h"
#include "core/values/motion_vector.h"
#include "core/values/picture_mask.h"
#include "core/values/scene_scale.h"
#include "core/values/track_state.h"

namespace eyrie {

class GroundMotion;

/// What finishing needs to know about the camera in one frame.
struct FrameMotionSummary {
    FrameIndex frame = 0;
    Registration registration;  ///< maps the frame before into this one
    cv::Size image_size;
};

/// Parameters of the finishing of tracks once a run is over.
struct FinishingOptions {
    bool keep_tentative = true;
    bool trim_predicted = true;
    double stop_speed_m_s = 2.0;
    double join_gap_s = 1.0;
    double join_distance_m = 1.5;
    double join_distance_px = 3;
    bool constant_size = true;
    double size_window_s = 3;
    bool smooth_path = true;
    double smooth_window_s = 0.4;
    int extend_back = 5;
    double extend_entry_s = 0.5;
    double trace_back_s = 4;
    double from_rest_s = 4;
    double follow_ends_s = 3;
    double min_length_m = 1.8;
    double min_width_m = 0.9;
    double max_aspect = 1.2;
    double max_sharing = 0.5;
    bool drop_shadows = true;
    bool trim_shadows = true;
    bool whole_lorries = true;
    double min_detected = 0.4;
    double standing_height = 0.33;
    double standing_depth = 0.2;
    double roof_height = 0.38;
    double min_score = 0.2;
    bool join_parts = true;

    void describe(ParameterVisitor& visitor);
    /// Confirmed tracks from their first detection on, otherwise unchanged (Teutsch §7.1.2).
    static FinishingOptions thesis();
    /// Whether any step looks at the pictures of the run.
    bool looksAtPictures() const { return follow_ends_s > 0 || trim_shadows || whole_lorries; }
};

/// A state of a track and the frame it belongs to.
using TimedState = std::pair<FrameIndex, TrackState>;

/// A box of a path, in single precision: some 1e-4 px in the largest pictures.
struct PathBox {
    cv::Point2f centre{0, 0};
    float length = 0;
    float width = 0;
    float heading = 0;

    PathBox() = default;
    PathBox(const OrientedBox& box)
        : centre(box.centre),
          length(static_cast<float>(box.length)),
          width(static_cast<float>(box.width)),
          heading(static_cast<float>(box.heading)) {}
    operator OrientedBox() const { return {centre, length, width, heading}; }
    double area() const { return double{length} * width; }
};

/// What finishing works on of a state: an hour of traffic is millions of them, all held at once.
struct PathState {
    PathBox box;
    cv::Point2f velocity{0, 0};
    float score = 0;
    int hits = 0;
    TrackStatus status = TrackStatus::tentative;
    StateOrigin origin = StateOrigin::detected;

    PathState() = default;
    explicit PathState(const TrackState& state)
        : box(state.box),
          velocity(state.velocity),
          score(static_cast<float>(state.score)),
          hits(state.hits),
          status(state.status),
          origin(state.origin) {}
};
using TimedPathState = std::pair<FrameIndex, PathState>;

/// One track: its states in ascending frames, never empty.
struct TrackPath {
    TrackId id = 0;
    std::vector<TimedPathState> states;

    /// Its state in a frame; nothing where it has none.
    const TimedPathState* at(FrameIndex frame) const {
        const auto found =
            std::lower_bound(states.begin(), states.end(), frame,
                             [](const TimedPathState& state, FrameIndex wanted) { return state.first < wanted; });
        return found != states.end() && found->first == frame ? &*found : nullptr;
    }
    FrameIndex firstFrame() const { return states.front().first; }
    FrameIndex lastFrame() const { return states.back().first; }
    int statesOf(StateOrigin origin) const {
        return static_cast<int>(std::count_if(states.begin(), states.end(), [origin](const TimedPathState& state) {
            return state.second.origin == origin;
        }));
    }
};

/// Takes the states of a run one by one.
using StateVisitor = std::function<void(FrameIndex, const TrackState&)>;

/// Hands all states of a run to a visitor, in any order; the same ones whenever it is asked.
using StatesOfRun = std::function<void(const StateVisitor&)>;

/// A track, or a part of one, that was left out.
struct DroppedPath {
    TrackPath path;
    TrackDrop why = TrackDrop::unconfirmed;
    TrackId beside = 0;
};

/// Takes the states that were left out one by one.
using DropVisitor = std::function<void(FrameIndex, const DroppedState&)>;

/// The result of a run, track by track.
struct FinishedTracks {
    std::vector<TrackPath> paths;
    std::vector<DroppedPath> dropped;
    std::unordered_set<TrackId> unconfirmed;  ///< left out, too: tracks that were never confirmed
    /// Those of `dropped` that only their score kept out of the result, as they would be in it.
    std::vector<TrackPath> doubtful;
    /// What speaks for the tracks of the result, for the doubtful ones, for those that could stand and for shadows that
    /// were left out at last; none where no classifier takes part.
    std::map<TrackId, TrackEvidence> evidence;
    RunLight light;  ///< how shadows fall, or what headlights light, and what of it was taken out of boxes

    /// All states, ordered by frame, then id.
    void visit(const StateVisitor& visitor) const;
    /// The same of the doubtful tracks.
    void visitDoubtful(const StateVisitor& visitor) const;
    /// All that was left out, in any order. `states`: what finishing was given; there those that were never confirmed
    /// are looked up again, since most of what is left out is of that kind.
    void visitDropped(const StatesOfRun& states, const DropVisitor& visitor) const;
};

/// A state that was left out and the frame it belongs to.
using TimedDrop = std::pair<FrameIndex, DroppedState>;

/// The motion vectors of a frame of the run, by ascending id; none for frames it does not have.
using VectorsAt = std::function<std::vector<MotionVector>(FrameIndex)>;

/// Detections that were kept in a frame of the run and of which the classifier says something; none for frames it does
/// not have.
using ClassifiedAt = std::function<std::vector<ClassifiedBox>(FrameIndex)>;

/// The grey picture (CV_8UC1) of a frame of the run; empty where it cannot be read.
using GrayOfFrame = std::function<cv::Mat(FrameIndex)>;

/// What was found in the frames of a run, as far as finishing looks at it. A source that is not there says nothing.
struct FoundInFrames {
    FoundInFrames() = default;
    FoundInFrames(VectorsAt vectors, ClassifiedAt classified = {})
        : vectors_at(std::move(vectors)), classified_at(std::move(classified)) {}
    VectorsAt vectors_at;
    ClassifiedAt classified_at;  ///< only of runs in which a classifier takes part
    PictureMask graphics;        ///< where something is drawn into the pictures
    GrayOfFrame gray_at;         ///< where the pictures can be read once more; asked for in ascending order
};

/// What was kept of frames; it must outlive the result.
using ClassifiedByFrame = std::unordered_map<FrameIndex, std::vector<ClassifiedBox>>;
ClassifiedAt classifiedIn(const ClassifiedByFrame& kept);

/// The vectors that were kept of frames; it must outlive the result.
using VectorsByFrame = std::unordered_map<FrameIndex, std::vector<MotionVector>>;
VectorsAt vectorsIn(const VectorsByFrame& kept);

/// Turns all states of a finished run into its result. Keeps the tracks that were ever confirmed, with their tentative
/// beginning; trims predicted ends; joins the fragments of one vehicle under the older id; drops what is no vehicle of
/// its own; gives every track a steady size on the ground and a smooth path; extends tracks back to where their motion
/// vectors began or the vehicle stood; follows sure ones on in the pictures. States come in any
/// order and leave ordered by frame, then id, one per frame and id. `ground` may lack frames; nothing is carried across
/// those. Without vectors no track is traced back, without pictures none is followed on. What is left out although the
/// tracker followed it is told, too; predicted ends that are trimmed and fragments that are joined do not count. Clean
/// tracks come out as they went in, so finishing twice is finishing once.
FinishedTracks finishRun(const StatesOfRun& states, const GroundMotion& ground, const FinishingOptions& options,
                         const SceneScale& scale, const FoundInFrames& found = {});

/// The same for states that are at hand.
std::vector<TimedState> finishTracks(const std::vector<TimedState>& states,
                                     const std::vector<FrameMotionSummary>& motion, const FinishingOptions& options,
                                     const SceneScale& scale, const FoundInFrames& found = {},
                                     std::vector<TimedDrop>* dropped = nullptr);

}  // namespace eyrie

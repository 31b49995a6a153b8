#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/evidence/classified_box.h"
#include "core/evidence/light_finding.h"
#include "core/evidence/track_evidence.h"
#include "core/labels/box_record.h"
#include "core/labels/track_class.h"
#include "core/review/track_correction.h"
#include "core/values/frame_result.h"
#include "core/values/scale_basis.h"
#include "core/values/scene_scale.h"
#include "store/project/project_file.h"

namespace eyrie {

/// Stopped by a person; failed with a reason. Running, too, is a run whose program was killed (run_lock.h).
enum class RunState { running, finished, stopped, failed };
/// The word for it, in lists and tables.
const char* nameOf(RunState state);

/// The video a run worked on.
struct SequenceRecord {
    int id = 0;
    std::string path;  ///< absolute path of the video file or image folder
    cv::Size size;     ///< px
    int frame_count = 0;
    double frame_rate_hz = 25;
    bool rate_assumed = false;  ///< neither the video nor anybody said the frame rate

    /// The rate to open it with, SourceOptions::remembered_rate_hz.
    double rememberedRate() const { return rate_assumed ? 0 : frame_rate_hz; }
};

/// One run of the chain over a sequence.
struct RunRecord {
    int id = 0;
    SequenceRecord sequence;
    std::string name;         ///< given by the user; may be empty
    std::string started_utc;  ///< ISO 8601, e.g. 2026-11-21T08:00:00Z
    /// The same moment, µs since 1970-01-01 (UTC): before its video was read. Runs of before schema 26 lack it.
    std::optional<std::int64_t> started_us;
    std::string engine_version;
    std::string preset;  ///< name of the preset it started from
    SceneScale scale;
    ScaleBasis scale_basis;              ///< where `scale` comes from; stored as agreeing() with it
    bool rate_assumed = false;           ///< the frame rate of `scale` is nobody's
    FrameIndex first_frame = 0;          ///< planned range, inclusive
    FrameIndex last_frame = 0;           ///< first_frame − 1: no frame of a run without a planned end is there yet
    int frames_done = 0;                 ///< whole frames in the file
    RunState state = RunState::running;  ///< as stored; a killed run is found as `running` and is not `live`
    bool live = false;                   ///< some program writes it at this moment
    std::string writer;                  ///< who, if live: "process 4711 on oak (since 2026-11-21T08:00:00Z)"
    std::string message;                 ///< why it failed
    /// How shadows fall in it, or what headlights light; empty where nothing is known. See StoredLight for the rest.
    std::vector<LightFinding> light;
};

/// How a run stands: as stored, but a killed one is stopped.
inline RunState stateNow(const RunRecord& run) {
    return run.state == RunState::running && !run.live ? RunState::stopped : run.state;
}

/// One frame of a run, for the timeline.
struct FrameSummary {
    FrameIndex frame = 0;
    std::int64_t time_us = 0;
    RegistrationState state = RegistrationState::first;
    int inliers = 0;
    double rms_px = 0;
    int corners = 0;
    int motion_vectors = 0;
    int detections = 0;   ///< kept ones
    int tracks = 0;       ///< confirmed or coasting ones
    bool details = true;  ///< what is behind the tracks was kept; else only the counts are known
    StageTimes stage_ms{};
};

/// The same of a frame that was not stored yet, for live views.
FrameSummary summaryOf(const FrameResult& result);

/// One track of a run, for lists.
struct TrackSummary {
    TrackId id = 0;
    FrameIndex first_frame = 0;
    FrameIndex last_frame = 0;
    int frames = 0;            ///< states
    bool confirmed = false;    ///< was confirmed at least once; others are not part of the result
    double mean_speed_px = 0;  ///< px/frame relative to the ground
    double mean_length_px = 0;
    double mean_width_px = 0;
    cv::Point2d place{0, 0};  ///< mean of its boxes' centres, where the run's scale differs over the picture
    double score = 0;  ///< of its last state; in a result the same in all: the probability of a vehicle that moves
    std::optional<BoxTrim> trim;                   ///< what was taken out of its boxes as shadow or beam
    bool doubtful = false;                         ///< only its score kept it out of the result
    TrackClass track_class = TrackClass::unknown;  ///< by its size and speed so far and the run's limits
    /// What a person did to it last, no track of the store has it. Rejected: it is in lists alone, and never confirmed.
    std::optional<CorrectionKind> corrected;
};

/// One state of a track in a frame.
struct TrackFrame {
    FrameIndex frame = 0;
    TrackState state;
};

/// The tracks of a run that was finished. States are handed, ordered by frame, to a visitor one by one.
struct TracksOfRun {
    using StateVisitor = std::function<void(FrameIndex, const TrackState&)>;
    using DropVisitor = std::function<void(FrameIndex, const DroppedState&)>;
    using States = std::function<void(const StateVisitor&)>;
    States states = [](const StateVisitor&) {};
    /// What was left out; only this one may still read the present states of the run meanwhile.
    std::function<void(const DropVisitor&)> dropped = [](const DropVisitor&) {};
    States doubtful = [](const StateVisitor&) {};  ///< tracks that only their score kept out of the result
    std::map<TrackId, TrackEvidence> evidence;     ///< of these and of those of the result
    RunLight light;                                ///< what was taken out of the boxes of these, and why
};

class DoubtfulTracks;

/// Reads, and where said changes, the runs of a project. Throws Error(project) for contents that no writer wrote, a run
/// to change that does not exist, or a project locked for seconds by another program.
class RunStore {
 public:
    /// `project` must outlive the store.
    explicit RunStore(ProjectFile& project) : project_(project) {}

    std::vector<RunRecord> runs() const;  ///< oldest first
    std::optional<RunRecord> run(int run_id) const;
    std::vector<std::pair<std::string, std::string>> parameters(int run_id) const;
    std::vector<FrameSummary> frameSummaries(int run_id) const;  ///< ascending frames
    /// How each frame from `from` to `last`, both included, was registered onto the one before it, ascending frames;
    /// for trails. What lies behind `last` is not read.
    std::vector<Homography> homographies(int run_id, FrameIndex from = 0,
                                         FrameIndex last = std::numeric_limits<FrameIndex>::max()) const;
    /// The same of all frames, with how each registration ended; for labelling over a moving camera.
    std::vector<Registration> registrations(int run_id) const;
    /// The same, one by one.
    void visitRegistrations(int run_id, const std::function<void(const Registration&)>& visitor) const;
    /// All a run knows of a frame; nothing when the run has no such frame.
    std::optional<FrameResult> frameResult(int run_id, FrameIndex frame) const;
    /// Its motion vectors alone, by ascending id; none when the run has no such frame.
    std::vector<MotionVector> motionVectors(int run_id, FrameIndex frame) const;
    /// Its kept detections of which the classifier says something; none when the run has no such frame.
    std::vector<ClassifiedBox> classifiedBoxes(int run_id, FrameIndex frame) const;
    std::vector<TrackSummary> tracks(int run_id) const;                    ///< ascending id
    TrackId lastTrackId(int run_id) const;                                 ///< the highest; 0 without tracks
    std::vector<TrackFrame> trackStates(int run_id, TrackId track) const;  ///< ascending frames
    std::vector<TrackFrame> trackStatesUpTo(int run_id, FrameIndex frame,
                                            int trail) const;  ///< states of frames (frame − trail, frame], for trails
    /// What only its score kept out of the result; nothing else here tells of it.
    DoubtfulTracks doubtful() const;
    /// Every state of every track, one by one, ordered by frame, then track.
    using StateVisitor = TracksOfRun::StateVisitor;
    void visitTrackStates(int run_id, const StateVisitor& visitor) const;
    /// Where every track is, in the same order: an hour has a million states, and most of a state is seldom asked for.
    /// `seen`: the box is no mere prediction.
    using PlaceVisitor = std::function<void(FrameIndex, TrackId, const OrientedBox&, bool seen)>;
    void visitTrackPlaces(int run_id, const PlaceVisitor& visitor) const;
    /// The run's result as boxes: every state of the confirmed tracks with the word of the track's class, or the kept
    /// detections (id and class empty).
    BoxesByFrame trackBoxes(int run_id) const;
    BoxesByFrame detectionBoxes(int run_id) const;
    /// The same one by one, ordered by frame.
    void visitTrackBoxes(int run_id, const BoxVisitor& visitor) const;
    void visitDetectionBoxes(int run_id, const BoxVisitor& visitor) const;

    /// Replaces all tracks of a run with what is known of them, and what was left out, in one transaction (used once,
    /// when the tracks of a run are finished).
    void replaceTracks(int run_id, const TracksOfRun& tracks);
    void rename(int run_id, const std::string& name);
    /// Takes a run out of all lists; it can be brought back until it is purged. Throws Error(project) naming the
    /// program that writes the run at this moment.
    void remove(int run_id);
    void restore(int run_id);
    /// The run that was removed last, to the second; of several the newest run.
    std::optional<RunRecord> lastRemoved() const;
    /// Deletes what was removed, for good. Its space goes back to the disk for a few seconds at most, since it is
    /// called where a project is closed; the rest is used again, or given back when a run ends.
    void purgeRemoved();

 private:
    void refuseUnchanged(int run_id) const;
    void markRemoved(int run_id, const std::string& when_utc);
    ProjectFile& project_;
};

}  // namespace eyrie

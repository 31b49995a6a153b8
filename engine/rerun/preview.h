#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "core/chain_stage.h"
#include "rerun/motion_window.h"
#include "rerun/replay.h"

namespace eyrie {

/// A frame as it would be with other parameters.
struct PreviewedFrame {
    FrameResult result;  ///< tracks carry the ids of the run's tracks they lie on, others ids beyond those
    ChainStage start = ChainStage::none;  ///< the first that the parameters change
    bool tracks_final = false;            ///< the frames before were done with the same parameters, too
    bool approximate = false;  ///< motion vectors were found anew over a short window, not over the whole run
};

/// Tries other parameters on single frames of a stored run. What the run stored of the stages before the first that
/// changed is used; what was computed for one set of parameters serves the next that agrees with it. For one thread.
class Preview {
 public:
    /// `source.result_of` is needed.
    explicit Preview(ReplaySource source);

    /// The frame by itself, at once: tracks are followed through the detections that the run stored of the `range`
    /// frames before. Nothing when `stop` was requested meanwhile. Throws Error(input | parameter | project).
    std::optional<PreviewedFrame> now(FrameIndex frame, const ChainOptions& options, int range,
                                      const std::stop_token& stop);
    /// The same after the `range` frames before were done with these parameters, too. `progress` is told how many are
    /// left.
    std::optional<PreviewedFrame> withTracks(FrameIndex frame, const ChainOptions& options, int range,
                                             const std::stop_token& stop, const std::function<void(int)>& progress);

    /// Somebody may be about to move a parameter of motion: registers what now() will need for that. Stops early when
    /// `stop` is requested; what is done is used.
    void warmUp(FrameIndex frame, const std::stop_token& stop);

    const ChainOptions& storedOptions() const { return source_.options; }

 private:
    /// A frame with what is known of it.
    struct Known {
        Frame frame;
        FrameResult stored;
        std::string clusters_for;  ///< parameters the clusters were found with
        std::vector<MotionCluster> clusters;
        std::string found_for;  ///< … and the detections
        ClusterSearch::Found found;
    };
    Known* known(FrameIndex frame);
    /// Motion of the frame and the `range` frames before it, by other parameters than the run's.
    bool prepareMotion(FrameIndex frame, const ChainOptions& options, int range, const std::stop_token& stop);
    void makeWindows(const ChainOptions& options);
    const FrameMotion& motionOf(const Known& known) const;
    FrameResult secondHalf(Known& known, const ChainOptions& options);
    /// Pixels of a frame where tracks are known by their looks; else nothing.
    cv::Mat pictureOf(Known& known);
    std::optional<PreviewedFrame> byReplay(FrameIndex frame, const ChainOptions& options, const std::stop_token& stop);
    void adoptIds(std::vector<TrackState>& tracks, const std::vector<TrackState>& stored) const;

    ReplaySource source_;
    std::map<FrameIndex, Known> frames_;
    std::unique_ptr<MotionWindow> window_;        ///< as short as can be, so that the first answer comes soon
    std::unique_ptr<MotionWindow> track_window_;  ///< over the range of tracks
    std::string windows_for_;
    std::map<FrameIndex, FrameMotion> motions_;  ///< with other parameters of motion; empty: the run's
    std::string motions_for_;
    std::unique_ptr<ClusterSearch> search_;
    std::string search_for_;
    std::unique_ptr<Replay> replay_;  ///< where stacks or difference images reach back
    std::string replay_for_;
};

}  // namespace eyrie

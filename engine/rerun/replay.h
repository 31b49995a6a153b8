#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "chain/chain.h"
#include "core/evidence/light_finding.h"

namespace eyrie {

/// A stored run as a replay needs it. Both functions are called on the thread that replays.
struct ReplaySource {
    ChainOptions options;
    SceneScale scale;
    FrameIndex first_frame = 0;                                          ///< of the run
    std::function<Frame(FrameIndex)> pixels;                             ///< throws Error where it cannot be read
    std::function<std::optional<FrameMotion>(FrameIndex)> motion_of{};   ///< nothing: the run has no such frame
    std::function<std::optional<FrameResult>(FrameIndex)> result_of{};   ///< all of a frame; for explanations only
    std::function<std::optional<TrackEvidence>(TrackId)> evidence_of{};  ///< what speaks for a track; the same
    std::function<std::optional<FrameShadow>(FrameIndex)> shadow_of{};   ///< where shadows fall to; the same
    std::function<std::optional<BoxTrim>(TrackId)> trim_of{};            ///< what was taken out of its boxes; the same
};

/// How many frames before play a part in what is found in one frame from given motion vectors.
int framesBefore(const ChainOptions& options);

/// One frame as the second half of the chain sees it.
struct ReplayedFrame {
    Frame frame;
    FrameResult result;  ///< tracks are those since the start of the replay, with ids of their own
    std::optional<DifferenceResult> differences;  ///< nothing where clusters come from motion vectors
    bool exact = false;  ///< the same as the run found: nothing before the start of the replay can play a part
};

/// Runs the second half of the chain again for single frames of a stored run, to look at what is not stored: image
/// stacks, difference images, the steps of a detection. Registration and motion vectors are taken from the run. Starts
/// as many frames before as stacks or background reach back, and goes on from where it is when a later frame is asked
/// for. For one thread.
class Replay {
 public:
    /// Throws Error where the parameters ask for a model file that cannot be read.
    explicit Replay(ReplaySource source);

    /// Nothing when `stop` was requested meanwhile (frames done so far are kept), or when the run has no such frame.
    /// The answer is valid until the next call. Throws Error(input | project) when pixels or motion cannot be read.
    const ReplayedFrame* at(FrameIndex frame, const std::stop_token& stop);

    /// The stacks of the frame that `at` answered last.
    std::vector<StackView> stacks(StackPictures pictures) const;
    /// The steps of the detection in one cluster of the frame that `at` answered last.
    std::vector<SearchTrace> trace(int cluster) const;
    /// What clustering did in the frame that `at` answered last; empty where clusters come from difference images.
    ClusteringTrace clustering() const;
    /// What duplicate removal did in the frame that `at` answered last.
    const RemovalTrace& removal() const { return half_.removal(); }

    /// Frames that are processed before the one asked for, at most.
    int reach() const { return reach_; }
    const ChainOptions& options() const { return source_.options; }
    const SceneScale& scale() const { return source_.scale; }

 private:
    void restart(FrameIndex first);
    bool advance(FrameIndex wanted);

    ReplaySource source_;
    int reach_;
    TrackHalf half_;
    FrameIndex started_ = 0;  ///< first frame since the last restart
    FrameIndex next_ = 0;     ///< frame to be processed next
    ReplayedFrame present_;
    bool present_valid_ = false;
};

}  // namespace eyrie

#pragma once

#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "chain/chain_options.h"
#include "core/error.h"
#include "core/values/frame.h"
#include "core/values/frame_result.h"
#include "io/video/frame_source.h"

namespace eyrie {

/// How far a run has come.
struct RunProgress {
    int frames_done = 0;
    int frames_total = 0;
    double frames_per_second = 0;  ///< over the last seconds
    double seconds_left = 0;
    bool estimating_scale = false;  ///< before the run proper: the frames are those of chooseScale's look
    bool finishing = false;         ///< after it: those up to which finishing has read pictures once more
};

/// How often the state of a run is kept.
struct StateKeeping {
    double every_s = 5;
    double most_share = 0.01;  ///< of the time; what takes longer to keep is kept less often
};

/// All that a run needs to go on after a frame, as bytes; see chain_state.h.
struct ChainState {
    FrameIndex last_done = 0;
    std::string bytes;
};

/// Receives the results of a run, frame after frame, on the run's own thread; the progress of the look at the scale
/// before it from any thread, one at a time. Must not throw anything but Error, which ends the run as failed.
class ChainObserver {
 public:
    virtual ~ChainObserver() = default;
    virtual void onFrame(const std::shared_ptr<const FrameResult>& result, const Frame& frame) = 0;
    virtual void onProgress(const RunProgress&) {}
    /// Whether onState() is to be called: now and then, and when the run is stopped.
    virtual std::optional<StateKeeping> stateKeeping() const { return std::nullopt; }
    /// Comes after onFrame() of the state's frame.
    virtual void onState(const ChainState&) {}
};

/// Whether a run came to its end, was stopped by a person, or broke off.
enum class RunOutcome { finished, stopped, failed };

/// How a run ended.
struct RunSummary {
    RunOutcome outcome = RunOutcome::failed;
    /// Why it failed; of a finished run what else there is to say, mostly nothing. For people.
    std::string message = "the run was never started";
    ErrorKind error = ErrorKind::internal;  ///< who has to act when it failed
    int frames_done = 0;
    int frames_total = 0;
    int unregistered_frames = 0;
    double seconds = 0;      ///< wall clock
    StageTimes median_ms{};  ///< median over the frames
};

struct ChainProgress;

/// What a run goes on from.
struct RunStart {
    std::shared_ptr<ChainProgress> progress;  ///< used up by the run; null: from the first frame
    int unregistered_frames = 0;              ///< among the frames done before
};

/// Frames to process, inclusive; last < 0: to the end.
struct FrameRange {
    FrameIndex first = 0;
    FrameIndex last = -1;
};

/// The loop over a video: reads, runs the chain, reports; catches every error. Frame t+1 is registered while frame t is
/// segmented and tracked; results do not depend on that.
class ChainRun {
 public:
    /// `scale` is the one to work with, given, estimated or assumed (see chooseScale).
    ChainRun(const ChainOptions& options, const SceneScale& scale) : options_(options), scale_(scale) {}

    /// Never throws. `with_colour`: frames handed to the observer carry colour. `start`: where the same range was left
    /// before; frames count from its beginning, times from now.
    RunSummary run(FrameSource& source, FrameRange range, ChainObserver& observer, std::stop_token stop,
                   bool with_colour = false, RunStart start = {}) const;

 private:
    ChainOptions options_;
    SceneScale scale_;
};

}  // namespace eyrie

#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>

#include "chain/chain_run.h"
#include "io/live/live_stream.h"
#include "store/details/recording_options.h"
#include "store/runs/run_store.h"

namespace eyrie {

/// What a run over a live source gave up to keep pace.
struct LiveLoad {
    LiveFacts facts;             ///< a frame that was skipped repeats the one before: nothing was looked for in it
    int fewer_corners = 0;       ///< frames that were registered by fewer corners than the parameters say
    int left_out_for_scale = 0;  ///< of those that were skipped, before the run had its scale

    /// "3 of 100 frames left out; 40 with fewer corners; …"; empty where nothing was given up.
    std::string text() const;
};

/// How a live run stands at a moment.
struct LiveStatus {
    LiveLoad load;
    bool lighter = false;  ///< fewer corners are looked for at this moment
    double behind_s = 0;   ///< by how much the frame at work is older than the newest one
};

/// What is wanted of a live source.
struct LiveRequest {
    std::string address;
    std::filesystem::path project;  ///< made where it is not there yet
    LiveOptions stream;             ///< `recording`: empty stands for recordingFor() the project
    ChainOptions options;
    std::string preset = "default";
    std::string name;         ///< of the run; empty: the address
    double gsd_m_per_px = 0;  ///< ≤ 0: not known: that of the metadata is taken, or an estimate
    RecordingOptions details;
};

/// A run over a live source that has ended.
struct LiveRunResult {
    RunRecord record;
    RunSummary summary;
    LiveLoad load;
};

/// Watches a live source: receives and records it, runs the chain as frames come, and stores what that finds as a run
/// over the recording. Where the chain is slower than the source it takes fewer corners first; where that is not
/// enough, frames are left out by the stream. Both is told in the run's message.
class LiveRun {
 public:
    using Begun = std::function<void(const RunRecord&)>;

    /// Waits for the first picture. `stop` ends waiting, and later the stream: what came before is still worked on.
    /// Throws Error(input) when the source does not answer or is of no use, Error(output | project) when recording or
    /// project cannot be written where they should; nothing is left behind then.
    LiveRun(LiveRequest request, std::stop_token stop);
    /// Takes the project away again, where it was made for a run that then did not begin.
    ~LiveRun();
    LiveRun(const LiveRun&) = delete;
    LiveRun& operator=(const LiveRun&) = delete;

    const VideoInfo& video() const;  ///< its length is not known
    const std::filesystem::path& recording() const;
    /// From any thread.
    LiveStatus status() const;

    /// Works until the source ends or is stopped; once. What is not known of the scale is looked for first: in the
    /// metadata, and in the pictures that come first (chooseScale()). `begun` hears of the run when it is in the
    /// project; `also`, if given, sees every frame, and how far that look is. What goes wrong with the stream or the
    /// chain is told by the summary; throws Error(project | output) where the run cannot be stored.
    LiveRunResult run(ChainObserver* also = nullptr, const Begun& begun = {});

 private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// "live-20261121-080000.eyrie", after the present time.
std::filesystem::path timedProjectName();
/// Where the recording lies when nobody said it: beside the project and named like it, in the place of no other file.
std::filesystem::path recordingFor(const std::filesystem::path& project);
/// What is to be said where a recording shows another number of frames than its run has; empty: nothing.
std::string remarkOnRecording(int recorded_frames, int run_frames);

/// The parameters with which a chain that is behind goes on.
ChainOptions withFewerCorners(ChainOptions options);

}  // namespace eyrie

#pragma once

#include <filesystem>
#include <string>

#include "chain/chain_run.h"
#include "io/live/live_stream.h"
#include "store/details/recording_options.h"
#include "store/runs/run_store.h"

namespace eyrie {

/// What a run over a live source gave up to keep pace.
struct LiveLoad {
    LiveFacts facts;        ///< a frame that was skipped repeats the one before: nothing was looked for in it
    int fewer_corners = 0;  ///< frames that were registered by fewer corners than the parameters say

    /// "3 of 100 frames left out; 40 with fewer corners; …"; empty where nothing was given up.
    std::string text() const;
};

/// A run over a live source that has ended.
struct LiveRunResult {
    RunRecord record;
    RunSummary summary;
    LiveLoad load;
};

/// Runs the chain over a live source until that ends or is ended, and stores it as a run over the recording. Where the
/// chain is slower than the source it takes fewer corners first; where that is not enough, frames are left out by the
/// stream. Both is told in the run's message. `also`, if given, sees every frame. What goes wrong with the stream or
/// the chain is told by the summary; throws Error(project | output) where the run cannot be stored.
LiveRunResult runLive(LiveStream& stream, const std::filesystem::path& project, const RunRecord& planned,
                      const ChainOptions& options, ChainObserver* also = nullptr,
                      const RecordingOptions& recording = {});

/// The parameters with which a chain that is behind goes on.
ChainOptions withFewerCorners(ChainOptions options);

}  // namespace eyrie

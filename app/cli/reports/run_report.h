#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "chain/chain_run.h"
#include "chain/recording/run_facts.h"
#include "chain/scale/scale_estimation.h"
#include "io/video/frame_source.h"
#include "store/runs/run_store.h"

namespace eyrie::cli {

/// What a look at the traffic says about the scale, and how sure it is.
std::string estimateText(const ScaleEstimate& estimate);

/// What is to be said of the metadata's scale before pictures are looked at; mostly nothing.
std::vector<std::string> remarksOn(const StatedScale& stated);
/// What is to be said of the scale that was chosen then; mostly nothing.
std::vector<std::string> remarksOn(const ChosenScale& chosen);
/// Both, in this order.
std::vector<std::string> remarksOn(const StatedScale& stated, const ChosenScale& chosen);

/// What a person wants to know when a run has ended, as text for the terminal.
std::string summaryText(const VideoInfo& video, const RunRecord& run, const RunSummary& summary, const RunFacts& facts,
                        const std::vector<TrackSummary>& tracks, const std::filesystem::path& project);

/// Median ms per stage and overall speed as JSON, for --timing. Throws Error(output).
void writeTiming(const std::filesystem::path& path, const RunSummary& summary);

}  // namespace eyrie::cli

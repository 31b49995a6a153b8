#pragma once

#include <vector>

#include "chain/chain_options.h"
#include "core/values/frame.h"

namespace eyrie::cli {

/// What tuning costs on a clip.
struct SweepTimes {
    int frames = 0;
    double run_s = 0;    ///< one run with its evaluation, from pictures in memory
    double sweep_s = 0;  ///< 46 quantiles, with all that they share
    int sweep_points = 0;
    double clustering_s = 0;  ///< figures of the clip after one changed parameter of a stage
    double removal_s = 0;
    double tracking_s = 0;
    double preview_ms = 0;  ///< one changed parameter on one frame, from stored motion vectors; median

    double speedUp() const { return sweep_s > 0 ? run_s * sweep_points / sweep_s : 0; }
};

/// Gradient based segmentation (fig. 7.6); the truth is what the chain itself finds, as only times count.
SweepTimes measureSweep(const std::vector<Frame>& frames, ChainOptions options, const SceneScale& scale);

}  // namespace eyrie::cli

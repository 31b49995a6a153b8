#pragma once

#include <QString>

#include "chain/recording/run_facts.h"

/// How a run ended, in words.
namespace eyrie::ui {

/// "0.08 m/px", "about 0.091 m/px, estimated from the traffic", "0.25 m/px, assumed".
QString scaleText(const SceneScale& scale);

/// "Run 2 finished: 118 tracks in 682 frames. 12 frames could not be registered (too few corners 9, cut 3). Scale: …";
/// without tracks it says why.
QString runSummaryText(const RunRecord& run, const RunFacts& facts);

/// Why a run has no tracks, as a sentence or two with what to do; empty when it has some.
QString whyNoTracks(const RunFacts& facts);

}  // namespace eyrie::ui

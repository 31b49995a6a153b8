#pragma once

#include <QString>
#include <cstddef>

#include "chain/recording/run_facts.h"

/// How a run ended, in words.
namespace eyrie::ui {

/// The scale of a run, where it comes from and how sure it is, as all of Eyrie words it (core/values/scale_basis.h).
QString scaleText(const RunRecord& run);

/// How shadows fall in a run, or why that is not known (core/evidence/light_finding.h); empty where there is nothing to
/// say.
QString lightText(const RunRecord& run);

/// "Run 2 finished: 118 tracks, 9 events. 0.5 s could not be searched: 12 frames could not be registered (too few
/// corners: 9, cut: 3). Scale: …"; without tracks it says why. `events`: how many were found in it; 0: none, or not
/// looked for yet.
QString runSummaryText(const RunRecord& run, const RunFacts& facts, std::size_t events = 0);

/// Why a run has no tracks, as a sentence or two with what to do; empty when it has some.
QString whyNoTracks(const RunFacts& facts);

}  // namespace eyrie::ui

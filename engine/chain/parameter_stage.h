#pragma once

#include <string>

#include "chain/chain_options.h"

namespace eyrie {

/// The first stage that a parameter touches, as its declaration says. Throws Error(internal) for a name that no stage
/// declares.
ChainStage firstStageOf(const std::string& parameter);

/// The first stage that differs between two sets of parameters; `none` when they are alike.
ChainStage firstDifference(const ChainOptions& a, const ChainOptions& b);

/// All parameters of the stages from `first` to `last`, as text: options with the same text do the same there.
std::string signatureOf(const ChainOptions& options, ChainStage first, ChainStage last);
/// The same from the beginning on: options with the same text give the same up to `last`.
std::string signatureUpTo(const ChainOptions& options, ChainStage last);
/// The same for motion vectors and what a detector prepares of a search area; see Detector::prepare().
std::string preparationSignature(const ChainOptions& options);
/// The same for motion vectors and detections in a search area.
std::string areaSignature(const ChainOptions& options);

}  // namespace eyrie

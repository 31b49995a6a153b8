#pragma once

#include <string>

#include "chain/chain_options.h"

namespace eyrie {

/// The stages of the chain as far as running it again in part goes, in their order.
enum class SweepStage { registration, motion, clustering, stacking, detection, removal, tracking, finishing };
inline constexpr int kSweepStageCount = 8;
const char* nameOf(SweepStage stage);

/// The first stage that a parameter touches, by the part of its name before the dot (and by the
/// whole name of motion.method). Throws Error(internal) for a name
/// that belongs to no stage.
SweepStage firstStageOf(const std::string& parameter);

/// All parameters that have a part in the stages up to `last`, as text: options with the same text give the same there.
std::string signatureUpTo(const ChainOptions& options, SweepStage last);
/// The same for motion vectors and what a detector prepares of a search area; see Detector::prepare().
std::string preparationSignature(const ChainOptions& options);
/// The same for motion vectors and detections in a search area.
std::string areaSignature(const ChainOptions& options);

}  // namespace eyrie

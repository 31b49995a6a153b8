#pragma once

namespace eyrie {

/// The stages of the chain in their order, as far as computing anew goes: when one begins to differ, so does all that
/// follows.
enum class ChainStage {
    registration,
    motion,
    clustering,
    stacking,
    detection,
    removal,
    tracking,
    finishing,
    none  ///< behind them all: nothing of the chain has to be computed anew
};
inline constexpr int kChainStageCount = 8;  ///< without `none`
/// The words on screen, e.g. "independent motion".
const char* nameOf(ChainStage stage);

}  // namespace eyrie

#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "canvas/marks/stack_mark.h"
#include "tune/inspect/replay_loader.h"
#include "widgets/chip_grid.h"

/// A replayed frame as pictures to look at, titled in the thesis' words. Pure functions.
namespace eyrie::ui {

/// Every step of one search (index into ReplayView::traces): raw chip, stacked image, what the method in use did with
/// it, what was kept; difference images and background where clusters come from them; general segmentation if asked
/// for.
std::vector<ChipCard> stageChips(const ReplayView& view, std::size_t trace);

/// Difference images and background of the whole frame; nothing where clusters come from motion vectors.
std::vector<ChipCard> differenceChips(const ReplayView& view);

/// Every stack of the frame: raw chip beside stacked image, under number, colour and height.
std::vector<ChipCard> stackChips(const ReplayView& view);

/// The stacks as they are drawn over the video.
std::vector<StackMark> stackMarks(const ReplayView& view);

}  // namespace eyrie::ui

#pragma once

#include <optional>

#include "core/labels/box_record.h"

namespace eyrie {

/// How far labels seem to be shifted in time against boxes that are right, such as tracks of a run.
struct OffsetGuess {
    int shift = 0;             ///< to be added to the labels' frames
    double overlap = 0;        ///< mean overlap of a label with its best box after the shift
    double overlap_as_is = 0;  ///< and without
};

/// The shift within ±`reach` frames at which labels and boxes overlap best, judged on up to some hundred frames;
/// upright boxes are compared. Nothing where labels and boxes have no frames in common or hardly meet (mean overlap
/// below 0.2).
std::optional<OffsetGuess> guessFrameOffset(const BoxesByFrame& labels, const BoxesByFrame& boxes, int reach = 10);

}  // namespace eyrie

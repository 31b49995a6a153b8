#pragma once

#include <optional>
#include <vector>

#include "core/labels/box_record.h"

namespace eyrie {

/// In what two results differ.
enum class DifferenceKind {
    only_first,   ///< an object that only the first result has
    only_second,  ///< … only the second
    box,          ///< both have it, but their boxes differ
    identity      ///< both have it, but one of them changes its id where the other does not
};

/// One object in which two results differ, over frames in a row.
struct ResultDifference {
    DifferenceKind kind = DifferenceKind::only_first;
    FrameIndex first_frame = 0;
    FrameIndex last_frame = 0;
    FrameIndex worst_frame = 0;   ///< where it shows most
    std::optional<int> first_id;  ///< the object's id in either result, where it is there and has one
    std::optional<int> second_id;
    OrientedBox box;  ///< in the worst frame
    double size = 0;  ///< frames in which it is missing, or Σ (1 − overlap) of the boxes; 1 for an identity
};

/// When two boxes are the same object, and when they differ.
struct DifferenceLimits {
    double same_object = 0.2;  ///< overlap from which two boxes are one object
    double same_box = 0.6;     ///< overlap below which the boxes of an object differ
    int gap = 2;               ///< frames without a difference that do not end one
};

/// Where two results over the same video differ, the largest first. Boxes without ids (detections) are joined over
/// frames by their overlap.
std::vector<ResultDifference> differencesOf(const BoxesByFrame& first, const BoxesByFrame& second,
                                            const DifferenceLimits& limits = {});

}  // namespace eyrie

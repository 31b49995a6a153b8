#pragma once

#include <optional>

#include "core/geometry/angle.h"
#include "core/labels/box_record.h"

/// Short ways to write down boxes in the tests of evaluation.
namespace eyrie::test {

inline constexpr double kLength = 20;
inline constexpr double kWidth = 10;

/// A car of 20 × 10 px at (x, y), driving to the right.
inline BoxRecord car(FrameIndex frame, std::optional<int> id, double x, double y = 50) {
    BoxRecord record;
    record.frame = frame;
    record.id = id;
    record.box = {{x, y}, kLength, kWidth, 0};
    record.object_class = "car";
    return record;
}

inline BoxRecord ignored(BoxRecord record) {
    record.ignore = true;
    return record;
}

/// Shift along x after which two cars overlap by `overlap`: (L − s) / (L + s) = overlap.
inline double shiftFor(double overlap) {
    return kLength * (1 - overlap) / (1 + overlap);
}

inline BoxesByFrame boxes(const std::vector<BoxRecord>& records) {
    BoxesByFrame by_frame;
    for (const BoxRecord& record : records) by_frame[record.frame].push_back(record);
    return by_frame;
}

}  // namespace eyrie::test

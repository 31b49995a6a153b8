#pragma once

#include "core/values/motion_vector.h"

namespace eyrie {

/// Ids of motion vectors that no corner carries, far above any corner's: of the outlines of plain roofs …
inline constexpr CornerId kFirstOfSilhouettes = CornerId{1} << 40;
/// … and of areas that differ between pictures.
inline constexpr CornerId kFirstOfAreas = CornerId{1} << 41;

/// Whether a vector lies on the outline of a plain roof.
inline bool isOfSilhouette(const MotionVector& vector) {
    return vector.isInferred() && vector.id < kFirstOfAreas;
}

}  // namespace eyrie

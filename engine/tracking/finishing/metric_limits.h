#pragma once

#include "core/values/scene_scale.h"

namespace eyrie {

/// Whether lengths in metres mean something: the GSD is given, or was estimated from the traffic. Not where it is the
/// assumption that a scale starts with.
inline bool hasMetricLimits(const SceneScale& scale) {
    return scale.gsd_known || scale.gsd_m_per_px != SceneScale().gsd_m_per_px;
}

}  // namespace eyrie

#pragma once

#include <string>

#include "core/values/scene_scale.h"
#include "motion/clusters/clustering_trace.h"

namespace eyrie {

/// Why nothing was clustered where clusters come from difference images.
inline constexpr char kNoMovingArea[] = "the difference image shows no moving area here";

/// Why the motion vectors of a place are in no cluster, in words: "2 motion vectors, 3 are needed", "the vectors linked
/// here are 62 px (15.5 m) long, 40 px (10 m) are allowed". Empty where nothing was compared. Why? and the list of
/// errors say the same. `here`: the scale at the place.
std::string textOf(const ClusteringVerdict& verdict, const SceneScale& here);

}  // namespace eyrie

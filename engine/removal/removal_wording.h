#pragma once

#include <string>

#include "core/values/scene_scale.h"
#include "removal/removal_trace.h"

namespace eyrie {

/// What was compared about a detection and with what, in words: "2 motion vectors move with the box, 3 are needed",
/// "4 px (1 m), at least 4.8 px (1.2 m)". Empty where nothing was compared. Why? and the list of errors say the same.
/// `here`: the scale at the detection.
std::string textOf(const RemovalVerdict& verdict, const SceneScale& here);

}  // namespace eyrie

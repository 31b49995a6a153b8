#pragma once

#include <cstddef>
#include <string>

#include "core/values/scene_scale.h"

/// Numbers in the sentences in which the engine tells what it compared.
namespace eyrie {

/// Three significant digits without trailing zeros; from 1000 on a whole number.
std::string numberText(double value);

/// "1 corner", "3 corners".
std::string countText(std::size_t count, const std::string& one, const std::string& many);

/// "12 px" or, where the scale is known, "12 px (3 m)". `here`: the scale at the place.
std::string pxText(double px, const SceneScale& here);

}  // namespace eyrie

#pragma once

#include <optional>

#include "tracking/silhouettes/silhouette_search.h"

namespace eyrie {

/// How much of what a shadow reaches beyond its vehicle lies in the box, 0 … 1. Nothing along an axis on which it
/// hardly falls.
struct ShadowShare {
    std::optional<double> along;
    std::optional<double> across;
};

/// What a look says of it. `reach`: px in the axes of the picture; `least`: share of the whole reach that must fall
/// along an axis.
ShadowShare shareInBox(const SilhouetteLook& look, cv::Point2d reach, double least);

}  // namespace eyrie

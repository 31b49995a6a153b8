#pragma once

#include <optional>
#include <vector>

#include "events/kinds/event_scene.h"

/// Inside of this room only.
namespace eyrie {

/// A zone as the paths of one ground meet it: on the ground in metres, or in the image in px.
struct PlacedZone {
    const Zone* zone = nullptr;
    std::vector<cv::Point2d> points;
    bool in_image = false;
};

/// Nothing where the zone is fixed to another ground than that of the stretch. `zone` must outlive it.
std::optional<PlacedZone> placed(const EventScene& scene, const Zone& zone, int stretch);

}  // namespace eyrie

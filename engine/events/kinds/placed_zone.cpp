#include "events/kinds/placed_zone.h"

namespace eyrie {

std::optional<PlacedZone> placed(const EventScene& scene, const Zone& zone, int stretch) {
    if (zone.anchor == ZoneAnchor::image) return PlacedZone{&zone, zone.points, true};
    if (scene.ground.indexOf(zone.frame) != stretch) return std::nullopt;
    PlacedZone result{&zone, {}, false};
    for (const cv::Point2d& point : zone.points) result.points.push_back(scene.ground.toGround(zone.frame, point));
    return result;
}

}  // namespace eyrie

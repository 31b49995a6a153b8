#include "events/kinds/drawn_ways.h"

#include <cmath>
#include <utility>

namespace eyrie {

DrawnWays::DrawnWays(const EventScene& scene, const std::vector<Zone>& zones, int stretch) : scene_(scene) {
    for (const Zone& zone : zones) {
        if (zone.shape != ZoneShape::arrow) continue;
        if (auto arrow = placed(scene, zone, stretch)) arrows_.push_back(std::move(*arrow));
    }
}

std::optional<DrawnWay> DrawnWays::at(const GroundSample& sample) const {
    std::optional<DrawnWay> nearest;
    double least = scene_.options.arrow_radius_m / sample.by_place;
    for (const PlacedZone& arrow : arrows_) {
        // An arrow that is fixed to the image lies elsewhere on the ground in every frame.
        const auto onGround = [&](cv::Point2d point) {
            return arrow.in_image ? scene_.ground.toGround(sample.frame, point) : point;
        };
        for (std::size_t i = 1; i < arrow.points.size(); ++i) {
            const cv::Point2d from = onGround(arrow.points[i - 1]), to = onGround(arrow.points[i]);
            const double far = distanceTo({from, to}, false, sample.at);
            if (!(far <= least) || from == to) continue;  // nor what lies on the horizon
            least = far;
            nearest = DrawnWay{arrow.zone, std::atan2(to.y - from.y, to.x - from.x)};
        }
    }
    return nearest;
}

}  // namespace eyrie

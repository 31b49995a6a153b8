#pragma once

#include <optional>
#include <vector>

#include "events/kinds/placed_zone.h"

/// Inside of this room only.
namespace eyrie {

/// The right way at a place, as a person drew it.
struct DrawnWay {
    const Zone* arrow = nullptr;
    double direction = 0;  ///< radians on the ground
};

/// The arrows of one ground.
class DrawnWays {
 public:
    /// `scene` and `zones` must outlive them; zones that are no arrows, or lie on another ground, say nothing.
    DrawnWays(const EventScene& scene, const std::vector<Zone>& zones, int stretch);

    /// What the nearest arrow says, where it lies within events.arrow_radius; nothing where none does.
    std::optional<DrawnWay> at(const GroundSample& sample) const;

 private:
    const EventScene& scene_;
    std::vector<PlacedZone> arrows_;
};

}  // namespace eyrie

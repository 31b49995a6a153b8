#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "annotation/pictures/box_tracker.h"
#include "core/review/track_correction.h"

namespace eyrie {

/// A vehicle around which a person drew a box, as far as it could be followed from there.
struct DrawnVehicle {
    std::vector<Sighting> sightings;  ///< ascending frames; the drawn one among them
    std::string ended_before;         ///< why it goes no further back, for people: "stopped at frame 12: …"
    std::string ended_after;
};

/// How far following has come.
struct DrawnVehicleAdvance {
    FrameIndex frame = 0;  ///< the last sure box
    bool backwards = false;
    int done = 0;       ///< frames, both ways
    int most_left = 0;  ///< of both ways; it ends earlier where it gets unsure
};

/// Follows a box that was drawn upright from `frame` on to `last`, then back to `first`, with followBox(). What was
/// sure when `stop` is requested is kept. Where the vehicle drives, its boxes are turned into the direction of its
/// motion. Throws Error(parameter) for a box that is too small.
DrawnVehicle followBothWays(const OrientedBox& box, FrameIndex frame, FrameIndex first, FrameIndex last,
                            const GrayFrames& gray, const CameraMotion& camera,
                            const std::function<void(const DrawnVehicleAdvance&)>& progress = {},
                            const std::stop_token& stop = {});

/// The boxes turned by the angle between their headings and the way they go over the ground, and as long and wide as a
/// vehicle is that so fills a box drawn upright; as they are where they hardly go anywhere.
std::vector<Sighting> turnedIntoMotion(std::vector<Sighting> sightings, const CameraMotion& camera);

}  // namespace eyrie

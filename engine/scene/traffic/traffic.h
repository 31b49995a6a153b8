#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "scene/random.h"
#include "scene/scene_description.h"
#include "scene/traffic/path.h"

namespace eyrie {

/// A place where vehicles wait while the light is red.
struct StopLine {
    double s = 0;                                ///< m along the route
    std::vector<std::pair<double, double>> red;  ///< seconds from … to, on the scene's clock (the run-up is negative)
};

/// A way through the scene with one or more parallel lanes.
struct Route {
    Path path;
    std::vector<double> lanes{0};  ///< m to the right of the path
    std::vector<StopLine> stops;
};

/// Who drives (or walks) a route.
struct Driver {
    ObjectLook look;
    int route = 0;
    int lane = 0;
    double start = 0;           ///< m along the route at the beginning of the run-up, or at `enter_time`
    double enter_time = -1e9;   ///< s; joins the traffic then
    double desired_speed = 13;  ///< m/s
    double headway = 1.0;       ///< s kept to the vehicle ahead
    double gap = 2.0;           ///< m kept when standing
    double drift = 0;           ///< m by which it strays from the middle of its lane
    bool overtakes = false;     ///< changes to a free lane when held up
};

/// Moves the drivers by a car-following law (Treiber's intelligent driver model), slowing for bends, red lights and
/// whatever stands on their way, changing lanes to overtake. `run_up` seconds pass before frame 0. The objects have ids
/// 1, 2 … in the order of the drivers; those that leave their route's end vanish.
std::vector<MovingObject> driveTraffic(const std::vector<Route>& routes, const std::vector<Driver>& drivers,
                                       int frame_count, double frame_rate_hz, double run_up);

/// Takes out vehicles that drive through one with a lower id, as may happen where streets cross without lights.
void dropColliding(std::vector<MovingObject>& objects);

/// What a camera sees that takes only every `step`-th moment of the clock.
std::vector<MovingObject> everyNth(const std::vector<MovingObject>& objects, int step);

}  // namespace eyrie

#pragma once

#include <utility>
#include <vector>

#include "scene/random.h"
#include "scene/towns/town.h"
#include "scene/traffic/traffic.h"

namespace eyrie {

/// How a lane is filled with platoons.
struct LaneLoad {
    double from = 0, to = 1e9;                ///< m along the route
    std::pair<int, int> platoon{2, 6};        ///< vehicles driving close together
    std::pair<double, double> gap{3, 8};      ///< m between their bodies at the start
    std::pair<double, double> pause{20, 60};  ///< m between platoons
    std::pair<double, double> speed{10, 14};  ///< m/s, one for each platoon
    double eager = 0.2;                       ///< share of drivers who want to go faster and overtake
    double motorcycles = 0.02;                ///< share of motorcycles
};

/// Traffic on the streets of a town.
class TownTraffic {
 public:
    TownTraffic(const Town& town, std::uint32_t seed) : town_(town), random_(seed) {}

    /// Along a street with all its lanes; returns the route's number.
    int straight(int street, bool forward);
    /// Along one lane of a street against those who use it: `forward` and `lane` name them; returns the route's number.
    int against(int street, bool forward, int lane);
    /// From one street into another at the crossing of the two. Right turns use the outer lanes, left turns the inner.
    int turn(int street_from, bool forward_from, int street_to, bool forward_to);
    /// Red light where a route reaches the crossing of `street` with `other`.
    void redLight(int route, int street, int other, bool forward, std::vector<std::pair<double, double>> red);
    void fill(int route, int lane, const LaneLoad& load);
    /// Vehicles that enter at the route's beginning, one after another for `duration` seconds, `every` apart, but in
    /// none of the stretches of time `free`; all in seconds on the scene's clock.
    void stream(int route, int lane, std::pair<double, double> speed, std::pair<double, double> every, double duration,
                const std::vector<std::pair<double, double>>& free = {});
    /// One vehicle.
    void send(int route, int lane, double start, ObjectKind kind, double speed, double enter_time = -1e9);
    /// A person or bicycle on a way of its own.
    void walk(const Path& path, double start, ObjectKind kind, double speed);
    /// People along the pavements, over the zebra crossings and on bicycles, `per_100_m` for each pavement.
    void people(int street, double per_100_m, double bicycles);
    /// People on the zebra crossings of a crossing.
    void zebraWalkers(int street, int other, int count);

    double lengthOf(int route) const { return routes_[static_cast<std::size_t>(route)].path.length(); }
    /// Arc length on a route of the point nearest to `point`.
    double nearestOn(int route, cv::Point2d point) const {
        return routes_[static_cast<std::size_t>(route)].path.nearest(point);
    }

    std::vector<MovingObject> drive(int frame_count, double frame_rate_hz, double run_up) const {
        return driveTraffic(routes_, drivers_, frame_count, frame_rate_hz, run_up);
    }

 private:
    const Crossing& crossingOf(int street, int other) const;
    bool onCrossing(cv::Point2d point) const;
    Path lanePath(int street, bool forward, int lane) const;

    const Town& town_;
    Random random_;
    std::vector<Route> routes_;
    std::vector<Driver> drivers_;
};

}  // namespace eyrie

#include "scene/traffic/town_traffic.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "scene/traffic/vehicle_shape.h"

namespace eyrie {
namespace {

/// From `a` at s_out smoothly over to `b` at s_in.
Path joined(const Path& a, double s_out, const Path& b, double s_in) {
    std::vector<cv::Point2d> points = a.part(0, s_out).points();
    const cv::Point2d p0 = a.position(s_out);
    const cv::Point2d p3 = b.position(s_in);
    const cv::Point2d way = p3 - p0;
    const double reach = 0.39 * std::sqrt(way.dot(way));
    const cv::Point2d p1 = p0 + a.direction(s_out) * reach;
    const cv::Point2d p2 = p3 - b.direction(s_in) * reach;
    const int pieces = std::max(4, static_cast<int>(std::sqrt(way.dot(way)) * 2.2));
    for (int i = 1; i < pieces; ++i) {
        const double t = static_cast<double>(i) / pieces;
        const double u = 1 - t;
        points.push_back(p0 * (u * u * u) + p1 * (3 * u * u * t) + p2 * (3 * u * t * t) + p3 * (t * t * t));
    }
    const std::vector<cv::Point2d> rest = b.part(s_in, b.length()).points();
    points.insert(points.end(), rest.begin(), rest.end());
    return Path(std::move(points));
}

}  // namespace

const Crossing& TownTraffic::crossingOf(int street, int other) const {
    for (const Crossing& crossing : town_.crossings()) {
        if ((crossing.first == street && crossing.second == other) ||
            (crossing.first == other && crossing.second == street)) {
            return crossing;
        }
    }
    throw Error(ErrorKind::internal,
                "Streets " + std::to_string(street) + " and " + std::to_string(other) + " do not cross.");
}

Path TownTraffic::lanePath(int street, bool forward, int lane) const {
    const Street& s = town_.streets()[static_cast<std::size_t>(street)];
    const Path path = forward ? s.path : s.path.reversed();
    return path.shifted(s.laneOffset(lane));
}

bool TownTraffic::onCrossing(cv::Point2d point) const {
    return std::any_of(town_.crossings().begin(), town_.crossings().end(), [&](const Crossing& crossing) {
        const cv::Point2d centre =
            town_.streets()[static_cast<std::size_t>(crossing.first)].path.position(crossing.s_first);
        const cv::Point2d offset = centre - point;
        return offset.dot(offset) < 24.0 * 24.0;
    });
}

int TownTraffic::straight(int street, bool forward) {
    const Street& s = town_.streets()[static_cast<std::size_t>(street)];
    Route route;
    route.path = forward ? s.path : s.path.reversed();
    route.lanes.clear();
    for (int lane = 0; lane < s.lanes; ++lane) route.lanes.push_back(s.laneOffset(lane));
    routes_.push_back(std::move(route));
    return static_cast<int>(routes_.size()) - 1;
}

int TownTraffic::against(int street, bool forward, int lane) {
    Route route;
    route.path = lanePath(street, forward, lane).reversed();
    routes_.push_back(std::move(route));
    return static_cast<int>(routes_.size()) - 1;
}

int TownTraffic::turn(int street_from, bool forward_from, int street_to, bool forward_to) {
    const Street& a = town_.streets()[static_cast<std::size_t>(street_from)];
    const Street& b = town_.streets()[static_cast<std::size_t>(street_to)];
    const Crossing& crossing = crossingOf(street_from, street_to);
    const double s_from = crossing.first == street_from ? crossing.s_first : crossing.s_second;
    const cv::Point2d centre = a.path.position(s_from);
    const cv::Point2d in = a.path.direction(s_from) * (forward_from ? 1.0 : -1.0);
    const cv::Point2d out = b.path.direction(b.path.nearest(centre)) * (forward_to ? 1.0 : -1.0);
    const bool right_turn = in.x * out.y - in.y * out.x > 0;
    const Path from = lanePath(street_from, forward_from, right_turn ? 0 : a.lanes - 1);
    const Path to = lanePath(street_to, forward_to, right_turn ? 0 : b.lanes - 1);
    const double slack = right_turn ? 3 : 1;
    const double s_out = from.nearest(centre) - b.halfCarriageway() - slack;
    const double s_in = to.nearest(centre) + a.halfCarriageway() + slack;
    Route route;
    route.path = joined(from, s_out, to, s_in);
    routes_.push_back(std::move(route));
    return static_cast<int>(routes_.size()) - 1;
}

void TownTraffic::redLight(int route, int street, int other, bool forward, std::vector<std::pair<double, double>> red) {
    const Crossing& crossing = crossingOf(street, other);
    const Street& s = town_.streets()[static_cast<std::size_t>(street)];
    Route& r = routes_[static_cast<std::size_t>(route)];
    const cv::Point2d line = s.path.position(town_.stopLineAt(crossing, street, forward));
    r.stops.push_back({r.path.nearest(line), std::move(red)});
}

void TownTraffic::send(int route, int lane, double start, ObjectKind kind, double speed, double enter_time) {
    Driver driver;
    driver.look = randomLook(kind, random_);
    driver.route = route;
    driver.lane = lane;
    driver.start = start;
    driver.enter_time = enter_time;
    driver.desired_speed = speed;
    driver.headway = random_.uniform(0.6, 1.2);
    driver.gap = random_.uniform(1.2, 2.4);
    driver.drift = kind == ObjectKind::motorcycle ? random_.uniform(-0.9, 0.9) : random_.uniform(-0.22, 0.22);
    drivers_.push_back(driver);
}

void TownTraffic::fill(int route, int lane, const LaneLoad& load) {
    const double end = std::min(load.to, lengthOf(route) - 5);
    double s = load.from + random_.uniform(0, load.pause.second - load.pause.first);
    while (s < end) {
        const int count = load.platoon.first + random_.below(load.platoon.second - load.platoon.first + 1);
        const double speed = random_.uniform(load.speed.first, load.speed.second);
        for (int i = 0; i < count && s < end; ++i) {
            if (onCrossing(routes_[static_cast<std::size_t>(route)].path.position(s))) {
                // Nobody starts in the middle of a crossing, where he would block it.
                s += 10;
                continue;
            }
            const ObjectKind kind =
                random_.chance(load.motorcycles) ? ObjectKind::motorcycle : randomVehicleKind(random_);
            send(route, lane, s, kind, speed * random_.uniform(0.96, 1.06));
            Driver& driver = drivers_.back();
            // Long vehicles stand around their middle.
            driver.start += driver.look.length / 2;
            s += driver.look.length + random_.uniform(load.gap.first, load.gap.second);
            if (random_.chance(load.eager)) {
                driver.desired_speed *= random_.uniform(1.2, 1.45);
                driver.overtakes = true;
            }
            driver.headway = random_.uniform(0.3, 0.8);
        }
        s += random_.uniform(load.pause.first, load.pause.second);
    }
}

void TownTraffic::stream(int route, int lane, std::pair<double, double> speed, std::pair<double, double> every,
                         double duration, const std::vector<std::pair<double, double>>& free) {
    for (double t = random_.uniform(0, every.second); t < duration; t += random_.uniform(every.first, every.second)) {
        const bool kept_free =
            std::any_of(free.begin(), free.end(), [&](const auto& span) { return t >= span.first && t < span.second; });
        if (kept_free) continue;
        send(route, lane, 8, randomVehicleKind(random_), random_.uniform(speed.first, speed.second), t);
    }
}

void TownTraffic::walk(const Path& path, double start, ObjectKind kind, double speed) {
    Route route;
    route.path = path;
    routes_.push_back(std::move(route));
    send(static_cast<int>(routes_.size()) - 1, 0, start, kind, speed);
    drivers_.back().drift = random_.uniform(-0.9, 0.9);
}

void TownTraffic::people(int street, double per_100_m, double bicycles) {
    const Street& s = town_.streets()[static_cast<std::size_t>(street)];
    const int count = static_cast<int>(s.path.length() / 100 * per_100_m);
    for (const double side : {-1.0, 1.0}) {
        for (int i = 0; i < count; ++i) {
            const bool rides = random_.chance(bicycles);
            const double right = side * (s.halfCarriageway() + (rides ? 1.3 : random_.uniform(1.6, s.pavement - 0.4)));
            Path way = s.path.shifted(right);
            if (random_.chance(0.5)) way = way.reversed();
            const double start = random_.uniform(0, way.length());
            if (rides) {
                walk(way, start, ObjectKind::bicycle, random_.uniform(3.5, 6.5));
                drivers_.back().drift = random_.uniform(-0.2, 0.2);
            } else {
                walk(way, start, ObjectKind::person, random_.uniform(0.9, 1.7));
            }
        }
    }
}

void TownTraffic::zebraWalkers(int street, int other, int count) {
    const Street& s = town_.streets()[static_cast<std::size_t>(street)];
    const Crossing& crossing = crossingOf(street, other);
    const double at = crossing.first == street ? crossing.s_first : crossing.s_second;
    const double half = town_.streets()[static_cast<std::size_t>(other)].halfCarriageway() + 3.7;
    for (int i = 0; i < count; ++i) {
        const double along = at + (random_.chance(0.5) ? half : -half);
        const double end = s.halfCarriageway() + 3;
        cv::Point2d a = s.path.beside(along, -end);
        cv::Point2d b = s.path.beside(along, end);
        if (random_.chance(0.5)) std::swap(a, b);
        const Path way = Path::rounded({a - (b - a), b + (b - a)}, 1);
        const double start = way.length() / 3 - random_.uniform(0, 9);
        walk(way, std::max(0.5, start), ObjectKind::person, random_.uniform(1.1, 1.6));
    }
}

}  // namespace eyrie

#include "scene/traffic/traffic.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.h"
#include "scene/portable_math.h"

namespace eyrie {
namespace {

constexpr double kAcceleration = 1.9;    ///< m/s²
constexpr double kBraking = 2.6;         ///< m/s², comfortable
constexpr double kHardBraking = 7.0;     ///< m/s²
constexpr double kSideways = 2.6;        ///< m/s² in bends
constexpr double kLaneChangeTime = 3.2;  ///< s
constexpr double kSight = 60;            ///< m
constexpr double kBendSight = 35;        ///< m

struct Mover {
    const Driver* driver = nullptr;
    const Route* route = nullptr;
    double s = 0;
    double speed = 0;
    double side = 0;       ///< m to the right of the path
    double side_from = 0;  ///< lane change: from here …
    double side_to = 0;    ///< … to here
    double change = 1;     ///< share of the lane change done
    int lane = 0;
    bool present = false;
    bool gone = false;
    cv::Point2d position;
    cv::Point2d direction{1, 0};
};

double fourth(double x) {
    return x * x * x * x;
}

/// The speed the driver would take on an empty road.
double freeSpeed(const Mover& mover) {
    double speed = mover.driver->desired_speed;
    if (mover.route->path.isStraight(mover.s, mover.s + kBendSight)) return std::max(speed, 0.5);
    // Slow down in time for bends: v² = v_bend² + 2 b d.
    for (double ahead = 0; ahead < kBendSight; ahead += 2.5) {
        const double bend = std::abs(mover.route->path.curvature(mover.s + ahead));
        if (bend > 1e-4) speed = std::min(speed, std::sqrt(kSideways / bend + 2 * kBraking * 0.6 * ahead));
    }
    return std::max(speed, 0.5);
}

/// Acceleration for a free road and for something `gap` metres ahead that moves at `other_speed`.
double following(const Mover& mover, double wanted, double gap, double other_speed) {
    const double free = 1 - fourth(mover.speed / wanted);
    const double approach = mover.speed * (mover.speed - other_speed) / (2 * std::sqrt(kAcceleration * kBraking));
    const double wish = mover.driver->gap + std::max(0.0, mover.speed * mover.driver->headway + approach);
    const double closeness = wish / std::max(gap, 0.1);
    return kAcceleration * (free - closeness * closeness);
}

/// Where another stands as seen along a mover's route.
struct Sighting {
    double ahead = 0;  ///< m between the centres
    double aside = 0;  ///< m to the right of the mover's line
    double speed = 0;  ///< m/s along the mover's direction there
    double half_length = 0;
    double half_width = 0;
};

bool sight(const Mover& mover, const Mover& other, double behind, Sighting& seen) {
    const cv::Point2d offset = other.position - mover.position;
    if (std::abs(offset.x) > kSight || std::abs(offset.y) > kSight) return false;
    const Path& path = mover.route->path;
    const double s = path.nearest(other.position, mover.s - behind, mover.s + kSight);
    const cv::Point2d from_path = other.position - path.position(s);
    const cv::Point2d along = path.direction(s);
    const double rest = from_path.dot(along);
    if (std::abs(rest) > 4) return false;  // beyond the searched part
    seen.ahead = s + rest - mover.s;
    seen.aside = from_path.dot(rightOf(along)) - mover.side_to;
    const double cosine = std::abs(other.direction.dot(along));
    const double sine = std::abs(other.direction.dot(rightOf(along)));
    seen.speed = other.speed * other.direction.dot(along);
    seen.half_length = (other.driver->look.length * cosine + other.driver->look.width * sine) / 2;
    seen.half_width = (other.driver->look.length * sine + other.driver->look.width * cosine) / 2;
    return true;
}

class Simulation {
 public:
    Simulation(const std::vector<Route>& routes, const std::vector<Driver>& drivers, double start) : time_(start) {
        for (const Driver& driver : drivers) {
            Mover mover;
            mover.driver = &driver;
            mover.route = &routes[static_cast<std::size_t>(driver.route)];
            mover.lane = driver.lane;
            mover.side = mover.side_from = mover.side_to = laneSide(mover, driver.lane);
            mover.s = driver.start;
            mover.speed = driver.desired_speed * 0.8;
            movers_.push_back(mover);
        }
        place();
        // Who found his place taken at the start stays away: nobody may appear in the middle of the picture.
        for (Mover& mover : movers_) mover.gone = !mover.present && mover.driver->enter_time <= time_;
    }

    const std::vector<Mover>& movers() const { return movers_; }

    void step(double dt) {
        std::vector<double> accelerations(movers_.size(), 0.0);
        for (std::size_t i = 0; i < movers_.size(); ++i) {
            if (movers_[i].present) accelerations[i] = accelerationOf(i);
        }
        for (std::size_t i = 0; i < movers_.size(); ++i) {
            Mover& mover = movers_[i];
            if (!mover.present) continue;
            const double before = mover.speed;
            mover.speed = std::max(0.0, before + accelerations[i] * dt);
            mover.s += (before + mover.speed) / 2 * dt;
            if (mover.change < 1) {
                // A lane change needs way, not time alone.
                mover.change = std::min(1.0, mover.change + dt / kLaneChangeTime * std::min(1.0, mover.speed / 5));
                const double eased =
                    mover.change * mover.change * mover.change * (10 + mover.change * (6 * mover.change - 15));
                mover.side = mover.side_from + (mover.side_to - mover.side_from) * eased;
            } else if (mover.driver->overtakes) {
                considerLaneChange(i, accelerations[i]);
            }
        }
        time_ += dt;
        place();
    }

 private:
    static double laneSide(const Mover& mover, int lane) {
        return mover.route->lanes[static_cast<std::size_t>(lane)] + mover.driver->drift;
    }

    void place() {
        for (Mover& mover : movers_) {
            if (!mover.present && !mover.gone && time_ >= mover.driver->enter_time && entryIsFree(mover))
                mover.present = true;
            if (!mover.present) continue;  // nobody asks where it is
            const double strayed =
                mover.side +
                0.12 * portable::sine(mover.s / 23 + static_cast<double>(mover.driver->look.seed % 628) / 100);
            mover.position = mover.route->path.beside(mover.s, strayed);
            const cv::Point2d tangent = mover.route->path.direction(mover.s);
            double slant = 0;
            if (mover.change < 1) {
                const double c = mover.change;
                slant = (mover.side_to - mover.side_from) * 30 * c * c * (1 - c) * (1 - c) / (kLaneChangeTime * 5);
                if (mover.speed > 5) slant *= 5 / mover.speed;
            }
            const cv::Point2d heading = tangent + rightOf(tangent) * slant;
            mover.direction = heading * (1 / std::sqrt(heading.dot(heading)));
            if (mover.s > mover.route->path.length() - 1) {
                mover.present = false;
                mover.gone = true;
            }
        }
    }

    bool entryIsFree(const Mover& mover) const {
        const cv::Point2d place = mover.route->path.beside(mover.s, mover.side);
        return std::none_of(movers_.begin(), movers_.end(), [&](const Mover& other) {
            if (!other.present) return false;
            const cv::Point2d offset = other.position - place;
            return std::sqrt(offset.dot(offset)) < (other.driver->look.length + mover.driver->look.length) / 2 + 1.0 &&
                   std::abs(offset.dot(rightOf(mover.route->path.direction(mover.s)))) < 1.8;
        });
    }

    double accelerationOf(std::size_t index) const {
        const Mover& mover = movers_[index];
        const double wanted = freeSpeed(mover);
        double best = kAcceleration * (1 - fourth(mover.speed / wanted));
        const double nose = mover.driver->look.length / 2;
        for (const StopLine& stop : mover.route->stops) {
            const double gap = stop.s - mover.s - nose;
            const bool red = std::any_of(stop.red.begin(), stop.red.end(),
                                         [&](const auto& span) { return time_ >= span.first && time_ < span.second; });
            if (!red || gap < -0.5 || gap > kSight) continue;
            if (mover.speed * mover.speed / (2 * 4.5) > gap + 0.5) continue;  // too late to stop
            best = std::min(best, following(mover, wanted, gap + mover.driver->gap - 0.4, 0));
        }
        // People on foot and on bicycles keep to ways of their own and walk on.
        if (mover.driver->look.kind == ObjectKind::person || mover.driver->look.kind == ObjectKind::bicycle)
            return best;
        for (std::size_t k = 0; k < movers_.size(); ++k) {
            const Mover& other = movers_[k];
            if (k == index || !other.present) continue;
            Sighting seen;
            if (!sight(mover, other, 0, seen)) continue;
            double aside = std::abs(seen.aside);
            // While changing lanes both the old and the new lane matter.
            if (mover.change < 1) aside = std::min(aside, std::abs(seen.aside + mover.side_to - mover.side));
            if (aside > seen.half_width + mover.driver->look.width / 2 + 0.25) continue;
            const double gap = seen.ahead - nose - seen.half_length;
            if (seen.ahead <= 0 || gap < -nose) continue;
            // Head on or crossing: the lower number has the right of way, so that nobody waits for ever.
            const double agreement = other.direction.dot(mover.direction);
            if (agreement < 0.3 && index < k && gap > 3) continue;
            best = std::min(best, following(mover, wanted, gap, std::max(0.0, seen.speed)));
        }
        return std::max(best, -kHardBraking);
    }

    void considerLaneChange(std::size_t index, double acceleration) {
        Mover& mover = movers_[index];
        const auto count = static_cast<int>(mover.route->lanes.size());
        if (count < 2 || mover.speed < 3) return;
        // Out when held up; back in to the first lane when there is room.
        const bool held_up = acceleration < 0.25 && mover.speed < 0.85 * mover.driver->desired_speed;
        const int target = held_up ? (mover.lane == 0 ? 1 : mover.lane - 1) : mover.lane - 1;
        if (target < 0 || target >= count) return;
        const double shift = laneSide(mover, target) - mover.side;
        const double room = held_up ? 9 : 22;
        for (std::size_t k = 0; k < movers_.size(); ++k) {
            if (k == index || !movers_[k].present) continue;
            Sighting seen;
            if (!sight(mover, movers_[k], 30, seen)) continue;
            if (std::abs(seen.aside - shift) > seen.half_width + mover.driver->look.width / 2 + 0.5) continue;
            const double reach = seen.half_length + mover.driver->look.length / 2;
            const double catching_up = std::max(0.0, seen.speed - mover.speed) * 2.5;
            if (seen.ahead > -(reach + 5 + catching_up) && seen.ahead < reach + room) return;
        }
        mover.lane = target;
        mover.side_from = mover.side;
        mover.side_to = laneSide(mover, target);
        mover.change = 0;
    }

    double time_;
    std::vector<Mover> movers_;
};

}  // namespace

std::vector<MovingObject> driveTraffic(const std::vector<Route>& routes, const std::vector<Driver>& drivers,
                                       int frame_count, double frame_rate_hz, double run_up) {
    const double dt = 1 / frame_rate_hz;
    const int warm = static_cast<int>(std::floor(run_up * frame_rate_hz));
    Simulation simulation(routes, drivers, -warm * dt);
    std::vector<MovingObject> objects(drivers.size());
    for (std::size_t i = 0; i < drivers.size(); ++i) {
        objects[i].id = static_cast<int>(i) + 1;
        objects[i].look = drivers[i].look;
    }
    for (int step = -warm; step < frame_count; ++step) {
        if (step >= 0) {
            for (std::size_t i = 0; i < drivers.size(); ++i) {
                const Mover& mover = simulation.movers()[i];
                if (!mover.present) continue;
                if (objects[i].poses.empty()) objects[i].first_frame = step;
                objects[i].poses.push_back({mover.position, mover.direction, mover.speed});
            }
        }
        simulation.step(dt);
    }
    return objects;
}

}  // namespace eyrie

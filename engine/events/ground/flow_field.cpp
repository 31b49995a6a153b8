#include "events/ground/flow_field.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.h"

namespace eyrie {

std::size_t FlowField::binOf(double direction) {
    const double turns = direction / (2 * kPi);
    const int bin = static_cast<int>((turns - std::floor(turns)) * kBins);
    return static_cast<std::size_t>(std::min(bin, kBins - 1));
}

std::int32_t FlowField::cellOf(double metres) const {
    return static_cast<std::int32_t>(std::clamp(std::floor(metres / (radius_ / 2)), -1e9, 1e9));
}

FlowField::Votes FlowField::votesOf(const GroundPath& path) const {
    struct Passed {
        cv::Point2d sum{0, 0};  ///< of directions
        bool any = false;
    };
    CellTiles<Passed> passed;
    const double cell = radius_ / 2;
    cv::Point2d before(0, 0);
    bool any = false;
    const auto stamp = [&](cv::Point2d at, cv::Point2d direction) {
        const std::int32_t column = cellOf(at.x), row = cellOf(at.y);
        for (std::int32_t dy = -2; dy <= 2; ++dy) {
            for (std::int32_t dx = -2; dx <= 2; ++dx) {
                const cv::Point2d way = cv::Point2d((column + dx + 0.5) * cell, (row + dy + 0.5) * cell) - at;
                if (!(way.dot(way) <= radius_ * radius_)) continue;
                Passed& place = passed.at(column + dx, row + dy);
                place.sum += direction;
                place.any = true;
            }
        }
    };
    for (const GroundSample& sample : path.samples) {
        if (!sample.moving || !(sample.speed > 0)) {
            any = false;
            continue;
        }
        const cv::Point2d direction = sample.velocity * (1 / sample.speed);
        const cv::Point2d step = any ? sample.at - before : cv::Point2d(0, 0);
        const double way = std::hypot(step.x, step.y);
        if (any && way < cell) continue;
        // Fast vehicles in slow videos pass several places between two frames.
        const int parts = std::clamp(static_cast<int>(way / cell), 1, 100);
        for (int part = 1; part <= parts; ++part)
            stamp(any ? before + step * (double{1} * part / parts) : sample.at, direction);
        before = sample.at;
        any = true;
    }
    Votes votes;
    for (const auto& [key, places] : passed.tiles()) {
        auto& bins = votes.bins_.tile(key);
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (!places[i].any) continue;
            bins[i] = static_cast<std::uint8_t>(binOf(std::atan2(places[i].sum.y, places[i].sum.x)) + 1);
            ++votes.places_;
        }
    }
    return votes;
}

void FlowField::add(const Votes& votes) {
    for (const auto& [key, bins] : votes.bins_.tiles()) {
        auto& places = places_.tile(key);
        for (std::size_t i = 0; i < bins.size(); ++i)
            if (bins[i] > 0) ++places[i][bins[i] - std::size_t{1}];
    }
}

FlowField::Others FlowField::othersAt(cv::Point2d place, double direction, double against_angle,
                                      const Votes& own) const {
    const std::int32_t column = cellOf(place.x), row = cellOf(place.y);
    const Bins* found = places_.find(column, row);
    if (found == nullptr) return {};
    Bins bins = *found;
    const std::uint8_t* mine = own.bins_.find(column, row);
    if (mine != nullptr && *mine > 0) --bins[*mine - std::size_t{1}];
    Others others;
    for (std::size_t i = 0; i < bins.size(); ++i) {
        if (bins[i] == 0) continue;
        const double turn = std::abs(turnBetween(direction, 2 * kPi * (static_cast<double>(i) + 0.5) / kBins));
        others.all += bins[i];
        if (turn <= kAlong) others.along += bins[i];
        if (turn > against_angle) others.against += bins[i];
    }
    return others;
}

}  // namespace eyrie

#include "events/ground/flow_field.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

std::uint64_t FlowField::key(std::int32_t column, std::int32_t row) {
    return std::uint64_t{static_cast<std::uint32_t>(column)} << 32 | static_cast<std::uint32_t>(row);
}

FlowField::Votes FlowField::votesOf(const GroundPath& path) const {
    std::unordered_map<std::uint64_t, cv::Point2d> sums;
    const double cell = radius_ / 2;
    cv::Point2d before(0, 0);
    bool any = false;
    const auto stamp = [&](cv::Point2d at, cv::Point2d direction) {
        const std::int32_t column = cellOf(at.x), row = cellOf(at.y);
        for (std::int32_t dy = -2; dy <= 2; ++dy) {
            for (std::int32_t dx = -2; dx <= 2; ++dx) {
                const cv::Point2d centre((column + dx + 0.5) * cell, (row + dy + 0.5) * cell);
                if (std::hypot(centre.x - at.x, centre.y - at.y) <= radius_)
                    sums[key(column + dx, row + dy)] += direction;
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
    votes.reserve(sums.size());
    for (const auto& [place, sum] : sums) votes.emplace(place, std::atan2(sum.y, sum.x));
    return votes;
}

void FlowField::add(const Votes& votes) {
    for (const auto& [place, direction] : votes) ++places_[place][binOf(direction)];
}

FlowField::Others FlowField::othersAt(cv::Point2d place, double direction, double against_angle,
                                      const Votes& own) const {
    const std::uint64_t at = key(cellOf(place.x), cellOf(place.y));
    const auto found = places_.find(at);
    if (found == places_.end()) return {};
    Bins bins = found->second;
    const auto mine = own.find(at);
    if (mine != own.end()) --bins[binOf(mine->second)];
    Others others;
    for (std::size_t i = 0; i < bins.size(); ++i) {
        const double turn = std::abs(turnBetween(direction, 2 * kPi * (static_cast<double>(i) + 0.5) / kBins));
        others.all += bins[i];
        if (turn <= kAlong) others.along += bins[i];
        if (turn > against_angle) others.against += bins[i];
    }
    return others;
}

}  // namespace eyrie

#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/geometry/angle.h"
#include "events/ground/ground_path.h"

namespace eyrie {

/// In which directions tracks pass the places of one ground. Each track counts once a place, so that neither slow nor
/// standing vehicles count more than others.
class FlowField {
 public:
    /// Tracks count wherever they come within `radius_m`.
    explicit FlowField(double radius_m) : radius_(radius_m) {}

    static constexpr double kAlong = kPi / 3;  ///< radians: directions that differ by no more are alike

    /// Directions (radians) of one track by places it passes.
    using Votes = std::unordered_map<std::uint64_t, double>;
    Votes votesOf(const GroundPath& path) const;
    void add(const Votes& votes);

    /// The other tracks at a place, by their direction relative to one that is asked about.
    struct Others {
        int along = 0;    ///< within kAlong
        int against = 0;  ///< further away than the angle that was given
        int all = 0;
    };
    /// `own` are the votes of the track that asks, which must have been added.
    Others othersAt(cv::Point2d place, double direction, double against_angle, const Votes& own) const;

 private:
    static constexpr int kBins = 24;
    using Bins = std::array<std::int32_t, kBins>;
    static std::size_t binOf(double direction);
    std::int32_t cellOf(double metres) const;
    static std::uint64_t key(std::int32_t column, std::int32_t row);

    double radius_;
    std::unordered_map<std::uint64_t, Bins> places_;
};

}  // namespace eyrie

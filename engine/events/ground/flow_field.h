#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/geometry/angle.h"
#include "events/ground/cell_tiles.h"
#include "events/ground/ground_path.h"

namespace eyrie {

/// In which directions tracks pass the places of one ground. Each track counts once a place, so that neither slow nor
/// standing vehicles count more than others.
class FlowField {
 public:
    /// Tracks count wherever they come within `radius_m`.
    explicit FlowField(double radius_m) : radius_(radius_m) {}

    static constexpr double kAlong = kPi / 3;  ///< radians: directions that differ by no more are alike

    /// The places that one track passes, and in which direction.
    class Votes {
     public:
        std::size_t size() const { return places_; }

     private:
        friend class FlowField;
        CellTiles<std::uint8_t> bins_;  ///< the bin plus 1; 0: not passed
        std::size_t places_ = 0;
    };
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

    double radius_;
    CellTiles<Bins> places_;
};

}  // namespace eyrie

#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "annotation/interpolation.h"

namespace eyrie {

/// A keyframe in the coordinates the path is drawn in.
struct Knot {
    double time = 0;  ///< frames
    cv::Point2d point;
    double length = 0;
    double width = 0;
    double heading = 0;
    bool heading_set = false;
    bool upright = false;  ///< its heading is that of the image's axes and says nothing of where it drives
};

/// The path through a few neighbouring keyframes. A piece i runs from knot i to knot i + 1; `share` is how far along
/// it a moment is, 0 … 1.
class KeyframePath {
 public:
    /// `along_headings`: directions of movement are headings, which they are on the ground, not in a moving picture.
    KeyframePath(PathShape shape, bool along_headings) : shape_(shape), along_headings_(along_headings) {}
    /// After the last knot the object stands: it brakes until there.
    void setStandsAfter(bool stands) { stands_after_ = stands; }
    void add(const Knot& knot) { knots_[count_++] = knot; }
    static constexpr std::size_t kMaxKnots = 6;

    const Knot& knot(std::size_t i) const { return knots_[i]; }
    std::size_t count() const { return count_; }

    cv::Point2d position(std::size_t piece, double share) const;
    /// Whether the ends of a piece are far enough apart for its direction to mean anything.
    bool moving(std::size_t piece) const;
    double heading(std::size_t piece, double share) const;
    /// The heading at a knot: as set, or along the path, or as stored where there is no movement.
    double headingAt(std::size_t knot) const;
    bool headingFollowsPath(std::size_t knot) const {
        return !knots_[knot].heading_set && directionAt(knot).has_value();
    }

 private:
    cv::Point2d slope(std::size_t piece) const;
    /// Velocity at a knot: of the parabola through it and its neighbours.
    cv::Point2d tangent(std::size_t knot) const;
    /// The same as a piece takes it that ends there.
    cv::Point2d tangentIn(std::size_t piece, std::size_t knot) const;
    /// Turns of the chord to the headings at both ends of a piece that is driven along them.
    struct Turns {
        double leave = 0;
        double arrive = 0;
    };
    std::optional<Turns> turnsOf(std::size_t piece) const;
    /// Whether both headings of a piece are set and mean where the vehicle heads.
    bool headed(std::size_t piece) const;
    /// Speed on a piece: along the curve where it is driven along its headings.
    double speedOn(std::size_t piece) const;
    /// Speed at one end of a piece, from the speeds beside it.
    double speedIn(std::size_t piece, std::size_t knot) const;
    /// How much a piece learns from the one beyond the knot, 0 … 1.
    double trust(std::size_t piece, std::size_t knot) const;
    /// The same for one piece: where both its headings are set, vehicles drive along them.
    cv::Point2d velocityAt(std::size_t piece, std::size_t knot) const;
    struct Drive {
        cv::Point2d point;
        double direction = 0;
    };
    std::optional<Drive> driven(std::size_t piece, double share) const;
    double direction(std::size_t piece, double share) const;
    std::optional<double> directionAt(std::size_t knot) const;

    PathShape shape_;
    bool along_headings_;
    bool stands_after_ = false;
    std::array<Knot, kMaxKnots> knots_;
    std::size_t count_ = 0;
};

}  // namespace eyrie

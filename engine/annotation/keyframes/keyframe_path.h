#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "annotation/keyframes/interpolation.h"

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

/// The path through a few neighbouring keyframes. A piece i runs from knot i to knot i + 1.
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

    /// Whether the ends of a piece are far enough apart for its direction to mean anything.
    bool moving(std::size_t piece) const;
    /// The heading at a knot: as set, or along the path, or as stored where there is no movement.
    double headingAt(std::size_t knot) const;
    bool headingFollowsPath(std::size_t knot) const {
        return !knots_[knot].heading_set && directionAt(knot).has_value();
    }

 private:
    friend class PieceCurve;
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
    std::optional<double> directionAt(std::size_t knot) const;

    PathShape shape_;
    bool along_headings_;
    bool stands_after_ = false;
    std::array<Knot, kMaxKnots> knots_;
    std::size_t count_ = 0;
};

/// Where an object is on one piece of a path, and in which direction it goes there. What is the same all along the
/// piece is worked out once. `share` is how far along a moment is, 0 … 1.
class PieceCurve {
 public:
    PieceCurve(const KeyframePath& path, std::size_t piece);
    cv::Point2d position(double share) const;
    double direction(double share) const;

 private:
    static constexpr std::size_t kSteps = 16;
    /// A cubic through place and heading at both ends, passed at a speed that changes smoothly from end to end.
    struct Drive {
        cv::Point2d first;                     ///< velocity along the cubic at its begin
        cv::Point2d last;                      ///< … and at its end
        std::array<double, kSteps + 1> way{};  ///< px driven after so many of its steps
        double start = 0;                      ///< px per piece at its begin
        double end = 0;
    };
    cv::Point2d pointAt(double s) const;
    /// How much of the cubic is driven after a share of the time.
    double driven(double share) const;

    bool straight_;
    cv::Point2d from_;
    cv::Point2d chord_;
    std::optional<Drive> drive_;
    cv::Point2d leave_;  ///< velocities at the ends of what is not driven along headings, px per piece
    cv::Point2d arrive_;
};

/// Place and heading along one piece of a path.
class PathPiece {
 public:
    PathPiece(const KeyframePath& path, std::size_t piece);
    cv::Point2d position(double share) const { return curve_.position(share); }
    double heading(double share) const;

 private:
    PieceCurve curve_;
    bool turns_with_path_;
    double leave_;  ///< headings at the ends
    double arrive_;
    double first_ = 0;   ///< turn of the heading against the path at the begin
    double change_ = 0;  ///< of that turn until the end
};

}  // namespace eyrie

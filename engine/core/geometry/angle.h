#pragma once

#include <cmath>
#include <numbers>

/// Arithmetic of directions. Headings are radians inside the engine, clockwise from +x as seen on screen (y points
/// down); degrees in [0, 360) appear in files and on screen only.
namespace eyrie {

inline constexpr double kPi = std::numbers::pi;

/// The same direction in (−π, π].
inline double wrapPi(double radians) {
    const double wrapped = std::remainder(radians, 2 * kPi);
    return wrapped <= -kPi ? wrapped + 2 * kPi : wrapped;
}

/// Signed shortest turn from `from` to `to`, radians in (−π, π].
inline double turnBetween(double from, double to) {
    return wrapPi(to - from);
}

/// Signed shortest turn between two axes, for boxes whose front and rear are not distinguished, in (−π/2, π/2].
inline double axisTurnBetween(double from, double to) {
    const double turn = std::remainder(to - from, kPi);
    return turn <= -kPi / 2 ? turn + kPi : turn;
}

inline double radiansFromDegrees(double degrees) {
    return degrees * kPi / 180.0;
}

/// Degrees in [0, 360).
inline double degreesFromRadians(double radians) {
    const double degrees = std::fmod(radians * 180.0 / kPi, 360.0);
    const double positive = degrees < 0 ? degrees + 360.0 : degrees;
    return positive >= 360.0 ? 0.0 : positive;
}

}  // namespace eyrie

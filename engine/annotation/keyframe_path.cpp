#include "annotation/keyframe_path.h"

#include <algorithm>
#include <cmath>

#include "core/angle.h"

namespace eyrie {
namespace {

double lengthOf(cv::Point2d v) {
    return std::hypot(v.x, v.y);
}

double angleOf(cv::Point2d v) {
    return std::atan2(v.y, v.x);
}

cv::Point2d limited(cv::Point2d v, double longest) {
    const double length = lengthOf(v);
    return length > longest ? v * (longest / length) : v;
}

// A tangent up to three times the slope keeps a cubic piece from running back (Fritsch and Carlson 1980).
constexpr double kLongestTangent = 3;
// A piece shorter than this share of the one beside it tells it little: a pixel of its ends is a lot of its speed.
constexpr double kLeastShare = 1.0 / 3;
// Between the heading and the direction of the path, radians.
constexpr double kLargestSlip = 0.6;
// Curves that are driven: headings against the chord, and their difference, radians.
constexpr double kSharpestHalfTurn = 1.2;
constexpr double kLeastTurn = 0.1;

}  // namespace

cv::Point2d KeyframePath::slope(std::size_t piece) const {
    return (knots_[piece + 1].point - knots_[piece].point) * (1 / (knots_[piece + 1].time - knots_[piece].time));
}

bool KeyframePath::moving(std::size_t piece) const {
    const double length = (knots_[piece].length + knots_[piece + 1].length) / 2;
    return lengthOf(knots_[piece + 1].point - knots_[piece].point) >= std::max(1.0, length / 2);
}

bool KeyframePath::headed(std::size_t piece) const {
    const Knot& a = knots_[piece];
    const Knot& b = knots_[piece + 1];
    return a.heading_set && b.heading_set && !(a.upright && b.upright) && moving(piece);
}

std::optional<KeyframePath::Turns> KeyframePath::turnsOf(std::size_t piece) const {
    if (shape_ == PathShape::straight || !along_headings_) return std::nullopt;
    if (!headed(piece)) return std::nullopt;
    const double along = angleOf(knots_[piece + 1].point - knots_[piece].point);
    const Turns turns{turnBetween(along, knots_[piece].heading), turnBetween(along, knots_[piece + 1].heading)};
    if (std::abs(turns.leave) > kSharpestHalfTurn || std::abs(turns.arrive) > kSharpestHalfTurn) return std::nullopt;
    return turns;
}

double KeyframePath::speedOn(std::size_t piece) const {
    const double speed = lengthOf(slope(piece));
    const auto turns = turnsOf(piece);
    const double half = turns ? std::abs(turns->arrive - turns->leave) / 2 : 0;
    // An arc is longer than its chord.
    return half > 1e-3 ? speed * half / std::sin(half) : speed;
}

double KeyframePath::trust(std::size_t piece, std::size_t knot) const {
    const std::size_t beside = knot == piece ? piece - 1 : piece + 1;
    const double own = knots_[piece + 1].time - knots_[piece].time;
    const double other = knots_[beside + 1].time - knots_[beside].time;
    return std::min(1.0, other / (kLeastShare * own));
}

double KeyframePath::speedIn(std::size_t piece, std::size_t knot) const {
    const double own = speedOn(piece);
    if (knot > 0 && knot + 1 < count_) {
        const double before = knots_[knot].time - knots_[knot - 1].time;
        const double after = knots_[knot + 1].time - knots_[knot].time;
        const double a = speedOn(knot - 1);
        const double b = speedOn(knot);
        const double both = std::min((a * after + b * before) / (before + after), kLongestTangent * std::min(a, b));
        return own + (both - own) * trust(piece, knot);
    }
    if (stands_after_ && knot + 1 == count_) return 0;
    if (count_ == 2 && !stands_after_) return own;
    return std::clamp(2 * own - speedIn(piece, knot == 0 ? 1 : knot - 1), 0.0, kLongestTangent * own);
}

cv::Point2d KeyframePath::velocityAt(std::size_t piece, std::size_t knot) const {
    const cv::Point2d free = tangentIn(piece, knot);
    const double speed = speedIn(piece, knot);
    if (!along_headings_ || !headed(piece) || lengthOf(free) < 1e-9) return free;
    const double heading = knots_[knot].heading;
    const double turn = std::abs(turnBetween(angleOf(free), heading));
    // What skids or is pushed does not drive where it heads.
    if (turn > kLargestSlip && turn < kPi - kLargestSlip) return free;
    return cv::Point2d(std::cos(heading), std::sin(heading)) * (turn <= kLargestSlip ? speed : -speed);
}

cv::Point2d KeyframePath::tangent(std::size_t knot) const {
    if (knot == 0) return tangentIn(0, 0);
    if (knot + 1 == count_) return tangentIn(knot - 1, knot);
    const double before = knots_[knot].time - knots_[knot - 1].time;
    const double after = knots_[knot + 1].time - knots_[knot].time;
    const cv::Point2d a = slope(knot - 1);
    const cv::Point2d b = slope(knot);
    // The parabola through three knots.
    return limited((a * after + b * before) * (1 / (before + after)),
                   kLongestTangent * std::min(lengthOf(a), lengthOf(b)));
}

cv::Point2d KeyframePath::tangentIn(std::size_t piece, std::size_t knot) const {
    const cv::Point2d own = slope(piece);
    if (knot > 0 && knot + 1 < count_) return own + (tangent(knot) - own) * trust(piece, knot);
    if (stands_after_ && knot + 1 == count_) return {0, 0};
    if (count_ == 2 && !stands_after_) return own;
    // At the ends the parabola that meets the tangent at the other end of the piece.
    const cv::Point2d end = own * 2 - tangentIn(piece, knot == 0 ? 1 : knot - 1);
    if (end.dot(own) <= 0) return {0, 0};
    return limited(end, kLongestTangent * lengthOf(own));
}

/// Where on its way a vehicle is that drives a curve: a cubic through place and heading at both ends, passed at a speed
/// that changes smoothly from end to end. How it turns and how it brakes are then told apart.
std::optional<KeyframePath::Drive> KeyframePath::driven(std::size_t piece, double share) const {
    const auto turns = turnsOf(piece);
    if (!turns || std::abs(turns->arrive - turns->leave) < kLeastTurn) return std::nullopt;
    const cv::Point2d chord = knots_[piece + 1].point - knots_[piece].point;
    const double length = lengthOf(chord);
    const double along = angleOf(chord);
    const auto [leave, arrive] = *turns;
    const double turn = arrive - leave;
    // The cubic that is nearest to an arc of this turn.
    const double pull = length / std::pow(std::cos(turn / 4), 2);
    const cv::Point2d first = cv::Point2d(std::cos(along + leave), std::sin(along + leave)) * pull;
    const cv::Point2d last = cv::Point2d(std::cos(along + arrive), std::sin(along + arrive)) * pull;
    const auto pointAt = [&](double s) {
        return chord * (s * s * (3 - 2 * s)) + first * (s * (s - 1) * (s - 1)) + last * (s * s * (s - 1));
    };
    constexpr int kSteps = 16;
    std::array<double, kSteps + 1> way{};
    cv::Point2d before(0, 0);
    for (int i = 1; i <= kSteps; ++i) {
        const cv::Point2d point = pointAt(static_cast<double>(i) / kSteps);
        way[static_cast<std::size_t>(i)] = way[static_cast<std::size_t>(i) - 1] + lengthOf(point - before);
        before = point;
    }
    const double whole = way[kSteps];
    const double duration = knots_[piece + 1].time - knots_[piece].time;
    const double start = std::min(speedIn(piece, piece) * duration, kLongestTangent * whole);
    const double end = std::min(speedIn(piece, piece + 1) * duration, kLongestTangent * whole);
    const double t = share;
    const double gone = whole * t * t * (3 - 2 * t) + start * t * (t - 1) * (t - 1) + end * t * t * (t - 1);
    const auto next = std::upper_bound(way.begin() + 1, way.end() - 1, gone);
    const auto i = static_cast<std::size_t>(next - way.begin());
    const double s = (static_cast<double>(i) - 1 + (gone - way[i - 1]) / std::max(1e-9, way[i] - way[i - 1])) / kSteps;
    Drive drive;
    drive.point = knots_[piece].point + pointAt(s);
    drive.direction = angleOf(chord * (6 * s * (1 - s)) + first * ((s - 1) * (3 * s - 1)) + last * (s * (3 * s - 2)));
    return drive;
}

cv::Point2d KeyframePath::position(std::size_t piece, double share) const {
    const cv::Point2d a = knots_[piece].point;
    const cv::Point2d b = knots_[piece + 1].point;
    if (shape_ == PathShape::straight) return a + (b - a) * share;
    if (const auto drive = driven(piece, share)) return drive->point;
    const double duration = knots_[piece + 1].time - knots_[piece].time;
    const cv::Point2d leave = velocityAt(piece, piece) * duration;
    const cv::Point2d arrive = velocityAt(piece, piece + 1) * duration;
    const double s2 = share * share;
    const double s3 = s2 * share;
    return a + (b - a) * (3 * s2 - 2 * s3) + leave * (s3 - 2 * s2 + share) + arrive * (s3 - s2);
}

double KeyframePath::direction(std::size_t piece, double share) const {
    const cv::Point2d chord = knots_[piece + 1].point - knots_[piece].point;
    if (shape_ == PathShape::straight) return angleOf(chord);
    if (const auto drive = driven(piece, share)) return drive->direction;
    // Where the object stands still for a moment, the direction just inside the piece.
    const double s = std::clamp(share, 1e-3, 1 - 1e-3);
    const double duration = knots_[piece + 1].time - knots_[piece].time;
    const cv::Point2d leave = velocityAt(piece, piece) * duration;
    const cv::Point2d arrive = velocityAt(piece, piece + 1) * duration;
    const cv::Point2d velocity =
        chord * (6 * s - 6 * s * s) + leave * (3 * s * s - 4 * s + 1) + arrive * (3 * s * s - 2 * s);
    return lengthOf(velocity) > 1e-9 ? angleOf(velocity) : angleOf(chord);
}

std::optional<double> KeyframePath::directionAt(std::size_t knot) const {
    if (knot + 1 < count_ && moving(knot)) {
        if (shape_ == PathShape::smooth && knot > 0 && moving(knot - 1)) {
            const cv::Point2d along = tangent(knot);
            if (lengthOf(along) > 1e-9) return angleOf(along);
        }
        return direction(knot, 0);
    }
    if (knot > 0 && moving(knot - 1)) return direction(knot - 1, 1);
    return std::nullopt;
}

double KeyframePath::headingAt(std::size_t knot) const {
    if (knots_[knot].heading_set) return knots_[knot].heading;
    return directionAt(knot).value_or(knots_[knot].heading);
}

double KeyframePath::heading(std::size_t piece, double share) const {
    const double leave = headingAt(piece);
    const double arrive = headingAt(piece + 1);
    if (!moving(piece)) return wrapPi(leave + share * turnBetween(leave, arrive));
    // The turn of the heading against the path, so that a set heading fades into the path's.
    const double first = turnBetween(direction(piece, 0), leave);
    const double last = turnBetween(direction(piece, 1), arrive);
    const double change = turnBetween(first, last);
    // Set headings that have little to do with the path turn by themselves.
    const bool both_set = knots_[piece].heading_set && knots_[piece + 1].heading_set;
    if (both_set && std::abs(change) > kLargestSlip / 2) return wrapPi(leave + share * turnBetween(leave, arrive));
    return wrapPi(direction(piece, share) + first + share * change);
}

}  // namespace eyrie

#include "annotation/keyframes/keyframe_path.h"

#include <algorithm>
#include <cmath>

#include "annotation/keyframes/path_limits.h"
#include "core/geometry/angle.h"

namespace eyrie {
namespace {

using path_limits::angleOf;
using path_limits::kLargestSlip;
using path_limits::kLeastShare;
using path_limits::kLongestTangent;
using path_limits::kSharpestHalfTurn;
using path_limits::lengthOf;

cv::Point2d limited(cv::Point2d v, double longest) {
    const double length = lengthOf(v);
    return length > longest ? v * (longest / length) : v;
}

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

std::optional<double> KeyframePath::directionAt(std::size_t knot) const {
    if (knot + 1 < count_ && moving(knot)) {
        if (shape_ == PathShape::smooth && knot > 0 && moving(knot - 1)) {
            const cv::Point2d along = tangent(knot);
            if (lengthOf(along) > 1e-9) return angleOf(along);
        }
        return PieceCurve(*this, knot).direction(0);
    }
    if (knot > 0 && moving(knot - 1)) return PieceCurve(*this, knot - 1).direction(1);
    return std::nullopt;
}

double KeyframePath::headingAt(std::size_t knot) const {
    if (knots_[knot].heading_set) return knots_[knot].heading;
    return directionAt(knot).value_or(knots_[knot].heading);
}

}  // namespace eyrie

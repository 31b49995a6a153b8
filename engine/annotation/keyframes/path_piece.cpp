#include <algorithm>
#include <cmath>

#include "annotation/keyframes/keyframe_path.h"
#include "annotation/keyframes/path_limits.h"
#include "core/geometry/angle.h"

namespace eyrie {

using path_limits::angleOf;
using path_limits::kLargestSlip;
using path_limits::kLeastTurn;
using path_limits::kLongestTangent;
using path_limits::lengthOf;

/// How a vehicle turns and how it brakes are told apart where it drives a curve.
PieceCurve::PieceCurve(const KeyframePath& path, std::size_t piece)
    : straight_(path.shape_ == PathShape::straight),
      from_(path.knots_[piece].point),
      chord_(path.knots_[piece + 1].point - path.knots_[piece].point) {
    if (straight_) return;
    const double duration = path.knots_[piece + 1].time - path.knots_[piece].time;
    const auto turns = path.turnsOf(piece);
    if (!turns || std::abs(turns->arrive - turns->leave) < kLeastTurn) {
        leave_ = path.velocityAt(piece, piece) * duration;
        arrive_ = path.velocityAt(piece, piece + 1) * duration;
        return;
    }
    Drive& drive = drive_.emplace();
    const double along = angleOf(chord_);
    const auto [leave, arrive] = *turns;
    const double turn = arrive - leave;
    // The cubic that is nearest to an arc of this turn.
    const double pull = lengthOf(chord_) / std::pow(std::cos(turn / 4), 2);
    drive.first = cv::Point2d(std::cos(along + leave), std::sin(along + leave)) * pull;
    drive.last = cv::Point2d(std::cos(along + arrive), std::sin(along + arrive)) * pull;
    cv::Point2d before(0, 0);
    for (std::size_t i = 1; i <= kSteps; ++i) {
        const cv::Point2d point = pointAt(static_cast<double>(i) / kSteps);
        drive.way[i] = drive.way[i - 1] + lengthOf(point - before);
        before = point;
    }
    const double whole = drive.way[kSteps];
    drive.start = std::min(path.speedIn(piece, piece) * duration, kLongestTangent * whole);
    drive.end = std::min(path.speedIn(piece, piece + 1) * duration, kLongestTangent * whole);
}

cv::Point2d PieceCurve::pointAt(double s) const {
    return chord_ * (s * s * (3 - 2 * s)) + drive_->first * (s * (s - 1) * (s - 1)) + drive_->last * (s * s * (s - 1));
}

double PieceCurve::driven(double share) const {
    const auto& way = drive_->way;
    const double t = share;
    const double gone =
        way[kSteps] * t * t * (3 - 2 * t) + drive_->start * t * (t - 1) * (t - 1) + drive_->end * t * t * (t - 1);
    const auto next = std::upper_bound(way.begin() + 1, way.end() - 1, gone);
    const auto i = static_cast<std::size_t>(next - way.begin());
    return (static_cast<double>(i) - 1 + (gone - way[i - 1]) / std::max(1e-9, way[i] - way[i - 1])) / kSteps;
}

cv::Point2d PieceCurve::position(double share) const {
    if (straight_) return from_ + chord_ * share;
    if (drive_) return from_ + pointAt(driven(share));
    const double s2 = share * share;
    const double s3 = s2 * share;
    return from_ + chord_ * (3 * s2 - 2 * s3) + leave_ * (s3 - 2 * s2 + share) + arrive_ * (s3 - s2);
}

double PieceCurve::direction(double share) const {
    if (straight_) return angleOf(chord_);
    if (drive_) {
        const double s = driven(share);
        return angleOf(chord_ * (6 * s * (1 - s)) + drive_->first * ((s - 1) * (3 * s - 1)) +
                       drive_->last * (s * (3 * s - 2)));
    }
    // Where the object stands still for a moment, the direction just inside the piece.
    const double s = std::clamp(share, 1e-3, 1 - 1e-3);
    const cv::Point2d velocity =
        chord_ * (6 * s - 6 * s * s) + leave_ * (3 * s * s - 4 * s + 1) + arrive_ * (3 * s * s - 2 * s);
    return lengthOf(velocity) > 1e-9 ? angleOf(velocity) : angleOf(chord_);
}

PathPiece::PathPiece(const KeyframePath& path, std::size_t piece)
    : curve_(path, piece),
      turns_with_path_(path.moving(piece)),
      leave_(path.headingAt(piece)),
      arrive_(path.headingAt(piece + 1)) {
    if (!turns_with_path_) return;
    // The turn of the heading against the path, so that a set heading fades into the path's.
    first_ = turnBetween(curve_.direction(0), leave_);
    change_ = turnBetween(first_, turnBetween(curve_.direction(1), arrive_));
    // Set headings that have little to do with the path turn by themselves.
    const bool both_set = path.knot(piece).heading_set && path.knot(piece + 1).heading_set;
    if (both_set && std::abs(change_) > kLargestSlip / 2) turns_with_path_ = false;
}

double PathPiece::heading(double share) const {
    if (!turns_with_path_) return wrapPi(leave_ + share * turnBetween(leave_, arrive_));
    return wrapPi(curve_.direction(share) + first_ + share * change_);
}

}  // namespace eyrie

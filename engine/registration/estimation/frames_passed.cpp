#include "registration/estimation/frames_passed.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "registration/estimation/point_jacobian.h"
#include "registration/pictures/scaled_to_one.h"

namespace eyrie {
namespace {

constexpr double kTellingPx = 4;       ///< by which pictures differ where a camera goes on or not, to tell it by
constexpr double kTellingMoverPx = 2;  ///< the same of what moves by itself, at …
constexpr double kTellingSpeed = 0.7;  ///< … px/frame or more, …
constexpr double kMoverPx = 1.5;       ///< … which is found this near to where it should be, …
constexpr double kMoverShare = 0.15;   ///< … and by this share of its way, but nearer to it than to the other place
constexpr int kLongStall = 3;          ///< frozen frames; more are no rhythm of the video but a gap in it

/// The farthest that any corner of a picture lies from where another map takes it, px.
double apart(const cv::Matx33d& a, const cv::Matx33d& b, cv::Size image) {
    double farthest = 0;
    for (const float x : {0.0F, float(image.width - 1)}) {
        for (const float y : {0.0F, float(image.height - 1)}) {
            const cv::Point2d off = PointJacobian(a, {x, y}).point - PointJacobian(b, {x, y}).point;
            farthest = std::max(farthest, std::hypot(off.x, off.y));
        }
    }
    return farthest;
}

/// What comes of the given motions on average, each a small one.
cv::Matx33d meanOf(const std::deque<cv::Matx33d>& motions) {
    cv::Matx33d whole = cv::Matx33d::eye();
    for (const cv::Matx33d& motion : motions) whole = scaledToOne(motion * whole);
    if (motions.empty()) return whole;
    return cv::Matx33d::eye() + (whole - cv::Matx33d::eye()) * (1.0 / static_cast<double>(motions.size()));
}

}  // namespace

std::vector<int> framesPassedBy(const cv::Matx33d& motion, const std::deque<cv::Matx33d>& recent, int repeated,
                                int most, cv::Size image) {
    // Either the pictures in between were lost, or the video only paused.
    const cv::Matx33d usual = meanOf(recent);
    const cv::Matx33d went_on = powerOf(usual, most);
    if (apart(usual, went_on, image) >= kTellingPx)
        return {apart(motion, went_on, image) < apart(motion, usual, image) ? most : 1};
    // A camera at rest tells nothing. Single pictures are repeated to fill up a rate; a clock that goes on is right.
    const bool missing = most > repeated + 1;
    return missing || repeated >= kLongStall ? std::vector{most, 1} : std::vector{1, most};
}

TellingMovers moversAfter(int elapsed, int other, const CornerSet& set, const std::vector<TrackedPosition>& found,
                          const cv::Matx33d& to_from) {
    TellingMovers movers;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const TrackedCorner& corner = set.corners[i];
        const double way = std::hypot(corner.velocity.x, corner.velocity.y);
        const double between = way * std::abs(other - elapsed);
        if (!corner.moves || corner.sticks || way < kTellingSpeed || between < kTellingMoverPx) continue;
        ++movers.all;
        if (!found[i].found) continue;
        const PointJacobian map(to_from, corner.position);
        const cv::Point2f off = found[i].position - map.point - map.vector(corner.velocity) * float(elapsed);
        const double near = std::min(kMoverPx + kMoverShare * way * elapsed, between / 2);
        movers.there += std::hypot(off.x, off.y) < near ? 1 : 0;
    }
    return movers;
}

}  // namespace eyrie

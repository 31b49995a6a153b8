#include "tracking/pictures/shadow_share.h"

#include <algorithm>
#include <cmath>

namespace eyrie {
namespace {

/// Along one axis: the silhouette ends at `low` and `high`, what is lit of it at `lit_low` and `lit_high`, the box at
/// ± `half`. What is dark ends where the shadow is expected to begin, but never before what is lit.
double shareAlong(double reach, double half, double low, double high, double lit_low, double lit_high) {
    const double vehicle_end = reach > 0 ? std::max(high - reach, lit_high) : -std::min(low - reach, lit_low);
    return std::clamp((half - vehicle_end) / std::abs(reach), 0.0, 1.0);
}

}  // namespace

ShadowShare shareInBox(const SilhouetteLook& look, cv::Point2d reach, double least) {
    if (!look.silhouette) return {};
    const cv::Point2d in_box = look.box.toBox(look.box.centre + reach);
    const double enough = least * std::hypot(reach.x, reach.y);
    const BoxEdges& whole = look.silhouette->whole;
    const BoxEdges lit = look.silhouette->lit.value_or(BoxEdges{});
    ShadowShare share;
    if (std::abs(in_box.x) > enough)
        share.along = shareAlong(in_box.x, look.box.length / 2, whole.rear, whole.front, lit.rear, lit.front);
    if (std::abs(in_box.y) > enough)
        share.across = shareAlong(in_box.y, look.box.width / 2, whole.left, whole.right, lit.left, lit.right);
    return share;
}

}  // namespace eyrie

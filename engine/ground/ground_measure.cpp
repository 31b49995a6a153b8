#include "ground/ground_measure.h"

#include <cmath>

namespace eyrie {

std::optional<GroundMeasure> measureBetween(const GroundStretches& ground, const FramePoint& from,
                                            const FramePoint& to) {
    const auto first = carriedTo(ground, from, to.frame);
    if (!first) return std::nullopt;
    const cv::Point2d way = ground.toGround(to.frame, to.at) - ground.toGround(from.frame, from.at);
    const cv::Point2d seen = to.at - first->at;
    const SceneScale& scale = ground.footage().scale;
    if (!scale.slope.isFlat()) return measureInFrame(scale.in(to.frame), first->at, to.at);
    return GroundMeasure{std::hypot(way.x, way.y), std::hypot(seen.x, seen.y)};
}

GroundMeasure measureInFrame(const SceneScale& scale, cv::Point2d from, cv::Point2d to) {
    const double px = std::hypot(to.x - from.x, to.y - from.y);
    return {scale.at((from + to) / 2).metres(px), px};
}

std::optional<FramePoint> carriedTo(const GroundStretches& ground, const FramePoint& point, FrameIndex frame) {
    if (point.frame == frame && ground.indexOf(frame) >= 0) return point;
    if (ground.indexOf(point.frame) < 0 || ground.indexOf(point.frame) != ground.indexOf(frame)) return std::nullopt;
    const auto at = ground.toImage(frame, ground.toGround(point.frame, point.at));
    if (!at) return std::nullopt;
    return FramePoint{frame, *at};
}

}  // namespace eyrie

#include "tracking/association/overlap_matrix.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.h"

namespace eyrie {
namespace {

double reachOf(const OrientedBox& box) {
    return std::hypot(box.length, box.width) / 2;
}

bool whollyInside(const OrientedBox& box, cv::Size image) {
    const double reach = reachOf(box);
    return box.centre.x - reach >= -0.5 && box.centre.y - reach >= -0.5 && box.centre.x + reach <= image.width - 0.5 &&
           box.centre.y + reach <= image.height - 0.5;
}

double visibleArea(const OrientedBox& box, cv::Size image) {
    return image.area() == 0 || whollyInside(box, image) ? box.area() : areaInImage(box, image);
}

bool moveAlike(cv::Point2d a, cv::Point2d b, const OverlapGate& gate) {
    if (gate.max_turn >= kPi) return true;
    const double speed_a = std::hypot(a.x, a.y);
    const double speed_b = std::hypot(b.x, b.y);
    if (speed_a <= gate.slow_speed || speed_b <= gate.slow_speed) return true;
    return std::abs(turnBetween(std::atan2(a.y, a.x), std::atan2(b.y, b.x))) <= gate.max_turn;
}

/// Whether a track that stands may be of the same vehicle as a detection.
bool mayTake(const MovingBox& track, const MovingBox& detection) {
    if (std::hypot(detection.velocity.x, detection.velocity.y) > track.fastest) return false;
    const cv::Point2d apart = detection.box.centre - track.box.centre;
    return std::hypot(apart.x, apart.y) <= track.farthest;
}

/// 1 where the centres agree, falling to 0 at the edge of the gate.
double gateCloseness(const MovingBox& detection, const MovingBox& track, double max_size_ratio) {
    if (!(track.gate_along > 0) || !(track.gate_across > 0)) return 0;
    const double ratio = detection.box.area() / track.box.area();
    if (!(ratio <= max_size_ratio && ratio * max_size_ratio >= 1)) return 0;
    const cv::Point2d apart = track.box.toBox(detection.box.centre);
    const double distance = std::hypot(apart.x / track.gate_along, apart.y / track.gate_across);
    return std::max(0.0, 1 - distance);
}

}  // namespace

OverlapMatrix::OverlapMatrix(const std::vector<MovingBox>& detections, const std::vector<MovingBox>& tracks,
                             const OverlapGate& gate)
    : by_detection_(detections.size()), by_track_(tracks.size()) {
    std::vector<double> track_area;
    for (const MovingBox& track : tracks) track_area.push_back(visibleArea(track.box, gate.image));
    for (std::size_t i = 0; i < detections.size(); ++i) {
        const MovingBox& detection = detections[i];
        const double detection_reach = reachOf(detection.box);
        const double detection_area = visibleArea(detection.box, gate.image);
        for (std::size_t j = 0; j < tracks.size(); ++j) {
            const MovingBox& track = tracks[j];
            const double reach = detection_reach + reachOf(track.box) + std::max(track.gate_along, track.gate_across);
            if (std::abs(detection.box.centre.x - track.box.centre.x) > reach ||
                std::abs(detection.box.centre.y - track.box.centre.y) > reach) {
                continue;
            }
            if (!mayTake(track, detection) || !moveAlike(detection.velocity, track.velocity, gate)) continue;
            BoxRelation relation;
            relation.detection = static_cast<int>(i);
            relation.track = static_cast<int>(j);
            const double smaller = std::min(detection_area, track_area[j]);
            const double shared = std::min(intersectionArea(detection.box, track.box), smaller);
            if (shared > 0) {
                relation.overlap = shared / (detection_area + track_area[j] - shared);
                relation.detection_share = shared / detection_area;
                relation.track_share = shared / track_area[j];
            }
            relation.score = relation.overlap;
            relation.accepted = relation.overlap >= gate.min_overlap;
            if (!relation.accepted) {
                const double closeness = gateCloseness(detection, track, gate.max_size_ratio);
                relation.accepted = closeness > 0;
                relation.score = closeness * gate.min_overlap;
            }
            if (!(shared > 0) && !relation.accepted) continue;
            by_detection_[i].push_back(static_cast<int>(relations_.size()));
            by_track_[j].push_back(static_cast<int>(relations_.size()));
            relations_.push_back(relation);
        }
    }
}

const std::vector<int>& OverlapMatrix::ofDetection(int detection) const {
    return by_detection_.at(static_cast<std::size_t>(detection));
}

const std::vector<int>& OverlapMatrix::ofTrack(int track) const {
    return by_track_.at(static_cast<std::size_t>(track));
}

}  // namespace eyrie

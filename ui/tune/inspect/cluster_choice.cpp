#include "tune/inspect/cluster_choice.h"

#include <algorithm>
#include <limits>

namespace eyrie::ui {

namespace {

/// Index of the smallest box under a point.
template <class Boxes, class BoxOf>
std::optional<int> smallestAt(const Boxes& boxes, QPointF point, double margin, BoxOf boxOf) {
    std::optional<int> found;
    double smallest = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const OrientedBox& box = boxOf(boxes[i]);
        if (box.area() >= smallest || !box.contains({point.x(), point.y()}, margin)) continue;
        found = static_cast<int>(i);
        smallest = box.area();
    }
    return found;
}

bool isCluster(const FrameResult& result, int index) {
    return index >= 0 && index < static_cast<int>(result.clusters.size());
}

}  // namespace

std::optional<int> clusterAt(const FrameResult& result, QPointF image_point, double margin) {
    const auto detection = smallestAt(
        result.detections, image_point, margin, [](const Detection& d) -> const auto& { return d.box; });
    if (detection) {
        const int cluster = result.detections[static_cast<std::size_t>(*detection)].cluster;
        if (isCluster(result, cluster)) return cluster;
    }
    const auto cluster = smallestAt(
        result.clusters, image_point, margin, [](const MotionCluster& c) -> const auto& { return c.box; });
    if (cluster) return cluster;
    const auto roi = smallestAt(
        result.rois, image_point, margin, [](const OrientedBox& box) -> const auto& { return box; });
    return roi && isCluster(result, *roi) ? roi : std::nullopt;
}

std::optional<int> clusterOfTrack(const FrameResult& result, TrackId track) {
    const auto state = std::find_if(result.tracks.begin(), result.tracks.end(),
                                    [track](const TrackState& s) { return s.id == track; });
    if (state == result.tracks.end()) return std::nullopt;
    std::optional<int> found;
    double most = 0;
    for (const Detection& detection : result.detections) {
        if (detection.rejection != Rejection::none || !isCluster(result, detection.cluster)) continue;
        const double shared = overlap(detection.box, state->box);
        if (shared > most) {
            most = shared;
            found = detection.cluster;
        }
    }
    if (found) return found;
    for (std::size_t i = 0; i < result.clusters.size(); ++i) {
        const double shared = intersectionArea(result.clusters[i].box, state->box);
        if (shared > most) {
            most = shared;
            found = static_cast<int>(i);
        }
    }
    return found;
}

std::vector<CornerId> cornersOf(const FrameResult& result, int cluster) {
    std::vector<CornerId> corners;
    if (!isCluster(result, cluster)) return corners;
    for (const int member : result.clusters[static_cast<std::size_t>(cluster)].members)
        corners.push_back(result.motion.motion_vectors[static_cast<std::size_t>(member)].id);
    std::sort(corners.begin(), corners.end());
    return corners;
}

std::optional<int> clusterWith(const FrameResult& result, const std::vector<CornerId>& corners) {
    std::optional<int> found;
    std::ptrdiff_t most = 0;
    for (std::size_t i = 0; i < result.clusters.size(); ++i) {
        const auto& members = result.clusters[i].members;
        const auto held = std::count_if(members.begin(), members.end(), [&](int member) {
            const CornerId id = result.motion.motion_vectors[static_cast<std::size_t>(member)].id;
            return std::binary_search(corners.begin(), corners.end(), id);
        });
        if (held > most) {
            most = held;
            found = static_cast<int>(i);
        }
    }
    return found;
}

}  // namespace eyrie::ui

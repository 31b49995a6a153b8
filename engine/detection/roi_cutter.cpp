#include "detection/roi_cutter.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "imaging/upright_patch.h"

namespace eyrie {

OrientedBox extendedCluster(const MotionCluster& cluster, cv::Size image, const DetectionOptions& options,
                            const SceneScale& scale) {
    constexpr double kSmallest = 3;  // px, the reach of the smallest pattern
    const double largest = std::max(kSmallest, 2 * std::hypot(image.width, image.height));
    OrientedBox area = cluster.box.scaled(options.extend_along, options.extend_across);
    const double context =
        options.method == DetectionMethod::sliding_window ? 2 * scale.px(options.sliding_window.context_m) : 0;
    area.length = std::clamp(context + std::max(area.length, scale.px(options.min_roi_length_m)), kSmallest, largest);
    area.width = std::clamp(context + std::max(area.width, scale.px(options.min_roi_width_m)), kSmallest, largest);
    return area;
}

MotionRoi cutMotionRoi(const Frame& frame, const MotionCluster& cluster, int cluster_index, const FrameMotion& motion,
                       const DetectionOptions& options, const SceneScale& scale) {
    if (frame.gray.empty() || frame.gray.type() != CV_8UC1) {
        throw Error(ErrorKind::internal, "frame " + std::to_string(frame.index) + " has no 8 bit grey image to search");
    }
    MotionRoi roi;
    roi.box = extendedCluster(cluster, frame.gray.size(), options, scale);
    UprightPatch patch = cutUpright(frame.gray, roi.box);
    roi.image = patch.image;
    roi.inside = patch.inside;
    roi.image_from_roi = patch.image_from_patch;
    roi.cluster = cluster_index;
    roi.velocity = cluster.velocity;
    if (!cluster.moving_points.empty()) {
        for (const cv::Point2f& point : cluster.moving_points)
            roi.vectors.emplace_back(toPatch(roi.image_from_roi, point));
        return roi;
    }
    roi.vectors.reserve(cluster.members.size());
    for (const int member : cluster.members) {
        const MotionVector& vector = motion.motion_vectors.at(static_cast<std::size_t>(member));
        roi.vectors.emplace_back(toPatch(roi.image_from_roi, vector.position));
    }
    return roi;
}

}  // namespace eyrie

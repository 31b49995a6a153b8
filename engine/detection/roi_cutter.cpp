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
    const SceneScale here = scale.at(cluster.box.centre);
    const double context = looksThroughWindows(options.method) ? 2 * here.px(options.sliding_window.context_m) : 0;
    const double length = std::max({area.length, here.px(options.min_roi_length_m), options.min_roi_length_px});
    const double width = std::max({area.width, here.px(options.min_roi_width_m), options.min_roi_width_px});
    area.length = std::clamp(context + length, kSmallest, largest);
    area.width = std::clamp(context + width, kSmallest, largest);
    return area;
}

MotionRoi cutMotionRoi(const Frame& frame, const MotionCluster& cluster, int cluster_index, const FrameMotion& motion,
                       const DetectionOptions& options, const SceneScale& scale) {
    if (frame.gray.empty() || frame.gray.type() != CV_8UC1) {
        throw Error(ErrorKind::internal, "frame " + std::to_string(frame.index) + " has no 8 bit grey image to search");
    }
    MotionRoi roi;
    roi.zoom = motion.registration.zoom;
    roi.box = extendedCluster(cluster, frame.gray.size(), options, scale.zoomed(roi.zoom));
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

MotionRoi narrowed(const MotionRoi& roi, int margin) {
    const int across = std::clamp(margin, 0, (roi.image.cols - 1) / 2);
    const int along = std::clamp(margin, 0, (roi.image.rows - 1) / 2);
    if (roi.image.empty() || (across == 0 && along == 0)) return roi;
    const cv::Rect middle(across, along, roi.image.cols - 2 * across, roi.image.rows - 2 * along);
    MotionRoi inner = roi;
    inner.image = roi.image(middle);
    inner.inside = roi.inside(middle);
    for (int row = 0; row < 2; ++row)
        inner.image_from_roi(row, 2) += roi.image_from_roi(row, 0) * across + roi.image_from_roi(row, 1) * along;
    inner.box.length -= 2 * along;
    inner.box.width -= 2 * across;
    for (cv::Point2f& vector : inner.vectors) vector -= cv::Point2f(middle.tl());
    return inner;
}

}  // namespace eyrie

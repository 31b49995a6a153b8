#include "annotation/edits/ignore_regions.h"

#include <algorithm>
#include <cmath>

#include "annotation/keyframes/interpolation.h"
#include "annotation/review/review_state.h"

namespace eyrie {
namespace {

bool onEdge(cv::Point2d a, cv::Point2d b, cv::Point2d p) {
    const cv::Point2d edge = b - a;
    const cv::Point2d to_point = p - a;
    const double length2 = edge.dot(edge);
    const double along = length2 > 0 ? std::clamp(to_point.dot(edge) / length2, 0.0, 1.0) : 0;
    const cv::Point2d off = to_point - edge * along;
    return off.dot(off) < 1e-18 * (1 + length2);
}

/// Where a horizontal line crosses a polygon, ascending.
std::vector<double> crossings(const std::vector<cv::Point2d>& polygon, double y) {
    std::vector<double> xs;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const cv::Point2d a = polygon[i];
        const cv::Point2d b = polygon[(i + 1) % polygon.size()];
        if ((a.y <= y) != (b.y <= y)) xs.push_back(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
    }
    std::sort(xs.begin(), xs.end());
    return xs;
}

/// Takes a polygon along with the ground; nothing when a corner leaves it (behind the horizon).
std::optional<std::vector<cv::Point2d>> carriedPolygon(const std::vector<cv::Point2d>& polygon, FrameIndex from,
                                                       FrameIndex to, const CameraMotion& camera) {
    const auto map = camera.map(from, to);
    if (!map) return std::nullopt;
    std::vector<cv::Point2d> result;
    for (const cv::Point2d& corner : polygon) {
        const auto& m = map->matrix;
        if (!(m(2, 0) * corner.x + m(2, 1) * corner.y + m(2, 2) > 1e-6)) return std::nullopt;
        result.push_back(map->apply(corner));
    }
    return result;
}

struct RecordMaker {
    const AnnotationSet& set;
    const GroundTruthOptions& options;
    const ReviewIndex& reviews;
    FrameIndex frame;
    std::vector<RegionInFrame> regions;

    bool ignored(const LabelledBoxOf& each, double share_in_image) const {
        if (each.box.ignore || share_in_image < options.min_share_in_image) return true;
        if (options.ignore_fully_occluded && each.box.occlusion == Occlusion::fully) return true;
        if (options.only_checked && reviews.stateAt(each.id, frame) != ReviewState::checked) return true;
        return std::any_of(regions.begin(), regions.end(),
                           [&](const RegionInFrame& region) { return contains(region.polygon, each.box.box.centre); });
    }

    std::optional<BoxRecord> make(const LabelledBoxOf& each) const {
        if (!each.box.visible()) return std::nullopt;
        double share = 1;
        if (!options.image.empty()) {
            const double area = each.box.box.area();
            share = area > 0 ? areaInImage(each.box.box, options.image) / area : 0;
            if (share <= 0) return std::nullopt;
        }
        BoxRecord record;
        record.frame = frame;
        record.id = each.id;
        record.box = each.box.box;
        record.object_class = set.objects.at(each.id).object_class;
        record.ignore = ignored(each, share);
        return record;
    }
};

}  // namespace

std::vector<RegionInFrame> regionsAt(const AnnotationSet& set, FrameIndex frame, const CameraMotion& camera) {
    std::vector<RegionInFrame> regions;
    for (const auto& [id, region] : set.regions) {
        if (frame < region.first_frame || frame > region.last_frame) continue;
        RegionInFrame result{id, region.polygon, true};
        if (region.anchor == RegionAnchor::ground) {
            auto carried = carriedPolygon(region.polygon, region.reference_frame, frame, camera);
            result.carried = carried.has_value();
            if (carried) result.polygon = std::move(*carried);
        }
        regions.push_back(std::move(result));
    }
    return regions;
}

bool contains(const std::vector<cv::Point2d>& polygon, cv::Point2d point) {
    bool inside = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const cv::Point2d a = polygon[i];
        const cv::Point2d b = polygon[(i + 1) % polygon.size()];
        if (onEdge(a, b, point)) return true;
        if ((a.y > point.y) != (b.y > point.y) && point.x < a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y)) {
            inside = !inside;
        }
    }
    return inside;
}

std::vector<OrientedBox> coveringBoxes(const std::vector<cv::Point2d>& polygon, double row_px) {
    std::vector<OrientedBox> boxes;
    if (polygon.size() < 3) return boxes;
    const auto [low, high] =
        std::minmax_element(polygon.begin(), polygon.end(), [](auto a, auto b) { return a.y < b.y; });
    const double height = high->y - low->y;
    constexpr int kMostRows = 4096;
    const int rows = std::clamp(static_cast<int>(std::ceil(height / std::max(0.5, row_px))), 1, kMostRows);
    const double row = height / rows;
    for (int i = 0; i < rows; ++i) {
        const double y = low->y + (i + 0.5) * row;
        const auto xs = crossings(polygon, y);
        for (std::size_t k = 0; k + 1 < xs.size(); k += 2) {
            if (xs[k + 1] > xs[k]) boxes.push_back({{(xs[k] + xs[k + 1]) / 2, y}, xs[k + 1] - xs[k], row, 0});
        }
    }
    return boxes;
}

BoxesByFrame groundTruthBoxes(const AnnotationSet& set, const CameraMotion& camera, const GroundTruthOptions& options) {
    const ReviewIndex reviews(set);
    const ObjectId highest = set.objects.empty() ? 0 : set.objects.rbegin()->first;
    BoxesByFrame result;
    for (FrameIndex frame = options.first_frame; frame <= options.last_frame; ++frame) {
        const RecordMaker maker{set, options, reviews, frame, regionsAt(set, frame, camera)};
        // A frame without objects is part of the truth, too.
        std::vector<BoxRecord>& records = result[frame];
        for (const LabelledBoxOf& each : boxesAt(set, frame, camera)) {
            if (auto record = maker.make(each)) records.push_back(std::move(*record));
        }
        if (!options.regions_as_boxes) continue;
        int id = highest;
        for (const RegionInFrame& region : maker.regions) {
            for (const OrientedBox& box : coveringBoxes(region.polygon)) {
                if (!options.image.empty() && areaInImage(box, options.image) <= 0) continue;
                BoxRecord record;
                record.frame = frame;
                record.id = ++id;
                record.box = box;
                record.ignore = true;
                records.push_back(std::move(record));
            }
        }
    }
    return result;
}

}  // namespace eyrie

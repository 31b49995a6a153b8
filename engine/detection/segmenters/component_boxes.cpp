#include "detection/segmenters/component_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace eyrie {
namespace {

constexpr double kOutlineMargin = 1.0;  ///< px; corners lie on the outline, gradients half a pixel beside it

cv::Rect2d edgesOf(const cv::Rect& pixels) {
    return {pixels.x - 0.5, pixels.y - 0.5, static_cast<double>(pixels.width), static_cast<double>(pixels.height)};
}

cv::Rect pixelsTouching(const cv::Rect2d& edges) {
    const int left = cvRound(edges.x);
    const int top = cvRound(edges.y);
    return {left, top, std::max(1, cvRound(edges.x + edges.width) - left + 1),
            std::max(1, cvRound(edges.y + edges.height) - top + 1)};
}

cv::Rect2d shrunk(const cv::Rect2d& box, double less_length, double less_width) {
    const double width = std::max(box.width - less_width, std::min(box.width, 1.0));
    const double height = std::max(box.height - less_length, std::min(box.height, 1.0));
    return {box.x + (box.width - width) / 2, box.y + (box.height - height) / 2, width, height};
}

/// Area of the box around the largest component, px².
double largestArea(const cv::Mat& labels) {
    std::map<int, cv::Rect> boxes;
    for (int y = 0; y < labels.rows; ++y) {
        for (int x = 0; x < labels.cols; ++x) {
            const int label = labels.at<int>(y, x);
            if (label > 0) boxes[label] |= cv::Rect(x, y, 1, 1);
        }
    }
    int largest = 0;
    for (const auto& [label, box] : boxes) largest = std::max(largest, box.area());
    return largest;
}

double patternReach(const GradientOptions& options) {
    return options.method == GradientMethod::lbp ? std::max(options.lbp_radius_min, options.lbp_radius_max) : 0;
}

}  // namespace

cv::Rect2d boundsOf(const std::vector<cv::Point2f>& points) {
    if (points.empty()) return {};
    double left = std::numeric_limits<double>::max();
    double top = left;
    double right = std::numeric_limits<double>::lowest();
    double bottom = right;
    for (const cv::Point2f& p : points) {
        left = std::min<double>(left, p.x);
        right = std::max<double>(right, p.x);
        top = std::min<double>(top, p.y);
        bottom = std::max<double>(bottom, p.y);
    }
    return {left, top, right - left, bottom - top};
}

cv::Rect2d grown(const cv::Rect2d& box, double along, double across) {
    const double dy = std::max(along, -box.height / 2);
    const double dx = std::max(across, -box.width / 2);
    return {box.x - dx, box.y - dy, box.width + 2 * dx, box.height + 2 * dy};
}

std::vector<cv::Point2f> pointsWithin(const cv::Rect2d& box, const std::vector<cv::Point2f>& points, double margin) {
    std::vector<cv::Point2f> found;
    for (const cv::Point2f& p : points) {
        if (p.x >= box.x - margin && p.x <= box.x + box.width + margin && p.y >= box.y - margin &&
            p.y <= box.y + box.height + margin)
            found.push_back(p);
    }
    return found;
}

BoxSupport supportOf(const cv::Rect2d& box, const std::vector<cv::Point2f>& vectors, double share) {
    return {static_cast<double>(pointsWithin(box, vectors, kOutlineMargin).size()),
            std::max(1.0, share * static_cast<double>(vectors.size()))};
}

ComponentBoxes::ComponentBoxes(const GradientOptions& options, const SceneScale& scale)
    : options_(options),
      core_margin_(std::max(1.0, scale.px(options.core_margin_m))),
      vehicle_length_(scale.px(options.vehicle_length_m)),
      vehicle_width_(std::max(scale.px(options.vehicle_width_m), 4.0)),
      growth_along_(options.growth_along_m > 0 ? std::max(1.0, scale.px(options.growth_along_m)) : 0),
      growth_across_(options.growth_across_m > 0 ? std::max(1.0, scale.px(options.growth_across_m)) : 0),
      too_long_(options.length_correction * patternReach(options)),
      too_wide_(options.width_correction * patternReach(options)) {}

cv::Rect2d ComponentBoxes::boxOf(const Region& region, const cv::Mat& labels, const cv::Rect2d& core) const {
    if (!options_.handle_cut || !region.cut) return edgesOf(region.box);
    return edgesOf(boxWithin(labels, region, pixelsTouching(core)));
}

void ComponentBoxes::join(std::vector<cv::Rect2d>& boxes) const {
    // The pair with the smallest union first, until none fits into one vehicle.
    while (boxes.size() > 1) {
        double smallest = std::numeric_limits<double>::max();
        std::size_t first = 0;
        std::size_t second = 0;
        for (std::size_t a = 0; a < boxes.size(); ++a) {
            for (std::size_t b = a + 1; b < boxes.size(); ++b) {
                const cv::Rect2d both = boxes[a] | boxes[b];
                if (both.height > vehicle_length_ || both.width > vehicle_width_) continue;
                if (both.area() >= smallest) continue;
                smallest = both.area();
                first = a;
                second = b;
            }
        }
        if (second == 0) return;
        boxes[first] |= boxes[second];
        boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(second));
    }
}

cv::Rect2d ComponentBoxes::limited(const cv::Rect2d& box, const std::vector<cv::Point2f>& vectors) const {
    const auto own = pointsWithin(box, vectors, kOutlineMargin);
    if (own.empty()) return box;
    const cv::Rect2d near = grown(boundsOf(own), growth_along_, growth_across_);
    cv::Rect2d allowed = box;
    if (growth_along_ > 0) {
        allowed.y = near.y;
        allowed.height = near.height;
    }
    if (growth_across_ > 0) {
        allowed.x = near.x;
        allowed.width = near.width;
    }
    return box & allowed;
}

std::vector<cv::Rect2d> ComponentBoxes::select(const std::vector<Region>& regions, const cv::Mat& labels,
                                               const std::vector<cv::Point2f>& vectors, DetectionTrace* trace) const {
    if (trace != nullptr && regions.empty()) {
        trace->checks.push_back({"area of the largest component", "gradient.min_box_area", largestArea(labels),
                                 static_cast<double>(options_.min_box_area), false, false});
    }
    const cv::Rect2d core = grown(boundsOf(vectors), core_margin_, core_margin_);
    std::vector<cv::Rect2d> boxes;
    for (const Region& region : regions) {
        const cv::Rect2d box = boxOf(region, labels, core);
        if (box.width < 1 || box.height < 1) continue;
        if (options_.need_support) {
            const BoxSupport support = supportOf(box, vectors, options_.support_share);
            if (trace != nullptr) {
                trace->checks.push_back({"motion vectors in a component", "gradient.support_share", support.inside,
                                         support.needed, false, support.enough(), box});
            }
            if (!support.enough()) continue;
        }
        boxes.push_back(box);
    }
    if (options_.join_components) join(boxes);
    std::vector<cv::Rect2d> selected;
    for (const cv::Rect2d& box : boxes) {
        const cv::Rect2d final_box = shrunk(limited(box, vectors), too_long_, too_wide_);
        const bool large_enough = final_box.area() >= options_.min_box_area;
        if (trace != nullptr) {
            trace->checks.push_back({"area of a box", "gradient.min_box_area", final_box.area(),
                                     static_cast<double>(options_.min_box_area), false, large_enough, final_box});
        }
        if (large_enough) selected.push_back(final_box);
    }
    return selected;
}

bool ComponentBoxes::explain(const std::vector<cv::Rect2d>& boxes, const std::vector<cv::Point2f>& vectors,
                             DetectionTrace* trace) const {
    if (boxes.empty()) return false;
    std::size_t held = 0;
    for (const cv::Point2f& p : vectors) {
        held += std::any_of(boxes.begin(), boxes.end(),
                            [&](const cv::Rect2d& box) { return !pointsWithin(box, {p}, kOutlineMargin).empty(); });
    }
    const double needed = options_.fall_back_share * static_cast<double>(vectors.size());
    const bool explained = static_cast<double>(held) >= needed;
    if (trace != nullptr) {
        trace->checks.push_back({"motion vectors that the boxes hold", "gradient.fall_back_share",
                                 static_cast<double>(held), needed, false, explained});
    }
    return explained;
}

}  // namespace eyrie

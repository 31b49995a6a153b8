#include "formats/label_file.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/geometry/angle.h"

namespace eyrie {

bool isTurned(const OrientedBox& box) {
    constexpr double kShift_px = 0.005;  // of an edge: how somebody's arithmetic rounds, and below what texts carry
    const OrientedBox enclosing = box.upright();
    const OrientedBox kept = straightened(box);
    return std::max(std::abs(enclosing.length - kept.length), std::abs(enclosing.width - kept.width)) / 2 > kShift_px;
}

OrientedBox straightened(const OrientedBox& box) {
    const bool swapped = std::lround(box.heading / (kPi / 2)) % 2 != 0;
    return {box.centre, swapped ? box.width : box.length, swapped ? box.length : box.width, 0};
}

OrientedBox boxFromEdges(const BoxEdges& edges, double first_pixel_edge) {
    const double to_ours = -0.5 - first_pixel_edge;
    return {
        {edges.left + edges.width / 2 + to_ours, edges.top + edges.height / 2 + to_ours}, edges.width, edges.height, 0};
}

BoxEdges edgesOf(const OrientedBox& box, double first_pixel_edge) {
    const OrientedBox upright = isTurned(box) ? box.upright() : straightened(box);
    const double to_theirs = 0.5 + first_pixel_edge;
    return {upright.centre.x - upright.length / 2 + to_theirs, upright.centre.y - upright.width / 2 + to_theirs,
            upright.length, upright.width};
}

CornerBox boxFromCorners(const std::array<cv::Point2d, 4>& corners) {
    const cv::Point2d front = (corners[0] + corners[1]) * 0.5;
    const cv::Point2d rear = (corners[2] + corners[3]) * 0.5;
    const cv::Point2d along = front - rear;
    const cv::Point2d across = (corners[1] + corners[2] - corners[0] - corners[3]) * 0.5;
    CornerBox found;
    found.box.centre = (front + rear) * 0.5;
    found.box.length = std::hypot(along.x, along.y);
    found.box.width = std::hypot(across.x, across.y);
    // Of a box without length the sides tell the direction.
    found.box.heading = found.box.length > 0 ? std::atan2(along.y, along.x) : std::atan2(-across.x, across.y);
    const std::array<cv::Point2d, 4> exact = frontFirstCorners(found.box);
    for (std::size_t i = 0; i < 4; ++i) {
        found.departure = std::max(found.departure, std::hypot(exact[i].x - corners[i].x, exact[i].y - corners[i].y));
    }
    return found;
}

std::array<cv::Point2d, 4> frontFirstCorners(const OrientedBox& box) {
    const auto [rear_left, front_left, front_right, rear_right] = box.corners();
    return {front_left, front_right, rear_right, rear_left};
}

BoxesByFrame plainBoxes(const LabelBoxes& labels) {
    BoxesByFrame boxes;
    for (const auto& [frame, records] : labels) boxes[frame].assign(records.begin(), records.end());
    return boxes;
}

LabelBoxes labelBoxes(const BoxesByFrame& boxes) {
    LabelBoxes labels;
    for (const auto& [frame, records] : boxes) {
        std::vector<LabelBox>& in_frame = labels[frame];
        for (const BoxRecord& record : records) in_frame.push_back({record, Occlusion::none});
    }
    return labels;
}

LabelReport reportOn(const LabelFile& labels) {
    LabelReport report;
    report.format = labels.format;
    report.image_size = labels.image_size;
    report.frame_count = labels.frame_count;
    report.first_frame_number = labels.first_frame_number;
    report.notes = labels.notes;
    std::set<int> ids;
    for (const auto& [frame, records] : labels.boxes) {
        if (records.empty()) continue;
        if (report.frames++ == 0) report.first_frame = frame;
        report.last_frame = frame;
        for (const LabelBox& record : records) {
            ++report.boxes;
            if (record.id) ids.insert(*record.id);
            if (!record.id) ++report.without_id;
            if (!record.id && !record.ignore) ++report.loose;
            if (isTurned(record.box)) ++report.turned;
            if (record.ignore) ++report.ignored;
            if (record.occlusion != Occlusion::none) ++report.occluded;
            ++report.boxes_of_class[record.object_class];
            const cv::Point2d c = record.box.centre;
            if (labels.image_size && (c.x < -0.5 || c.y < -0.5 || c.x > labels.image_size->width - 0.5 ||
                                      c.y > labels.image_size->height - 0.5)) {
                ++report.outside;
            }
        }
    }
    report.ids = static_cast<int>(ids.size());
    if (!ids.empty()) {
        report.lowest_id = *ids.begin();
        report.highest_id = *ids.rbegin();
    }
    for (const LabelledObject& object : labels.objects) report.keyframes += static_cast<int>(object.keyframes.size());
    if (labels.not_filled > 0) {
        report.notes.push_back(std::to_string(labels.not_filled) +
                               " more boxes between keyframes lie far beyond the video's end and are not counted");
    }
    if (report.outside > 0) {
        report.notes.push_back(std::to_string(report.outside) + " boxes have their centre outside the image" +
                               (report.outside > report.boxes / 4 ? "; is the scale right?" : ""));
    }
    if (report.frame_count && report.last_frame >= *report.frame_count) {
        report.notes.push_back("the last box is in frame " + std::to_string(report.last_frame) + ", but only " +
                               std::to_string(*report.frame_count) + " frames are declared; is the offset right?");
    }
    return report;
}

}  // namespace eyrie

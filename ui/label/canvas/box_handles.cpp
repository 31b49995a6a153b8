#include "label/canvas/box_handles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace eyrie::ui {

namespace {

constexpr double kSmallestSide = 1;    ///< px
constexpr double kTurnDistance = 22;   ///< logical px in front of the box
constexpr double kSmallOnScreen = 30;  ///< logical px: sides shorter than this get their handles moved out …
constexpr double kApart = 9;           ///< … by so much

struct Place {
    BoxHandle handle;
    double along;   ///< −1 rear … 1 front
    double across;  ///< −1 left … 1 right
};
constexpr Place kPlaces[] = {
    {BoxHandle::centre, 0, 0},      {BoxHandle::front, 1, 0},       {BoxHandle::rear, -1, 0},
    {BoxHandle::left, 0, -1},       {BoxHandle::right, 0, 1},       {BoxHandle::front_left, 1, -1},
    {BoxHandle::front_right, 1, 1}, {BoxHandle::rear_left, -1, -1}, {BoxHandle::rear_right, -1, 1}};

double apart(double side_on_screen) {
    return side_on_screen < kSmallOnScreen ? kApart : 0;
}

/// Grows or shrinks the box at one end of one axis.
void dragSide(double& size, double& middle, double direction, double by) {
    const double grown = std::max(kSmallestSide, size + direction * by);
    middle += direction * (grown - size) / 2;
    size = grown;
}

}  // namespace

std::vector<std::pair<BoxHandle, QPointF>> boxHandles(const OrientedBox& box, const ViewTransform& transform) {
    const double scale = transform.scale();
    const double half_length = box.length / 2 + apart(box.length * scale) / scale;
    const double half_width = box.width / 2 + apart(box.width * scale) / scale;
    const auto at = [&](double along, double across) {
        const cv::Point2d point = box.toImage({along, across});
        return transform.viewFromImage({point.x, point.y});
    };
    std::vector<std::pair<BoxHandle, QPointF>> handles;
    for (const Place& place : kPlaces)
        handles.emplace_back(place.handle, at(place.along * half_length, place.across * half_width));
    handles.emplace_back(BoxHandle::turn, at(half_length + kTurnDistance / scale, 0));
    return handles;
}

std::optional<BoxHandle> handleAt(const OrientedBox& box, const ViewTransform& transform, QPointF view_point,
                                  double reach) {
    std::optional<BoxHandle> nearest;
    double least = reach;
    for (const auto& [handle, place] : boxHandles(box, transform)) {
        const double distance = std::hypot(place.x() - view_point.x(), place.y() - view_point.y());
        if (distance > least) continue;
        least = distance;
        nearest = handle;
    }
    if (nearest) return nearest;
    const QPointF point = transform.imageFromView(view_point);
    if (box.contains({point.x(), point.y()})) return BoxHandle::centre;
    return std::nullopt;
}

OrientedBox draggedBox(const OrientedBox& box, BoxHandle handle, QPointF from, QPointF to) {
    OrientedBox result = box;
    if (handle == BoxHandle::centre) {
        result.centre += cv::Point2d(to.x() - from.x(), to.y() - from.y());
        return result;
    }
    if (handle == BoxHandle::turn) {
        const double before = std::atan2(from.y() - box.centre.y, from.x() - box.centre.x);
        const double after = std::atan2(to.y() - box.centre.y, to.x() - box.centre.x);
        result.heading = std::remainder(box.heading + after - before, 2 * std::numbers::pi);
        return result;
    }
    const cv::Point2d in_box_from = box.toBox({from.x(), from.y()});
    const cv::Point2d in_box_to = box.toBox({to.x(), to.y()});
    const cv::Point2d by = in_box_to - in_box_from;
    const auto* place =
        std::find_if(std::begin(kPlaces), std::end(kPlaces), [&](const Place& p) { return p.handle == handle; });
    cv::Point2d middle(0, 0);
    if (place->along != 0) dragSide(result.length, middle.x, place->along, by.x);
    if (place->across != 0) dragSide(result.width, middle.y, place->across, by.y);
    result.centre = box.toImage(middle);
    return result;
}

OrientedBox boxFromRearToFront(QPointF rear, QPointF front, double width) {
    OrientedBox box;
    box.centre = {(rear.x() + front.x()) / 2, (rear.y() + front.y()) / 2};
    box.length = std::max(kSmallestSide, std::hypot(front.x() - rear.x(), front.y() - rear.y()));
    box.width = std::max(kSmallestSide, width);
    box.heading = std::atan2(front.y() - rear.y(), front.x() - rear.x());
    return box;
}

OrientedBox boxFromCorners(QPointF a, QPointF b, double rotation) {
    OrientedBox box;
    const double right = (b.x() - a.x()) * std::cos(rotation) - (b.y() - a.y()) * std::sin(rotation);
    const double down = (b.x() - a.x()) * std::sin(rotation) + (b.y() - a.y()) * std::cos(rotation);
    const double width = std::max(kSmallestSide, std::abs(right));
    const double height = std::max(kSmallestSide, std::abs(down));
    box.centre = {(a.x() + b.x()) / 2, (a.y() + b.y()) / 2};
    box.length = std::max(width, height);
    box.width = std::min(width, height);
    // Dragged towards the front: the way the mouse went along the longer side.
    const double on_screen = width >= height ? (right >= 0 ? 0 : std::numbers::pi)
                                             : (down >= 0 ? std::numbers::pi / 2 : -std::numbers::pi / 2);
    box.heading = std::remainder(on_screen - rotation, 2 * std::numbers::pi);
    return box;
}

}  // namespace eyrie::ui

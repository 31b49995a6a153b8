#include "formats/json_xml/coco_shape.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/geometry/angle.h"
#include "formats/format_functions.h"

namespace eyrie {
namespace {

using Points = std::vector<cv::Point2d>;

/// Points as a flat list of numbers or as a list of pairs.
Points pointsOf(const JsonPlace& list) {
    Points points;
    const bool pairs = list.size() > 0 && list.at(std::size_t{0}).value().is_array();
    for (std::size_t i = 0; pairs ? i < list.size() : i + 1 < list.size(); i += pairs ? 1 : 2) {
        const JsonPlace first = list.at(i);
        if (!pairs) {
            points.emplace_back(first.pixels() - 0.5, list.at(i + 1).pixels() - 0.5);
        } else {
            if (first.size() != 2) first.fail("is not a point");
            points.emplace_back(first.at(std::size_t{0}).pixels() - 0.5, first.at(1).pixels() - 0.5);
        }
    }
    return points;
}

/// A polygon as COCO has it, or as KWCOCO with `exterior`; empty for runs of a mask.
Points polygonOf(const JsonPlace& polygon) {
    if (polygon.value().is_array()) return pointsOf(polygon);
    if (polygon.has("exterior")) {
        const JsonPlace exterior = polygon.at("exterior");
        return pointsOf(exterior);
    }
    return {};
}

std::vector<Points> polygonsOf(const JsonPlace& annotation) {
    std::vector<Points> polygons;
    if (!annotation.has("segmentation")) return polygons;
    const JsonPlace outline = annotation.at("segmentation");
    const bool several =
        outline.value().is_array() && outline.size() > 0 && !outline.at(std::size_t{0}).value().is_number();
    if (!several) {
        polygons.push_back(polygonOf(outline));
    } else {
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const JsonPlace part = outline.at(i);
            polygons.push_back(polygonOf(part));
        }
    }
    std::erase_if(polygons, [](const Points& points) { return points.size() < 3; });
    return polygons;
}

/// Four corners beside a bbox, which need not be well-formed as the bbox says where the object is.
std::optional<std::array<cv::Point2d, 4>> cornersBesideBox(const JsonPlace& annotation) {
    if (!annotation.has("segmentation")) return std::nullopt;
    const JsonPlace polygons = annotation.at("segmentation");
    if (!polygons.value().is_array() || polygons.size() != 1) return std::nullopt;  // runs of a mask, or several parts
    const JsonPlace polygon = polygons.at(std::size_t{0});
    if (!polygon.value().is_array() || polygon.size() != 8) return std::nullopt;
    const Points points = pointsOf(polygon);
    if (points.size() != 4) return std::nullopt;
    return std::array{points[0], points[1], points[2], points[3]};
}

std::optional<double> rotationOf(const JsonPlace& annotation) {
    if (!annotation.has("dive_detection_attributes")) return std::nullopt;
    const JsonPlace attributes = annotation.at("dive_detection_attributes");
    if (!attributes.has("rotation")) return std::nullopt;
    const JsonPlace turn = attributes.at("rotation");
    if (std::abs(turn.real()) > 1000) turn.fail("is not an angle in radians");
    return wrapPi(turn.real());
}

}  // namespace

std::optional<OrientedBox> CocoShapes::boxOf(const JsonPlace& annotation) {
    const bool boxed = annotation.has("bbox");
    if (boxed && annotation.at("bbox").value().is_array() && annotation.at("bbox").size() == 4) {
        const JsonPlace bounds = annotation.at("bbox");
        const BoxEdges e{bounds.at(std::size_t{0}).pixels(), bounds.at(1).pixels(), bounds.at(2).pixels(),
                         bounds.at(3).pixels()};
        if (e.width < 0 || e.height < 0) bounds.fail("the size is negative");
        return turned(boxFromEdges(e, 0), cornersBesideBox(annotation), rotationOf(annotation));
    }
    const std::vector<Points> polygons = polygonsOf(annotation);
    if (polygons.empty()) {
        const JsonPlace bounds = boxed ? annotation.at("bbox") : annotation;
        if (boxed && bounds.size() != 0)
            bounds.fail(std::to_string(bounds.size()) + " numbers, expected left, top, width, height");
        ++without_box_;
        return std::nullopt;
    }
    ++by_outline_;
    Points all;
    for (const Points& points : polygons) all.insert(all.end(), points.begin(), points.end());
    const OrientedBox bounds = boxAround(all, 0);
    if (all.size() != 4) return turned(bounds, std::nullopt, rotationOf(annotation));
    return turned(bounds, Corners{all[0], all[1], all[2], all[3]}, rotationOf(annotation));
}

OrientedBox CocoShapes::turned(const OrientedBox& upright, const std::optional<Corners>& corners,
                               std::optional<double> rotation) {
    if (corners && rotation) return boxAround(*corners, *rotation);
    if (corners) return boxOfOutline(*corners, upright);
    OrientedBox box = upright;
    if (rotation) box.heading = *rotation;
    return box;
}

OrientedBox CocoShapes::boxOfOutline(const std::array<cv::Point2d, 4>& corners, const OrientedBox& upright) {
    const CornerBox fitted = boxFromCorners(corners);
    const double tolerance = std::max(1.0, 0.05 * std::hypot(fitted.box.length, fitted.box.width));
    if (fitted.departure > tolerance) {
        ++odd_outlines_;
        return upright;
    }
    if (std::abs(std::sin(2 * fitted.box.heading)) < 1e-3) return upright;
    ++without_front_;
    OrientedBox box = fitted.box;
    if (box.length < box.width) {
        std::swap(box.length, box.width);
        box.heading += kPi / 2;
    }
    box.heading = axisTurnBetween(0, box.heading);
    return box;
}

void CocoShapes::tell(LabelFile& labels) const {
    const auto say = [&](int count, const char* one, const char* many, const char* what) {
        if (count > 0) labels.notes.push_back(counted(count, one, many) + what);
    };
    say(without_box_, "annotation has", "annotations have", " no bbox and no polygon, and cannot be taken");
    say(by_outline_, "annotation has", "annotations have", " no bbox; the box of the polygon was taken");
    say(odd_outlines_, "outline is", "outlines are", " no rectangle; the bounds were taken");
    say(without_front_, "turned box does", "turned boxes do",
        " not say where the front is; the heading may be opposite");
}

}  // namespace eyrie

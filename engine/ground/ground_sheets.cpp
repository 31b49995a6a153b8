#include "ground/ground_sheets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/geometry/homography_jacobian.h"
#include "core/geometry/sound_map.h"

namespace eyrie {
namespace {

constexpr double kMostOnStation = 2;    ///< enlargement of a corner beside the frame it is laid on
constexpr double kMostStretched = 1.6;  ///< in any direction in the middle, beside that frame

/// The map that moves and turns all as `map` does at a place, and enlarges by half as much in steps of zoom: views from
/// another side make things smaller on the ground than they are, which would add up over a long flight.
cv::Matx33d similarityAt(const cv::Matx33d& map, cv::Point2d place) {
    const HomographyJacobian local(map, place);
    const double scale = std::sqrt(local.scale());
    const double turn = local.turned(0);
    const double c = scale * std::cos(turn);
    const double s = scale * std::sin(turn);
    const cv::Point2d to = local.point();
    return {c, -s, to.x - c * place.x + s * place.y, s, c, to.y - s * place.x - c * place.y, 0, 0, 1};
}

}  // namespace

GroundSheets::GroundSheets(const Footage& footage, FrameIndex anchor)
    : first_(footage.first_frame), image_(footage.image_size) {
    if (footage.last_frame < footage.first_frame) return;
    const auto count = static_cast<std::size_t>(footage.last_frame - footage.first_frame) + 1;
    anchor_ = std::clamp(anchor, footage.first_frame, footage.last_frame);
    sheet_from_image_.assign(count, cv::Matx33d::eye());
    sheet_of_.assign(count, 0);
    lay(footage.camera, 1);
    lay(footage.camera, -1);
    const int lowest = sheet_of_.front();
    for (int& sheet : sheet_of_) sheet -= lowest;
}

void GroundSheets::lay(const CameraMotion& camera, int direction) {
    const cv::Point2d middle((image_.width - 1) / 2.0, (image_.height - 1) / 2.0);
    FrameIndex station = anchor_;  // the frame that others are laid on
    cv::Matx33d sheet_from_station = cv::Matx33d::eye();
    int sheet = 0;
    const auto laid = [&](FrameIndex frame) -> std::optional<cv::Matx33d> {
        const auto map = camera.map(frame, station);
        if (!map || !isSoundMap(map->matrix, image_, kMostOnStation)) return std::nullopt;
        // Seen from another side, things become narrow in one direction before their area tells.
        const HomographyJacobian local(map->matrix, middle);
        for (const cv::Point2d& way :
             {cv::Point2d(1, 0), cv::Point2d(0, 1), cv::Point2d(0.7, 0.7), cv::Point2d(0.7, -0.7)}) {
            const double stretched = cv::norm(local.vector(way)) / cv::norm(way);
            if (!(stretched < kMostStretched && stretched > 1 / kMostStretched)) return std::nullopt;
        }
        const cv::Matx33d result = sheet_from_station * map->matrix;
        return result * (1 / result(2, 2));
    };
    for (FrameIndex frame = anchor_ + direction; frame >= first_ && frame <= lastFrame(); frame += direction) {
        const auto at = static_cast<std::size_t>(frame - first_);
        std::optional<cv::Matx33d> map;
        if (camera.connects(frame - direction, frame)) map = laid(frame);
        if (!map && camera.connects(frame - direction, frame)) {
            station = frame - direction;
            sheet_from_station = similarityAt(sheetFromImage(station), middle);
            map = laid(frame);
        }
        if (!map) {
            station = frame;
            sheet_from_station = cv::Matx33d::eye();
            sheet += direction;
            map = cv::Matx33d::eye();
        }
        sheet_from_image_[at] = *map;
        sheet_of_[at] = sheet;
    }
}

int GroundSheets::sheetOf(FrameIndex frame) const {
    if (sheet_of_.empty() || frame < first_ || frame > lastFrame()) return -1;
    return sheet_of_[static_cast<std::size_t>(frame - first_)];
}

const cv::Matx33d& GroundSheets::sheetFromImage(FrameIndex frame) const {
    static const cv::Matx33d unmoved = cv::Matx33d::eye();
    return sheetOf(frame) < 0 ? unmoved : sheet_from_image_[static_cast<std::size_t>(frame - first_)];
}

std::optional<cv::Point2d> GroundSheets::inImage(FrameIndex frame, cv::Point2d on_sheet) const {
    if (sheetOf(frame) < 0) return std::nullopt;
    const cv::Matx33d back = sheetFromImage(frame).inv();
    // What lies behind the camera is not inside: maps are sound, no horizon crosses a picture.
    const cv::Point2d place = HomographyJacobian(back, on_sheet).point();
    const bool inside =
        place.x >= -0.5 && place.y >= -0.5 && place.x <= image_.width - 0.5 && place.y <= image_.height - 0.5;
    return inside ? std::optional(place) : std::nullopt;
}

std::vector<cv::Point2d> GroundSheets::outlineOf(FrameIndex frame) const {
    const double right = image_.width - 0.5;
    const double bottom = image_.height - 0.5;
    const std::array<cv::Point2d, 4> corners{{{-0.5, -0.5}, {right, -0.5}, {right, bottom}, {-0.5, bottom}}};
    std::vector<cv::Point2d> outline;
    for (const cv::Point2d& corner : corners)
        outline.push_back(HomographyJacobian(sheetFromImage(frame), corner).point());
    return outline;
}

}  // namespace eyrie

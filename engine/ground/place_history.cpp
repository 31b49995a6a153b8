#include "ground/place_history.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "core/geometry/homography_jacobian.h"
#include "core/review/zone.h"

namespace eyrie {
namespace {

/// Whether a box of a frame lies at the place; where the frame does not show it, nobody is there.
bool isAt(const GroundSheets& sheets, const TrackedBox& box, const std::optional<cv::Point2d>& in_image,
          double margin) {
    if (!in_image) return false;
    const double enlarged = HomographyJacobian(sheets.sheetFromImage(box.frame), *in_image).scale();
    return box.box.contains(*in_image, margin / enlarged);
}

}  // namespace

PlaceHistory placeHistory(const GroundSheets& sheets, const std::vector<EventTrack>& tracks, int sheet,
                          cv::Point2d on_sheet, double margin) {
    PlaceHistory history;
    std::vector<std::optional<cv::Point2d>> in_image;  // by frame
    for (FrameIndex frame = sheets.firstFrame(); frame <= sheets.lastFrame(); ++frame) {
        in_image.push_back(sheets.sheetOf(frame) == sheet ? sheets.inImage(frame, on_sheet) : std::nullopt);
        if (!in_image.back()) continue;
        if (!history.seen.empty() && history.seen.back().last == frame - 1)
            history.seen.back().last = frame;
        else
            history.seen.push_back({frame, frame});
    }
    for (const EventTrack& track : tracks) {
        FrameSpan there;
        bool is_there = false;
        const auto end = [&] {
            if (is_there) history.passed.push_back({track.id, there});
            is_there = false;
        };
        const TrackedBox* before = nullptr;
        cv::Point2d centre_before(0, 0);
        for (const TrackedBox& box : track.boxes) {
            if (sheets.sheetOf(box.frame) != sheet) {
                end();
                before = nullptr;
                continue;
            }
            const auto& place = in_image[static_cast<std::size_t>(box.frame - sheets.firstFrame())];
            const HomographyJacobian local(sheets.sheetFromImage(box.frame), box.box.centre);
            const double reach = box.box.width * local.scale() / 2 + margin;
            const bool crossed =
                before != nullptr && place && distanceTo({centre_before, local.point()}, false, on_sheet) <= reach;
            if (isAt(sheets, box, place, margin) || crossed) {
                if (!is_there) there.first = box.frame;
                there.last = box.frame;
                is_there = true;
            } else {
                end();
            }
            before = &box;
            centre_before = local.point();
        }
        end();
    }
    std::sort(history.passed.begin(), history.passed.end(), [](const Passage& a, const Passage& b) {
        return std::tie(a.frames.first, a.track) < std::tie(b.frames.first, b.track);
    });
    return history;
}

std::vector<std::vector<SheetPath>> pathsOn(const GroundSheets& sheets, const std::vector<EventTrack>& tracks,
                                            double least) {
    std::vector<std::vector<SheetPath>> paths(static_cast<std::size_t>(sheets.count()));
    for (const EventTrack& track : tracks) {
        for (const TrackedBox& box : track.boxes) {
            const int sheet = sheets.sheetOf(box.frame);
            if (sheet < 0) continue;
            std::vector<SheetPath>& there = paths[static_cast<std::size_t>(sheet)];
            const cv::Point2d at = HomographyJacobian(sheets.sheetFromImage(box.frame), box.box.centre).point();
            if (there.empty() || there.back().track != track.id) there.push_back({track.id, {}});
            std::vector<FramePoint>& points = there.back().points;
            const bool last = &box == &track.boxes.back();
            if (!points.empty() && !last) {
                const cv::Point2d way = at - points.back().at;
                if (std::hypot(way.x, way.y) < least) continue;
            }
            points.push_back({box.frame, at});
        }
    }
    return paths;
}

}  // namespace eyrie

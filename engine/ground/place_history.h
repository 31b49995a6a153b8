#pragma once

#include <vector>

#include "core/review/seen_frames.h"
#include "events/event.h"
#include "ground/ground_measure.h"
#include "ground/ground_sheets.h"

namespace eyrie {

/// A vehicle at a place.
struct Passage {
    TrackId track = 0;
    FrameSpan frames;  ///< in which it was there

    bool operator==(const Passage&) const = default;
};

/// What is known of a place of the ground.
struct PlaceHistory {
    std::vector<FrameSpan> seen;  ///< when it was in the picture, ascending and apart
    std::vector<Passage> passed;  ///< every time a track crossed it, by first frame, then track
};

/// `on_sheet`, in the unit of the sheet; what comes as near as `margin` of it counts as there. A vehicle that is so
/// fast that no frame shows it at the place crossed it, too, where its way between two of its frames did.
PlaceHistory placeHistory(const GroundSheets& sheets, const std::vector<EventTrack>& tracks, int sheet,
                          cv::Point2d on_sheet, double margin);

/// The way of a vehicle over a sheet.
struct SheetPath {
    TrackId track = 0;
    std::vector<FramePoint> points;  ///< on the sheet, ascending frames
};

/// Between points of a way that is shown, units of the sheet.
inline constexpr double kLeastWay = 2;

/// The ways of all tracks over each sheet, ascending ids; of points nearer to each other than `least`, one.
std::vector<std::vector<SheetPath>> pathsOn(const GroundSheets& sheets, const std::vector<EventTrack>& tracks,
                                            double least = kLeastWay);

}  // namespace eyrie

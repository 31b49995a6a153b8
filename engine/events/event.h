#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/oriented_box.h"
#include "core/review/event_kind.h"
#include "core/values/ids.h"
#include "core/values/last_frame.h"
#include "core/values/scene_scale.h"

namespace eyrie {

/// What an event's figure counts.
enum class FigureUnit { none, km_per_hour, px_per_frame, seconds, degrees, metres, px, vehicles };
/// "km/h"; empty for none.
const char* nameOf(FigureUnit unit);

/// Something that happened to one vehicle or several.
struct Event {
    EventKind kind = EventKind::appears;
    std::vector<TrackId> tracks;  ///< ascending; several for convoys and meetings
    FrameIndex first_frame = 0;
    FrameIndex last_frame = 0;  ///< included; the same as `first_frame` for what happens in a moment
    FrameIndex frame = 0;       ///< the frame to look at, between the two
    cv::Point2d place{0, 0};    ///< px in `frame`
    FrameIndex ground_frame = 0;
    cv::Point2d ground{0, 0};  ///< the same place on the ground, px in `ground_frame`
    double figure = 0;         ///< what it counts depends on the kind, see docs/manual.md
    FigureUnit unit = FigureUnit::none;
    std::string zone;  ///< of enters, exits and crosses; of against the flow the arrow that told, if one did
    CrossingSense sense = CrossingSense::none;
};

/// What the figure of a kind counts, before the figure itself: "Speed before", "Stood", "Convoy of".
const char* figureNameOf(EventKind kind);
/// "43 km/h", "1.8 px/frame", "12.4 s"; empty without a figure.
std::string figureText(const Event& event);

/// One box of a track.
struct TrackedBox {
    FrameIndex frame = 0;
    OrientedBox box;
};

/// One vehicle through the frames.
struct EventTrack {
    TrackId id = 0;
    std::vector<TrackedBox> boxes;       ///< ascending frames, never empty
    FrameIndex seen_until = kLastFrame;  ///< boxes after it are mere predictions
};

}  // namespace eyrie

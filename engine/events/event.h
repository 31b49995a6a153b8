#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/oriented_box.h"
#include "core/values/ids.h"
#include "core/values/scene_scale.h"

namespace eyrie {

/// What can happen to a vehicle, as an operator asks for it.
enum class EventKind {
    appears,       ///< its track begins
    leaves,        ///< it drives out of the picture
    lost,          ///< its track ends in mid-picture
    starts,        ///< it stood and drives off
    stops,         ///< it drove and comes to stand
    stands,        ///< it does not move for some time
    turns_back,    ///< it drives back where it came from
    against_flow,  ///< it drives where others come the other way
    leaves_flow,   ///< it turns off to where no other drives
    over_speed,    ///< faster than a limit
    under_speed,   ///< slower than a limit without standing
    convoy,        ///< several follow each other at steady distances
    meeting,       ///< two that came from different directions stand side by side
    loiters,       ///< it drives about in one place
    enters,        ///< it comes into a zone
    exits,         ///< it leaves a zone
    crosses        ///< it crosses a line
};
inline constexpr int kEventKinds = 17;

/// The word used in files and on screen: "turns back", "against the flow".
const char* nameOf(EventKind kind);
/// All kinds, in the order of their numbers.
std::vector<EventKind> allEventKinds();
/// A kind by its name; "-" and "_" count as blanks. Throws Error(parameter) with the nearest one.
EventKind eventKindOf(const std::string& name);

/// What an event's figure counts.
enum class FigureUnit { none, km_per_hour, px_per_frame, seconds, degrees, metres, px, vehicles };
/// "km/h"; empty for none.
const char* nameOf(FigureUnit unit);

/// How an event crosses a line, seen when looking along it from its first point on.
enum class CrossingSense { none, to_right, to_left };
const char* nameOf(CrossingSense sense);

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
    std::string zone;  ///< of enters, exits and crosses
    CrossingSense sense = CrossingSense::none;
};

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
    std::vector<TrackedBox> boxes;  ///< ascending frames, never empty
};

}  // namespace eyrie

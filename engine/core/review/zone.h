#pragma once

#include <map>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "core/values/ids.h"

namespace eyrie {

/// What a zone is, and so what can happen at it.
enum class ZoneShape {
    area,  ///< it is entered and left
    line,  ///< it is crossed
    arrow  ///< it says which way is right near it
};
enum class ZoneAnchor { image, ground };

/// A place that somebody watches, or says the right way of.
struct Zone {
    std::string name;
    ZoneShape shape = ZoneShape::area;
    ZoneAnchor anchor = ZoneAnchor::ground;
    FrameIndex frame = 0;             ///< in which the points are meant, if fixed to the ground
    std::vector<cv::Point2d> points;  ///< px; corners of an area, or the line or arrow from its first to its last point

    bool operator==(const Zone&) const = default;
};

/// A zone that a project keeps: of a video, not of a run.
struct StoredZone {
    static constexpr int kColourByNumber = -1;

    int id = 0;  ///< within a project, from 1; never used again
    Zone zone;
    int colour = kColourByNumber;  ///< 0xRRGGBB
    bool shown = true;             ///< drawn over the video; it is searched for events all the same
    std::string person;            ///< who changed it last
    std::string when_utc;          ///< and when, ISO 8601

    bool operator==(const StoredZone&) const = default;
};

/// "zone", "line" or "arrow": what people call one.
const char* nameOf(ZoneShape shape);

/// The zones by themselves, in the order of their numbers: what events are searched with.
std::vector<Zone> zonesOf(const std::map<int, StoredZone>& stored);

/// Points that a zone of a project may have.
inline constexpr std::size_t kMostZonePoints = 1000;

/// What makes a zone useless, for people ("has no area"); empty for a good one.
std::string faultOf(const Zone& zone);

/// Shortest distance from the outline or the line.
double distanceTo(const std::vector<cv::Point2d>& points, bool closed, cv::Point2d place);
/// Whether a place lies inside a closed outline.
bool isInside(const std::vector<cv::Point2d>& outline, cv::Point2d place);
/// How a step crosses a line: +1 to the right as seen along it, −1 to the left, 0 not at all.
int crossing(const std::vector<cv::Point2d>& line, cv::Point2d from, cv::Point2d to);

}  // namespace eyrie

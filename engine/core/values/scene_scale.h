#pragma once

#include <string>

#include "core/values/scale_slope.h"
#include "core/values/zoom_course.h"

namespace eyrie {

/// The smallest and the largest ground sampling distance that a person may give, metres per pixel. At the largest one a
/// lorry is a single pixel.
inline constexpr double kSmallestGsd = 0.001;
inline constexpr double kLargestGsd = 10;

/// Of a video of which nobody knows the scale, metres per pixel.
inline constexpr double kAssumedGsd = 0.25;

/// The usual car, m: what a scale is checked by, areas and corner densities are compared with, and parameters that mean
/// a car are by default.
inline constexpr double kCarLength_m = 4.5;
inline constexpr double kCarWidth_m = 1.8;

/// What is wrong with a ground sampling distance that a person gave, with what was probably meant; empty when it can be
/// used. Command line and window say the same.
std::string whyNotAGsd(double gsd_m_per_px);
/// Why nothing will be found with one that can be used, with the remedy; empty where vehicles have a size that is
/// looked for.
std::string doubtOfGsd(double gsd_m_per_px);

/// Turns physical lengths and speeds into pixels. What a stage measures at a place it asks of the scale there, `at()`;
/// what it needs once for the whole picture is that of the picture's centre. Where the camera zooms, the scale is that
/// of the first frame; stages take it to the frame in hand by `Registration::zoom`, and what has a whole run before it
/// asks by frame and place.
struct SceneScale {
    double gsd_m_per_px = kAssumedGsd;  ///< ground sampling distance at the slope's centre, metres per pixel, > 0
    double frame_rate_hz = 25;          ///< frames per second, > 0
    bool gsd_known = false;             ///< false: `gsd_m_per_px` is an assumption; do not show metres or km/h
    ScaleSlope slope = {};              ///< flat unless the view is known to be oblique
    ZoomCourse zoom = {};               ///< of a run that is over; steady while it goes on

    /// The scale at a place of the picture, as a scale that is the same everywhere.
    SceneScale at(cv::Point2d place) const { return withGsd(gsd_m_per_px / slope.factorAt(place), {}); }
    /// The scale when the camera shows everything larger by this factor than in the first frame.
    SceneScale zoomed(double by) const { return withGsd(gsd_m_per_px / by, slope.zoomed(by)); }
    /// The scale of a frame, as one that stays the same.
    SceneScale in(FrameIndex frame) const { return zoomed(zoom.at(frame)); }
    /// The scale at a place of a frame, as one that is the same everywhere and stays so.
    SceneScale at(FrameIndex frame, cv::Point2d place) const { return in(frame).at(place); }

    /// Pixels per metre at a place of a frame as a multiple of those at the centre of the first one.
    double enlargementAt(FrameIndex frame, cv::Point2d place) const {
        const double by = zoom.at(frame);
        return by * slope.zoomed(by).factorAt(place);
    }
    /// The same with another GSD and slope, for one time.
    SceneScale withGsd(double gsd, const ScaleSlope& sloping) const {
        return {gsd, frame_rate_hz, gsd_known, sloping, {}};
    }

    double px(double metres) const { return metres / gsd_m_per_px; }
    double metres(double px) const { return px * gsd_m_per_px; }
    double pxPerFrame(double metres_per_second) const { return metres_per_second / gsd_m_per_px / frame_rate_hz; }
    double metresPerSecond(double px_per_frame) const { return px_per_frame * gsd_m_per_px * frame_rate_hz; }
};

/// Whether lengths in metres mean something: the GSD is given, or was estimated from the traffic. Not where it is the
/// assumption that a scale starts with. To be asked of a run's scale, not of that of a frame or place.
inline bool hasMetricLimits(const SceneScale& scale) {
    return scale.gsd_known || scale.gsd_m_per_px != kAssumedGsd;
}

}  // namespace eyrie

#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/oriented_box.h"
#include "core/values/ids.h"
#include "core/values/scene_scale.h"

namespace eyrie {

/// What became of the search for shadows, and for what headlights throw on the ground, when the tracks of a run were
/// finished.
enum class LightOutcome {
    shadows,        ///< the sun casts them
    beams,          ///< it is night: headlights light the ground about vehicles
    switched_off,   ///< nobody wanted to know (finishing.trim_shadows)
    no_scale,       ///< lengths in metres mean nothing
    no_classifier,  ///< without one no track is sure enough to be asked
    no_pictures,    ///< they were not looked at once more, as after a stop and over live sources
    few_vehicles,   ///< too few stand out clearly from what is dark beside them
    short_shadows,  ///< what is dark beside them hardly reaches beyond them
    disagreement,   ///< it lies elsewhere at each of them
    shaded_sides    ///< boxes hold all of it, so that it is their own shaded sides, which an oblique view shows
};

/// As JSON has it: "shadows", "few vehicles".
const char* nameOf(LightOutcome outcome);

/// Fewer vehicles whose shadow is sure say nothing: one may be dark on one side.
inline constexpr int kFewestShadowVehicles = 4;

/// What was found in a stretch of frames that are registered to each other; of searches that found nothing, in some.
struct LightFinding {
    FrameIndex first_frame = 0;
    FrameIndex last_frame = 0;
    LightOutcome outcome = LightOutcome::shadows;
    double heading = 0;    ///< where shadows fall to in the picture of `first_frame`: radians, clockwise
    double reach_m = 0;    ///< by which they reach beyond most vehicles
    double scatter_m = 0;  ///< how far what vehicles say usually is from that
    int vehicles = 0;      ///< that say so; of beams: that have one
    double agreement = 0;  ///< share of what vehicles say that points the same way, 0 … 1
    std::optional<double> darkening = std::nullopt;  ///< share of its brightness that the ground loses, 0 … 1
    int trimmed = 0;                                 ///< tracks out of whose boxes it was taken
    int dropped = 0;                                 ///< tracks that were left out as nothing but shadow

    bool operator==(const LightFinding&) const = default;
};

/// Where shadows fall to in one picture.
struct FrameShadow {
    FrameIndex frame = 0;
    double heading = 0;   ///< radians, clockwise
    double reach_px = 0;  ///< by which they reach beyond most vehicles, in the middle of the picture

    bool operator==(const FrameShadow&) const = default;
};

/// What was taken out of the boxes of a track.
struct BoxTrim {
    LightOutcome what = LightOutcome::shadows;  ///< or beams
    double along = 0;  ///< share of what shadows reach along its heading that was in its boxes; of beams: of the length
    double across = 0;  ///< the same across it; of beams: of the width
    double taken = 0;   ///< share of the boxes' area that was taken out, 0 … 1

    bool operator==(const BoxTrim&) const = default;
};

/// All of it of a run.
struct RunLight {
    std::vector<LightFinding> findings;  ///< ascending frames; empty: nothing is known, as without tracks
    std::vector<FrameShadow> frames;     ///< in which shadows fall, ascending
    std::map<TrackId, BoxTrim> trims;    ///< of the tracks of the result
};

/// px by which shadows reach beyond a vehicle that stands at `place`, in the picture's axes.
cv::Point2d shadowReach(const FrameShadow& shadow, cv::Point2d place, const SceneScale& scale);

/// Outline of a vehicle with the shadow that is predicted for it: of a box and of the same box moved by the reach. Its
/// corners in their order about it, clockwise.
std::vector<cv::Point2d> shadowOutline(const OrientedBox& box, cv::Point2d reach);

/// For people, of one picture: "to 135° (to the lower left), 2.4 m beyond most vehicles".
std::string describe(const FrameShadow& shadow, const SceneScale& scale);

/// "to the lower left": where a heading points to in a picture.
std::string wayOnScreen(double heading);

/// For people, of all findings of a run: "shadows fall to 135° (to the lower left) in frame 0, 2.4 m beyond vehicles
/// …", or why none were found; empty where nothing is known. Nothing else words it.
std::string describe(const std::vector<LightFinding>& findings, const SceneScale& scale);

/// For people, of one track: "a shadow was taken out of its boxes: 23 % of their area".
std::string describe(const BoxTrim& trim);

}  // namespace eyrie

#include "core/evidence/light_finding.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/angle.h"
#include "core/measure_text.h"

namespace eyrie {
namespace {

int framesOf(const LightFinding& finding) {
    return finding.last_frame - finding.first_frame + 1;
}

/// With a point in every locale.
std::string tenths(double value) {
    const long rounded = std::lround(10 * value);
    return std::to_string(rounded / 10) + "." + std::to_string(rounded % 10);
}

std::string percentOf(double share) {
    return std::to_string(std::lround(100 * share)) + " %";
}

std::string tracksText(int count) {
    return countText(static_cast<std::size_t>(count), "track", "tracks");
}

std::string vehiclesText(int count) {
    return countText(static_cast<std::size_t>(count), "vehicle", "vehicles");
}

std::string directionOf(double heading) {
    return std::to_string(std::lround(degreesFromRadians(heading)) % 360) + "° (" + wayOnScreen(heading) + ")";
}

/// Metres only where the scale is known.
std::string reachOf(double reach_px, const SceneScale& scale) {
    const std::string reach = scale.gsd_known ? tenths(scale.metres(reach_px)) + " m" : tenths(reach_px) + " px";
    return reach + " beyond most vehicles";
}

std::string takenOut(const LightFinding& finding) {
    std::string text;
    if (finding.trimmed > 0) text = "taken out of the boxes of " + tracksText(finding.trimmed);
    if (finding.dropped > 0)
        text += (text.empty() ? "" : ", ") + tracksText(finding.dropped) + " left out as mere shadow";
    return text;
}

std::string shadowsText(const LightFinding& finding, const SceneScale& scale) {
    std::string text = "shadows fall to " + directionOf(finding.heading) + " in frame " +
                       std::to_string(finding.first_frame) + ", " + reachOf(scale.px(finding.reach_m), scale);
    if (finding.darkening) text += " and are " + percentOf(*finding.darkening) + " darker than the ground";
    text += ": " + vehiclesText(finding.vehicles) + (finding.vehicles == 1 ? " says so, " : " say so, ") +
            percentOf(finding.agreement) + " of what they say agrees";
    if (const std::string taken = takenOut(finding); !taken.empty()) text += "; " + taken;
    return text;
}

std::string whyNone(const LightFinding& finding) {
    switch (finding.outcome) {
        case LightOutcome::shadows:
        case LightOutcome::beams:
            break;
        case LightOutcome::switched_off:
            return "shadows were not looked for (finishing.trim_shadows is off)";
        case LightOutcome::no_scale:
            return "shadows were not looked for: the scale is not known";
        case LightOutcome::no_classifier:
            return "shadows were not looked for: no classifier took part (detection.method)";
        case LightOutcome::no_pictures:
            return "shadows were not looked for: the pictures were not read once more when the tracks were finished";
        case LightOutcome::few_vehicles:
            return "no shadows found: " +
                   (finding.vehicles == 0 ? std::string("no vehicle stands out")
                                          : "only " + vehiclesText(finding.vehicles) +
                                                (finding.vehicles == 1 ? " stands out" : " stand out")) +
                   " clearly from what is dark beside " + (finding.vehicles > 1 ? "them, " : "it, ") +
                   std::to_string(kFewestShadowVehicles) + " are needed";
        case LightOutcome::short_shadows:
            return "no shadows found: what is dark beside " + vehiclesText(finding.vehicles) +
                   " hardly reaches beyond them";
        case LightOutcome::disagreement:
            return "no shadows found: what is dark beside " + vehiclesText(finding.vehicles) +
                   " does not lie on one side of them";
        case LightOutcome::shaded_sides:
            return "no shadows found: what is dark at " + vehiclesText(finding.vehicles) +
                   " is their own shaded sides, since boxes hold all of it";
    }
    return {};
}

}  // namespace

const char* nameOf(LightOutcome outcome) {
    switch (outcome) {
        case LightOutcome::shadows:
            return "shadows";
        case LightOutcome::beams:
            return "beams";
        case LightOutcome::switched_off:
            return "switched off";
        case LightOutcome::no_scale:
            return "no scale";
        case LightOutcome::no_classifier:
            return "no classifier";
        case LightOutcome::no_pictures:
            return "no pictures";
        case LightOutcome::few_vehicles:
            return "few vehicles";
        case LightOutcome::short_shadows:
            return "short shadows";
        case LightOutcome::disagreement:
            return "disagreement";
        case LightOutcome::shaded_sides:
            return "shaded sides";
    }
    return "";
}

std::string describe(const FrameShadow& shadow, const SceneScale& scale) {
    return "to " + directionOf(shadow.heading) + ", " + reachOf(shadow.reach_px, scale);
}

cv::Point2d shadowReach(const FrameShadow& shadow, cv::Point2d place, const SceneScale& scale) {
    const double reach = shadow.reach_px * scale.slope.factorAt(place);
    return {reach * std::cos(shadow.heading), reach * std::sin(shadow.heading)};
}

std::vector<cv::Point2d> shadowOutline(const OrientedBox& box, cv::Point2d reach) {
    enum class Side { near, far, both };
    const cv::Point2d in_box = box.toBox(box.centre + reach);
    const std::array<cv::Point2d, 4> corners = box.corners();
    std::array<Side, 4> sides{};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const cv::Point2d corner = box.toBox(corners[i]);
        const double x = corner.x * in_box.x;
        const double y = corner.y * in_box.y;
        sides[i] = x >= 0 && y >= 0 ? Side::far : x <= 0 && y <= 0 ? Side::near : Side::both;
    }
    std::vector<cv::Point2d> outline;
    outline.reserve(6);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const bool from_far = sides[(i + 3) % 4] == Side::far;
        if (sides[i] == Side::far || (sides[i] == Side::both && from_far)) outline.push_back(corners[i] + reach);
        if (sides[i] != Side::far) outline.push_back(corners[i]);
        if (sides[i] == Side::both && !from_far) outline.push_back(corners[i] + reach);
    }
    return outline;
}

std::string wayOnScreen(double heading) {
    static constexpr std::array<const char*, 8> kWays{
        "to the right", "to the lower right", "down", "to the lower left",
        "to the left",  "to the upper left",  "up",   "to the upper right"};
    const double eighths = degreesFromRadians(heading) / 45;
    return kWays[static_cast<std::size_t>(std::lround(eighths)) % kWays.size()];
}

std::string describe(const std::vector<LightFinding>& findings, const SceneScale& scale) {
    const auto longest = [&](bool with_shadows) -> const LightFinding* {
        const LightFinding* best = nullptr;
        for (const LightFinding& finding : findings) {
            if ((finding.outcome == LightOutcome::shadows) != with_shadows) continue;
            if (best == nullptr || framesOf(finding) > framesOf(*best)) best = &finding;
        }
        return best;
    };
    const LightFinding* shadows = longest(true);
    if (shadows == nullptr) {
        const LightFinding* none = longest(false);
        if (none == nullptr) return {};
        if (none->outcome != LightOutcome::beams) return whyNone(*none);
        return "night: what the headlights of " + vehiclesText(none->vehicles) + " light about them was " +
               takenOut(*none);
    }
    std::string text = shadowsText(*shadows, scale);
    const auto others = std::count_if(findings.begin(), findings.end(), [&](const LightFinding& finding) {
        return &finding != shadows && finding.outcome == LightOutcome::shadows;
    });
    if (others > 0)
        text += "; the like in " + countText(static_cast<std::size_t>(others), "other stretch", "other stretches");
    if (const LightFinding* none = longest(false))
        text += ". In frames " + std::to_string(none->first_frame) + " to " + std::to_string(none->last_frame) + " " +
                whyNone(*none);
    return text;
}

std::string describe(const BoxTrim& trim) {
    const std::string share = trim.taken < 0.005 ? "less than 1 %" : percentOf(trim.taken);
    return (trim.what == LightOutcome::beams ? "what its headlights light was taken out of its boxes: "
                                             : "its shadow was taken out of its boxes: ") +
           share + " of their area";
}

}  // namespace eyrie

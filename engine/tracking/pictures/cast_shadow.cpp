#include "tracking/pictures/cast_shadow.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/robust_statistics.h"
#include "tracking/pictures/shadow_share.h"

namespace eyrie {
namespace {

constexpr double kShortestShadow = 0.25;  ///< m
constexpr double kLeastAgreement = 0.8;   ///< of what vehicles say
constexpr double kLargestResidual = 0.4;  ///< of the reach
constexpr double kMainSide = 0.5;         ///< of the reach: a side that the shadow falls to
constexpr double kWhollyInBoxes = 0.95;   ///< share from which on it is no shadow on the ground
constexpr double kSaysSomething = 0.1;    ///< m
constexpr double kShrinkage = 0.03;       ///< towards no shadow, along axes on which no vehicle says anything
constexpr double kLeastScatter = 0.05;    ///< m
constexpr int kFitRounds = 10;

/// What a look says of the shadow along one axis of its vehicle.
struct ShadowSide {
    std::pair<TrackId, bool> of;  ///< track, and whether along it
    cv::Point2d axis;             ///< unit vector in the first picture of the stretch
    double reach = 0;             ///< m, signed along it
    double weight = 1;            ///< every vehicle counts once
};

/// Weighted least squares, outliers counting less from round to round.
cv::Point2d fittedReach(const std::vector<ShadowSide>& sides) {
    cv::Point2d reach(0, 0);
    std::vector<double> weights;
    weights.reserve(sides.size());
    for (const ShadowSide& side : sides) weights.push_back(side.weight);
    for (int round = 0; round < kFitRounds; ++round) {
        cv::Matx22d normal = cv::Matx22d::zeros();
        cv::Vec2d right(0, 0);
        double total = 0;
        for (std::size_t i = 0; i < sides.size(); ++i) {
            const cv::Vec2d axis(sides[i].axis.x, sides[i].axis.y);
            normal += weights[i] * (axis * axis.t());
            right += weights[i] * sides[i].reach * axis;
            total += weights[i];
        }
        normal += kShrinkage * total * cv::Matx22d::eye();
        const cv::Vec2d solved = normal.inv() * right;
        reach = {solved[0], solved[1]};
        std::vector<double> off;
        off.reserve(sides.size());
        for (const ShadowSide& side : sides) off.push_back(std::abs(side.reach - side.axis.dot(reach)));
        const double scatter = 1.5 * medianOf(off) + kLeastScatter;
        for (std::size_t i = 0; i < sides.size(); ++i)
            weights[i] = sides[i].weight / (1 + off[i] * off[i] / (scatter * scatter));
    }
    return reach;
}

/// Of those sides of vehicles on which a shadow of that reach shows, the share that usually say so, by weight: a single
/// look is right to within a pixel or two, which may be all of a short shadow.
double agreementOf(const std::vector<ShadowSide>& sides, cv::Point2d reach) {
    struct Said {
        std::vector<double> reaches;
        double weight = 0;
    };
    std::map<std::pair<TrackId, bool>, Said> said;
    for (const ShadowSide& side : sides) {
        const double expected = side.axis.dot(reach);
        if (std::abs(expected) <= kMainSide * std::hypot(reach.x, reach.y)) continue;
        said[side.of].reaches.push_back(std::copysign(1.0, expected) * side.reach);
        said[side.of].weight += side.weight;
    }
    double shows = 0;
    double agrees = 0;
    for (const auto& [of, each] : said) {
        shows += each.weight;
        if (medianOf(each.reaches) > kSaysSomething) agrees += each.weight;
    }
    return shows > 0 ? agrees / shows : 0;
}

bool showsVehicle(const SilhouetteLook& look) {
    return look.silhouette && look.silhouette->lit_vehicle;
}

using LooksOfStretch = std::vector<const SilhouetteLook*>;

/// What the sure looks of a stretch say, and of how many tracks they are.
std::pair<std::vector<ShadowSide>, int> sidesOf(const LooksOfStretch& looks, const GroundTurns& turns,
                                                const SceneScale& scale) {
    std::map<TrackId, int> looks_of;
    for (const SilhouetteLook* look : looks) {
        if (showsVehicle(*look)) ++looks_of[look->track];
    }
    std::vector<ShadowSide> sides;
    for (const SilhouetteLook* look : looks) {
        if (!showsVehicle(*look)) continue;
        const GroundTurns::Turn& turn = turns.at(look->frame);
        const double metre = scale.at(turn.stretch, look->box.centre).px(1) * turn.enlargement;
        const BoxEdges& whole = look->silhouette->whole;
        const BoxEdges& lit = *look->silhouette->lit;
        const double heading = look->box.heading - turn.angle;
        const cv::Point2d along(std::cos(heading), std::sin(heading));
        const double weight = 1.0 / looks_of[look->track];
        sides.push_back(
            {{look->track, true}, along, (whole.front - lit.front + whole.rear - lit.rear) / metre, weight});
        sides.push_back({{look->track, false},
                         {-along.y, along.x},
                         (whole.right - lit.right + whole.left - lit.left) / metre,
                         weight});
    }
    return {sides, static_cast<int>(looks_of.size())};
}

/// How much darker the ground is in the shade of sure vehicles.
std::optional<double> darkeningOf(const LooksOfStretch& looks) {
    std::vector<double> shades;
    for (const SilhouetteLook* look : looks) {
        if (showsVehicle(*look) && look->silhouette->shade) shades.push_back(*look->silhouette->shade);
    }
    if (shades.empty()) return std::nullopt;
    return 1 - medianOf(std::move(shades));
}

/// Whether boxes usually hold all of it: then it is the vehicles' own shaded side, which an oblique view shows. Boxes
/// rarely hold a whole shadow.
bool isShadedSide(const CastShadow& shadow, const LooksOfStretch& looks, const GroundTurns& turns,
                  const SceneScale& scale) {
    std::vector<double> shares;
    for (const SilhouetteLook* look : looks) {
        const cv::Point2d reach = reachAt(shadow, turns.at(look->frame), look->box.centre, scale);
        const ShadowShare share = shareInBox(*look, reach, kMainSide);
        if (share.along) shares.push_back(*share.along);
        if (share.across) shares.push_back(*share.across);
    }
    return medianOf(shares) >= kWhollyInBoxes;
}

}  // namespace

std::vector<StretchLight> readLight(const std::vector<SilhouetteLook>& looks, const GroundTurns& turns,
                                    const SceneScale& scale) {
    std::map<FrameIndex, LooksOfStretch> by_stretch;
    for (const SilhouetteLook& look : looks) by_stretch[turns.at(look.frame).stretch].push_back(&look);
    std::vector<StretchLight> read;
    read.reserve(by_stretch.size());
    for (const auto& [stretch, of_stretch] : by_stretch) {
        StretchLight& light = read.emplace_back();
        const auto [sides, tracks] = sidesOf(of_stretch, turns, scale);
        light.shadow.stretch = stretch;
        light.shadow.tracks = tracks;
        light.outcome = LightOutcome::few_vehicles;
        if (tracks < kFewestShadowVehicles) continue;
        const cv::Point2d fitted = fittedReach(sides);
        light.shadow.reach_m = fitted;
        light.shadow.agreement = agreementOf(sides, fitted);
        light.darkening = darkeningOf(of_stretch);
        const double reach = std::hypot(fitted.x, fitted.y);
        std::vector<double> off;
        off.reserve(sides.size());
        for (const ShadowSide& side : sides) off.push_back(std::abs(side.reach - side.axis.dot(fitted)));
        light.scatter_m = medianOf(std::move(off));
        if (reach < kShortestShadow)
            light.outcome = LightOutcome::short_shadows;
        else if (light.shadow.agreement < kLeastAgreement || light.scatter_m > kLargestResidual * reach)
            light.outcome = LightOutcome::disagreement;
        else
            light.outcome = isShadedSide(light.shadow, of_stretch, turns, scale) ? LightOutcome::shaded_sides
                                                                                 : LightOutcome::shadows;
    }
    return read;
}

std::vector<CastShadow> shadowsOf(const std::vector<StretchLight>& read) {
    std::vector<CastShadow> shadows;
    for (const StretchLight& light : read) {
        if (light.outcome == LightOutcome::shadows) shadows.push_back(light.shadow);
    }
    return shadows;
}

const CastShadow* shadowIn(const std::vector<CastShadow>& shadows, FrameIndex stretch) {
    const auto found =
        std::lower_bound(shadows.begin(), shadows.end(), stretch,
                         [](const CastShadow& shadow, FrameIndex wanted) { return shadow.stretch < wanted; });
    return found != shadows.end() && found->stretch == stretch ? &*found : nullptr;
}

cv::Point2d reachAt(const CastShadow& shadow, const GroundTurns::Turn& turn, cv::Point2d place,
                    const SceneScale& scale) {
    const double metre = scale.at(turn.stretch, place).px(1) * turn.enlargement;
    const double c = std::cos(turn.angle) * metre;
    const double s = std::sin(turn.angle) * metre;
    return {c * shadow.reach_m.x - s * shadow.reach_m.y, s * shadow.reach_m.x + c * shadow.reach_m.y};
}

}  // namespace eyrie

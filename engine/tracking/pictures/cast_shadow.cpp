#include "tracking/pictures/cast_shadow.h"

#include <cmath>
#include <map>

#include "core/robust_statistics.h"
#include "tracking/pictures/shadow_share.h"

namespace eyrie {
namespace {

constexpr int kFewestTracks = 4;          ///< one vehicle may be dark on one side
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
    cv::Point2d axis;   ///< unit vector in the first picture of the stretch
    double reach = 0;   ///< m, signed along it
    double weight = 1;  ///< every vehicle counts once
};

double dot(cv::Point2d a, cv::Point2d b) {
    return a.x * b.x + a.y * b.y;
}

/// Weighted least squares, outliers counting less from round to round.
cv::Point2d fittedReach(const std::vector<ShadowSide>& sides) {
    cv::Point2d reach(0, 0);
    std::vector<double> weights;
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
        for (const ShadowSide& side : sides) off.push_back(std::abs(side.reach - dot(side.axis, reach)));
        const double scatter = 1.5 * medianOf(off) + kLeastScatter;
        for (std::size_t i = 0; i < sides.size(); ++i)
            weights[i] = sides[i].weight / (1 + off[i] * off[i] / (scatter * scatter));
    }
    return reach;
}

/// Of those sides on which a shadow of that reach shows, the share that say so, by weight.
double agreementOf(const std::vector<ShadowSide>& sides, cv::Point2d reach) {
    double shows = 0;
    double agrees = 0;
    for (const ShadowSide& side : sides) {
        const double expected = dot(side.axis, reach);
        if (std::abs(expected) <= kMainSide * std::hypot(reach.x, reach.y)) continue;
        shows += side.weight;
        if (side.reach * expected > 0 && std::abs(side.reach) > kSaysSomething) agrees += side.weight;
    }
    return shows > 0 ? agrees / shows : 0;
}

/// Whether boxes usually hold all of it: then it is the vehicles' own shaded side, which an oblique view shows. Boxes
/// rarely hold a whole shadow.
bool isShadedSide(const CastShadow& shadow, const std::vector<SilhouetteLook>& looks, const GroundTurns& turns,
                  const SceneScale& scale) {
    std::vector<double> shares;
    for (const SilhouetteLook& look : looks) {
        const GroundTurns::Turn& turn = turns.at(look.frame);
        if (turn.stretch != shadow.stretch) continue;
        const ShadowShare share = shareInBox(look, reachAt(shadow, turn, look.box.centre, scale), kMainSide);
        if (share.along) shares.push_back(*share.along);
        if (share.across) shares.push_back(*share.across);
    }
    return medianOf(shares) >= kWhollyInBoxes;
}

}  // namespace

std::vector<CastShadow> castShadows(const std::vector<SilhouetteLook>& looks, const GroundTurns& turns,
                                    const SceneScale& scale) {
    std::map<std::pair<FrameIndex, TrackId>, int> looks_of;  // sure ones, by stretch and track
    for (const SilhouetteLook& look : looks) {
        if (look.silhouette.lit_vehicle) ++looks_of[{turns.at(look.frame).stretch, look.track}];
    }
    std::map<FrameIndex, std::vector<ShadowSide>> sides_of;
    std::map<FrameIndex, int> tracks_of;
    for (const auto& [key, count] : looks_of) ++tracks_of[key.first];
    for (const SilhouetteLook& look : looks) {
        if (!look.silhouette.lit_vehicle) continue;
        const GroundTurns::Turn& turn = turns.at(look.frame);
        const double metre = scale.at(look.box.centre).px(1) * turn.enlargement;
        const BoxEdges& whole = look.silhouette.whole;
        const BoxEdges& lit = *look.silhouette.lit;
        const double heading = look.box.heading - turn.angle;
        const cv::Point2d along(std::cos(heading), std::sin(heading));
        const double weight = 1.0 / looks_of[{turn.stretch, look.track}];
        std::vector<ShadowSide>& sides = sides_of[turn.stretch];
        sides.push_back({along, (whole.front - lit.front + whole.rear - lit.rear) / metre, weight});
        sides.push_back({{-along.y, along.x}, (whole.right - lit.right + whole.left - lit.left) / metre, weight});
    }
    std::vector<CastShadow> shadows;
    for (const auto& [stretch, sides] : sides_of) {
        CastShadow shadow{stretch, {0, 0}, tracks_of[stretch], 0};
        if (shadow.tracks < kFewestTracks) continue;
        shadow.reach_m = fittedReach(sides);
        shadow.agreement = agreementOf(sides, shadow.reach_m);
        const double reach = std::hypot(shadow.reach_m.x, shadow.reach_m.y);
        std::vector<double> off;
        for (const ShadowSide& side : sides) off.push_back(std::abs(side.reach - dot(side.axis, shadow.reach_m)));
        if (reach < kShortestShadow || shadow.agreement < kLeastAgreement || medianOf(off) > kLargestResidual * reach)
            continue;
        if (!isShadedSide(shadow, looks, turns, scale)) shadows.push_back(shadow);
    }
    return shadows;
}

cv::Point2d reachAt(const CastShadow& shadow, const GroundTurns::Turn& turn, cv::Point2d place,
                    const SceneScale& scale) {
    const double metre = scale.at(place).px(1) * turn.enlargement;
    const double c = std::cos(turn.angle) * metre;
    const double s = std::sin(turn.angle) * metre;
    return {c * shadow.reach_m.x - s * shadow.reach_m.y, s * shadow.reach_m.x + c * shadow.reach_m.y};
}

}  // namespace eyrie

#include <algorithm>
#include <cmath>
#include <map>

#include "core/robust_statistics.h"
#include "tracking/pictures/cast_shadow.h"
#include "tracking/pictures/shadow_share.h"

namespace eyrie {
namespace {

constexpr std::size_t kFewestLooks = 2;
constexpr double kFallsAside = 0.15;  ///< share of the reach from which on a side says how much of it is in the box
constexpr double kLeastOfBox = 0.5;   ///< share of a box's length and width that stays

/// What the looks at a track say.
struct TrackShares {
    std::vector<double> along, across;
};

double usualShare(const std::vector<double>& shares) {
    return shares.size() >= kFewestLooks ? medianOf(shares) : 0;
}

/// A box without what lies at one end of each axis.
OrientedBox withoutEnds(const OrientedBox& box, cv::Point2d less) {
    const double along = std::copysign(std::min(std::abs(less.x), (1 - kLeastOfBox) * box.length), less.x);
    const double across = std::copysign(std::min(std::abs(less.y), (1 - kLeastOfBox) * box.width), less.y);
    return {box.toImage({-along / 2, -across / 2}), box.length - std::abs(along), box.width - std::abs(across),
            box.heading};
}

}  // namespace

std::map<TrackId, BoxTrim> takeOutShadows(std::vector<TrackPath>& paths, const std::vector<SilhouetteLook>& looks,
                                          const std::vector<CastShadow>& shadows, const GroundTurns& turns,
                                          const SceneScale& scale) {
    std::map<TrackId, TrackShares> shares;
    for (const SilhouetteLook& look : looks) {
        const GroundTurns::Turn& turn = turns.at(look.frame);
        const CastShadow* shadow = shadowIn(shadows, turn.stretch);
        if (shadow == nullptr) continue;
        const ShadowShare share = shareInBox(look, reachAt(*shadow, turn, look.box.centre, scale), kFallsAside);
        if (share.along) shares[look.track].along.push_back(*share.along);
        if (share.across) shares[look.track].across.push_back(*share.across);
    }
    std::map<TrackId, BoxTrim> trims;
    for (TrackPath& path : paths) {
        const double along = usualShare(shares[path.id].along);
        const double across = usualShare(shares[path.id].across);
        if (along == 0 && across == 0) continue;
        double whole = 0;
        double left = 0;
        for (auto& [frame, state] : path.states) {
            const GroundTurns::Turn& turn = turns.at(frame);
            const CastShadow* shadow = shadowIn(shadows, turn.stretch);
            if (shadow == nullptr) continue;
            const OrientedBox box = state.box;
            const cv::Point2d reach = box.toBox(box.centre + reachAt(*shadow, turn, box.centre, scale));
            state.box = withoutEnds(box, {along * reach.x, across * reach.y});
            whole += box.area();
            left += state.box.area();
        }
        if (left < whole) trims[path.id] = {LightOutcome::shadows, along, across, 1 - left / whole};
    }
    return trims;
}

}  // namespace eyrie

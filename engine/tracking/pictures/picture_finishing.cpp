#include "tracking/pictures/picture_finishing.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "tracking/finishing/frames_of.h"
#include "tracking/finishing/track_paths.h"
#include "tracking/pictures/cast_shadow.h"
#include "tracking/pictures/headlight_beams.h"
#include "tracking/pictures/light_telling.h"
#include "tracking/pictures/long_vehicles.h"

namespace eyrie {
namespace {

constexpr double kLongestStretch = 300;  ///< s in which shadows fall one way

/// By each track that another took up: which one did. That one may have been taken up, too.
using TakenUp = std::map<TrackId, TrackId>;

TrackId ownerOf(const TakenUp& taken_up, TrackId track) {
    for (auto owner = taken_up.find(track); owner != taken_up.end(); owner = taken_up.find(track))
        track = owner->second;
    return track;
}

/// Joins those that meet: they keep the better score, and what speaks for it.
TakenUp joinFollowed(FinishedTracks& finished, const FollowedEnds& followed, const GroundMotion& ground,
                     const FinishingOptions& options, const SceneScale& scale) {
    std::vector<TrackPath>& paths = finished.paths;
    TakenUp taken_up;
    for (const auto& [older, later] : joinMeeting(paths, followed, ground, options, scale)) {
        const TrackEvidence of_later = finished.evidence[later];
        TrackEvidence& evidence = finished.evidence[older];
        if (of_later.score > evidence.score) evidence = of_later;
        finished.evidence.erase(later);
        taken_up[later] = older;
    }
    if (taken_up.empty()) return taken_up;
    std::set<TrackId> grown;
    for (const auto& [later, older] : taken_up) grown.insert(ownerOf(taken_up, older));
    for (DroppedPath& path : finished.dropped) path.beside = ownerOf(taken_up, path.beside);
    for (TrackPath& path : paths) {
        if (!grown.contains(path.id)) continue;
        for (auto& [frame, state] : path.states) state.score = static_cast<float>(finished.evidence[path.id].score);
    }
    return taken_up;
}

/// Follows tracks on where they end, and joins those that meet.
TakenUp followOn(FinishedTracks& finished, const GroundMotion& ground, const FinishingOptions& options,
                 const SceneScale& scale, const GrayOfFrame& gray_at) {
    const int frames = framesOf(options.follow_ends_s, scale);
    const FollowedEnds followed = followEnds(finished.paths, ground, gray_at, frames, scale);
    return joinFollowed(finished, followed, ground, options, scale);
}

/// Makes boxes reach whole lorries, whose parts in other tracks are theirs from then on. Leaves out of the looks those
/// at boxes that it changed.
void makeWhole(FinishedTracks& finished, std::vector<SilhouetteLook>& looks, const std::vector<CastShadow>& shadows,
               const GroundTurns& turns, const GroundMotion& ground, const FinishingOptions& options,
               const SceneScale& scale) {
    const PartsByVehicle parts = reachWholeVehicles(finished.paths, looks, shadows, turns, scale);
    if (parts.empty()) return;
    std::set<TrackId> longer;
    for (const auto& [id, of_vehicle] : parts) longer.insert(id);
    std::vector<std::pair<FrameSpan, TrackId>> spans;
    for (const TrackPath& path : finished.paths) {
        if (longer.contains(path.id)) spans.push_back({{path.firstFrame(), path.lastFrame()}, path.id});
    }
    const TakenUp taken_up = joinFollowed(finished, {longer, longer}, ground, options, scale);
    std::map<TrackId, std::vector<FrameSpan>> whole;
    std::sort(spans.begin(), spans.end());
    for (const auto& [span, id] : spans) whole[ownerOf(taken_up, id)].push_back(span);
    for (TrackPath& path : finished.paths) {
        if (const auto of_path = whole.find(path.id); of_path != whole.end()) reachAlong(path, of_path->second, ground);
    }
    PartsByVehicle lorries;
    for (const auto& [id, of_vehicle] : parts) {
        std::set<TrackId>& of_owner = lorries[ownerOf(taken_up, id)];
        for (const TrackId part : of_vehicle) of_owner.insert(ownerOf(taken_up, part));
    }
    dropPartsOf(lorries, finished.paths, scale, finished.dropped);
    std::erase_if(looks, [&](const SilhouetteLook& look) { return lorries.contains(ownerOf(taken_up, look.track)); });
}

GroundTurns turnsOf(const std::vector<TrackPath>& paths, const GroundMotion& ground, const SceneScale& scale) {
    FrameIndex first = paths.front().firstFrame();
    FrameIndex last = first;
    for (const TrackPath& path : paths) {
        first = std::min(first, path.firstFrame());
        last = std::max(last, path.lastFrame());
    }
    return GroundTurns(ground, first, last, std::max(1, framesOf(kLongestStretch, scale)));
}

/// Those at tracks that are surely vehicles by their score: what others show of the light is no evidence.
std::vector<SilhouetteLook> sureOnes(const std::vector<SilhouetteLook>& looks) {
    std::vector<SilhouetteLook> sure;
    std::copy_if(looks.begin(), looks.end(), std::back_inserter(sure),
                 [](const SilhouetteLook& look) { return look.sure; });
    return sure;
}

}  // namespace

void finishByPictures(FinishedTracks& finished, const GroundMotion& ground, const FinishingOptions& options,
                      const SceneScale& scale, const GrayOfFrame& gray_at) {
    std::vector<TrackPath>& paths = finished.paths;
    if (!gray_at || paths.empty()) {
        finished.light = untoldLight(paths, LightOutcome::no_pictures);
        return;
    }
    if (!(options.trim_shadows || options.whole_lorries) || !hasMetricLimits(scale)) {
        finished.light = untoldLight(paths, options.trim_shadows ? LightOutcome::no_scale : LightOutcome::switched_off);
        followOn(finished, ground, options, scale, gray_at);
        return;
    }
    SilhouetteSearch search(paths, ground, scale);
    // Both go through the run together, so that a picture is decoded once.
    const TakenUp taken_up = followOn(finished, ground, options, scale, [&](FrameIndex frame) {
        search.readUpTo(frame, gray_at);
        cv::Mat gray = gray_at(frame);
        search.show(frame, gray);
        return gray;
    });
    std::vector<SilhouetteLook> all_looks = search.finish(gray_at);
    for (SilhouetteLook& look : all_looks) look.track = ownerOf(taken_up, look.track);
    const GroundTurns turns = turnsOf(paths, ground, scale);
    std::vector<SilhouetteLook> looks = sureOnes(all_looks);
    const std::vector<StretchLight> light = readLight(looks, turns, scale);
    const std::vector<CastShadow> shadows = shadowsOf(light);
    // Where the sun casts shadows headlights light nothing, and what seems to be lit ahead is a bright vehicle.
    const bool dark = shadows.empty() && driveWithHeadlights(looks);
    const std::size_t dropped_before = finished.dropped.size();
    if (options.drop_shadows && options.trim_shadows)
        dropShadowTracks(paths, all_looks, shadows, turns, scale, finished.dropped);
    std::vector<TrackPath> mere_shadows;
    for (std::size_t i = dropped_before; i < finished.dropped.size(); ++i)
        mere_shadows.push_back(finished.dropped[i].path);
    if (options.whole_lorries && !dark) {
        makeWhole(finished, all_looks, shadows, turns, ground, options, scale);
        looks = sureOnes(all_looks);
    }
    if (!options.trim_shadows) {
        finished.light = untoldLight(paths, LightOutcome::switched_off);
        return;
    }
    if (dark) {
        finished.light = toldBeams(takeOutBeams(paths, looks), turns);
        return;
    }
    std::map<TrackId, BoxTrim> trims = takeOutShadows(paths, looks, shadows, turns, scale);
    finished.light = toldShadows(light, turns, scale, paths, std::move(trims), mere_shadows);
}

}  // namespace eyrie

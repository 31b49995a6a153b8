#include "tracking/pictures/picture_finishing.h"

#include <algorithm>
#include <set>
#include <vector>

#include "tracking/finishing/frames_of.h"
#include "tracking/finishing/track_paths.h"
#include "tracking/pictures/cast_shadow.h"

namespace eyrie {
namespace {

/// Which track went into which; the latest first.
using JoinedTracks = std::vector<std::pair<TrackId, TrackId>>;

/// Follows tracks on where they end, and joins those that meet: they keep the better score, and what speaks for it.
JoinedTracks followOn(FinishedTracks& finished, const GroundMotion& ground, const FinishingOptions& options,
                      const SceneScale& scale, const GrayOfFrame& gray_at) {
    std::vector<TrackPath>& paths = finished.paths;
    const FollowedEnds followed = followEnds(paths, ground, gray_at, framesOf(options.follow_ends_s, scale), scale);
    JoinedTracks joined = joinMeeting(paths, followed, ground, options, scale);
    std::set<TrackId> grown;
    for (const auto& [older, later] : joined) {
        const TrackEvidence of_later = finished.evidence[later];
        TrackEvidence& evidence = finished.evidence[older];
        if (of_later.score > evidence.score) evidence = of_later;
        finished.evidence.erase(later);
        grown.insert(older);
        for (DroppedPath& path : finished.dropped) {
            if (path.beside == later) path.beside = older;
        }
    }
    for (TrackPath& path : paths) {
        if (!grown.contains(path.id)) continue;
        for (auto& [frame, state] : path.states) state.score = static_cast<float>(finished.evidence[path.id].score);
    }
    return joined;
}

GroundTurns turnsOf(const std::vector<TrackPath>& paths, const GroundMotion& ground) {
    FrameIndex first = paths.front().firstFrame();
    FrameIndex last = first;
    for (const TrackPath& path : paths) {
        first = std::min(first, path.firstFrame());
        last = std::max(last, path.lastFrame());
    }
    return GroundTurns(ground, first, last);
}

}  // namespace

void finishByPictures(FinishedTracks& finished, const GroundMotion& ground, const FinishingOptions& options,
                      const SceneScale& scale, const GrayOfFrame& gray_at) {
    std::vector<TrackPath>& paths = finished.paths;
    if (!gray_at || paths.empty()) return;
    if (!options.trim_shadows) {
        followOn(finished, ground, options, scale, gray_at);
        return;
    }
    SilhouetteSearch search(paths, ground, scale);
    // Both go through the run together, so that a picture is decoded once.
    const JoinedTracks joined = followOn(finished, ground, options, scale, [&](FrameIndex frame) {
        search.readUpTo(frame, gray_at);
        cv::Mat gray = gray_at(frame);
        search.show(frame, gray);
        return gray;
    });
    std::vector<SilhouetteLook> looks = search.finish(gray_at);
    for (const auto& [older, later] : joined) {
        for (SilhouetteLook& look : looks) {
            if (look.track == later) look.track = older;
        }
    }
    const GroundTurns turns = turnsOf(paths, ground);
    takeOutShadows(paths, looks, castShadows(looks, turns, scale), turns, scale);
}

}  // namespace eyrie

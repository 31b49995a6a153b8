#include "chain/scale/scale_trial.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "chain/chain.h"
#include "core/robust_statistics.h"

namespace eyrie {
namespace {

// Shares of a look; what is longer than one counts as one.
constexpr double kSettling = 0.35;   ///< until tracks have formed, …
constexpr int kSettlingFrames = 5;   ///< … but so many frames at least
constexpr double kFewestSeen = 0.2;  ///< in which a track has to be seen, …
constexpr int kFewestStates = 3;     ///< … but in so many frames at least
constexpr double kAtTrack = 0.5;     ///< of its length, from which a detection is off its middle at most

/// Whether the classifier takes what is at a track's place for a whole vehicle.
bool looksWhole(const OrientedBox& box, const std::vector<Detection>& detections) {
    return std::any_of(detections.begin(), detections.end(), [&](const Detection& detection) {
        const cv::Point2d off = detection.box.centre - box.centre;
        return detection.complete && std::hypot(off.x, off.y) < kAtTrack * box.length;
    });
}

}  // namespace

std::optional<FrameIndex> lastOfLook(const FrameSource& source, FrameRange range) {
    const FrameIndex end = source.info().frame_count - 1;
    const FrameIndex last = range.last < 0 ? end : std::min(range.last, end);
    if (range.first < 0 || range.first > last) return std::nullopt;
    return last;
}

std::array<FrameIndex, 3> startsOfLooks(FrameIndex first, FrameIndex last, int frames) {
    const FrameIndex farthest = std::max(first, last - frames + 1);
    return {first, first + (farthest - first) / 2, farthest};
}

ScaleOutcome outcomeUnder(int count, const FrameOfLook& frame_of, const ChainOptions& options, const SceneScale& scale,
                          const std::stop_token& stop, const std::function<void()>& tell) {
    struct Seen {
        std::vector<double> lengths, widths, speeds;
        int looked_whole = 0;  ///< frames
    };
    ScaleOutcome outcome;
    Chain chain(options, scale);
    std::map<TrackId, Seen> tracks;
    const int look = std::min(count, kFramesOfLook);
    const int settled = std::max(kSettlingFrames, static_cast<int>(std::lround(kSettling * look)));
    const int fewest = std::max(kFewestStates, static_cast<int>(std::lround(kFewestSeen * look)));
    for (int i = 0; i < count && !stop.stop_requested(); ++i) {
        const FrameResult result = chain.next(frame_of(i));
        tell();
        for (const Detection& detection : result.detections) {
            ++outcome.detections;
            if (!detection.complete) continue;
            ++outcome.looks;
            outcome.decision += detection.score;
        }
        if (i < settled) continue;
        for (const auto& track : result.tracks) {
            if (track.status != TrackStatus::confirmed) continue;
            const SceneScale here = scale.at(track.box.centre);
            Seen& seen = tracks[track.id];
            seen.looked_whole += looksWhole(track.box, result.detections) ? 1 : 0;
            seen.lengths.push_back(here.metres(track.box.length));
            seen.widths.push_back(here.metres(track.box.width));
            seen.speeds.push_back(here.metresPerSecond(std::hypot(track.velocity.x, track.velocity.y)));
        }
    }
    for (auto& [id, seen] : tracks) {
        if (std::ssize(seen.lengths) < fewest) continue;
        const double whole = seen.looked_whole / static_cast<double>(count - settled);
        ++outcome.tracks;
        outcome.whole_tracks += whole;
        if (!isCarSized(medianOf(seen.lengths), medianOf(seen.widths))) continue;
        ++outcome.cars;
        outcome.whole_cars += whole;
        // What relief and haze seem to move is slow.
        if (seen.looked_whole > 0) outcome.car_speeds_m_s.push_back(medianOf(seen.speeds));
    }
    return outcome;
}

ChainOptions lookingOptions(const ChainOptions& options) {
    ChainOptions looking = options;
    looking.detection = DetectionOptions{};
    // Scales are told apart by what each finds in search areas of the same size in metres.
    looking.detection.min_roi_length_px = 0;
    looking.detection.min_roi_width_px = 0;
    looking.detection.sliding_window.model = options.detection.sliding_window.model;
    return looking;
}

}  // namespace eyrie

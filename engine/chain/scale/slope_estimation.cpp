#include "chain/scale/slope_estimation.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "chain/chain.h"
#include "chain/scale/camera_slope.h"
#include "chain/scale/look_progress.h"
#include "chain/scale/moving_votes.h"
#include "chain/scale/scale_slope_fit.h"
#include "chain/scale/scale_trial.h"
#include "core/error.h"

namespace eyrie {
namespace {

constexpr int kSlopeFrames = 34;             ///< of a stretch
constexpr int kStretches = 3;                ///< at most: start, middle and end
constexpr std::array kLooks{17, 25, 33};     ///< frames of a stretch in which is looked; vehicles moved on in between
constexpr double kWidestRange = 3.5;         ///< factor by which the scale may be finer or coarser anywhere
constexpr std::size_t kPlentyOfVotes = 100;  ///< with which no other stretch is looked at

/// What votes from a frame on; the camera's way there is told to `camera`.
std::vector<ScaleVote> votesFrom(FrameSource& source, FrameIndex first, FrameIndex last, const ChainOptions& options,
                                 const SceneScale& scale, const ScaleLooker& looker, const std::stop_token& stop,
                                 LookProgress& progress, CameraSlope& camera) {
    std::vector<ScaleVote> votes;
    CameraWay way;
    MotionHalf motion_half(options, scale);
    const MotionClustering clustering(options.clustering, scale);
    const ScaleRange scales{scale.gsd_m_per_px / kWidestRange, scale.gsd_m_per_px * kWidestRange};
    for (int i = 0; i < kSlopeFrames && first + i <= last && !stop.stop_requested(); ++i) {
        Frame frame;
        try {
            frame = source.read(first + i, false);
        } catch (const Error&) {
            break;  // the run will come to this frame and report it
        }
        StageTimes times{};
        const FrameMotion motion = motion_half.next(frame, times);
        progress.step();
        way.add(motion.registration);
        if (std::find(kLooks.begin(), kLooks.end(), i) == kLooks.end()) continue;
        const std::vector<ScaleVote> found = votesIn(frame, motion, clustering, looker, scales);
        votes.insert(votes.end(), found.begin(), found.end());
    }
    camera.add(way.steps());
    return votes;
}

}  // namespace

ScaleSlope estimateSlope(FrameSource& source, FrameRange range, const ChainOptions& options, const SceneScale& scale,
                         const std::stop_token& stop, const ScaleProgress& told) {
    const std::optional<FrameIndex> last_of_look = lastOfLook(source, range);
    if (!last_of_look) return {};
    const FrameIndex last = *last_of_look;
    std::optional<ScaleLooker> looker;
    try {
        looker.emplace(options.detection.sliding_window);
    } catch (const Error&) {
        return {};  // a run that needs the classifier says so itself
    }
    std::vector<ScaleVote> votes;
    const FrameIndex farthest = std::max(range.first, last - kSlopeFrames + 1);
    FrameIndex looked_to = range.first - 1;
    CameraSlope camera(source.info().size);
    LookProgress progress(told, std::min(kStretches * kSlopeFrames, last - range.first + 1));
    for (const FrameIndex first : {range.first, range.first + (farthest - range.first) / 2, farthest}) {
        if (first <= looked_to || votes.size() >= kPlentyOfVotes || stop.stop_requested()) continue;
        looked_to = first + kSlopeFrames - 1;
        const std::vector<ScaleVote> found =
            votesFrom(source, first, last, options, scale, *looker, stop, progress, camera);
        votes.insert(votes.end(), found.begin(), found.end());
    }
    return stop.stop_requested() ? ScaleSlope{} : fitSlope(votes, source.info().size, scale.gsd_m_per_px, camera);
}

}  // namespace eyrie

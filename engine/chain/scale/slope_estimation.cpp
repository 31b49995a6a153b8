#include "chain/scale/slope_estimation.h"

#include <algorithm>
#include <optional>

#include "chain/scale/look_progress.h"
#include "chain/scale/scale_slope_fit.h"
#include "chain/scale/scale_trial.h"
#include "chain/scale/stretch_look.h"
#include "core/error.h"

namespace eyrie {
namespace {

constexpr int kSlopeFrames = 34;             ///< of a stretch
constexpr int kStretches = 3;                ///< at most: start, middle and end
constexpr double kWidestRange = 3.5;         ///< factor by which the scale may be finer or coarser anywhere
constexpr std::size_t kPlentyOfVotes = 100;  ///< with which no other stretch is looked at

/// Whether a frame of a stretch is looked at: three of its second half, in between which vehicles moved on.
bool isLookedAt(int frame, int frames_of_stretch) {
    return frame == frames_of_stretch / 2 || frame == frames_of_stretch * 3 / 4 || frame == frames_of_stretch - 1;
}

}  // namespace

SlopeLook lookForSlope(FrameSource& source, FrameRange range, const ChainOptions& options, const SceneScale& scale,
                       const std::stop_token& stop, const ScaleProgress& told) {
    SlopeLook look{{}, CameraSlope(source.info().size)};
    const std::optional<FrameIndex> last_of_look = lastOfLook(source, range);
    if (!last_of_look) return look;
    const FrameIndex last = *last_of_look;
    const ScaleRange scales{scale.gsd_m_per_px / kWidestRange, scale.gsd_m_per_px * kWidestRange};
    std::optional<StretchLooker> looker;
    try {
        looker.emplace(options, scale, scales);
    } catch (const Error&) {
        return look;  // a run that needs the classifier says so itself
    }
    FrameIndex looked_to = range.first - 1;
    LookProgress progress(told, std::min(kStretches * kSlopeFrames, last - range.first + 1));
    for (const FrameIndex first : startsOfLooks(range.first, last, kSlopeFrames)) {
        if (first <= looked_to || look.votes.size() >= kPlentyOfVotes || stop.stop_requested()) continue;
        looked_to = std::min(last, first + kSlopeFrames - 1);
        const int frames = looked_to - first + 1;
        const auto counts = [frames](int frame) { return isLookedAt(frame, frames); };
        const StretchLook found = looker->look(source, {first, frames}, counts, stop, progress);
        look.votes.insert(look.votes.end(), found.votes.begin(), found.votes.end());
        look.camera.add(found.steps);
    }
    return look;
}

ScaleSlope estimateSlope(FrameSource& source, FrameRange range, const ChainOptions& options, const SceneScale& scale,
                         const std::stop_token& stop, const ScaleProgress& told) {
    const SlopeLook look = lookForSlope(source, range, options, scale, stop, told);
    if (stop.stop_requested()) return {};
    return fitSlope(look.votes, source.info().size, scale.gsd_m_per_px, look.camera);
}

}  // namespace eyrie

#include "chain/scale/view_estimation.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "chain/scale/look_progress.h"
#include "chain/scale/scale_slope_fit.h"
#include "chain/scale/scale_trial.h"

namespace eyrie {
namespace {

constexpr int kUntilMoving = 12;            ///< frames of a stretch of a look's length until what moves has vectors
constexpr double kLinkedAt = 0.1;           ///< m/px at which they are linked: no car falls to pieces …
constexpr ScaleRange kAnyScale{0.02, 0.6};  ///< … however near or far it is
constexpr double kErrorOfLook = 0.11;       ///< standard error of the logarithm of the scale …
constexpr double kErrorOfLength = 0.15;     ///< … and what one vehicle of unknown length adds
constexpr double kNineOfTen = 1.645;        ///< standard errors that hold 90 %

/// The beginning, the middle and the end; as one where they touch.
std::vector<Stretch> stretchesOf(FrameIndex first, FrameIndex last) {
    std::vector<Stretch> stretches;
    for (const FrameIndex start : startsOfLooks(first, last, kFramesOfLook)) {
        if (stretches.empty() || start > stretches.back().first + stretches.back().count)
            stretches.push_back({start, 0});
        const FrameIndex past = std::min(start + kFramesOfLook, last + 1);
        stretches.back().count = static_cast<int>(past - stretches.back().first);
    }
    return stretches;
}

int framesOf(const std::vector<Stretch>& stretches) {
    int frames = 0;
    for (const Stretch& stretch : stretches) frames += stretch.count;
    return frames;
}

}  // namespace

double uncertaintyOfView(std::size_t vehicles_at_once) {
    const auto vehicles = static_cast<double>(std::max<std::size_t>(vehicles_at_once, 1));
    return std::exp(kNineOfTen * std::hypot(kErrorOfLook, kErrorOfLength / std::sqrt(vehicles)));
}

ViewLook lookForView(FrameSource& source, FrameRange range, const ChainOptions& options, double frame_rate_hz,
                     const std::stop_token& stop, const ScaleProgress& told) {
    ViewLook look{{}, {}, 0, CameraSlope(source.info().size)};
    const std::optional<FrameIndex> last = lastOfLook(source, range);
    if (!last) return look;
    look.stretches = stretchesOf(range.first, *last);
    SceneScale scale;
    scale.gsd_m_per_px = kLinkedAt;
    scale.frame_rate_hz = frame_rate_hz;
    const StretchLooker looker(options, scale, kAnyScale);
    LookProgress progress(told, framesOf(look.stretches));
    for (Stretch& stretch : look.stretches) {
        const int until_moving = kUntilMoving * std::min(stretch.count, kFramesOfLook) / kFramesOfLook;
        const auto counts = [until_moving](int frame) { return frame >= until_moving; };
        const StretchLook found = looker.look(source, stretch, counts, stop, progress);
        stretch.count = found.frames;
        look.votes.insert(look.votes.end(), found.votes.begin(), found.votes.end());
        look.most_at_once = std::max(look.most_at_once, found.most_at_once);
        look.camera.add(found.steps);
    }
    return look;
}

std::optional<EstimatedView> estimateView(FrameSource& source, FrameRange range, const ChainOptions& options,
                                          double frame_rate_hz, const std::stop_token& stop,
                                          const ScaleProgress& told) {
    const ViewLook look = lookForView(source, range, options, frame_rate_hz, stop, told);
    const std::vector<ViewFit> views = fitView(look.votes, source.info().size, look.camera);
    LookProgress trying(told, static_cast<int>(views.size()) * framesOf(look.stretches));
    std::vector<ScaleOutcome> outcomes(views.size());
    for (std::size_t i = 0; i < views.size(); ++i) {
        const SceneScale scale{views[i].gsd_m_per_px, frame_rate_hz, false, views[i].slope};
        for (const Stretch& stretch : look.stretches) {
            const auto frame_of = [&](int k) { return source.read(stretch.first + k, false); };
            const ScaleOutcome found =
                outcomeUnder(stretch.count, frame_of, lookingOptions(options), scale, stop, [&] { trying.step(); });
            outcomes[i] = outcomes[i] + found;
        }
    }
    const std::optional<std::size_t> best = bestOfViews(outcomes);
    if (stop.stop_requested() || !best) return std::nullopt;
    EstimatedView view;
    view.middle.gsd_m_per_px = views[*best].gsd_m_per_px;
    view.middle.vehicles = static_cast<int>(outcomes[*best].cars);
    // One vehicle may vote by several of its parts.
    view.middle.uncertainty =
        uncertaintyOfView(std::min(look.most_at_once, static_cast<std::size_t>(view.middle.vehicles)));
    view.slope = views[*best].slope;
    return view;
}

}  // namespace eyrie

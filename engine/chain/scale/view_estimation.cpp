#include "chain/scale/view_estimation.h"

#include <algorithm>
#include <cmath>
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

constexpr int kUntilMoving = 12;            ///< frames of a stretch until what moves has vectors
constexpr double kLinkedAt = 0.1;           ///< m/px at which they are linked: no car falls to pieces …
constexpr ScaleRange kAnyScale{0.02, 0.6};  ///< … however near or far it is
constexpr double kMostlyCars = 0.5;         ///< share of tracks that have to be as large as a car
constexpr double kErrorOfLook = 0.11;       ///< standard error of the logarithm of the scale …
constexpr double kErrorOfLength = 0.15;     ///< … and what one vehicle of unknown length adds
constexpr double kNineOfTen = 1.645;        ///< standard errors that hold 90 %

/// Frames that follow each other.
struct Stretch {
    FrameIndex first = 0;
    int count = 0;
};

/// The beginning, the middle and the end; as one where they touch.
std::vector<Stretch> stretchesOf(FrameIndex first, FrameIndex last) {
    const FrameIndex farthest = std::max(first, last - kFramesOfLook + 1);
    std::vector<Stretch> stretches;
    for (const FrameIndex start : {first, first + (farthest - first) / 2, farthest}) {
        if (stretches.empty() || start > stretches.back().first + stretches.back().count)
            stretches.push_back({start, 0});
        const FrameIndex past = std::min(start + kFramesOfLook, last + 1);
        stretches.back().count = static_cast<int>(past - stretches.back().first);
    }
    return stretches;
}

/// Votes, and the most of one frame.
struct VotesOfView {
    std::vector<ScaleVote> votes;
    std::size_t at_once = 0;
};

/// Stretches end before a frame that cannot be read: the run will come to it and report it.
VotesOfView votesOf(FrameSource& source, std::vector<Stretch>& stretches, const ChainOptions& options,
                    double frame_rate_hz, const std::stop_token& stop, LookProgress& progress, CameraSlope& camera) {
    const ScaleLooker looker(options.detection.sliding_window);
    SceneScale scale;
    scale.gsd_m_per_px = kLinkedAt;
    scale.frame_rate_hz = frame_rate_hz;
    const MotionClustering clustering(options.clustering, scale);
    VotesOfView all;
    for (Stretch& stretch : stretches) {
        MotionHalf motion_half(options, scale);
        CameraWay way;
        for (int i = 0; i < stretch.count && !stop.stop_requested(); ++i) {
            Frame frame;
            try {
                frame = source.read(stretch.first + i, false);
            } catch (const Error&) {
                stretch.count = i;
                break;
            }
            StageTimes times{};
            const FrameMotion motion = motion_half.next(frame, times);
            progress.step();
            way.add(motion.registration);
            if (i < kUntilMoving) continue;
            const std::vector<ScaleVote> found = votesIn(frame, motion, clustering, looker, kAnyScale);
            all.at_once = std::max(all.at_once, found.size());
            all.votes.insert(all.votes.end(), found.begin(), found.end());
        }
        camera.add(way.steps());
    }
    return all;
}

}  // namespace

double uncertaintyOfView(std::size_t vehicles_at_once) {
    const auto vehicles = static_cast<double>(std::max<std::size_t>(vehicles_at_once, 1));
    return std::exp(kNineOfTen * std::hypot(kErrorOfLook, kErrorOfLength / std::sqrt(vehicles)));
}

std::optional<EstimatedView> estimateView(FrameSource& source, FrameRange range, const ChainOptions& options,
                                          double frame_rate_hz, const std::stop_token& stop,
                                          const ScaleProgress& told) {
    const std::optional<FrameIndex> last_of_look = lastOfLook(source, range);
    if (!last_of_look) return std::nullopt;
    const FrameIndex last = *last_of_look;
    std::vector<Stretch> stretches = stretchesOf(range.first, last);
    int frames = 0;
    for (const Stretch& stretch : stretches) frames += stretch.count;
    LookProgress voting(told, frames);
    CameraSlope camera(source.info().size);
    const VotesOfView given = votesOf(source, stretches, options, frame_rate_hz, stop, voting, camera);
    const std::vector<ViewFit> views = fitView(given.votes, source.info().size, camera);
    LookProgress trying(told, static_cast<int>(views.size()) * frames);
    std::optional<ViewFit> fit;
    ScaleOutcome found;
    for (const ViewFit& view : views) {
        const SceneScale scale{view.gsd_m_per_px, frame_rate_hz, false, view.slope};
        ScaleOutcome outcome;
        for (const Stretch& stretch : stretches) {
            const auto frame_of = [&](int i) { return source.read(stretch.first + i, false); };
            outcome = outcome + outcomeUnder(stretch.count, frame_of, lookingOptions(options), scale, stop,
                                             [&] { trying.step(); });
        }
        if (!outcome.showsTraffic() || outcome.cars < kMostlyCars * outcome.tracks) continue;
        if (outcome.score() <= found.score()) continue;
        found = outcome;
        fit = view;
    }
    if (stop.stop_requested() || !fit) return std::nullopt;
    // One vehicle may vote by several of its parts.
    const std::size_t vehicles = std::min(given.at_once, static_cast<std::size_t>(std::max(found.cars, 1.0)));
    EstimatedView view;
    view.middle.gsd_m_per_px = fit->gsd_m_per_px;
    view.middle.uncertainty = uncertaintyOfView(vehicles);
    view.middle.vehicles = static_cast<int>(found.cars);
    view.slope = fit->slope;
    return view;
}

}  // namespace eyrie

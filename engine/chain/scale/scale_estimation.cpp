#include "chain/scale/scale_estimation.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <mutex>
#include <opencv2/core/utility.hpp>
#include <string>
#include <vector>

#include "chain/scale/look_progress.h"
#include "chain/scale/scale_outcomes.h"
#include "chain/scale/scale_trial.h"
#include "chain/scale/slope_estimation.h"
#include "chain/scale/view_estimation.h"
#include "core/error.h"
#include "detection/detector_factory.h"
#include "imaging/picture_darkness.h"

namespace eyrie {
namespace {

/// Why nobody can say what is a vehicle; empty where the classifier is there.
std::string missingClassifier(const ChainOptions& options, const SceneScale& scale) {
    try {
        makeDetector(lookingOptions(options).detection, scale);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

/// What every assumption gives on the frames from `first` on; nothing when a stop is requested.
std::vector<ScaleOutcome> outcomesOf(FrameSource& source, FrameIndex first, FrameIndex last,
                                     const ChainOptions& options, double frame_rate_hz, const std::stop_token& stop,
                                     const ScaleProgress& told) {
    const ChainOptions looking = lookingOptions(options);
    std::vector<Frame> frames;
    for (FrameIndex i = first; i <= last && i < first + kFramesOfLook && !stop.stop_requested(); ++i) {
        try {
            frames.push_back(source.read(i, false));
        } catch (const Error&) {
            break;  // the run will come to this frame and report it
        }
    }
    SceneScale scale;
    scale.frame_rate_hz = frame_rate_hz;
    LookProgress progress(told, kScaleAssumptions * static_cast<int>(frames.size()));
    std::mutex telling;
    const auto tell = [&] {
        const std::scoped_lock lock(telling);
        progress.step();
    };
    const auto count = static_cast<int>(frames.size());
    const auto frame_of = [&](int i) { return frames[static_cast<std::size_t>(i)]; };
    std::vector<ScaleOutcome> outcomes(kScaleAssumptions);
    std::atomic<int> next{0};
    const auto look = [&] {
        for (int i = next++; i < kScaleAssumptions; i = next++) {
            SceneScale assumed = scale;
            assumed.gsd_m_per_px = assumedGsd(i);
            outcomes[static_cast<std::size_t>(i)] = outcomeUnder(count, frame_of, looking, assumed, stop, tell);
        }
    };
    // One chain leaves processors idle. Threads of their own: what waits in a pool for a part of one chain would begin
    // another chain meanwhile, and all would be held at once.
    std::vector<std::future<void>> others;
    for (int i = 1; i < std::min(kScaleAssumptions, cv::getNumThreads()); ++i)
        others.push_back(std::async(std::launch::async, look));
    look();
    for (auto& other : others) other.get();
    if (stop.stop_requested()) return {};
    const double darkness = frames.empty() ? 0 : darknessOf(frames.front().gray);
    for (ScaleOutcome& outcome : outcomes) outcome.in_dark = darkness * outcome.detections;
    return outcomes;
}

ScaleBasis basisOfChoice(const SceneScale& scale, const StatedScale& stated,
                         const std::optional<ScaleEstimate>& estimate) {
    if (scale.gsd_known) return {stated.origin};
    if (!estimate) return {ScaleOrigin::assumed};
    return {ScaleOrigin::estimated, estimate->uncertainty, estimate->vehicles};
}

/// Runs keep the scale of the picture's middle. `measured` there, it stays as it is.
void countFromMiddle(ChosenScale& chosen, cv::Size image, bool measured) {
    SceneScale& scale = chosen.scale;
    const cv::Point2d middle = ScaleSlope::ofPicture(image, 0, 0).centre();
    if (scale.slope.isFlat() || scale.slope.centre() == middle) return;
    if (!measured) {
        chosen.gsd_of_vehicles = scale.gsd_m_per_px;
        scale.gsd_m_per_px = scale.at(middle).gsd_m_per_px;
    }
    scale.slope = scale.slope.countedFrom(middle);
}

/// What the traffic says of the scale at the middle of the picture.
std::optional<ScaleEstimate> estimateMiddle(FrameSource& source, FrameRange range, const ChainOptions& options,
                                            double frame_rate_hz, const std::stop_token& stop,
                                            const ScaleProgress& told) {
    const std::optional<FrameIndex> last_of_look = lastOfLook(source, range);
    if (!last_of_look) return std::nullopt;
    const FrameIndex last = *last_of_look;
    FrameIndex looked_to = range.first - 1;
    LooksTogether together;
    for (const FrameIndex first : startsOfLooks(range.first, last, kFramesOfLook)) {
        if (first <= looked_to || together.suffice() || stop.stop_requested()) continue;
        looked_to = first + kFramesOfLook - 1;
        auto outcomes = outcomesOf(source, first, last, options, frame_rate_hz, stop, told);
        if (source.info().frame_rate_assumed) {
            for (ScaleOutcome& outcome : outcomes) outcome.car_speeds_m_s.clear();
        }
        if (!outcomes.empty()) together.add(outcomes);
    }
    return together.estimate();
}

}  // namespace

ChosenScale chooseScale(FrameSource& source, FrameRange range, const ChainOptions& options, const StatedScale& stated,
                        const std::stop_token& stop, const ScaleProgress& told) {
    ChosenScale chosen;
    SceneScale& scale = chosen.scale;
    scale = sceneScale(source.info(), stated.gsd_m_per_px);
    if (!scale.gsd_known) {
        if (!looksThroughWindows(options.detection.method)) chosen.why_not = missingClassifier(options, scale);
        if (chosen.why_not.empty())
            chosen.estimate = estimateMiddle(source, range, options, scale.frame_rate_hz, stop, told);
        if (chosen.estimate) scale.gsd_m_per_px = chosen.estimate->gsd_m_per_px;
    }
    if (!scale.gsd_known && !chosen.estimate && chosen.why_not.empty() && options.view.oblique) {
        if (const auto view = estimateView(source, range, options, scale.frame_rate_hz, stop, told)) {
            chosen.estimate = view->middle;
            scale.gsd_m_per_px = view->middle.gsd_m_per_px;
            scale.slope = view->slope;
        }
    } else {
        scale.slope = slopeFor(source, range, options, scale, stop, told);
        const bool measured = scale.gsd_known && stated.origin == ScaleOrigin::metadata;
        countFromMiddle(chosen, source.info().size, measured);
    }
    chosen.basis = basisOfChoice(scale, stated, chosen.estimate);
    return chosen;
}

ScaleSlope slopeFor(FrameSource& source, FrameRange range, const ChainOptions& options, const SceneScale& scale,
                    const std::stop_token& stop, const ScaleProgress& told) {
    // Where nothing is known of the scale, nothing looked like vehicles either. What knows its own scale is a rendered
    // scene, which is seen from above; its later frames are dear to come by.
    if (!options.view.oblique || !hasMetricLimits(scale) || source.info().gsd_m_per_px > 0) return {};
    return estimateSlope(source, range, options, scale, stop, told);
}

}  // namespace eyrie

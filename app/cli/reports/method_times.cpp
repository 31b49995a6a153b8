#include "cli/reports/method_times.h"

#include <algorithm>

#include "chain/chain.h"
#include "cli/reports/median.h"
#include "rerun/method_variants.h"

namespace eyrie::cli {
namespace {

MethodTimes measure(const MethodVariant& variant, const std::vector<Frame>& frames,
                    const std::vector<FrameMotion>& motions, const SceneScale& scale, int warm_up) {
    TrackHalf half(variant.options, scale);
    std::vector<double> areas, stacking, detection, removal, tracking;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const FrameResult result = half.next(frames[i], motions[i], {});
        if (static_cast<int>(i) < warm_up) continue;
        const auto ms = [&](Stage stage) {
            return static_cast<double>(result.stage_ms[static_cast<std::size_t>(stage)]);
        };
        areas.push_back(ms(Stage::clustering));
        stacking.push_back(ms(Stage::stacking));
        detection.push_back(ms(Stage::detection));
        removal.push_back(ms(Stage::removal));
        tracking.push_back(ms(Stage::tracking));
    }
    return {variant.name,        medianOf(areas),   medianOf(stacking),
            medianOf(detection), medianOf(removal), medianOf(tracking)};
}

}  // namespace

std::vector<MethodTimes> measureMethods(const std::vector<Frame>& frames, const ChainOptions& options,
                                        const SceneScale& scale, int warm_up) {
    MotionHalf motion_half(options, scale);
    std::vector<FrameMotion> motions;
    for (const Frame& frame : frames) {
        StageTimes times{};
        motions.push_back(motion_half.next(frame, times));
    }
    std::vector<MethodVariant> variants;
    for (const char* group : {"detectors", "motion"}) {
        for (const std::string& word : methodsNamed(group))
            variants.push_back(withStacking(methodVariant(word, options), false));
    }
    for (const char* word : {"gradient", "sliding_window", "window_and_gradient"}) {
        variants.push_back(withStacking(methodVariant(word, options), true));
    }
    std::vector<MethodTimes> times;
    for (const MethodVariant& variant : variants) times.push_back(measure(variant, frames, motions, scale, warm_up));
    return times;
}

}  // namespace eyrie::cli

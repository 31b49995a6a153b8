#include "ground/moving_spans.h"

#include <algorithm>
#include <cmath>

#include "events/ground/ground_path.h"

namespace eyrie {
namespace {

constexpr double kMargin_s = 1;

}  // namespace

std::vector<FrameSpan> movingSpans(const StoredTracks& run, const GroundStretches& ground, const EventOptions& options,
                                   double min_score) {
    const Footage& footage = run.footage;
    const auto margin = static_cast<FrameIndex>(std::lround(kMargin_s * footage.scale.frame_rate_hz));
    std::vector<FrameSpan> spans;
    const auto add = [&](FrameIndex first, FrameIndex last) {
        spans.push_back({std::max(footage.first_frame, first - margin), std::min(footage.last_frame, last + margin)});
    };
    for (const GroundPath& path : groundPaths(run.tracks, ground, options)) {
        const auto score = run.scores.find(path.id());
        if (score != run.scores.end() && score->second < min_score) continue;
        if (path.samples.empty()) continue;
        // What was followed too shortly to tell its speed may have moved.
        if (!path.measured) {
            add(path.samples.front().frame, path.samples.back().frame);
            continue;
        }
        for (const SampleSpan& span : spansOf(path, true))
            add(path.samples[span.first].frame, path.samples[span.last].frame);
    }
    for (FrameIndex frame = footage.first_frame + 1; frame <= footage.last_frame; ++frame)
        if (!footage.camera.connects(frame - 1, frame)) add(frame, frame);
    return mergedSpans(std::move(spans));
}

}  // namespace eyrie

#include "tune/compare/comparison_computation.h"

#include <chrono>

#include "io/tables/number_text.h"
#include "rerun/range_run.h"
#include "session/frames/open_run.h"

namespace eyrie::ui {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kTellInterval = std::chrono::milliseconds(120);

/// One side as it is compared.
struct SideResult {
    ChainOptions options;
    BoxesByFrame tracks;
    BoxesByFrame detections;
    bool exact = true;
};

BoxesByFrame within(BoxesByFrame boxes, FrameRange range) {
    std::erase_if(boxes, [&](const auto& entry) { return entry.first < range.first || entry.first > range.last; });
    return boxes;
}

SideResult readSide(const ComparisonPair& pair, const ComparisonSide& side, const std::stop_token& stop) {
    ProjectFile project = ProjectFile::open(pair.project, ProjectFile::Mode::read_only);
    const RunStore store(project);
    SideResult result;
    result.options = storedOptions(store.parameters(side.run_id));
    if (stop.stop_requested()) return result;
    result.tracks = store.trackBoxes(side.run_id);
    if (stop.stop_requested()) return result;
    result.detections = store.detectionBoxes(side.run_id);
    if (!pair.computes()) return result;
    result.tracks = within(std::move(result.tracks), pair.range);
    result.detections = within(std::move(result.detections), pair.range);
    return result;
}

SideResult computeSide(const ComparisonPair& pair, const ComparisonSide& side, ComputedFrames& frames,
                       const std::stop_token& stop, const std::function<void(int, int)>& tell) {
    OpenRun open({pair.media, pair.project, side.run_id}, stop);
    SideResult result;
    result.options = *side.options;
    Clock::time_point told{};
    const auto done = runRange(open.source(), *side.options, pair.range, stop,
                               [&](const std::shared_ptr<const FrameResult>& frame, int frames_done, int frames_total) {
                                   if (frame) frames.add(frame);
                                   if (frames_done < frames_total && Clock::now() - told < kTellInterval) return;
                                   told = Clock::now();
                                   tell(frames_done, frames_total);
                               });
    if (!done) return result;
    frames.replace(done->frames);
    result.tracks = trackBoxesOf(*done);
    result.detections = detectionBoxesOf(*done);
    result.exact = done->exact;
    return result;
}

/// The scale stands first where it differs: it is no parameter, but decides as much as any.
std::vector<ParameterDifference> parameterDifferences(const ComparisonPair& pair, const SideResult& first,
                                                      const SideResult& second) {
    std::vector<ParameterDifference> differences = differencesBetween(first.options, second.options);
    ProjectFile project = ProjectFile::open(pair.project, ProjectFile::Mode::read_only);
    const RunStore store(project);
    const auto scale_of = [&](const ComparisonSide& side) {
        const auto run = store.run(side.run_id);
        return run ? shortestText(run->scale.gsd_m_per_px) : std::string();
    };
    const std::string a = scale_of(pair.first);
    const std::string b = scale_of(pair.second);
    if (a != b) differences.insert(differences.begin(), {"GSD (m/px)", a, b});
    return differences;
}

}  // namespace

SideComparison compareSides(const ComparisonPair& pair, const ComputedPair& computed, const std::stop_token& stop,
                            const std::function<void(int, int)>& tell) {
    const bool both = computed.first && computed.second;
    int first_total = 0;
    const auto side = [&](const ComparisonSide& wanted, ComputedFrames* frames, bool second) {
        if (frames == nullptr) return readSide(pair, wanted, stop);
        return computeSide(pair, wanted, *frames, stop, [&](int done, int total) {
            // Of two the second takes about as long as the first.
            if (!second) first_total = total;
            const int before = second ? first_total : 0;
            tell(before + done, both ? first_total + (second ? total : first_total) : total);
        });
    };
    const SideResult first = side(pair.first, computed.first.get(), false);
    SideComparison comparison;
    if (stop.stop_requested()) return comparison;
    const SideResult second = side(pair.second, computed.second.get(), true);
    comparison.exact = first.exact && second.exact;
    comparison.parameters = parameterDifferences(pair, first, second);
    if (stop.stop_requested()) return comparison;
    comparison.tracks = differencesOf(first.tracks, second.tracks);
    if (stop.stop_requested()) return comparison;
    comparison.detections = differencesOf(first.detections, second.detections);
    return comparison;
}

}  // namespace eyrie::ui

#include "cli/arguments/sweep_arguments.h"

#include "chain/scale/scale_estimation.h"
#include "cli/arguments/input.h"
#include "cli/reports/run_report.h"
#include "core/error.h"
#include "scene/scene_source.h"

namespace eyrie::cli {
namespace {

ClipFrames::Open opener(const std::string& sequence, double frame_rate_hz, double remembered_rate_hz = 0) {
    return [sequence, frame_rate_hz, remembered_rate_hz]() -> std::unique_ptr<FrameSource> {
        if (isScene(sequence)) return openScene(sceneOf(sequence));
        SourceOptions options;
        options.frame_rate_hz = frame_rate_hz;
        options.remembered_rate_hz = remembered_rate_hz;
        return openSource(sequence, options);
    };
}

std::string absolutePath(const std::string& path) {
    return isScene(path) || path.empty() ? path : std::filesystem::absolute(path).lexically_normal().string();
}

GroundTruthSource sourceOf(const SweepSources& sources, std::size_t clip) {
    if (sources.ground_truths.empty()) return {};
    return {absolutePath(sources.ground_truths[clip]), sources.ground_truth.mot_origin};
}

}  // namespace

OpenedClips openSequences(const SweepSources& sources, const ChainOptions& options, const std::string& project,
                          std::stop_token stop) {
    if (sources.sequences.size() != sources.ground_truths.size()) {
        throw Error(ErrorKind::parameter, "every --sequence needs its --ground-truth: there are " +
                                              std::to_string(sources.sequences.size()) + " and " +
                                              std::to_string(sources.ground_truths.size()));
    }
    if (sources.gsds.size() > 1 && sources.gsds.size() != sources.sequences.size()) {
        throw Error(ErrorKind::parameter, "--gsd: give one for all sequences or one for each of the " +
                                              std::to_string(sources.sequences.size()));
    }
    for (const double gsd : sources.gsds) checkGsd(gsd);
    sources.video.check();
    const FrameRange range = sources.video.range();
    OpenedClips opened;
    for (std::size_t i = 0; i < sources.sequences.size(); ++i) {
        const std::string& sequence = sources.sequences[i];
        SweepClip clip;
        clip.sequence = absolutePath(sequence);
        const double rate = sources.video.frame_rate_hz.value_or(0);
        const double remembered = rememberedRate(project, sequence);
        const auto source = openInput(sequence, rate, stop, remembered);
        const GroundTruthSource truth_source = sourceOf(sources, i);
        GroundTruth truth = readGroundTruth(truth_source, source->info().size);
        clip.ground_truth = truth_source.file.string();
        const double gsd = sources.gsds.empty() ? 0 : sources.gsds[sources.gsds.size() == 1 ? 0 : i];
        const StatedScale stated = statedScale(*source, range.first, range.last, gsd, ScaleOrigin::given, stop);
        const ChosenScale chosen = chooseScale(*source, range, options, stated, stop);
        clip.scale = chosen.scale;
        for (const std::string& remark : remarksOn(stated, chosen))
            opened.remarks.push_back(clip.sequence + ": " + remark);
        SweepInput input = openClip(clip, opener(clip.sequence, rate, remembered), range, std::move(truth),
                                    sources.evaluation.options, {.looked_for_slope = options.view.oblique});
        opened.add(std::move(clip), std::move(input));
    }
    return opened;
}

OpenedClips openStoredRuns(const SweepSources& sources, std::vector<StoredRun> runs, const ChainOptions& options) {
    if (!sources.ground_truths.empty() && sources.ground_truths.size() != runs.size()) {
        throw Error(ErrorKind::parameter,
                    "--ground-truth: give none, for the labels of the project, or one for each "
                    "of the " +
                        std::to_string(runs.size()) + " runs");
    }
    OpenedClips opened;
    ProjectFile project = ProjectFile::open(sources.project, ProjectFile::Mode::read_only);
    for (std::size_t i = 0; i < runs.size(); ++i) {
        StoredRun& run = runs[i];
        if (signatureUpTo(run.options, ChainStage::motion) != signatureUpTo(options, ChainStage::motion))
            opened.remarks.push_back(
                "run " + std::to_string(run.record.id) +
                " has other motion vectors than the parameters given would find, so they are computed again");
        const auto open = opener(run.clip.sequence, run.clip.scale.frame_rate_hz);
        opened.add(std::move(run), open, sourceOf(sources, i), project, sources.evaluation.options);
    }
    return opened;
}

}  // namespace eyrie::cli

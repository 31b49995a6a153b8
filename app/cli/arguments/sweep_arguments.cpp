#include "cli/arguments/sweep_arguments.h"

#include <algorithm>

#include "annotation/edits/ignore_regions.h"
#include "chain/scale_estimation.h"
#include "cli/arguments/evaluation_files.h"
#include "cli/arguments/input.h"
#include "core/error.h"
#include "exchange/project_labels.h"
#include "scene/scene_source.h"
#include "store/labels/annotation_store.h"

namespace eyrie::cli {
namespace {

bool isScene(const std::string& sequence) {
    return sequence.rfind("scene:", 0) == 0;
}

ClipFrames::Open opener(const std::string& sequence, double frame_rate_hz, double remembered_rate_hz = 0) {
    return [sequence, frame_rate_hz, remembered_rate_hz]() -> std::unique_ptr<FrameSource> {
        if (isScene(sequence)) return openScene(sequence.substr(6));
        SourceOptions options;
        options.frame_rate_hz = frame_rate_hz;
        options.remembered_rate_hz = remembered_rate_hz;
        return openSource(sequence, options);
    };
}

std::string absolutePath(const std::string& path) {
    return isScene(path) || path.empty() ? path : std::filesystem::absolute(path).lexically_normal().string();
}

/// Reads the truth of a clip and decides how boxes are compared.
BoxesByFrame readClipTruth(const SweepSources& sources, const std::string& file, cv::Size image_size, SweepClip& clip,
                           std::vector<std::string>& remarks) {
    BoxFile truth = readTruthBoxes(file, sources.mot_origin, image_size);
    remarks.insert(remarks.end(), truth.remarks.begin(), truth.remarks.end());
    clip.ground_truth = absolutePath(file);
    clip.upright = sources.upright;
    if (!clip.upright && !truth.has_headings) {
        clip.upright = true;
        remarks.push_back(file + ": " + truth.format +
                          ": boxes are upright, so the enclosing boxes of the results are compared");
    } else if (!clip.upright && allUpright(truth.boxes)) {
        remarks.push_back(file + ": has upright boxes only; if it has no headings, add --upright");
    }
    return std::move(truth.boxes);
}

cv::Size imageSizeOf(const SweepSources& sources, const StoredRun& run) {
    ProjectFile project = ProjectFile::open(sources.project, ProjectFile::Mode::read_only);
    return RunStore(project).run(run.clip.run).value().sequence.size;
}

BoxesByFrame labelsOfProject(const SweepSources& sources, const StoredRun& run, SweepClip& clip) {
    ProjectFile project = ProjectFile::open(sources.project, ProjectFile::Mode::read_only);
    const RunStore store(project);
    const SequenceRecord sequence = store.run(run.clip.run).value().sequence;
    const AnnotationSet labels = readAnnotations(project, sequence.id);
    GroundTruthOptions options;
    options.first_frame = run.range.first;
    options.last_frame = run.range.last;
    options.image = sequence.size;
    clip.upright = sources.upright;
    BoxesByFrame truth = groundTruthBoxes(labels, cameraMotionOf(store, sequence.id), options);
    if (std::all_of(truth.begin(), truth.end(), [](const auto& entry) { return entry.second.empty(); })) {
        throw Error(ErrorKind::project, sources.project + ": has no labels in the frames of run " +
                                            std::to_string(run.clip.run) +
                                            "; name a file with --ground-truth, or label or import some");
    }
    return truth;
}

}  // namespace

OpenedSources openSequences(const SweepSources& sources, const ChainOptions& options, const std::string& project,
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
    if (sources.frame_rate_hz) checkFrameRate(*sources.frame_rate_hz);
    const ParsedRange frames = sources.frames.empty() ? ParsedRange{} : parseFrames(sources.frames);
    const FrameRange range{frames.first, frames.last};
    OpenedSources opened;
    for (std::size_t i = 0; i < sources.sequences.size(); ++i) {
        const std::string& sequence = sources.sequences[i];
        SweepClip clip;
        clip.sequence = absolutePath(sequence);
        const double rate = sources.frame_rate_hz.value_or(0);
        const double remembered = rememberedRate(project, sequence);
        const auto source = openInput(sequence, rate, stop, remembered);
        const BoxesByFrame truth =
            readClipTruth(sources, sources.ground_truths[i], source->info().size, clip, opened.remarks);
        const double gsd = sources.gsds.empty() ? 0 : sources.gsds[sources.gsds.size() == 1 ? 0 : i];
        clip.scale = chooseScale(*source, range, options, gsd, stop);
        opened.inputs.push_back(openClip(clip, opener(clip.sequence, rate, remembered), range, truth));
        opened.clips.push_back(std::move(clip));
    }
    return opened;
}

OpenedSources openStoredRuns(const SweepSources& sources, std::vector<StoredRun> runs, const ChainOptions& options) {
    if (!sources.ground_truths.empty() && sources.ground_truths.size() != runs.size()) {
        throw Error(ErrorKind::parameter,
                    "--ground-truth: give none, for the labels of the project, or one for each "
                    "of the " +
                        std::to_string(runs.size()) + " runs");
    }
    OpenedSources opened;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        StoredRun& run = runs[i];
        SweepClip clip = run.clip;
        const BoxesByFrame truth =
            sources.ground_truths.empty()
                ? labelsOfProject(sources, run, clip)
                : readClipTruth(sources, sources.ground_truths[i], imageSizeOf(sources, run), clip, opened.remarks);
        SweepInput input = openClip(clip, opener(clip.sequence, clip.scale.frame_rate_hz), run.range, truth);
        input.cache->useStoredMotion(run.options, std::move(run.motion));
        if (signatureUpTo(run.options, SweepStage::motion) != signatureUpTo(options, SweepStage::motion))
            opened.remarks.push_back(
                "run " + std::to_string(clip.run) +
                " has other motion vectors than the parameters given would find, so they are computed again");
        opened.inputs.push_back(std::move(input));
        opened.clips.push_back(std::move(clip));
    }
    return opened;
}

}  // namespace eyrie::cli

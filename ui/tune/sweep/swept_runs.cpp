#include "tune/sweep/swept_runs.h"

#include <algorithm>

#include "annotation/edits/ignore_regions.h"
#include "core/error.h"
#include "exchange/project_labels.h"
#include "formats/label_formats.h"
#include "session/project/media.h"
#include "store/labels/annotation_store.h"

namespace eyrie::ui {
namespace {

BoxesByFrame labelsOfProject(ProjectFile& project, const StoredRun& run) {
    const RunStore store(project);
    const SequenceRecord sequence = store.run(run.clip.run).value().sequence;
    GroundTruthOptions options;
    options.first_frame = run.range.first;
    options.last_frame = run.range.last;
    options.image = sequence.size;
    BoxesByFrame truth =
        groundTruthBoxes(readAnnotations(project, sequence.id), cameraMotionOf(store, sequence.id), options);
    if (std::all_of(truth.begin(), truth.end(), [](const auto& entry) { return entry.second.empty(); })) {
        throw Error(ErrorKind::input, "This project has no labels in the frames of run " +
                                          std::to_string(run.clip.run) +
                                          ". Label (Ctrl+2) or import some, or choose a ground truth file.");
    }
    return truth;
}

}  // namespace

OpenedRuns openRunsForSweep(const std::filesystem::path& project_path, const std::vector<RunToSweep>& runs,
                            const std::stop_token& stop) {
    OpenedRuns opened;
    ProjectFile project = ProjectFile::open(project_path, ProjectFile::Mode::read_only);
    for (const RunToSweep& wanted : runs) {
        StoredRun run = readStoredRun(project, wanted.run_id);
        SweepClip clip = run.clip;
        clip.ground_truth = wanted.truth_file.string();
        clip.upright = wanted.upright;
        BoxesByFrame truth;
        if (wanted.truth_file.empty()) {
            truth = labelsOfProject(project, run);
        } else {
            if (!opened.clips.empty() && opened.clips.front().sequence != clip.sequence &&
                opened.clips.front().ground_truth == clip.ground_truth) {
                throw Error(
                    ErrorKind::parameter,
                    clip.ground_truth +
                        ": a ground truth file belongs to one video, but the chosen runs are of several. Use the "
                        "labels of the project, or choose fewer runs.");
            }
            ImportOptions options;
            options.image_size = clip.size;
            truth = plainBoxes(readLabels(wanted.truth_file, "auto", options).boxes);
        }
        const Media media = mediaOfIdentity(clip.sequence, {.remembered_hz = clip.scale.frame_rate_hz});
        StageCacheOptions cache;
        cache.all_cores = false;  // the sweep's own threads give way to the window, helpers of OpenCV would not
        SweepInput input = openClip(
            clip, [media, stop] { return media.open({}, stop); }, run.range, truth, cache);
        input.cache->useStoredMotion(run.options, std::move(run.motion));
        if (opened.clips.empty()) opened.options = run.options;
        opened.clips.push_back(std::move(clip));
        opened.inputs.push_back(std::move(input));
    }
    return opened;
}

}  // namespace eyrie::ui

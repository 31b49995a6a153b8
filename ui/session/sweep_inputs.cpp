#include "session/sweep_inputs.h"

#include <algorithm>

#include "annotation/ignore_regions.h"
#include "core/error.h"
#include "exchange/project_labels.h"
#include "formats/label_formats.h"
#include "session/media.h"
#include "store/annotation_store.h"

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
        throw Error(ErrorKind::input,
                    "This project has no labels in the frames of the run. Label or import some (F4, Import), or choose "
                    "a file of true boxes.");
    }
    return truth;
}

}  // namespace

OpenedRun openRunForSweep(const std::filesystem::path& project_path, int run_id,
                          const std::filesystem::path& truth_file, bool upright, const std::stop_token& stop) {
    OpenedRun opened;
    ProjectFile project = ProjectFile::open(project_path, ProjectFile::Mode::read_only);
    StoredRun run = readStoredRun(project, run_id);
    opened.clip = run.clip;
    opened.clip.ground_truth = truth_file.string();
    opened.clip.upright = upright;
    BoxesByFrame truth;
    if (truth_file.empty()) {
        truth = labelsOfProject(project, run);
    } else {
        ImportOptions options;
        options.image_size = run.clip.size;
        truth = plainBoxes(readLabels(truth_file, "auto", options).boxes);
    }
    const Media media = mediaOfIdentity(opened.clip.sequence, opened.clip.scale.frame_rate_hz);
    StageCacheOptions cache;
    cache.all_cores = false;  // the sweep's own threads give way to the window, helpers of OpenCV would not
    SweepInput input = openClip(
        opened.clip, [media, stop] { return media.open({}, stop); }, run.range, truth, cache);
    opened.options = run.options;
    input.cache->useStoredMotion(run.options, std::move(run.motion));
    opened.inputs.push_back(std::move(input));
    return opened;
}

}  // namespace eyrie::ui

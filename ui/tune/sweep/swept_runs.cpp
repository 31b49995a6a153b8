#include "tune/sweep/swept_runs.h"

#include "core/error.h"
#include "session/project/media.h"

namespace eyrie::ui {

OpenedRuns openRunsForSweep(const std::filesystem::path& project_path, const std::vector<RunToSweep>& runs,
                            const std::stop_token& stop) {
    OpenedRuns opened;
    ProjectFile project = ProjectFile::open(project_path, ProjectFile::Mode::read_only);
    for (const RunToSweep& wanted : runs) {
        StoredRun run = readStoredRun(project, wanted.run_id);
        SweepClip clip = run.clip;
        clip.ground_truth = wanted.truth.file.string();
        if (!clip.ground_truth.empty() && !opened.clips.empty() && opened.clips.front().sequence != clip.sequence &&
            opened.clips.front().ground_truth == clip.ground_truth) {
            throw Error(ErrorKind::parameter, clip.ground_truth +
                                                  ": one file of true boxes belongs to one video, but the runs chosen "
                                                  "are of several. Use the labels of the project, or choose fewer "
                                                  "runs.");
        }
        const Media media = mediaOfIdentity(clip.sequence, {.remembered_hz = clip.scale.frame_rate_hz});
        StageCacheOptions cache;
        cache.all_cores = false;  // the sweep's own threads give way to the window, helpers of OpenCV would not
        SweepInput input = openClip(
            clip, [media, stop] { return media.open({}, stop); }, run.range,
            readGroundTruth(wanted.truth, project, run.record), wanted.wishes, cache);
        input.cache->useStoredMotion(run.options, std::move(run.motion));
        if (opened.clips.empty()) opened.options = run.options;
        opened.clips.push_back(std::move(clip));
        opened.inputs.push_back(std::move(input));
    }
    return opened;
}

}  // namespace eyrie::ui

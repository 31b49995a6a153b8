#include "tune/sweep/swept_runs.h"

#include "core/error.h"
#include "session/project/media.h"

namespace eyrie::ui {

OpenedRuns openRunsForSweep(const std::filesystem::path& project_path, const std::vector<RunToSweep>& runs,
                            const std::stop_token& stop) {
    OpenedRuns opened;
    StageCacheOptions cache;
    cache.all_cores = false;  // the sweep's own threads give way to the window, helpers of OpenCV would not
    ProjectFile project = ProjectFile::open(project_path, ProjectFile::Mode::read_only);
    for (const RunToSweep& wanted : runs) {
        StoredRun run = readStoredRun(project, wanted.run_id);
        const std::string file = wanted.truth.file.string();
        if (!file.empty() && !opened.clips.empty() && opened.clips.front().sequence != run.clip.sequence &&
            opened.clips.front().ground_truth == file) {
            throw Error(ErrorKind::parameter, file +
                                                  ": a ground truth file belongs to one video, but the chosen runs are "
                                                  "of several. Use the labels of the project, or choose fewer runs.");
        }
        const Media media = mediaOfIdentity(run.clip.sequence, {.remembered_hz = run.clip.scale.frame_rate_hz});
        if (opened.clips.empty()) opened.options = run.options;
        opened.add(
            std::move(run), [media, stop] { return media.open({}, stop); }, wanted.truth, project, wanted.wishes,
            cache);
    }
    return opened;
}

}  // namespace eyrie::ui

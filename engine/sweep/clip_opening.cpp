#include "sweep/clip_opening.h"

#include <cmath>

#include "core/error.h"
#include "rerun/replay.h"
#include "store/runs/run_store.h"

namespace eyrie {

SweepInput openClip(SweepClip& clip, const ClipFrames::Open& open, FrameRange range, const BoxesByFrame& truth,
                    const StageCacheOptions& options) {
    SweepInput input;
    input.cache = std::make_unique<StageCache>(open, range, clip.scale, options);
    const ClipFrames& frames = input.cache->frames();
    clip.size = frames.info().size;
    clip.first_frame = frames.first();
    clip.last_frame = frames.last();
    const std::string name = clip.ground_truth.empty() ? "the labels of " + clip.sequence : clip.ground_truth;
    input.truth = truthWithin(truth, clip.first_frame, clip.last_frame, name);
    clip.digest = digestOf(frames.reader().read(clip.first_frame), input.truth);
    return input;
}

StoredRun readStoredRun(ProjectFile& project, std::optional<int> run_id) {
    const RunStore store(project);
    const std::vector<RunRecord> runs = store.runs();
    std::string known;
    std::optional<RunRecord> run;
    for (const RunRecord& record : runs) {
        if (!run_id || record.id == *run_id) run = record;
        known += (known.empty() ? "" : ", ") + std::to_string(record.id);
    }
    const std::string name = project.path().string();
    if (runs.empty()) throw Error(ErrorKind::project, name + ": holds no run; make one first (eyrie-cli run)");
    if (!run) {
        throw Error(ErrorKind::parameter,
                    name + ": there is no run " + std::to_string(*run_id) + "; it holds the runs " + known);
    }
    if (run->frames_done < 1)
        throw Error(ErrorKind::parameter, name + ": run " + std::to_string(run->id) + " has no frame");
    StoredRun stored;
    stored.options = storedOptions(store.parameters(run->id));
    stored.clip.sequence = run->sequence.path;
    stored.clip.run = run->id;
    stored.clip.size = run->sequence.size;
    stored.clip.scale = run->scale;
    stored.range = {run->first_frame, run->first_frame + run->frames_done - 1};
    for (FrameIndex i = stored.range.first; i <= stored.range.last; ++i) {
        std::optional<FrameResult> frame = store.frameResult(run->id, i);
        if (!frame)
            throw Error(ErrorKind::project,
                        name + ": run " + std::to_string(run->id) + " lacks frame " + std::to_string(i));
        stored.motion.push_back(std::move(frame->motion));
    }
    return stored;
}

}  // namespace eyrie

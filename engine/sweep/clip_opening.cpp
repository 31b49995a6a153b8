#include "sweep/clip_opening.h"

#include <tuple>

#include "core/error.h"
#include "rerun/replay.h"
#include "store/details/kept_details.h"

namespace eyrie {

SweepInput openClip(SweepClip& clip, const ClipFrames::Open& open, FrameRange range, GroundTruth truth,
                    EvaluationOptions wishes, const StageCacheOptions& options) {
    SweepInput input;
    input.cache = std::make_unique<StageCache>(open, range, clip.scale, options);
    const ClipFrames& frames = input.cache->frames();
    clip.size = frames.info().size;
    clip.first_frame = frames.first();
    clip.last_frame = frames.last();
    wishes.image_size = clip.size;
    input.scoring = scoringOf(std::move(truth), wishes, ScoredFrames{clip.first_frame, clip.last_frame});
    clip.upright = input.scoring.options.upright;
    clip.digest = digestOf(frames.reader().read(clip.first_frame), input.scoring.truth.boxes);
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
                    name + ": there is no run " + std::to_string(*run_id) +
                        (runs.size() == 1 ? "; it holds run " + known + " alone" : "; it holds the runs " + known));
    }
    if (run->frames_done < 1)
        throw Error(ErrorKind::parameter, name + ": run " + std::to_string(run->id) + " has no frame");
    StoredRun stored;
    stored.record = *run;
    stored.options = storedOptions(store.parameters(run->id));
    stored.clip.sequence = run->sequence.path;
    stored.clip.run = run->id;
    stored.clip.size = run->sequence.size;
    stored.clip.scale = run->scale;
    std::tie(stored.range.first, stored.range.last) = coveredFrames(*run);
    // Part of it is of no use: then all is found anew.
    if (detailedFrames(project, run->id) < run->frames_done) return stored;
    for (FrameIndex i = stored.range.first; i <= stored.range.last; ++i) {
        std::optional<FrameResult> frame = store.frameResult(run->id, i);
        if (!frame)
            throw Error(ErrorKind::project,
                        name + ": run " + std::to_string(run->id) + " lacks frame " + std::to_string(i));
        stored.motion.push_back(std::move(frame->motion));
    }
    return stored;
}

void OpenedClips::add(SweepClip clip, SweepInput input) {
    const std::vector<std::string>& told = input.scoring.truth.remarks;
    remarks.insert(remarks.end(), told.begin(), told.end());
    inputs.push_back(std::move(input));
    clips.push_back(std::move(clip));
}

void OpenedClips::add(StoredRun run, const ClipFrames::Open& open, const GroundTruthSource& truth, ProjectFile& project,
                      const EvaluationOptions& wishes, const StageCacheOptions& options) {
    run.clip.ground_truth = truth.file.string();
    StageCacheOptions cache = options;
    cache.looked_for_slope = run.options.view.oblique;
    SweepInput input = openClip(run.clip, open, run.range, readGroundTruth(truth, project, run.record), wishes, cache);
    if (run.motion.empty()) {
        remarks.push_back("run " + std::to_string(run.record.id) +
                          " keeps no motion vectors of all its frames (recording.details): they are found anew");
    } else {
        input.cache->useStoredMotion(run.options, std::move(run.motion));
    }
    add(std::move(run.clip), std::move(input));
}

}  // namespace eyrie

#include "chain/recording/run_resume.h"

#include <algorithm>
#include <utility>

#include "chain/chain_options.h"
#include "chain/recording/chain_state.h"
#include "chain/recording/run_recorder.h"
#include "core/error.h"
#include "store/details/recording_options.h"
#include "store/runs/run_state_store.h"

namespace eyrie {
namespace {

std::string sizeText(cv::Size size) {
    return std::to_string(size.width) + "×" + std::to_string(size.height) + " px";
}

void checkVideo(const RunRecord& run, const VideoInfo& video) {
    const auto refuse = [&](const std::string& now, const std::string& then) {
        throw Error(ErrorKind::input, video.path.string() + " is not the video that run " + std::to_string(run.id) +
                                          " was started with: it has " + now + " now, " + then +
                                          " then; put the old video back, or start a new run");
    };
    if (video.size != run.sequence.size) refuse(sizeText(video.size), sizeText(run.sequence.size));
    if (video.frame_count != run.sequence.frame_count) {
        refuse(std::to_string(video.frame_count) + " frames", std::to_string(run.sequence.frame_count));
    }
}

/// Whether every frame of the run up to `last` is stored.
bool allThere(const std::vector<FrameSummary>& frames, FrameIndex first, FrameIndex last) {
    const auto kept =
        std::count_if(frames.begin(), frames.end(), [&](const auto& frame) { return frame.frame <= last; });
    return last >= first && kept == last - first + 1;
}

int unregisteredUpTo(const std::vector<FrameSummary>& frames, FrameIndex last) {
    return static_cast<int>(std::count_if(frames.begin(), frames.end(), [&](const FrameSummary& frame) {
        return frame.frame <= last && frame.state == RegistrationState::failed;
    }));
}

}  // namespace

std::string textOf(ResumeObstacle obstacle) {
    switch (obstacle) {
        case ResumeObstacle::none:
            return "";
        case ResumeObstacle::finished:
            return "it is finished";
        case ResumeObstacle::live:
            return "another program is writing it";
        case ResumeObstacle::other_engine:
            return "another version of Eyrie started it, whose frames would not match those of this one";
        case ResumeObstacle::other_parameters:
            return "it has other parameters than this version of Eyrie knows";
    }
    return "";
}

ResumeObstacle resumeObstacle(const RunStore& store, const RunRecord& run) {
    if (run.state == RunState::finished) return ResumeObstacle::finished;
    if (run.live) return ResumeObstacle::live;
    if (run.engine_version != engineVersion()) return ResumeObstacle::other_engine;
    auto stored = store.parameters(run.id);
    std::erase_if(stored, [](const auto& parameter) { return isOfRecording(parameter.first); });
    if (stored != parameterValues(storedOptions(stored))) return ResumeObstacle::other_parameters;
    return ResumeObstacle::none;
}

std::vector<RunRecord> resumableRuns(const RunStore& store) {
    std::vector<RunRecord> runs = store.runs();
    std::erase_if(runs, [&](const RunRecord& run) { return resumeObstacle(store, run) != ResumeObstacle::none; });
    std::reverse(runs.begin(), runs.end());
    return runs;
}

ResumedRun resumedRun(const std::filesystem::path& project, int run_id, FrameSource& source) {
    ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
    const RunStore store(file);
    const std::string which = "run " + std::to_string(run_id) + " of " + file.path().string();
    const std::optional<RunRecord> found = store.run(run_id);
    if (!found) throw Error(ErrorKind::parameter, which + ": there is no such run; eyrie-cli info lists the runs");
    ResumedRun resumed;
    resumed.run = *found;
    resumed.run.state = RunState::running;
    resumed.run.message.clear();
    const ResumeObstacle obstacle = resumeObstacle(store, *found);
    if (obstacle != ResumeObstacle::none) {
        throw obstacle == ResumeObstacle::live
            ? Error(ErrorKind::project, which + " is being written by " + found->writer + "; let it end there first")
            : Error(ErrorKind::parameter,
                    which + " cannot be resumed: " + textOf(obstacle) + "; start a new run instead");
    }
    checkVideo(*found, source.info());
    resumed.options = storedOptions(store.parameters(run_id));
    resumed.last_done = found->first_frame - 1;
    const auto state = RunStateStore(file).newest(run_id);
    const std::vector<FrameSummary> frames = store.frameSummaries(run_id);
    if (!state) {
        resumed.restart = RestartReason::nothing_kept;
        return resumed;
    }
    std::shared_ptr<ChainProgress> progress = unpackedState(state->bytes, resumed.options, found->scale, source);
    if (!progress || progress->last_done != state->frame || !allThere(frames, found->first_frame, state->frame)) {
        resumed.restart = RestartReason::damaged_state;
        return resumed;
    }
    resumed.last_done = state->frame;
    resumed.start = {std::move(progress), unregisteredUpTo(frames, state->frame)};
    return resumed;
}

}  // namespace eyrie

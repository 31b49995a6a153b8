#include "cli/arguments/run_choice.h"

#include <algorithm>

#include "chain/recording/run_resume.h"
#include "cli/project_runs.h"
#include "cli/reports/figure_text.h"
#include "store/details/kept_details.h"
#include "store/details/recording_options.h"

namespace eyrie::cli {
namespace {

/// What a run was begun with otherwise than is wished; empty when nothing.
std::string differenceOf(const RunStore& store, const RunRecord& run, const ResumeWishes& wishes) {
    if (wishes.gsd_m_per_px && !(run.scale.gsd_known && run.scale.gsd_m_per_px == *wishes.gsd_m_per_px)) {
        return run.scale_basis.origin == ScaleOrigin::given ? "--gsd " + numberText(run.scale.gsd_m_per_px)
                                                            : "without --gsd";
    }
    if (wishes.frame_rate_hz && run.scale.frame_rate_hz != *wishes.frame_rate_hz) {
        return "--fps " + numberText(run.scale.frame_rate_hz);
    }
    if (wishes.frames) {
        const FrameIndex last = wishes.frames->last < 0 ? run.sequence.frame_count - 1 : wishes.frames->last;
        if (wishes.frames->first != run.first_frame || last != run.last_frame) {
            return "--frames " + std::to_string(run.first_frame) + ":" + std::to_string(run.last_frame);
        }
    }
    auto stored = store.parameters(run.id);
    RecordingOptions kept = RecordingOptions::among(stored);
    for (const Parameter& parameter : listParameters(describeOf(kept))) {
        const auto wish = std::find_if(wishes.recording.begin(), wishes.recording.end(),
                                       [&](const auto& value) { return value.first == parameter.name; });
        if (wish != wishes.recording.end() && wish->second != parameter.value)
            return parameter.name + "=" + parameter.value;
    }
    if (!wishes.options) return "";
    std::erase_if(stored, [](const auto& parameter) { return isOfRecording(parameter.first); });
    const auto wished = parameterValues(*wishes.options);
    for (const auto& parameter : stored) {
        if (std::find(wished.begin(), wished.end(), parameter) == wished.end()) {
            return parameter.first + "=" + parameter.second;
        }
    }
    return wished.size() == stored.size() ? "" : "other parameters";
}

ResumeChoice chosen(const RunStore& store, const std::string& project, const RunRecord& run,
                    const ResumeWishes& wishes) {
    const std::string difference = differenceOf(store, run, wishes);
    if (difference.empty()) return {run, ""};
    throw Error(ErrorKind::parameter, "--resume: run " + std::to_string(run.id) + " of " + project +
                                          " was started with " + difference +
                                          "; leave out what differs to resume it, or --resume for a new run");
}

}  // namespace

ResumeChoice chooseRun(const RunStore& store, const std::string& project, const ResumeWishes& wishes) {
    if (wishes.run) return chosen(store, project, chosenRun(store, project, wishes.run), wishes);
    std::vector<RunRecord> runs = store.runs();
    std::reverse(runs.begin(), runs.end());
    if (wishes.video.empty()) {
        const auto open =
            std::find_if(runs.begin(), runs.end(), [](const auto& run) { return run.state != RunState::finished; });
        const RunRecord run = open != runs.end() ? *open : chosenRun(store, project, std::nullopt);
        return chosen(store, project, run, wishes);
    }
    ResumeChoice choice;
    for (const RunRecord& run : runs) {
        if (run.sequence.path != wishes.video) continue;
        const ResumeObstacle obstacle = resumeObstacle(store, run);
        // One that another program writes is chosen, too: beginning it a second time would be no help.
        const bool usable = obstacle != ResumeObstacle::other_engine && obstacle != ResumeObstacle::other_parameters;
        const std::string difference = usable ? differenceOf(store, run, wishes) : "";
        if (usable && difference.empty()) return {run, ""};
        if (!choice.why_new.empty() || run.state == RunState::finished) continue;
        choice.why_new = "run " + std::to_string(run.id) +
                         (usable ? " was started with " + difference : " cannot be resumed: " + textOf(obstacle));
    }
    return choice;
}

void checkNotBegun(const RunStore& store, const std::string& project, const ResumeWishes& wishes) {
    const std::optional<RunRecord> begun = chooseRun(store, project, wishes).run;
    if (!begun) return;
    if (begun->state == RunState::finished) throw FinishedMeanwhile(*begun, project);
    const std::string which = "run " + std::to_string(begun->id) + " of " + project + " was begun over this video by ";
    throw Error(ErrorKind::project,
                begun->live
                    ? which + begun->writer + " meanwhile; let it end there, or give the same command again later"
                    : which + "another program meanwhile and stopped; the same command goes on with it");
}

void needDetections(ProjectFile& project, const RunRecord& run) {
    if (run.state == RunState::finished) return needDetails(project, run);
    const RecordingOptions kept = RecordingOptions::among(RunStore(project).parameters(run.id));
    if (!kept.keepsAllDetails(run.first_frame, run.last_frame))
        throw Error(ErrorKind::input, lackOfDetails(run, detailedFrames(project, run.id)));
}

}  // namespace eyrie::cli

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "cli/arguments/earlier_state.h"
#include "cli/arguments/event_arguments.h"
#include "cli/arguments/input.h"
#include "cli/arguments/output_arguments.h"
#include "cli/arguments/video_arguments.h"
#include "cli/command.h"
#include "cli/common_options.h"
#include "cli/interrupt.h"
#include "cli/project_runs.h"
#include "cli/reports/console_progress.h"
#include "core/error.h"
#include "report/clip/run_clip.h"

namespace eyrie::cli {
namespace {

struct ClipArguments {
    EventArguments events;
    std::optional<int> event;
    std::string frames;
    double around_s = kAroundClip_s;
    bool overlay = false;
    std::string out;
    OutputArguments outputs;
    bool quiet = false;
};

/// The frames of an event with what is before and after it, as far as the run goes.
FrameRange framesOfEvent(const ClipArguments& arguments, const ReviewedRun& reviewed) {
    const int number = *arguments.event;
    checkEventNumber(number, reviewed);
    const Event& event = reviewed.events[static_cast<std::size_t>(number - 1)];
    const Footage& footage = reviewed.tracks.footage;
    return framesAround({event.first_frame, event.last_frame}, arguments.around_s,
                        {footage.first_frame, footage.last_frame},
                        [&](FrameIndex frame) { return reviewed.tracks.secondsOf(frame); });
}

FrameRange framesAsked(const ClipArguments& arguments, int frame_count) {
    VideoArguments video;
    video.frames = arguments.frames;
    FrameRange range = video.range();
    if (range.last < 0) range.last = frame_count - 1;
    if (range.first < frame_count && range.last < frame_count) return range;
    throw Error(ErrorKind::parameter,
                "--frames " + arguments.frames + ": the video has frames 0 to " + std::to_string(frame_count - 1));
}

/// Answers the exit code.
int makeClip(const ClipArguments& arguments, const std::stop_token& stop) {
    if (arguments.event.has_value() == !arguments.frames.empty()) {
        throw Error(ErrorKind::parameter, "clip needs to know what to cut: either --event N or --frames A:B");
    }
    if (!(std::isfinite(arguments.around_s) && arguments.around_s >= 0)) {
        throw Error(ErrorKind::parameter, "--around: expected 0 seconds or more, e.g. 2");
    }
    const EventChoice choice = arguments.events.choice();
    ProjectFile project = openForReading(arguments.events.project);
    const RunStore store(project);
    const RunRecord run = chosenRun(store, arguments.events.project, arguments.events.run);
    arguments.outputs.check({{arguments.out, FileKind::video}},
                            {arguments.events.project, arguments.events.zones, run.sequence.path});
    std::optional<FrameRange> range;
    if (arguments.event) {
        const ReviewedRun reviewed = readReviewedRun(project, run, choice);
        arguments.events.tellZones(reviewed);
        range = framesOfEvent(arguments, reviewed);
    }
    const auto source = openInput(run.sequence.path, 0, stop, run.sequence.frame_rate_hz);
    if (!range) range = framesAsked(arguments, source->info().frame_count);
    ConsoleProgress progress("% written");
    const auto show = [&](double share) {
        if (!arguments.quiet) progress.showShare(share);
    };
    const ClipWish wish{*range, arguments.overlay, arguments.events.uncorrected};
    const auto written = writeClip(wish, project, run, *source, arguments.out, show, stop);
    if (!written) return exit_stopped;
    std::printf("Clip: %s, frames %d to %d\n", arguments.out.c_str(), written->first, written->last);
    return exit_ok;
}

}  // namespace

void addClipCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<ClipArguments>();
    CLI::App* command =
        app.add_subcommand("clip", "Cut an event, or some frames, out of a run's video, with or without the tracks");
    arguments->events.addRunTo(*command);
    CLI::Option* event =
        command->add_option("--event", arguments->event,
                            "Number of the event, as eyrie-cli events lists it with the same --zone and --set");
    command->add_option("--frames", arguments->frames, "First and last frame instead, both included: A:B, A: or :B")
        ->excludes(event);
    command->add_option("--around", arguments->around_s, "Seconds before and after the event")->capture_default_str();
    command->add_flag("--overlay", arguments->overlay, "Draw the tracks with their numbers and trails");
    arguments->events.addSearchTo(*command);
    command->add_option("--out", arguments->out, "Video to write (mp4)")->required();
    arguments->outputs.addTo(*command);
    addQuiet(*command, arguments->quiet);
    command->callback([arguments, &exit_code] {
        exit_code = untilStopped([&](const std::stop_token& stop) { return makeClip(*arguments, stop); });
    });
}

}  // namespace eyrie::cli

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "cli/annotator.h"
#include "cli/arguments/earlier_state.h"
#include "cli/arguments/event_arguments.h"
#include "cli/arguments/input.h"
#include "cli/arguments/output_arguments.h"
#include "cli/arguments/video_arguments.h"
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/project_runs.h"
#include "cli/reports/console_progress.h"
#include "core/error.h"
#include "correction/corrected_run.h"
#include "io/video/frame_colour.h"
#include "io/video/video_writer.h"

namespace eyrie::cli {
namespace {

constexpr double kAround_s = 2;

struct ClipArguments {
    EventArguments events;
    std::optional<int> event;
    std::string frames;
    double around_s = kAround_s;
    bool overlay = false;
    std::string out;
    OutputArguments outputs;
    bool quiet = false;
};

/// The frames of an event with what is before and after it, as far as the run goes.
FrameRange framesOfEvent(const ClipArguments& arguments, const ReviewedRun& reviewed) {
    const int count = static_cast<int>(reviewed.events.size());
    const int number = *arguments.event;
    if (number < 1 || number > count) {
        throw Error(ErrorKind::parameter, "--event " + std::to_string(number) + ": the run has " +
                                              (count == 0 ? "no events" : "the events 1 to " + std::to_string(count)) +
                                              "; eyrie-cli events lists them with their numbers");
    }
    const Event& event = reviewed.events[static_cast<std::size_t>(number - 1)];
    const Footage& footage = reviewed.tracks.footage;
    // By the frames' own times, which need not be even.
    const double begin = reviewed.tracks.secondsOf(event.first_frame) - arguments.around_s;
    const double end = reviewed.tracks.secondsOf(event.last_frame) + arguments.around_s;
    FrameRange range{event.first_frame, event.last_frame};
    constexpr double kSlack_s = 1e-6;
    while (range.first > footage.first_frame && reviewed.tracks.secondsOf(range.first - 1) >= begin - kSlack_s)
        --range.first;
    while (range.last < footage.last_frame && reviewed.tracks.secondsOf(range.last + 1) <= end + kSlack_s) ++range.last;
    return range;
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

/// Answers whether all was written; stopped, there is no file.
bool writeClip(const ClipArguments& arguments, FrameRange range, ProjectFile& project, const RunRecord& run,
               FrameSource& source, const std::stop_token& stop) {
    const RunStore store(project);
    const CorrectedTracks corrected =
        arguments.overlay && !arguments.events.uncorrected ? readCorrectedTracks(project, run) : CorrectedTracks();
    const auto resultOf = [&](FrameIndex frame) {
        auto result = store.frameResult(run.id, frame);
        if (result) result->tracks = corrected.in(frame, std::move(result->tracks));
        return result;
    };
    const int zoom = arguments.overlay ? annotationZoom(source.info().size) : 1;
    VideoWriterOptions options;
    options.frame_rate_hz = source.info().frame_rate_hz;
    Annotator annotator(Annotator::Parts::tracks);
    if (arguments.overlay) {
        // Trails that began before the clip.
        for (FrameIndex frame = std::max(0, range.first - Annotator::kTrailFrames); frame < range.first; ++frame)
            if (const auto result = resultOf(frame)) annotator.follow(*result);
    }
    ConsoleProgress progress("% written");
    VideoWriter writer(arguments.out, source.info().size * zoom, options);
    const std::int64_t begin = source.timeOf(range.first);
    const auto writeAll = [&] {
        for (FrameIndex frame = range.first; frame <= range.last; ++frame) {
            if (stop.stop_requested()) return false;
            const Frame picture = source.read(frame, true);
            const auto result = arguments.overlay ? resultOf(frame) : std::nullopt;
            const FrameResult none;
            const cv::Mat image =
                arguments.overlay ? annotator.draw(picture, result ? *result : none) : colourOf(picture);
            // Frames keep their distances in time; where the rate is even the writer counts them itself, to the digit.
            writer.write(image, source.info().variable_frame_rate ? source.timeOf(frame) - begin : -1);
            if (!arguments.quiet)
                progress.showShare(static_cast<double>(frame - range.first + 1) / (range.last - range.first + 1));
        }
        return true;
    };
    try {
        if (writeAll()) {
            writer.finish();
            return true;
        }
    } catch (const Error&) {
        writer.abandon();  // half a clip is no evidence
        throw;
    }
    writer.abandon();
    return false;
}

/// Answers the exit code.
int makeClip(const ClipArguments& arguments) {
    if (arguments.event.has_value() == !arguments.frames.empty()) {
        throw Error(ErrorKind::parameter, "clip needs to know what to cut: either --event N or --frames A:B");
    }
    if (!(std::isfinite(arguments.around_s) && arguments.around_s >= 0)) {
        throw Error(ErrorKind::parameter, "--around: expected 0 seconds or more, e.g. 2");
    }
    const InterruptGuard interrupt;
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
    const auto source = openInput(run.sequence.path, 0, interrupt.token(), run.sequence.frame_rate_hz);
    if (!range) range = framesAsked(arguments, source->info().frame_count);
    // The video may have become shorter since the run.
    range->last = std::min(range->last, source->info().frame_count - 1);
    if (range->first > range->last) {
        throw Error(ErrorKind::input, run.sequence.path + ": is shorter than when the run was made; it has " +
                                          std::to_string(source->info().frame_count) + " frames");
    }
    if (!writeClip(arguments, *range, project, run, *source, interrupt.token())) return exit_stopped;
    std::printf("Clip: %s, frames %d to %d\n", arguments.out.c_str(), range->first, range->last);
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
    command->add_flag("--quiet", arguments->quiet, "No progress");
    command->callback([arguments, &exit_code] { exit_code = makeClip(*arguments); });
}

}  // namespace eyrie::cli

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "cli/arguments/earlier_state.h"
#include "cli/arguments/event_arguments.h"
#include "cli/arguments/input.h"
#include "cli/arguments/output_arguments.h"
#include "cli/arguments/video_arguments.h"
#include "cli/command.h"
#include "cli/common_options.h"
#include "cli/interrupt.h"
#include "cli/reports/console_progress.h"
#include "cli/reports/events/event_table.h"
#include "cli/reports/events/likeness_table.h"
#include "cli/reports/figure_text.h"
#include "cli/run_clock.h"
#include "ground/look_reading.h"

namespace eyrie::cli {
namespace {

struct ListArguments {
    EventArguments events;
    TrackId like = 0;
    std::vector<std::string> like_by;
    std::string csv;
    std::string start;
    OutputArguments outputs;
};

/// What of it was asked for, in the order and with the numbers of all events.
JudgedEvents wantedOf(const ReviewedRun& reviewed, const EventChoice& choice) {
    JudgedEvents wanted;
    wanted.any = !reviewed.review.verdicts.empty();
    for (std::size_t i = 0; i < reviewed.events.size(); ++i) {
        const Verdict* verdict = reviewed.verdictOn(i);
        const int number = static_cast<int>(i) + 1;
        if (!choice.wants(reviewed.events[i].kind, verdict, number)) continue;
        wanted.events.push_back(reviewed.events[i]);
        wanted.numbers.push_back(number);
        wanted.verdicts.push_back(verdict);
    }
    for (const LeftVerdict& left : reviewed.carried.left) {
        const Verdict& verdict = reviewed.review.verdicts.at(left.verdict);
        if (choice.wants(verdict.subject.kind, &verdict, 0)) wanted.left.push_back(left);
    }
    return wanted;
}

std::vector<std::string> makersOf(const JudgedEvents& wanted, const StoredTracks& stored) {
    std::vector<std::string> makers;
    for (const Event& event : wanted.events) makers.push_back(makerText(correctionOf(event, stored)));
    return makers;
}

void tellUnregistered(const StoredTracks& stored) {
    if (stored.unregistered == 0) return;
    std::fprintf(stderr, "eyrie-cli: %d frame%s could not be registered; no event is found across them\n",
                 stored.unregistered, stored.unregistered == 1 ? "" : "s");
}

void tellRemarks(const StoredTracks& stored, const std::vector<std::string>& remarks) {
    if (!stored.footage.scale.gsd_known) {
        std::fprintf(stderr,
                     "eyrie-cli: the scale is not known; limits in km/h and m are taken at %s m/px; run again with "
                     "--gsd for reliable speeds\n",
                     numberText(stored.footage.scale.gsd_m_per_px).c_str());
    }
    tellUnregistered(stored);
    for (const std::string& remark : remarks) std::fprintf(stderr, "eyrie-cli: %s\n", remark.c_str());
}

/// A list is there at once: only a table is worth reading through the video for.
VideoClock clockFor(const ListArguments& arguments, const RunRecord& run, const std::stop_token& stop) {
    ProjectFile project = openForReading(arguments.events.project);
    return clockOf(project, run, arguments.start, !arguments.csv.empty(), stop);
}

int tellEvents(const ListArguments& arguments, const std::stop_token& stop) {
    const EventChoice choice = arguments.events.choice();
    arguments.outputs.check({{arguments.csv, FileKind::text}}, {arguments.events.project, arguments.events.zones});
    const ReviewedRun reviewed = arguments.events.read(choice);
    if (stop.stop_requested()) return exit_stopped;
    const StoredTracks& stored = reviewed.tracks;
    arguments.events.tellZones(reviewed);
    if (choice.zones) checkReach(*choice.zones, stored.footage);
    tellRemarks(stored, remarksOn(reviewed.zones, stored.footage));
    const JudgedEvents wanted = wantedOf(reviewed, choice);
    const FrameClock seconds = [&](FrameIndex frame) { return stored.secondsOf(frame); };
    const VideoClock clock = clockFor(arguments, reviewed.run, stop);
    if (stop.stop_requested()) return exit_stopped;
    if (clock.source() != VideoClock::Source::none)
        std::fprintf(stderr, "eyrie-cli: clock times come from %s\n", clock.origin().c_str());
    const FrameMoment moment = momentsBy(clock, seconds);
    if (!arguments.csv.empty()) {
        writeEventCsv(arguments.csv, wanted.events, seconds, wanted.verdicts, wanted.numbers, makersOf(wanted, stored),
                      moment);
    }
    printEvents(wanted, stored, moment);
    printLeft(wanted, reviewed.review);
    printCorrections(reviewed.tracks.corrections, reviewed.review);
    return exit_ok;
}

/// Reads what the vehicles of a run look like, and says what of it could not be read.
LooksByTrack looksIn(const RunRecord& run, const StoredTracks& stored, const std::stop_token& stop) {
    const auto open = [&]() -> ReadPicture {
        const std::shared_ptr<FrameSource> source = openInput(run.sequence.path, 0, stop, run.sequence.frame_rate_hz);
        return [source](FrameIndex frame) { return source->read(frame, true); };
    };
    LooksRead read;
    {
        ConsoleProgress progress("% of the pictures");
        read = readLooks(
            stored.tracks, open, [&](double share) { progress.showShare(share); }, stop);
    }
    if (const std::string missing = read.missing(); !missing.empty() && !stop.stop_requested())
        std::fprintf(stderr, "eyrie-cli: what vehicles look like does not count, or only in part: %s\n",
                     missing.c_str());
    return read.looks;
}

/// Tracks like one: no events are looked for. Answers the exit code.
int tellLikeTracks(const ListArguments& arguments, const std::stop_token& stop) {
    const LikenessChoice counts =
        arguments.like_by.empty() ? LikenessChoice() : LikenessChoice::named(arguments.like_by);
    const EventChoice choice = arguments.events.choice();
    const auto [run, stored] = arguments.events.readTracksAlone();
    arguments.outputs.check({{arguments.csv, FileKind::text}}, {arguments.events.project, run.sequence.path});
    if (!hasMetricLimits(stored.footage.scale))
        std::fprintf(stderr, "eyrie-cli: the scale is not known; distances are measured in vehicle lengths\n");
    tellUnregistered(stored);
    const GroundStretches ground(stored.footage);
    std::vector<TrackLikeness> found = tracksLike(stored, ground, arguments.like, choice.options);
    if (counts.looks) compareLooks(found, looksIn(run, stored, stop), arguments.like);
    if (stop.stop_requested()) return exit_stopped;
    orderBy(counts, found);
    if (!arguments.csv.empty()) writeLikenessCsv(arguments.csv, found, stored);
    printLikeness(arguments.like, found, stored, counts.looks);
    return exit_ok;
}

}  // namespace

void addEventsCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<ListArguments>();
    CLI::App* command = app.add_subcommand(
        "events", "List what happened to the vehicles of a run: stops, turns back, against the flow, zones and more");
    arguments->events.addRunTo(*command);
    arguments->events.addChoiceTo(*command, "all");
    arguments->events.addSearchTo(*command);
    auto* like =
        command
            ->add_option(
                "--like", arguments->like,
                "List the other tracks instead, by their likeness to this one, in path over the ground, speed and size")
            ->type_name("TRACK");
    command
        ->add_option("--like-by", arguments->like_by,
                     "What of it counts: path, speed, size, looks (reads pictures of the video); default: the first "
                     "three")
        ->type_name("NAMES")
        ->delimiter(',')
        ->needs(like);
    for (const char* of_events : {"--kind", "--verdict", "--tag", "--zone"})
        like->excludes(command->get_option(of_events));
    command->add_option("--csv", arguments->csv, "Write what is listed as a table, too");
    like->excludes(addStart(*command, arguments->start));
    arguments->outputs.addTo(*command);
    command->callback([arguments, like, &exit_code] {
        exit_code = untilStopped([&](const std::stop_token& stop) {
            return like->count() > 0 ? tellLikeTracks(*arguments, stop) : tellEvents(*arguments, stop);
        });
    });
}

}  // namespace eyrie::cli

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "cli/arguments/event_arguments.h"
#include "cli/arguments/output_arguments.h"
#include "cli/command.h"
#include "cli/reports/event_table.h"
#include "cli/reports/figure_text.h"
#include "events/event_csv.h"

namespace eyrie::cli {
namespace {

struct ListArguments {
    EventArguments events;
    std::string csv;
    OutputArguments outputs;
};

/// What of it was asked for, in the order and with the numbers of all events.
JudgedEvents wantedOf(const ReviewedRun& reviewed, const EventChoice& choice) {
    JudgedEvents wanted;
    wanted.any = !reviewed.review.verdicts.empty();
    for (std::size_t i = 0; i < reviewed.events.size(); ++i) {
        const Verdict* verdict = reviewed.verdictOn(i);
        if (!choice.wants(reviewed.events[i].kind, verdict)) continue;
        wanted.events.push_back(reviewed.events[i]);
        wanted.numbers.push_back(static_cast<int>(i) + 1);
        wanted.verdicts.push_back(verdict);
    }
    for (const LeftVerdict& left : reviewed.carried.left) {
        const Verdict& verdict = reviewed.review.verdicts.at(left.verdict);
        if (choice.wants(verdict.subject.kind, &verdict)) wanted.left.push_back(left);
    }
    return wanted;
}

void tellRemarks(const StoredTracks& stored, const std::vector<std::string>& remarks) {
    if (!stored.footage.scale.gsd_known) {
        std::fprintf(stderr,
                     "eyrie-cli: the scale is not known; limits in km/h and m are taken at %s m/px, run again with "
                     "--gsd for speeds that hold\n",
                     numberText(stored.footage.scale.gsd_m_per_px).c_str());
    }
    if (stored.unregistered > 0) {
        std::fprintf(stderr, "eyrie-cli: %d frame%s could not be registered; nothing is told across them\n",
                     stored.unregistered, stored.unregistered == 1 ? "" : "s");
    }
    for (const std::string& remark : remarks) std::fprintf(stderr, "eyrie-cli: %s\n", remark.c_str());
}

void tellEvents(const ListArguments& arguments) {
    const EventChoice choice = arguments.events.choice();
    arguments.outputs.check({{arguments.csv, FileKind::text}}, {arguments.events.project, arguments.events.zones});
    const ReviewedRun reviewed = arguments.events.read(choice);
    const StoredTracks& stored = reviewed.tracks;
    arguments.events.tellZones(reviewed);
    if (choice.zones) checkReach(*choice.zones, stored.footage);
    tellRemarks(stored, remarksOn(reviewed.zones, stored.footage));
    const JudgedEvents wanted = wantedOf(reviewed, choice);
    if (!arguments.csv.empty()) {
        writeEventCsv(
            arguments.csv, wanted.events, [&](FrameIndex frame) { return stored.secondsOf(frame); }, wanted.verdicts,
            wanted.numbers);
    }
    printEvents(wanted, stored);
    printLeft(wanted, reviewed.review);
}

}  // namespace

void addEventsCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<ListArguments>();
    CLI::App* command = app.add_subcommand(
        "events", "List what happened to the vehicles of a run: stops, turns back, against the flow, zones and more");
    arguments->events.addRunTo(*command);
    arguments->events.addChoiceTo(*command, "all");
    arguments->events.addSearchTo(*command);
    command->add_option("--csv", arguments->csv, "Write the events as a table, too");
    arguments->outputs.addTo(*command);
    command->callback([arguments, &exit_code] {
        tellEvents(*arguments);
        exit_code = exit_ok;
    });
}

}  // namespace eyrie::cli

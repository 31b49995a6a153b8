#include "cli/arguments/event_arguments.h"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "cli/arguments/earlier_state.h"
#include "cli/arguments/preset_arguments.h"
#include "cli/common_options.h"
#include "cli/project_runs.h"
#include "core/error.h"
#include "correction/corrected_run.h"
#include "events/zones/zone_file.h"

namespace eyrie::cli {

void checkEventNumber(int number, const ReviewedRun& reviewed) {
    const std::size_t count = reviewed.events.size();
    if (number >= 1 && static_cast<std::size_t>(number) <= count) return;
    throw Error(ErrorKind::parameter, "--event " + std::to_string(number) + ": the run has " +
                                          (count == 0 ? "no events" : "the events 1 to " + std::to_string(count)) +
                                          "; eyrie-cli events lists them with their numbers");
}

void EventArguments::addRunTo(CLI::App& command) {
    command.add_option("--project", project, "Project that holds the run")->required();
    addRunNumber(command, run);
}

void addUncorrected(CLI::App& command, bool& uncorrected) {
    command.add_flag("--uncorrected", uncorrected,
                     "The run's own tracks, without what people added, joined, split and rejected in Review");
}

void EventArguments::addSearchTo(CLI::App& command) {
    command.add_option("--zone", zones, "JSON file of zones, lines and arrows (default: those of the project)")
        ->type_name("FILE");
    command
        .add_option("--set", settings,
                    "Set one threshold, e.g. --set events.over=80 (eyrie-cli params lists them); may be repeated")
        ->type_name("NAME=VALUE");
    addUncorrected(command, uncorrected);
}

void EventArguments::addChoiceTo(CLI::App& command, const std::string& usual_verdicts) {
    std::string names;
    for (const EventKind kind : allEventKinds()) names += (names.empty() ? "" : ", ") + std::string(nameOf(kind));
    command.add_option("--kind", kinds, "Only these kinds: " + names)->type_name("KIND")->delimiter(',');
    command
        .add_option("--verdict", verdicts,
                    "Only what was judged so: open (by nobody), relevant, not relevant, unsure (default: " +
                        usual_verdicts + ")")
        ->type_name("VERDICT")
        ->delimiter(',');
    command.add_option("--tag", tags, "Only what has one of these tags, spelled as they were given in the window")
        ->type_name("TAG")
        ->delimiter(',');
}

EventChoice EventArguments::choice() const {
    EventChoice wanted;
    wanted.uncorrected = uncorrected;
    wanted.kinds.reserve(kinds.size());
    for (const std::string& name : kinds) wanted.kinds.push_back(eventKindOf(name));
    wanted.judgements.reserve(verdicts.size());
    for (const std::string& name : verdicts) wanted.judgements.push_back(judgementOf(name));
    wanted.tags = tags;
    applySettings(
        [&](ParameterVisitor& visitor) {
            wanted.options.describe(visitor);
            wanted.review.describe(visitor);
        },
        settings);
    if (!zones.empty()) wanted.zones = readZones(zones);
    return wanted;
}

ReviewedRun EventArguments::read(const EventChoice& wanted) const {
    ProjectFile file = openForReading(project);
    const RunRecord record = chosenRun(RunStore(file), project, run);
    return readReviewedRun(file, record, wanted);
}

std::pair<RunRecord, StoredTracks> EventArguments::readTracksAlone() const {
    ProjectFile file = openForReading(project);
    const RunStore store(file);
    const RunRecord record = chosenRun(store, project, run);
    return {record, readTracks(store, record, uncorrected ? CorrectedTracks() : readCorrectedTracks(file, record))};
}

void EventArguments::tellZones(const ReviewedRun& found) const {
    if (!zones.empty() || found.zones.empty()) return;
    std::string names;
    for (const Zone& zone : found.zones) names += (names.empty() ? "" : ", ") + zone.name;
    const bool one = found.zones.size() == 1;
    std::fprintf(stderr, "eyrie-cli: watching the %s of the project: %s (--zone takes %s)\n", one ? "zone" : "zones",
                 names.c_str(), one ? "another" : "others");
}

}  // namespace eyrie::cli

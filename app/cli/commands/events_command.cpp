#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "cli/arguments/earlier_state.h"
#include "cli/arguments/output_arguments.h"
#include "cli/arguments/preset_arguments.h"
#include "cli/command.h"
#include "cli/project_runs.h"
#include "cli/reports/event_table.h"
#include "cli/reports/figure_text.h"
#include "events/event_csv.h"
#include "events/event_search.h"
#include "events/stored_events.h"
#include "events/zones/zone_file.h"
#include "store/review/review_store.h"

namespace eyrie::cli {
namespace {

struct EventArguments {
    std::string project;
    std::optional<int> run;
    std::vector<std::string> kinds;
    std::vector<std::string> verdicts;
    std::string zones;
    std::vector<std::string> settings;
    std::string csv;
    OutputArguments outputs;
};

/// The kinds that are asked for; all where nothing is.
std::vector<EventKind> wantedKinds(const std::vector<std::string>& names) {
    std::vector<EventKind> kinds;
    kinds.reserve(names.size());
    for (const std::string& name : names) kinds.push_back(eventKindOf(name));
    return kinds.empty() ? allEventKinds() : kinds;
}

/// The verdicts that are asked for; all where nothing is.
std::vector<Judgement> wantedJudgements(const std::vector<std::string>& names) {
    std::vector<Judgement> wanted;
    wanted.reserve(names.size());
    for (const std::string& name : names) wanted.push_back(judgementOf(name));
    if (!wanted.empty()) return wanted;
    return {Judgement::open, Judgement::relevant, Judgement::not_relevant, Judgement::unsure};
}

template <class Value>
bool isAmong(const std::vector<Value>& values, const Value& value) {
    return std::find(values.begin(), values.end(), value) != values.end();
}

Judgement judgementIn(const Verdict* verdict) {
    return verdict == nullptr ? Judgement::open : verdict->judgement;
}

JudgedEvents judgedEvents(const std::vector<Event>& events, const ReviewSet& review, const StoredTracks& stored,
                          const std::vector<Zone>& zones, const ReviewOptions& options) {
    const auto unsearched = unsearchedStretches(stored.footage, options);
    const CarriedVerdicts carried = carryOver(review.verdicts, events, unsearched, stored, zones, options);
    JudgedEvents judged{events, {}, carried.left, !review.verdicts.empty()};
    for (const int id : carried.of_event) judged.verdicts.push_back(id == 0 ? nullptr : &review.verdicts.at(id));
    return judged;
}

/// Leaves out events and verdicts of which nobody asked.
void keepWanted(JudgedEvents& judged, const ReviewSet& review, const std::vector<EventKind>& kinds,
                const std::vector<Judgement>& judgements) {
    JudgedEvents kept{{}, {}, {}, judged.any};
    for (std::size_t i = 0; i < judged.events.size(); ++i) {
        if (!isAmong(kinds, judged.events[i].kind) || !isAmong(judgements, judgementIn(judged.verdicts[i]))) continue;
        kept.events.push_back(judged.events[i]);
        kept.verdicts.push_back(judged.verdicts[i]);
    }
    for (const LeftVerdict& left : judged.left) {
        const Verdict& verdict = review.verdicts.at(left.verdict);
        const auto& kind = verdict.subject.kind;
        if (kind && !isAmong(kinds, *kind)) continue;
        if (isAmong(judgements, verdict.judgement)) kept.left.push_back(left);
    }
    judged = std::move(kept);
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

void tellEvents(const EventArguments& arguments) {
    const std::vector<EventKind> kinds = wantedKinds(arguments.kinds);
    const std::vector<Judgement> judgements = wantedJudgements(arguments.verdicts);
    EventOptions options;
    ReviewOptions review_options;
    applySettings(
        [&](ParameterVisitor& visitor) {
            options.describe(visitor);
            review_options.describe(visitor);
        },
        arguments.settings);
    std::vector<Zone> zones;
    if (!arguments.zones.empty()) zones = readZones(arguments.zones);
    arguments.outputs.check({{arguments.csv, FileKind::text}}, {arguments.project, arguments.zones});
    StoredTracks stored;
    ReviewSet review;
    {
        ProjectFile project = openForReading(arguments.project);
        const RunStore store(project);
        const RunRecord run = chosenRun(store, arguments.project, arguments.run);
        stored = readTracks(store, run);
        review = readReview(project, run.sequence.id);
    }
    tellRemarks(stored, remarksOn(zones, stored.footage));
    const std::vector<Event> events = findEvents(stored.tracks, stored.footage, options, zones);
    JudgedEvents judged = judgedEvents(events, review, stored, zones, review_options);
    keepWanted(judged, review, kinds, judgements);
    if (!arguments.csv.empty()) {
        writeEventCsv(
            arguments.csv, judged.events, [&](FrameIndex frame) { return stored.secondsOf(frame); }, judged.verdicts);
    }
    printEvents(judged, stored);
    printLeft(judged, review);
}

}  // namespace

void addEventsCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<EventArguments>();
    CLI::App* command = app.add_subcommand(
        "events", "List what happened to the vehicles of a run: stops, turns back, against the flow, zones and more");
    command->add_option("--project", arguments->project, "Project that holds the run")->required();
    command->add_option("--run", arguments->run, "Number of the run (default: the last)");
    std::string kinds;
    for (const EventKind kind : allEventKinds()) kinds += (kinds.empty() ? "" : ", ") + std::string(nameOf(kind));
    command->add_option("--kind", arguments->kinds, "Only these kinds: " + kinds)->type_name("KIND")->delimiter(',');
    command
        ->add_option("--verdict", arguments->verdicts,
                     "Only what was judged so: open (by nobody), relevant, not relevant, unsure")
        ->type_name("VERDICT")
        ->delimiter(',');
    command->add_option("--zone", arguments->zones, "JSON file of zones and lines to be watched")->type_name("FILE");
    command
        ->add_option("--set", arguments->settings,
                     "Set one threshold, e.g. --set events.over=80 (eyrie-cli params lists them); may be repeated")
        ->type_name("NAME=VALUE");
    command->add_option("--csv", arguments->csv, "Write the events as a table, too");
    arguments->outputs.addTo(*command);
    command->callback([arguments, &exit_code] {
        tellEvents(*arguments);
        exit_code = exit_ok;
    });
}

}  // namespace eyrie::cli

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>

#include "cli/arguments/earlier_state.h"
#include "cli/arguments/output_arguments.h"
#include "cli/arguments/preset_arguments.h"
#include "cli/command.h"
#include "cli/project_runs.h"
#include "cli/reports/figure_text.h"
#include "events/event_csv.h"
#include "events/event_search.h"
#include "events/stored_events.h"
#include "events/zones/zone_file.h"

namespace eyrie::cli {
namespace {

struct EventArguments {
    std::string project;
    std::optional<int> run;
    std::vector<std::string> kinds;
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

std::string framesText(const Event& event) {
    const std::string first = std::to_string(event.first_frame);
    return event.first_frame == event.last_frame ? first : first + "-" + std::to_string(event.last_frame);
}

std::string tracksText(const Event& event) {
    std::string text;
    for (const TrackId id : event.tracks) text += (text.empty() ? "" : ", ") + std::to_string(id);
    return text;
}

std::string whereText(const Event& event) {
    char place[80];
    std::snprintf(place, sizeof place, "%.0f, %.0f", event.place.x, event.place.y);
    std::string text = place;
    if (event.first_frame != event.last_frame) text += " in " + std::to_string(event.frame);
    if (!event.zone.empty()) text += "  " + event.zone;
    if (event.sense != CrossingSense::none) text += std::string(" ") + nameOf(event.sense);
    return text;
}

void printEvents(const std::vector<Event>& events, const StoredTracks& stored) {
    std::printf("%-17s %-13s %-10s %-12s %-14s %s\n", "kind", "frames", "clock", "tracks", "figure", "place");
    std::map<EventKind, int> counts;
    for (const Event& event : events) {
        // A degree sign is two bytes, but one column.
        const int width = event.unit == FigureUnit::degrees ? 15 : 14;
        std::printf("%-17s %-13s %-10s %-12s %-*s %s\n", nameOf(event.kind), framesText(event).c_str(),
                    videoClockText(stored.secondsOf(event.first_frame)).c_str(), tracksText(event).c_str(), width,
                    figureText(event).c_str(), whereText(event).c_str());
        ++counts[event.kind];
    }
    std::printf("%zu event%s of %zu tracks", events.size(), events.size() == 1 ? "" : "s", stored.tracks.size());
    const char* separator = ": ";
    for (const auto& [kind, count] : counts) {
        std::printf("%s%d %s", separator, count, nameOf(kind));
        separator = ", ";
    }
    std::puts("");
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
    EventOptions options;
    applySettings(describeOf(options), arguments.settings);
    std::vector<Zone> zones;
    if (!arguments.zones.empty()) zones = readZones(arguments.zones);
    arguments.outputs.check({{arguments.csv, FileKind::text}}, {arguments.project, arguments.zones});
    StoredTracks stored;
    {
        ProjectFile project = openForReading(arguments.project);
        const RunStore store(project);
        stored = readTracks(store, chosenRun(store, arguments.project, arguments.run));
    }
    tellRemarks(stored, remarksOn(zones, stored.footage));
    std::vector<Event> events = findEvents(stored.tracks, stored.footage, options, zones);
    std::erase_if(events,
                  [&](const Event& event) { return std::find(kinds.begin(), kinds.end(), event.kind) == kinds.end(); });
    if (!arguments.csv.empty())
        writeEventCsv(arguments.csv, events, [&](FrameIndex frame) { return stored.secondsOf(frame); });
    printEvents(events, stored);
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

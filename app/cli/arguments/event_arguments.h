#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "events/review/reviewed_run.h"

namespace CLI {
class App;
}

namespace eyrie::cli {

/// --uncorrected, of commands that hand out tracks.
void addUncorrected(CLI::App& command, bool& uncorrected);

/// Throws Error(parameter) unless a run has an event of this number, from 1, as --event names it.
void checkEventNumber(int number, const ReviewedRun& reviewed);

/// Which events of which run a command is about.
struct EventArguments {
    std::string project;
    std::optional<int> run;
    std::vector<std::string> kinds;
    std::vector<std::string> verdicts;
    std::vector<std::string> tags;
    std::string zones;
    std::vector<std::string> settings;
    bool uncorrected = false;

    /// --project (required) and --run.
    void addRunTo(CLI::App& command);
    /// --zone and --set: what is an event; --uncorrected.
    void addSearchTo(CLI::App& command);
    /// --kind, --verdict and --tag.
    void addChoiceTo(CLI::App& command, const std::string& usual_verdicts);

    /// Throws Error(parameter | input).
    EventChoice choice() const;
    /// Throws Error(project | parameter).
    ReviewedRun read(const EventChoice& choice) const;
    /// A run and its tracks, without their events. Throws Error(project).
    std::pair<RunRecord, StoredTracks> readTracksAlone() const;
    /// Says on standard error which zones of the project were watched, where no file was given.
    void tellZones(const ReviewedRun& found) const;
};

}  // namespace eyrie::cli

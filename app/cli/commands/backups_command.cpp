#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "cli/command.h"
#include "cli/common_options.h"
#include "cli/interrupt.h"
#include "cli/reports/console_progress.h"
#include "core/error.h"
#include "store/backup/project_restore.h"
#include "store/health/project_contents.h"

namespace eyrie::cli {
namespace {

using Json = nlohmann::ordered_json;

/// What the project holds now; nothing when it is gone or cannot be read.
std::optional<ProjectContents> presentContents(const std::string& project) {
    try {
        return contentsOf(project);
    } catch (const Error& error) {
        std::fprintf(stderr, "note: %s\n", error.what());
        return std::nullopt;
    }
}

Json factsOf(const ProjectBackup& backup, const std::optional<ProjectContents>& present) {
    Json facts{{"name", backup.name()},
               {"made", inWords(backup.made)},
               {"reason", nameOf(backup.reason)},
               {"bytes", backup.bytes},
               {"differences", nullptr}};
    if (!present) return facts;
    try {
        facts["differences"] = differencesInWords(*present, contentsOf(backup.path));
    } catch (const Error& error) {
        facts["damage"] = error.what();
    }
    return facts;
}

/// The facts of every earlier state. Large projects take a while to be looked through, the present one like the others.
Json factsOfAll(const std::string& project, const std::vector<ProjectBackup>& backups) {
    ConsoleProgress progress("% looked through");
    std::error_code missing;
    const auto bytes_now = std::filesystem::file_size(project, missing);
    double done = missing ? 0.0 : static_cast<double>(bytes_now);
    double bytes = done;
    for (const ProjectBackup& backup : backups) bytes += static_cast<double>(backup.bytes);
    const auto present = presentContents(project);
    Json all = Json::array();
    for (const ProjectBackup& backup : backups) {
        progress.showShare(done / bytes);
        all.push_back(factsOf(backup, present));
        done += static_cast<double>(backup.bytes);
    }
    return all;
}

void print(const Json& facts) {
    std::printf("%s\n", facts["name"].get<std::string>().c_str());
    std::printf("  %s, %s, %.1f MB\n", facts["made"].get<std::string>().c_str(),
                facts["reason"].get<std::string>().c_str(), facts["bytes"].get<double>() / 1e6);
    if (facts.contains("damage")) std::printf("  %s\n", facts["damage"].get<std::string>().c_str());
    if (facts["differences"].is_null()) return;
    if (facts["differences"].empty()) std::printf("  holds what the project holds now\n");
    for (const Json& line : facts["differences"]) std::printf("  %s\n", line.get<std::string>().c_str());
}

void listEarlierStates(const std::string& project, bool json) {
    const auto backups = listBackups(project);
    std::error_code missing;
    if (backups.empty() && !std::filesystem::exists(project, missing)) {
        throw Error(ErrorKind::project, "there is no project " + project + ", and no earlier state of one");
    }
    const Json all = factsOfAll(project, backups);
    if (json) {
        std::printf("%s\n", all.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
        return;
    }
    if (all.empty()) std::printf("no earlier state of %s is kept yet\n", project.c_str());
    for (const Json& facts : all) print(facts);
}

ProjectBackup chosenBackup(const std::string& project, const std::string& name) {
    std::string known;
    for (const ProjectBackup& backup : listBackups(project)) {
        if (backup.name() == name) return backup;
        known += (known.empty() ? "" : ", ") + backup.name();
    }
    throw Error(ErrorKind::parameter, "--backup " + name + ": " +
                                          (known.empty() ? "no earlier state of " + project + " is kept"
                                                         : "the earlier states of " + project + " are " + known));
}

int restore(const std::string& project, const std::string& name, const std::string& out) {
    const ProjectBackup backup = chosenBackup(project, name);
    const InterruptGuard interrupt;
    const std::string target = out.empty() ? project : out;
    BackupResult kept;
    {
        ConsoleProgress progress("% restored");
        const CopyWatch watch{[&](double share) { progress.showShare(share); }, interrupt.token()};
        if (out.empty()) {
            kept = restoreBackup(project, backup, watch);
        } else if (!restoreAsNew(backup, out, watch)) {
            kept.outcome = BackupOutcome::stopped;
        }
    }
    if (kept.outcome == BackupOutcome::by_others) throw Error(ErrorKind::project, kept.notice);
    if (kept.outcome == BackupOutcome::stopped) {
        std::fprintf(stderr, "stopped; nothing was changed\n");
        return exit_stopped;
    }
    std::printf("%s is now as of %s\n", target.c_str(), inWords(backup.made).c_str());
    if (kept.backup) std::printf("what it was before is kept as %s\n", kept.backup->name().c_str());
    return exit_ok;
}

}  // namespace

void addBackupsCommand(CLI::App& app, int&) {
    struct Arguments {
        std::string project;
        bool json = false;
    };
    const auto arguments = std::make_shared<Arguments>();
    CLI::App* command =
        app.add_subcommand("backups", "List the earlier states of a project, and how they differ from the present one");
    command->add_option("PROJECT", arguments->project, "Project (.eyrie), which may have been deleted")->required();
    addJson(*command, arguments->json);
    command->callback([arguments] { listEarlierStates(arguments->project, arguments->json); });
}

void addRestoreCommand(CLI::App& app, int& exit_code) {
    struct Arguments {
        std::string project;
        std::string backup;
        std::string out;
    };
    const auto arguments = std::make_shared<Arguments>();
    CLI::App* command =
        app.add_subcommand("restore", "Restore a project to an earlier state; the present state is kept first");
    command->add_option("PROJECT", arguments->project, "Project (.eyrie) that no other program has open")->required();
    command->add_option("--backup", arguments->backup, "Name of the earlier state, as eyrie-cli backups lists it")
        ->required();
    command->add_option("--out", arguments->out, "Make a new project of it and leave PROJECT as it is");
    command->callback(
        [arguments, &exit_code] { exit_code = restore(arguments->project, arguments->backup, arguments->out); });
}

}  // namespace eyrie::cli

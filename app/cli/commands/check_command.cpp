#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.h"
#include "cli/common_options.h"
#include "cli/interrupt.h"
#include "core/error.h"
#include "store/backup/project_backup.h"
#include "store/health/project_check.h"
#include "store/health/project_repair.h"

namespace eyrie::cli {
namespace {

using Json = nlohmann::ordered_json;

struct CheckArguments {
    std::string project;
    std::string repair;
    bool json = false;
};

const char* nameOf(Health health) {
    switch (health) {
        case Health::good:
            return "good";
        case Health::remark:
            return "note";
        case Health::damaged:
            return "DAMAGED";
    }
    return "";
}

void printReport(const CheckArguments& arguments, const HealthReport& report) {
    for (const HealthItem& item : report.items) {
        std::printf("%-15s %-8s %s\n", item.subject.c_str(), nameOf(item.health), item.words.c_str());
    }
    if (report.healthy()) {
        std::printf("%s is healthy\n", arguments.project.c_str());
        return;
    }
    std::printf("%s is damaged\n", arguments.project.c_str());
    if (!arguments.repair.empty()) return;
    std::printf("  eyrie-cli check %s --repair NEW saves what can be read\n", arguments.project.c_str());
    if (!listBackups(arguments.project).empty()) {
        std::printf("  eyrie-cli backups %s lists its earlier states\n", arguments.project.c_str());
    }
}

Json jsonOf(const HealthReport& report) {
    Json items = Json::array();
    for (const HealthItem& item : report.items) {
        items.push_back({{"subject", item.subject}, {"health", nameOf(item.health)}, {"words", item.words}});
    }
    return {{"healthy", report.healthy()}, {"items", items}};
}

void printRepair(const CheckArguments& arguments, const RepairReport& repair) {
    std::printf("saved in %s\n", arguments.repair.c_str());
    for (const std::string& line : repair.saved) std::printf("  %s\n", line.c_str());
    if (repair.saved.empty()) std::printf("  nothing\n");
    std::printf(repair.lost.empty() ? "nothing was lost\n" : "lost, or assumed\n");
    for (const std::string& line : repair.lost) std::printf("  %s\n", line.c_str());
}

int check(const CheckArguments& arguments) {
    const InterruptGuard interrupt;
    const CopyWatch watch{{}, interrupt.token()};
    const HealthReport report = checkProject(arguments.project, watch);
    const auto stopped = [] {
        std::fprintf(stderr, "stopped\n");
        return exit_stopped;
    };
    if (report.stopped) return stopped();
    Json json = jsonOf(report);
    if (!arguments.json) printReport(arguments, report);
    int exit_code = report.healthy() ? exit_ok : exit_project;
    if (!arguments.repair.empty()) {
        const RepairReport repair = repairProject(arguments.project, arguments.repair, watch);
        if (repair.stopped) return stopped();
        json["saved"] = repair.saved;
        json["lost"] = repair.lost;
        if (!arguments.json) printRepair(arguments, repair);
        exit_code = exit_ok;
    }
    if (arguments.json) std::printf("%s\n", json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
    return exit_code;
}

}  // namespace

void addCheckCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<CheckArguments>();
    CLI::App* command = app.add_subcommand("check", "Check a project for damage, and save what can be read of it");
    command->add_option("PROJECT", arguments->project, "Project (.eyrie); it is only read")->required();
    command->add_option("--repair", arguments->repair, "Write all that can be read into this new project");
    addJson(*command, arguments->json);
    command->callback([arguments, &exit_code] { exit_code = check(*arguments); });
}

}  // namespace eyrie::cli

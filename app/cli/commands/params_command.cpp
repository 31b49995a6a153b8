#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/arguments/preset_arguments.h"
#include "cli/command.h"
#include "cli/common_options.h"
#include "events/event_options.h"
#include "events/review/review_options.h"
#include "peer/peer_options.h"

namespace eyrie::cli {
namespace {

void printParameterJson(const std::vector<Parameter>& parameters) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const auto& p : parameters) {
        nlohmann::ordered_json entry{{"name", p.name}, {"value", p.value}, {"unit", p.text.unit}};
        if (p.kind == ParameterKind::choice) {
            entry["choices"] = p.choices;
        } else if (p.kind == ParameterKind::real || p.kind == ParameterKind::integer) {
            entry["min"] = p.min;
            entry["max"] = p.max;
        }
        entry["help"] = p.text.help;
        if (!p.text.source.empty()) entry["source"] = p.text.source;
        list.push_back(std::move(entry));
    }
    std::puts(list.dump(2).c_str());
}

void printParameterTable(const std::vector<Parameter>& parameters) {
    std::string group;
    for (const auto& p : parameters) {
        const std::string own_group = p.name.substr(0, p.name.find('.'));
        if (own_group != group) std::printf("%s%s\n", group.empty() ? "" : "\n", own_group.c_str());
        group = own_group;
        std::printf("  %-38s %-10s %s\n      %s%s\n", p.name.c_str(), p.value.c_str(), p.expected().c_str(),
                    p.text.help.c_str(), p.text.source.empty() ? "" : (" (" + p.text.source + ")").c_str());
    }
}

}  // namespace

void addParamsCommand(CLI::App& app, int&) {
    struct Arguments {
        PresetArguments preset;
        bool json = false;
    };
    const auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("params", "List every parameter with its value, range and meaning");
    arguments->preset.addTo(*command);
    addJson(*command, arguments->json);
    command->callback([arguments] {
        ChainOptions options = arguments->preset.options();
        auto parameters = listParameters(describeOf(options));
        RecordingOptions recording = arguments->preset.recording();
        for (Parameter& parameter : listParameters(describeOf(recording))) parameters.push_back(std::move(parameter));
        EventOptions events;
        for (Parameter& parameter : listParameters(describeOf(events))) parameters.push_back(std::move(parameter));
        ReviewOptions review;
        for (Parameter& parameter : listParameters(describeOf(review))) parameters.push_back(std::move(parameter));
        PeerOptions peer;
        for (Parameter& parameter : listParameters(describeOf(peer))) parameters.push_back(std::move(parameter));
        arguments->json ? printParameterJson(parameters) : printParameterTable(parameters);
    });
}

}  // namespace eyrie::cli

#include "cli/usage_error.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "core/text.h"
#include "io/tables/number_text.h"

namespace eyrie::cli {
namespace {

bool isOption(const std::string& word) {
    return word.size() > 1 && word[0] == '-' && (word[1] < '0' || word[1] > '9') && word[1] != '.' && word != "--";
}

std::optional<std::string> unknownOption(const CLI::App& command, const std::string& word) {
    const std::string name = word.substr(0, word.find('='));
    if (command.get_option_no_throw(name) != nullptr) return std::nullopt;
    std::vector<std::string> known;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& long_name : option->get_lnames()) known.push_back("--" + long_name);
    }
    const auto dashes = std::min(name.find_first_not_of('-'), name.size());
    const auto nearest = nearestWord("--" + name.substr(dashes), known);
    return command.get_name() + " has no option " + name +
           (nearest ? "; did you mean " + *nearest + "?" : "; eyrie-cli " + command.get_name() + " --help lists them");
}

/// Whether an option takes one number, no list of them.
bool takesNumber(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    return option.get_items_expected_max() == 1 &&
           (type.starts_with("FLOAT") || type.starts_with("INT") || type.starts_with("UINT"));
}

/// An option without the value that it needs, or with a word where it takes a number.
std::optional<std::string> badValue(const CLI::App& command, const std::string& name, const std::string& value,
                                    bool missing) {
    const CLI::Option* option = command.get_option_no_throw(name);
    if (option == nullptr || option->get_items_expected_min() < 1) return std::nullopt;
    if (missing) return name + " needs a value; eyrie-cli " + command.get_name() + " --help tells which";
    if (takesNumber(*option) && !parseReal(value)) return name + " " + value + ": expected a number";
    return std::nullopt;
}

/// A number with a decimal comma for an option that takes a number.
std::optional<std::string> decimalComma(const CLI::App& command, const std::string& name, const std::string& value) {
    const auto point = withDecimalPoint(value);
    const CLI::Option* option = command.get_option_no_throw(name);
    if (!point || option == nullptr || option->get_type_name().find("FLOAT") == std::string::npos) return std::nullopt;
    return name + " " + value + ": write " + *point + " with a decimal point";
}

}  // namespace

std::optional<std::string> explainUsage(CLI::App& app, const std::vector<std::string>& words) {
    const auto named =
        std::find_if(words.begin(), words.end(), [](const std::string& word) { return !isOption(word); });
    if (named == words.end())
        return words.empty() ? std::optional<std::string>("a command is missing; eyrie-cli --help lists them")
                             : std::nullopt;
    std::vector<std::string> commands;
    const CLI::App* command = nullptr;
    for (const CLI::App* known : app.get_subcommands([](const CLI::App*) { return true; })) {
        if (!known->get_group().empty()) commands.push_back(known->get_name());  // those without are not for people
        if (known->get_name() == *named) command = known;
    }
    if (command == nullptr) {
        std::string all;
        for (const std::string& name : commands) all += (all.empty() ? "" : ", ") + name;
        const auto nearest = nearestWord(*named, commands);
        return "there is no command \"" + *named + "\"" +
               (nearest ? "; did you mean " + *nearest + "?" : "; there are " + all);
    }
    for (auto word = named + 1; word != words.end(); ++word) {
        if (*word == "--") break;
        if (!isOption(*word)) continue;
        if (auto text = unknownOption(*command, *word)) return text;
        const std::size_t equals = word->find('=');
        const std::string name = word->substr(0, equals);
        const std::string value = equals != std::string::npos ? word->substr(equals + 1)
                                  : word + 1 != words.end()   ? *(word + 1)
                                                              : std::string();
        if (auto text = decimalComma(*command, name, value)) return text;
        const bool missing = equals == std::string::npos && (word + 1 == words.end() || isOption(*(word + 1)));
        if (auto text = badValue(*command, name, value, missing)) return text;
    }
    return std::nullopt;
}

}  // namespace eyrie::cli

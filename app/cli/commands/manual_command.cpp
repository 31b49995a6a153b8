#include <CLI/CLI.hpp>
#include <ctime>
#include <memory>
#include <set>
#include <string>

#include "chain/chain_options.h"
#include "chain/recording/run_recorder.h"
#include "cli/command.h"
#include "core/parameter.h"
#include "events/event_options.h"
#include "events/review/review_options.h"

/// The manual page and the shell completion are made of what the program itself accepts, so that they cannot differ
/// from it.
namespace eyrie::cli {
namespace {

/// A text as troff takes it literally.
std::string troff(const std::string& text) {
    std::string safe;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const bool begins_line = i == 0 || text[i - 1] == '\n';
        if (begins_line && (c == '.' || c == '\'')) safe += "\\&";
        if (c == '\\') {
            safe += "\\e";
        } else if (c == '-') {
            safe += "\\-";
        } else {
            safe += c;
        }
    }
    return safe;
}

std::vector<const CLI::App*> commandsOf(const CLI::App& app) {
    std::vector<const CLI::App*> commands;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        if (!command->get_group().empty()) commands.push_back(command);
    }
    return commands;
}

/// "--project FILE", "INPUT", "-h, --help".
std::string spelling(const CLI::Option& option) {
    std::string text;
    for (const char c : option.get_name(option.get_positional() && !option.nonpositional(), true)) {
        text.append(1, c).append(c == ',' ? " " : "");
    }
    if (!option.get_positional() && option.get_items_expected_max() > 0)
        text.append(" ").append(option.get_type_name());
    return text;
}

void printOptions(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_group().empty()) continue;
        std::printf(".TP\n.B %s\n%s\n", troff(spelling(*option)).c_str(), troff(option->get_description()).c_str());
    }
}

void printManual(const CLI::App& app) {
    std::printf(".TH EYRIE\\-CLI 1 \"\" \"Eyrie %s\" \"Eyrie\"\n.SH NAME\n", engineVersion().c_str());
    std::printf("eyrie\\-cli \\- finds, outlines and follows small moving vehicles in aerial video\n");
    std::printf(".SH SYNOPSIS\n.B eyrie\\-cli\n.I COMMAND\n[options]\n.SH DESCRIPTION\n%s\n",
                troff(app.get_description()).c_str());
    std::printf("The window program is\n.BR eyrie (1).\n.SH COMMANDS\n");
    for (const CLI::App* command : commandsOf(app)) {
        std::printf(".SS eyrie\\-cli %s\n%s.\n", troff(command->get_name()).c_str(),
                    troff(command->get_description()).c_str());
        printOptions(*command);
    }
    std::printf(".SH EXIT STATUS\n.nf\n%s\n.fi\n.SH SEE ALSO\n.BR eyrie (1)\n", troff(app.get_footer()).c_str());
}

/// Words in single quotes for the shell; none of ours holds one.
std::string words(const std::set<std::string>& all) {
    std::string text = "'";
    for (const std::string& word : all) text.append(text.size() > 1 ? " " : "").append(word);
    return text.append("'");
}

void printCompletion(const CLI::App& app) {
    std::set<std::string> names;
    std::string options;
    for (const CLI::App* command : commandsOf(app)) {
        names.insert(command->get_name());
        std::set<std::string> known;
        for (const CLI::Option* option : command->get_options()) {
            for (const std::string& name : option->get_lnames()) known.insert(std::string("--").append(name));
        }
        options.append("        ")
            .append(command->get_name())
            .append(") options=")
            .append(words(known))
            .append(" ;;\n");
    }
    std::set<std::string> parameters;
    ChainOptions chain;
    for (const Parameter& parameter : listParameters(describeOf(chain))) parameters.insert(parameter.name + "=");
    EventOptions events;
    for (const Parameter& parameter : listParameters(describeOf(events))) parameters.insert(parameter.name + "=");
    ReviewOptions review;
    for (const Parameter& parameter : listParameters(describeOf(review))) parameters.insert(parameter.name + "=");
    const std::vector<std::string> presets = builtInPresets();
    std::printf(
        "# Completion of eyrie-cli for bash; made by `eyrie-cli manual --completion`.\n"
        "_eyrie_cli() {\n"
        "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} options=\n"
        "    COMPREPLY=()\n"
        "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
        "        COMPREPLY=($(compgen -W %s' --help --version' -- \"$word\"))\n"
        "        return\n"
        "    fi\n"
        "    case $before in\n"
        "    --preset) COMPREPLY=($(compgen -W %s -- \"$word\") $(compgen -f -- \"$word\")); return ;;\n"
        "    --set) compopt -o nospace; COMPREPLY=($(compgen -W %s -- \"$word\")); return ;;\n"
        "    esac\n"
        "    case $word in\n"
        "    -*)\n"
        "        case ${COMP_WORDS[1]} in\n%s        esac\n"
        "        COMPREPLY=($(compgen -W \"$options\" -- \"$word\")) ;;\n"
        "    *) compopt -o filenames 2>/dev/null; COMPREPLY=($(compgen -f -- \"$word\")) ;;\n"
        "    esac\n"
        "}\n"
        "complete -F _eyrie_cli eyrie-cli\n",
        words(names).c_str(), words({presets.begin(), presets.end()}).c_str(), words(parameters).c_str(),
        options.c_str());
}

}  // namespace

void addManualCommand(CLI::App& app, int&) {
    // In no group, so that --help does not list what only the build and packagers need.
    CLI::App* command =
        app.add_subcommand("manual", "Print the manual page, or the completion of the shell")->group("");
    const auto completion = std::make_shared<bool>(false);
    command->add_flag("--completion", *completion, "Print the completion for bash");
    command->callback([&app, completion] { *completion ? printCompletion(app) : printManual(app); });
}

}  // namespace eyrie::cli

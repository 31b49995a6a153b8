#include "cli/arguments/preset_arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "core/error.h"
#include "io/tables/preset_file.h"

namespace eyrie::cli {

void PresetArguments::addTo(CLI::App& command) {
    command.add_option("--preset", preset, "Parameters to start from: default, thesis, or a preset file")
        ->capture_default_str();
    command.add_option("--set", settings, "Set one parameter, e.g. --set motion.min_speed=1.5; may be repeated")
        ->type_name("NAME=VALUE");
}

ChainOptions PresetArguments::options() const {
    const auto built_in = builtInPresets();
    const bool is_built_in = std::find(built_in.begin(), built_in.end(), preset) != built_in.end();
    std::error_code failed;
    if (!is_built_in && !std::filesystem::exists(preset, failed)) {
        throw Error(ErrorKind::parameter,
                    "there is no preset or preset file \"" + preset + "\"; built in are: default, thesis");
    }
    ChainOptions options = builtInPreset(is_built_in ? preset : "default");
    if (!is_built_in) setParameters(describeOf(options), readPreset(preset).values);
    applySettings(options);
    return options;
}

void PresetArguments::applySettings(ChainOptions& options) const {
    cli::applySettings(describeOf(options), settings);
}

void applySettings(const Describe& describe, const std::vector<std::string>& settings) {
    for (const auto& setting : settings) {
        const auto equals = setting.find('=');
        if (equals == std::string::npos) {
            throw Error(ErrorKind::parameter, "--set " + setting + ": expected name=value");
        }
        setParameter(describe, setting.substr(0, equals), setting.substr(equals + 1));
    }
}

}  // namespace eyrie::cli

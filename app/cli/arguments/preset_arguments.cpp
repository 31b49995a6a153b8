#include "cli/arguments/preset_arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>

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
    std::vector<std::string> of_chain;
    std::copy_if(settings.begin(), settings.end(), std::back_inserter(of_chain),
                 [](const std::string& setting) { return !isOfRecording(setting); });
    cli::applySettings(describeOf(options), of_chain);
    recording();  // what is wrong with it is told now
}

RecordingOptions PresetArguments::recording() const {
    RecordingOptions options;
    std::vector<std::string> of_recording;
    std::copy_if(settings.begin(), settings.end(), std::back_inserter(of_recording), isOfRecording);
    cli::applySettings(describeOf(options), of_recording);
    return options;
}

RecordingOptions PresetArguments::recordingAll(const std::string& option, FrameIndex first, FrameIndex last) const {
    RecordingOptions kept = recording();
    if (kept.keepsAllDetails(first, last)) return kept;
    if (kept.details != KeptDetails::automatic)
        throw Error(ErrorKind::parameter,
                    option + " needs the details behind the tracks of every frame, which recording.details=" +
                        nameOf(kept.details) + " does not keep; leave out one of the two");
    kept.details = KeptDetails::all;
    return kept;
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

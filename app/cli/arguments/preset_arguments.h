#pragma once

#include <string>
#include <vector>

#include "chain/chain_options.h"
#include "store/details/recording_options.h"

namespace CLI {
class App;
}

namespace eyrie::cli {

/// The arguments --preset and --set, shared by all commands that run the chain.
struct PresetArguments {
    std::string preset = "default";     ///< a built-in name or a preset file
    std::vector<std::string> settings;  ///< "name=value"

    void addTo(CLI::App& command);
    /// Throws Error(parameter | input).
    ChainOptions options() const;
    /// What of a run is kept, by --set recording.…. The same.
    RecordingOptions recording() const;
    /// The same with the details of every frame of a run from `first` to `last`, which `option` needs. Throws
    /// Error(parameter) where a setting forbids that.
    RecordingOptions recordingAll(const std::string& option, FrameIndex first, FrameIndex last) const;
    /// Only what --set says. Throws Error(parameter).
    void applySettings(ChainOptions& options) const;
};

/// Sets what --set says, "name=value" each. Throws Error(parameter).
void applySettings(const Describe& describe, const std::vector<std::string>& settings);

}  // namespace eyrie::cli

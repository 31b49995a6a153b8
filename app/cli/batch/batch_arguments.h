#pragma once

#include <string>
#include <vector>

#include "cli/arguments/preset_arguments.h"
#include "cli/arguments/video_arguments.h"
#include "cli/batch/batch.h"

namespace CLI {
class App;
}

namespace eyrie::cli {

/// What `batch` and `watch` are told alike.
struct BatchArguments {
    std::vector<std::string> places;
    std::string out;
    int jobs = 0;  ///< 0: by the machine
    VideoArguments video;
    PresetArguments preset;
    bool quiet = false;

    void addTo(CLI::App& command);
    /// Makes the folder for the results. `record`: how summary and log are called. Throws Error(parameter | input |
    /// output).
    BatchOptions options(const std::string& record) const;
};

}  // namespace eyrie::cli

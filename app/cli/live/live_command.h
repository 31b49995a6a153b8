#pragma once

#include <filesystem>
#include <string>

#include "cli/arguments/output_arguments.h"
#include "cli/arguments/preset_arguments.h"
#include "cli/arguments/video_arguments.h"

namespace eyrie::cli {

/// What a run over a live source is given.
struct LiveArguments {
    std::string address;
    std::filesystem::path project;  ///< empty: named after the time, in this folder
    VideoArguments video;
    PresetArguments preset;
    std::string name;
    std::string tracks_csv;
    double wait_s = 10;     ///< for the first picture
    double give_up_s = 30;  ///< after the last one
    double seconds = 0;     ///< after which it is ended; 0: never
    OutputArguments outputs;
    bool quiet = false;
};

/// Receives, records beside the project, runs the chain as frames come, and tells how it went. Nothing is made before
/// the source answers. Answers the exit code. Throws Error.
int runLiveCommand(const LiveArguments& arguments);

}  // namespace eyrie::cli

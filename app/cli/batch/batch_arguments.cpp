#include "cli/batch/batch_arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <system_error>
#include <thread>

#include "core/error.h"
#include "io/folder.h"
#include "io/output_files.h"

namespace eyrie::cli {
namespace {

constexpr unsigned kCoresOfARun = 4;  ///< that a run can make use of

/// All digits, so that it means to a child what it means here.
std::string exactText(double value) {
    char text[64];
    const auto end = std::to_chars(text, text + sizeof text, value);
    return {text, end.ptr};
}

}  // namespace

void BatchArguments::addTo(CLI::App& command) {
    command.add_option("places", places, "Folders with videos or images, subfolders included, and single videos")
        ->required();
    command
        .add_option(
            "--out", out,
            "Folder for the projects, one for each file and laid out as the videos are, the summary and the log")
        ->required();
    command.add_option("--jobs", jobs, "Files processed at once (default: one for every four cores)")
        ->check(CLI::Range(1, 256));
    video.addTo(command);
    preset.addTo(command);
    command.add_flag("--quiet", quiet, "Report only what failed");
}

BatchOptions BatchArguments::options(const std::string& record) const {
    video.check();
    BatchOptions options;
    options.out = std::filesystem::absolute(out).lexically_normal();
    options.record = record;
    options.jobs = jobs > 0 ? jobs : static_cast<int>(std::max(1U, std::thread::hardware_concurrency() / kCoresOfARun));
    options.wishes.options = preset.options();
    options.wishes.gsd_m_per_px = video.gsd_m_per_px;
    options.wishes.frame_rate_hz = video.frame_rate_hz;
    if (!video.frames.empty()) options.wishes.frames = video.range();
    const auto tell = [&](const char* name, const std::string& value) {
        options.run_words.emplace_back(name);
        options.run_words.push_back(value);
    };
    tell("--preset", preset.preset);
    for (const std::string& setting : preset.settings) tell("--set", setting);
    if (video.gsd_m_per_px) tell("--gsd", exactText(*video.gsd_m_per_px));
    if (video.frame_rate_hz) tell("--fps", exactText(*video.frame_rate_hz));
    if (!video.frames.empty()) tell("--frames", video.frames);
    for (const std::string& place : places) {
        if (!isFolder(place) && !isFile(place)) {
            throw Error(ErrorKind::input, place + ": no such file or folder");
        }
    }
    std::error_code failed;
    std::filesystem::create_directories(options.out, failed);
    if (failed)
        throw Error(ErrorKind::output,
                    out + ": the folder cannot be made (" + failed.message() + "); choose another with --out");
    // Summary and log are ours to write on; what else lies under these names is not.
    filesToReplace(
        {{options.out / (record + ".csv"), FileKind::text}, {options.out / (record + ".jsonl"), FileKind::json, true}},
        {preset.preset});
    return options;
}

}  // namespace eyrie::cli

#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "formats/label_stream.h"
#include "io/video/frame_source.h"
#include "store/project/project_file.h"
#include "store/runs/run_store.h"

/// Tracks of a run for other programs: what the command line and the window have in common.
namespace eyrie {

/// Name of the format that is a copy of the video with the tracks in it (writeVmti()). It is not one of labelFormats():
/// it holds no labels, and needs the video.
inline constexpr char kVmtiFormat[] = "vmti";

/// Opens the video of a run, or answers null where there is none. Throws Error.
using OpenVideo = std::function<std::unique_ptr<FrameSource>()>;

/// Gives the tracks of a run times and places, as the project and the video know them, where what is written in
/// `format` has such; `labels` is of `run`. Answers the video that was opened for it: null in formats that need
/// neither, and where it cannot be opened, but for kVmtiFormat. `start_utc_us`: when the video began, if a person says
/// so now; else what the project keeps counts. Throws Error(project), Error(input) when it was stopped, as what was not
/// read to its end knows less, and in kVmtiFormat what `open` throws or Error(input) where there is no video.
std::unique_ptr<FrameSource> addWorld(const std::string& format, LabelStream& labels, ProjectFile& project,
                                      const RunRecord& run, const OpenVideo& open,
                                      std::optional<std::int64_t> start_utc_us = {}, const std::stop_token& stop = {});

}  // namespace eyrie

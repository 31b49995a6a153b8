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

/// The video of a run, opened for what is written in `format`: null in formats that need neither times nor places, and
/// where it cannot be opened, but for kVmtiFormat. Throws in kVmtiFormat what `open` throws, or Error(input) where
/// there is no video, and what `open` throws when it was stopped.
std::unique_ptr<FrameSource> openVideoFor(const std::string& format, const RunRecord& run, const OpenVideo& open,
                                          const std::stop_token& stop = {});

/// Gives the tracks of a run times and places, as the project and the video know them, where what is written in
/// `format` has such; `labels` is of `run`, `video` of openVideoFor(), null where there is none. `start_utc_us`: when
/// the video began, if a person says so now; else what the project keeps counts. Throws Error(project), and
/// Error(input) when it was stopped, as what was not read to its end knows less.
void addWorld(LabelStream& labels, const std::string& format, ProjectFile& project, const RunRecord& run,
              const FrameSource* video, std::optional<std::int64_t> start_utc_us = {},
              const std::stop_token& stop = {});

}  // namespace eyrie

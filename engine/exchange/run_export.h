#pragma once

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

/// Whether what is written in a format has times or places on the earth, for which the video is asked.
bool tellsWorld(const std::string& format);

/// Gives the tracks of a run times and places as the project and the video know them. `pixels` may be null, `labels` is
/// of `run`. `start_utc_us`: when the video began, if a person says so now; else what the project keeps counts. Throws
/// Error(project), and Error(input) when it was stopped: what was not read to its end knows less.
void addWorld(LabelStream& labels, ProjectFile& project, const RunRecord& run, const FrameSource* pixels,
              std::optional<std::int64_t> start_utc_us = {}, const std::stop_token& stop = {});

}  // namespace eyrie

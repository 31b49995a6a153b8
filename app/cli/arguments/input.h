#pragma once

#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "core/scene_name.h"
#include "io/video/frame_source.h"

namespace eyrie::cli {

/// Opens a video file, a folder of images, or a built-in scene ("scene:seq1"). Shows progress while a long video is
/// indexed. Throws Error(input | parameter).
/// `remembered_rate_hz`: see rememberedRate().
std::unique_ptr<FrameSource> openInput(const std::string& input, double frame_rate_hz, std::stop_token stop,
                                       double remembered_rate_hz = 0);

/// The same of what a command names: one input, or several video files that are one video in a row. The list of them is
/// kept beside `project`, under its name with the ending of lists; no project, no list. A rate that the project knows
/// counts where none is given.
std::unique_ptr<FrameSource> openInputs(const std::vector<std::string>& inputs, double frame_rate_hz,
                                        const std::stop_token& stop, const std::filesystem::path& project);

/// The frames per second that a project knows for an input, so that a rate given once need not be given again; 0 when
/// there is no such project or it does not know the input. Throws Error(project) for one that cannot be read.
double rememberedRate(const std::filesystem::path& project, const std::string& input);

}  // namespace eyrie::cli

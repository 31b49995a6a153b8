#pragma once

#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>

#include "io/frame_source.h"

namespace eyrie::cli {

/// Opens a video file, a folder of images, or a built-in scene ("scene:seq1"). Shows progress while a long video is
/// indexed. Throws Error(input | parameter).
std::unique_ptr<FrameSource> openInput(const std::string& input, double frame_rate_hz, std::stop_token stop);

/// Throws Error(parameter) unless `gsd` is a usable number of metres per pixel.
void checkGsd(double gsd_m_per_px);
/// Throws Error(parameter) unless `rate` is a usable number of frames per second.
void checkFrameRate(double rate_hz);
/// "A:B", "A:", ":B" or "A" as first and last frame, both included. Throws Error(parameter).
struct ParsedRange {
    FrameIndex first = 0;
    FrameIndex last = -1;
};
ParsedRange parseFrames(const std::string& text);

}  // namespace eyrie::cli

#pragma once

#include <filesystem>
#include <map>
#include <opencv2/core/matx.hpp>

#include "core/ids.h"

namespace eyrie {

/// Reads true homographies: CSV with the header frame,h00,h01,h02,h10,h11,h12,h20,h21,h22; each line maps points of its
/// frame (px) into one frame common to all, usually frame 0. Throws Error(input) "file:line:column: …".
std::map<FrameIndex, cv::Matx33d> readHomographyCsv(const std::filesystem::path& file);

}  // namespace eyrie

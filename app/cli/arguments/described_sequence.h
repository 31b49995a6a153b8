#pragma once

#include <filesystem>
#include <opencv2/core/types.hpp>
#include <string>

#include "formats/mot/motchallenge.h"

namespace eyrie::cli {

/// Size of the image and length of the sequence as a seqinfo.ini, meta.json or scene.json beside the file or one folder
/// up says; empty where none does. Throws Error(input) for a damaged one.
MotSequence describedBeside(const std::filesystem::path& file);

/// "1024x540". Throws Error(parameter).
cv::Size parseSize(const std::string& text);

}  // namespace eyrie::cli

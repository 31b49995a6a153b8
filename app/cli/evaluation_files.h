#pragma once

#include <filesystem>
#include <opencv2/core/types.hpp>
#include <optional>

#include "core/box_record.h"
#include "formats/motchallenge.h"

namespace eyrie::cli {

enum class BoxFormat { ours, mot };

/// Boxes of a file together with what it was.
struct BoxFile {
    BoxesByFrame boxes;
    BoxFormat format = BoxFormat::ours;
};

/// Reads our CSV (its first line names the column "frame") or MOTChallenge text. Throws Error(input) when it is neither
/// or malformed.
BoxFile readTruthBoxes(const std::filesystem::path& file, const MotOptions& options);
BoxFile readResultBoxes(const std::filesystem::path& file, const MotOptions& options);

/// Size of the image and length of the sequence as a seqinfo.ini, meta.json or scene.json beside the file or one folder
/// up says; empty where none does. Throws Error(input) for a damaged one.
MotSequence describedBeside(const std::filesystem::path& file);

/// "1024x540". Throws Error(parameter).
cv::Size parseSize(const std::string& text);

}  // namespace eyrie::cli

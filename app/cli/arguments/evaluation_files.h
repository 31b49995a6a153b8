#pragma once

#include <filesystem>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/labels/box_record.h"
#include "formats/mot/motchallenge.h"

namespace eyrie::cli {

/// Boxes of a file together with what it was.
struct BoxFile {
    BoxesByFrame boxes;
    std::string format;                ///< title for people: "UAVDT"
    bool has_headings = true;          ///< whether the format can turn boxes
    std::vector<std::string> remarks;  ///< which files were read besides, and what was odd
};

/// Reads true boxes in any format that import reads, recognised in the same way. `mot_origin` is where the first pixel
/// begins in MOTChallenge text, where the user said; `image_size` is for formats relative to the image. Throws
/// Error(input) when no format fits or the file is malformed.
BoxFile readTruthBoxes(const std::filesystem::path& file, std::optional<double> mot_origin,
                       std::optional<cv::Size> image_size = {});
/// Reads boxes to be measured: a table of numbers is a MOTChallenge result, anything else as above.
BoxFile readResultBoxes(const std::filesystem::path& file, std::optional<double> mot_origin,
                        std::optional<cv::Size> image_size = {});

/// Size of the image and length of the sequence as a seqinfo.ini, meta.json or scene.json beside the file or one folder
/// up says; empty where none does. Throws Error(input) for a damaged one.
MotSequence describedBeside(const std::filesystem::path& file);

/// What the option --mot-origin of several commands is for.
std::string motOriginHelp();

/// "1024x540". Throws Error(parameter).
cv::Size parseSize(const std::string& text);

}  // namespace eyrie::cli

#pragma once

#include <filesystem>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/labels/box_record.h"
#include "store/runs/run_store.h"

namespace eyrie {

/// Which true boxes are meant.
struct GroundTruthSource {
    std::filesystem::path file;          ///< any format that import reads; empty: the labels of the run's project
    std::optional<double> mot_origin{};  ///< where the first pixel begins in MOTChallenge text, where the user said
};

/// True boxes, wherever they come from.
struct GroundTruth {
    BoxesByFrame boxes;  ///< a frame that is missing is not labelled; boxes to be ignored say so, regions are such
    std::string name;    ///< for people: "gt/truth.csv", "labels of the project p.eyrie"
    bool has_headings = true;  ///< whether its boxes can be turned; otherwise they are upright for that reason
    std::vector<std::string> remarks{};  ///< which files were read besides, what was odd, what was left out
};

/// Thrown where nobody has labelled the video of a run. A type of its own for who shows the video and its project
/// already, and says so without their paths.
class NothingLabelled : public Error {
 public:
    NothingLabelled(const std::filesystem::path& project, const std::string& video);
};

/// Reads a file or folder of labels. `image_size` is for formats relative to the image. Throws Error(input) when no
/// format fits, the file is malformed or holds no box.
GroundTruth readGroundTruth(const GroundTruthSource& source, std::optional<cv::Size> image_size);

/// The true boxes of a run's video: the file that is named, else what people labelled in the project, interpolated over
/// the ground as this run registered it, all frames of the video. Throws NothingLabelled.
GroundTruth readGroundTruth(const GroundTruthSource& source, ProjectFile& project, const RunRecord& run);

/// Boxes to be measured from a file: a table of numbers is a MOTChallenge result, anything else is read as above.
BoxesByFrame readResultBoxes(const GroundTruthSource& source);

}  // namespace eyrie

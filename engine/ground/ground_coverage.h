#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/review/seen_frames.h"
#include "events/stored_events.h"
#include "ground/ground_sheets.h"

namespace eyrie {

/// How finely coverage is told.
struct CoverageOptions {
    int cells_across = 40;               ///< over the smaller side of the picture that takes up most ground
    std::int64_t max_cells = 1'000'000;  ///< of all sheets together; where more were needed, cells are larger
};

/// How a sheet of ground was covered in time, by cells of a grid. A cell is seen in a frame whose picture holds its
/// middle. Frames that could not be registered onto the one before were not searched, and do not count.
struct SheetCoverage {
    cv::Rect2d area;        ///< of all cells, in the unit of the sheet
    double cell = 1;        ///< side, in the same unit
    cv::Mat seen_s;         ///< CV_64F: for how long, all times together; 0: never
    cv::Mat last_frame;     ///< CV_32S: in which frame it was seen last; −1: never
    double shortest_s = 0;  ///< of the cells that were seen; 0 where none was
    double longest_s = 0;
    FrameSpan frames{0, -1};  ///< first and last of those that count; none where no cell was seen

    /// The cell of a place of the sheet, x then y; nothing beside the grid.
    std::optional<cv::Point> cellAt(cv::Point2d on_sheet) const;
};

/// The coverage of every sheet of the run's ground, by sheet; a frame lasts until the next one is shown.
std::vector<SheetCoverage> groundCoverage(const GroundSheets& sheets, const StoredTracks& run,
                                          const CoverageOptions& options = {});

}  // namespace eyrie

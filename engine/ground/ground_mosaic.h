#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/values/frame.h"
#include "ground/ground_sheets.h"

namespace eyrie {

/// How large and how fine a mosaic becomes.
struct MosaicOptions {
    std::int64_t max_pixels = 8'000'000;  ///< of all sheets together
    int wanted_frames = 400;              ///< that are painted, of all sheets together; two of each are at least
    bool colour = true;                   ///< else grey
    std::vector<int> wanted_sheets = {};  ///< that get pixels, all others next to none; none: all
};

/// The ground of one sheet as it was seen, newest on top.
struct MosaicSheet {
    cv::Rect2d area;         ///< of the sheet, in its unit
    double px_per_unit = 1;  ///< of the picture
    cv::Mat picture;         ///< CV_8UC3 or CV_8UC1; black where nothing was painted yet
    cv::Mat painted;         ///< CV_8UC1, 255 where something was

    cv::Point2d pictureFromSheet(cv::Point2d on_sheet) const {
        return (on_sheet - area.tl()) * px_per_unit - cv::Point2d(0.5, 0.5);
    }
};

/// Lays the pictures of a run side by side on its sheets, frame by frame, in memory that does not grow: sheets share
/// one budget of pixels and are as coarse as that asks for. Of frames that show nearly the same ground only some are
/// needed.
class GroundMosaic {
 public:
    /// Nothing is painted yet.
    explicit GroundMosaic(std::shared_ptr<const GroundSheets> sheets, const MosaicOptions& options = {});

    /// The frames to paint, ascending: all ground that was seen is in one of them, but for slivers where
    /// `wanted_frames` do not suffice. The first and the last of every sheet are always among them, so that a run that
    /// falls into very many sheets has more.
    const std::vector<FrameIndex>& frames() const { return frames_; }
    /// Throws Error(input) for a picture of another size than the run's.
    void paint(const Frame& frame);
    const std::vector<MosaicSheet>& sheets() const { return pictures_; }

 private:
    void chooseFrames(int most);
    void layOut(const MosaicOptions& options);

    std::shared_ptr<const GroundSheets> sheets_;
    bool colour_;
    std::vector<FrameIndex> frames_;
    std::vector<MosaicSheet> pictures_;
    cv::Mat edge_;  ///< how much a picture counts at each pixel: less towards its border
};

}  // namespace eyrie

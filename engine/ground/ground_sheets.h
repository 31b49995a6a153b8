#pragma once

#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>
#include <optional>
#include <vector>

#include "events/ground/ground_stretches.h"

namespace eyrie {

/// Lays every frame of a run on a plane of ground, so that what stands on the ground stands still: place, rotation and
/// enlargement are those of a chosen frame, the anchor. Where a picture has become too unlike the anchor (height, tilt,
/// way flown) the frames from there on are laid on one that lies between, which itself lies as it is turned in its
/// middle, and about as large: so rotation and zoom stay steady on any flight. A new sheet begins where nothing
/// connects two frames, as it was filmed there. Never changed, safe to share.
class GroundSheets {
 public:
    /// No frames.
    GroundSheets() = default;
    /// `anchor` is brought into the frames that were searched.
    GroundSheets(const Footage& footage, FrameIndex anchor);

    /// Sheets are numbered in the order of their frames.
    int count() const { return sheet_of_.empty() ? 0 : sheet_of_.back() + 1; }
    /// −1 for a frame that was not searched.
    int sheetOf(FrameIndex frame) const;
    FrameIndex anchor() const { return anchor_; }
    FrameIndex firstFrame() const { return first_; }
    FrameIndex lastFrame() const { return first_ + static_cast<FrameIndex>(sheet_of_.size()) - 1; }
    cv::Size imageSize() const { return image_; }
    /// The map from a frame onto its sheet; in the sheet of the anchor its unit is a pixel of the anchor. Sound for
    /// every frame that was searched; others are not moved.
    const cv::Matx33d& sheetFromImage(FrameIndex frame) const;
    /// A place of the sheet in a frame of it, px; nothing where the frame does not show it.
    std::optional<cv::Point2d> inImage(FrameIndex frame, cv::Point2d on_sheet) const;
    /// The corners of a frame on its sheet, clockwise from the top left.
    std::vector<cv::Point2d> outlineOf(FrameIndex frame) const;

 private:
    void lay(const CameraMotion& camera, int direction);

    FrameIndex first_ = 0;
    FrameIndex anchor_ = 0;
    cv::Size image_;
    std::vector<cv::Matx33d> sheet_from_image_;
    std::vector<int> sheet_of_;
};

}  // namespace eyrie

#pragma once

#include <vector>

#include "annotation/keyframes/camera_motion.h"
#include "core/labels/annotation.h"
#include "core/labels/box_record.h"

namespace eyrie {

/// A region as it lies in a frame.
struct RegionInFrame {
    int id = 0;
    std::vector<cv::Point2d> polygon;  ///< px in the frame
    bool carried = true;  ///< false: fixed to the ground, but the frames are not connected, so it stands in the image
};

/// The regions that hold in a frame.
std::vector<RegionInFrame> regionsAt(const AnnotationSet& set, FrameIndex frame, const CameraMotion& camera);

/// Whether a point lies in a polygon; its border belongs to it.
bool contains(const std::vector<cv::Point2d>& polygon, cv::Point2d point);

/// Upright boxes that cover a polygon up to its border, in rows of about `row_px`; for what knows boxes only.
std::vector<OrientedBox> coveringBoxes(const std::vector<cv::Point2d>& polygon, double row_px = 8);

/// Which labels go into the boxes.
struct GroundTruthOptions {
    FrameIndex first_frame = 0;
    FrameIndex last_frame = 0;          ///< included
    cv::Size image;                     ///< px; empty: boxes are not compared with the image
    double min_share_in_image = 0.6;    ///< boxes with less of their area in the image are ignored
    bool ignore_fully_occluded = true;  ///< those count neither way
    bool only_checked = false;          ///< what nobody has checked counts neither way
    bool regions_as_boxes = true;       ///< regions become ignored boxes, so that results in them count neither way
};

/// Labels as the boxes an evaluation takes: an object in every frame in which it is in the image, with its id; ignored
/// where its keyframe says so or its centre lies in an ignore region. The boxes of regions have ids above all objects.
BoxesByFrame groundTruthBoxes(const AnnotationSet& set, const CameraMotion& camera, const GroundTruthOptions& options);

}  // namespace eyrie

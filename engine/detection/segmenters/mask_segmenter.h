#pragma once

#include "core/values/scene_scale.h"
#include "detection/detector.h"
#include "detection/segmenters/component_boxes.h"
#include "detection/segmenters/gradient_options.h"

namespace eyrie {

/// What all segmentations of a motion ROI share once they have found their pixels: connected components and the boxes
/// made of them, with the same limits as gradient based segmentation, so that methods differ by their pixels alone.
class MaskSegmenter : public Detector {
 public:
    /// `components`: what happens to components (see ComponentBoxes); `cluster_margin`: margin of the cluster's box
    /// where that is delivered instead.
    MaskSegmenter(const GradientOptions& components, const SceneScale& scale, double cluster_margin);

    /// Trace layers: raw, those of the method, components.
    std::vector<Detection> detect(const MotionRoi& roi, DetectionTrace* trace = nullptr) const final;
    const VehicleModel* model() const final { return nullptr; }

 protected:
    /// The pixels of objects, CV_8UC1 of the ROI's size, 0 or 255. The ROI is at least 3 px a side.
    virtual cv::Mat objectPixels(const MotionRoi& roi, DetectionTrace* trace) const = 0;

 private:
    std::vector<cv::Rect2d> segment(const MotionRoi& roi, DetectionTrace* trace) const;

    GradientOptions components_;
    ComponentBoxes component_boxes_;
    double cluster_margin_;
};

/// Adds a layer scaled to its largest value, for images whose range says nothing; does nothing without a trace.
void addLayer(DetectionTrace* trace, TraceLayer kind, const cv::Mat& image);

/// A filled disc of this diameter as structuring element; at least 1 px, made odd.
cv::Mat discElement(double diameter_px);

/// Otsu's threshold over the pixels of a CV_8UC1 image that lie in `mask`: values above it are the brighter class. 255
/// when there are none.
double otsuWithin(const cv::Mat& image, const cv::Mat& mask);

}  // namespace eyrie

#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>
#include <vector>

namespace eyrie {

/// The intermediate images of one detection, for the inspector: in the order they were made, all of the ROI's size.
struct DetectionTrace {
    struct Layer {
        std::string name;                 ///< "raw", "lbp mask", "gradient", "binary", "closed", "components"
        cv::Mat image;                    ///< CV_8UC1 or CV_32FC1
        std::vector<cv::Rect2d> boxes{};  ///< what came of it, by their edges in ROI coordinates, to be drawn over it
    };
    std::vector<Layer> layers;

    /// Adds a copy.
    void add(const std::string& name, const cv::Mat& image, std::vector<cv::Rect2d> boxes = {}) {
        layers.push_back({name, image.clone(), std::move(boxes)});
    }
};

}  // namespace eyrie

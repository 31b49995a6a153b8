#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>
#include <vector>

namespace eyrie {

/// The intermediate images of one detection, for the inspector: in the order they were made, all of the ROI's size; and
/// the comparisons that kept or dropped what came of them.
struct DetectionTrace {
    struct Layer {
        std::string name;                 ///< "raw", "lbp mask", "gradient", "binary", "closed", "components"
        cv::Mat image;                    ///< CV_8UC1 or CV_32FC1
        std::vector<cv::Rect2d> boxes{};  ///< what came of it, by their edges in ROI coordinates, to be drawn over it
    };
    /// A value that a box had to reach (or, `at_most`, not to exceed).
    struct Check {
        std::string what;       ///< for people: "decision value of the best window"
        std::string parameter;  ///< that says the limit
        double value = 0;
        double limit = 0;
        bool at_most = false;
        bool passed = false;
        cv::Rect2d box{};  ///< what it is about, by its edges in ROI coordinates; empty: the whole area
    };
    std::vector<Layer> layers;
    std::vector<Check> checks;

    /// Adds a copy.
    void add(const std::string& name, const cv::Mat& image, std::vector<cv::Rect2d> boxes = {}) {
        layers.push_back({name, image.clone(), std::move(boxes)});
    }
};

}  // namespace eyrie

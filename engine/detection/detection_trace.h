#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>
#include <vector>

namespace eyrie {

/// What an intermediate image of a detection is. How it is called for people is said where it is shown.
enum class TraceLayer : std::uint8_t {
    raw,  ///< the search area as it was given
    gradient,
    lbp_mask,
    quantile_area,  ///< of whose gradients the quantile is taken
    binary,
    closed,
    components,    ///< CV_8UC1, labels from 1; 0: none
    bright_lines,  ///< relative connectivity: the accumulator of bright pixels
    bright_areas,
    dark_lines,
    dark_areas,
    fused,
    decision,            ///< sliding window: decision values at the windows' centres, of one scale
    first_suppression,   ///< raw, with the boxes left
    second_suppression,  ///< raw, with the boxes left
    smoothed,
    white_tophat,
    black_tophat,
    regions,    ///< of MSER
    edges,      ///< of Canny
    corners,    ///< of Harris
    clustered,  ///< corners that lie together
};

/// The intermediate images of one detection, for the inspector: in the order they were made, all of the ROI's size; and
/// the comparisons that kept or dropped what came of them.
struct DetectionTrace {
    struct Layer {
        TraceLayer kind = TraceLayer::raw;
        cv::Mat image;                    ///< CV_8UC1 or CV_32FC1
        std::vector<cv::Rect2d> boxes{};  ///< what came of it, by their edges in ROI coordinates, to be drawn over it
        double scale = 1;                 ///< of a decision: that at which windows were laid over the area; else 1
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
    void add(TraceLayer kind, const cv::Mat& image, std::vector<cv::Rect2d> boxes = {}) {
        layers.push_back({kind, image.clone(), std::move(boxes)});
    }
    /// Adds a copy of the decision values of a scale.
    void addDecision(double scale, const cv::Mat& image) {
        layers.push_back({TraceLayer::decision, image.clone(), {}, scale});
    }
};

}  // namespace eyrie

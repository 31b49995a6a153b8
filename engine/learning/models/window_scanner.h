#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "learning/classifiers/gentle_adaboost.h"
#include "learning/descriptors/channel_features.h"
#include "learning/models/vehicle_model.h"

namespace eyrie {

/// What a scan cost.
struct ScanStatistics {
    std::int64_t windows = 0;
    std::int64_t trees = 0;  ///< evaluated over all windows; per window it is the run time
};

/// Evaluates a model in every 16×32 window of an image (Teutsch §5.4.3: dense sliding window). Channel features with
/// AdaBoost share their integral channels among the windows and are evaluated for neighbouring windows at once; every
/// other model is computed window by window. Immutable: may be used by several threads.
class WindowScanner {
 public:
    explicit WindowScanner(VehicleModel model);

    /// `roi` is CV_8UC1, vehicles' heading up. `decision` becomes CV_32FC1 of (width − 15) × (height − 31): element
    /// (x, y) is the decision value of the window whose upper left pixel is (x, y), exactly that of the model for the
    /// window alone. Empty where the image is smaller than the window.
    ///
    /// Soft cascade, only with channel features and AdaBoost: a window is given up, with −∞ as its value, as soon as
    /// the sum over the first trees lies more than `rejection_margin` below the lowest such sum of the accepted
    /// training vehicles. Smaller, even negative, is faster and may lose unusual vehicles; infinity rejects nothing.
    void scan(const cv::Mat& roi, double rejection_margin, cv::Mat& decision,
              ScanStatistics* statistics = nullptr) const;

    const VehicleModel& model() const { return model_; }
    /// Whether scans use shared channels and early rejection.
    bool fast() const { return !trees_.empty(); }

    static constexpr double kNothingRejected = std::numeric_limits<double>::infinity();

 private:
    /// A tree over channel rectangles with thresholds for whole sums.
    struct RectangleTree {
        std::array<ChannelRectangle, 3> rectangle;
        std::array<std::uint16_t, 3> threshold{};
        std::array<std::int16_t, 4> leaf{};
        double least_sum = 0;  ///< leaf units
    };

    void scanShared(const cv::Mat& roi, double rejection_margin, cv::Mat& decision, ScanStatistics* statistics) const;
    void scanOneByOne(const cv::Mat& roi, cv::Mat& decision) const;

    VehicleModel model_;
    std::vector<RectangleTree> trees_;
};

}  // namespace eyrie

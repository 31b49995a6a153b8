#include "learning/models/window_scanner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "learning/models/window.h"
#include "learning/models/window_scan_kernel.h"

namespace eyrie {
namespace {

/// Sums are whole numbers, so that "at least t" means "at least the next whole number". Sums stay below 65535.
std::uint16_t wholeThreshold(float threshold) {
    return static_cast<std::uint16_t>(std::clamp(std::ceil(threshold), 0.F, 65535.F));
}

std::int32_t rejectionLine(double least_sum, double margin) {
    const double line = std::ceil(least_sum - margin * GentleAdaBoost::kLeafUnit);
    constexpr double lowest = std::numeric_limits<std::int32_t>::min();
    constexpr double highest = std::numeric_limits<std::int32_t>::max();
    return static_cast<std::int32_t>(std::clamp(line, lowest, highest));
}

}  // namespace

WindowScanner::WindowScanner(VehicleModel model) : model_(std::move(model)) {
    const auto* features = dynamic_cast<const ChannelFeatures*>(model_.descriptor.get());
    const auto* boosted = dynamic_cast<const GentleAdaBoost*>(model_.classifier.get());
    if (features == nullptr || boosted == nullptr) return;
    for (std::size_t t = 0; t < boosted->trees().size(); ++t) {
        const BoostedTree& tree = boosted->trees()[t];
        RectangleTree& own = trees_.emplace_back();
        for (std::size_t node = 0; node < 3; ++node) {
            own.rectangle[node] = features->rectangles()[static_cast<std::size_t>(tree.feature[node])];
            own.threshold[node] = wholeThreshold(tree.threshold[node]);
        }
        own.leaf = tree.leaf;
        own.least_sum = static_cast<double>(boosted->leastSums()[t]) * GentleAdaBoost::kLeafUnit;
    }
}

void WindowScanner::scan(const cv::Mat& roi, double rejection_margin, cv::Mat& decision,
                         ScanStatistics* statistics) const {
    CV_Assert(roi.type() == CV_8UC1);
    const int columns = roi.cols - kWindowWidth + 1;
    const int rows = roi.rows - kWindowHeight + 1;
    if (columns < 1 || rows < 1) {
        decision.release();
        return;
    }
    decision.create(rows, columns, CV_32FC1);
    if (fast()) {
        scanShared(roi, rejection_margin, decision, statistics);
    } else {
        scanOneByOne(roi, decision);
    }
    if (statistics != nullptr) statistics->windows += static_cast<std::int64_t>(rows) * columns;
}

void WindowScanner::scanShared(const cv::Mat& roi, double rejection_margin, cv::Mat& decision,
                               ScanStatistics* statistics) const {
    const IntegralChannels channels(roi);
    std::vector<ScanTree> trees;
    trees.reserve(trees_.size());
    for (const RectangleTree& tree : trees_) {
        ScanTree& scan = trees.emplace_back();
        for (std::size_t node = 0; node < 3; ++node) {
            const auto& [channel, area] = tree.rectangle[node];
            const int right = area.x + area.width;
            const int bottom = area.y + area.height;
            scan.offset[node] = {channels.offset(channel, area.x, area.y), channels.offset(channel, right, area.y),
                                 channels.offset(channel, area.x, bottom), channels.offset(channel, right, bottom)};
        }
        scan.threshold = tree.threshold;
        scan.leaf = tree.leaf;
        scan.rejection_line = rejectionLine(tree.least_sum, rejection_margin);
    }
    std::int64_t evaluated = 0;
    for (int y = 0; y < decision.rows; ++y) {
        evaluated += scanRow(channels.data() + channels.offset(0, 0, y), decision.cols, trees, decision.ptr<float>(y));
    }
    if (statistics != nullptr) statistics->trees += evaluated;
}

void WindowScanner::scanOneByOne(const cv::Mat& roi, cv::Mat& decision) const {
    for (int y = 0; y < decision.rows; ++y) {
        std::vector<cv::Mat> windows;
        for (int x = 0; x < decision.cols; ++x) windows.push_back(roi(cv::Rect(x, y, kWindowWidth, kWindowHeight)));
        const std::vector<double> values = model_.decideAll(windows);
        std::transform(values.begin(), values.end(), decision.ptr<float>(y),
                       [](double value) { return static_cast<float>(value); });
    }
}

}  // namespace eyrie

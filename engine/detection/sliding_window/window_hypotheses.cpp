#include "detection/sliding_window/window_hypotheses.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "learning/models/window.h"

namespace eyrie {
namespace {

constexpr double kLargestSide = 16384;  // px of a rescaled image

double overlapOf(const cv::Rect2d& a, const cv::Rect2d& b) {
    const double shared = (a & b).area();
    const double both = a.area() + b.area() - shared;
    return both > 0 ? shared / both : 0;
}

int sideOf(double length) {
    return static_cast<int>(std::clamp(std::round(length), 1.0, kLargestSide));
}

}  // namespace

std::vector<cv::Point> decisionPeaks(const cv::Mat& decision, double threshold) {
    CV_Assert(decision.empty() || decision.type() == CV_32FC1);
    std::vector<cv::Point> peaks;
    for (int y = 0; y < decision.rows; ++y) {
        for (int x = 0; x < decision.cols; ++x) {
            const float value = decision.at<float>(y, x);
            if (!(static_cast<double>(value) >= threshold)) continue;
            bool highest = true;
            for (int dy = -1; dy <= 1 && highest; ++dy) {
                for (int dx = -1; dx <= 1 && highest; ++dx) {
                    const int nx = x + dx;
                    const int ny = y + dy;
                    if ((dx == 0 && dy == 0) || nx < 0 || ny < 0 || nx >= decision.cols || ny >= decision.rows)
                        continue;
                    const float other = decision.at<float>(ny, nx);
                    const bool before = dy < 0 || (dy == 0 && dx < 0);
                    highest = before ? other < value : other <= value;
                }
            }
            if (highest) peaks.emplace_back(x, y);
        }
    }
    return peaks;
}

std::vector<WindowHypothesis> suppressOverlapping(std::vector<WindowHypothesis> hypotheses, double overlap_threshold) {
    std::stable_sort(hypotheses.begin(), hypotheses.end(),
                     [](const WindowHypothesis& a, const WindowHypothesis& b) { return a.decision > b.decision; });
    std::vector<WindowHypothesis> kept;
    for (const WindowHypothesis& hypothesis : hypotheses) {
        const bool free = std::none_of(kept.begin(), kept.end(), [&](const WindowHypothesis& stronger) {
            return overlapOf(stronger.box, hypothesis.box) > overlap_threshold;
        });
        if (free) kept.push_back(hypothesis);
    }
    return kept;
}

cv::Size rescaledSize(cv::Size image, double scale, const SlidingWindowOptions& options, const SceneScale& scene,
                      const WindowFit& fit) {
    const double width_scale = options.rescaling == WindowRescaling::joint_11 ? scale : 1;
    const double across = fit.width / (scene.px(options.car_width_m) * width_scale);
    const double along = fit.length / (scene.px(options.car_length_m) * scale);
    return {sideOf(image.width * across), sideOf(image.height * along)};
}

std::vector<WindowHypothesis> scanAtScale(const WindowScanner& scanner, const cv::Mat& upright, double scale,
                                          const SlidingWindowOptions& options, const SceneScale& scene,
                                          cv::Mat& decision) {
    const cv::Size size = rescaledSize(upright.size(), scale, options, scene, scanner.model().fit);
    const bool smaller = size.width <= upright.cols && size.height <= upright.rows;
    cv::Mat rescaled;
    cv::resize(upright, rescaled, size, 0, 0, smaller ? cv::INTER_AREA : cv::INTER_LINEAR);
    const bool all = options.rejection_margin >= SlidingWindowOptions::kNoRejection;
    scanner.scan(rescaled, all ? WindowScanner::kNothingRejected : options.rejection_margin, decision);
    const double x_factor = static_cast<double>(upright.cols) / size.width;
    const double y_factor = static_cast<double>(upright.rows) / size.height;
    std::vector<WindowHypothesis> found;
    for (const cv::Point& peak : decisionPeaks(decision, options.decision_threshold)) {
        WindowHypothesis hypothesis;
        const double width = scanner.model().fit.width * x_factor;
        const double length = scanner.model().fit.length * y_factor;
        hypothesis.box = {(peak.x + kWindowWidth / 2.0) * x_factor - 0.5 - width / 2,
                          (peak.y + kWindowHeight / 2.0) * y_factor - 0.5 - length / 2, width, length};
        hypothesis.decision = static_cast<double>(decision.at<float>(peak));
        hypothesis.scale = scale;
        found.push_back(hypothesis);
    }
    return found;
}

}  // namespace eyrie

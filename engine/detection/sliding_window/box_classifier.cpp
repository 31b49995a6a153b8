#include "detection/sliding_window/box_classifier.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "imaging/upright_patch.h"
#include "learning/models/window.h"

namespace eyrie {
namespace {

constexpr double kLooksPerSecond = 4;  ///< neighbouring frames tell the same
constexpr double kReach = 0.15;        ///< of the window's vehicle: boxes of segments are not exact
constexpr std::array<double, 3> kLengths{0.75, 1, 1.33};
/// Boxes of parts, and of vehicles that were joined, are taken for no smaller and no larger than this, of a car.
constexpr double kShortest = 0.5;
constexpr double kLongest = 2;
constexpr double kNarrowest = 0.6;
constexpr double kWidest = 1.6;

double between(double measured, double of_car, double least, double most) {
    return (std::clamp(measured, least * of_car, most * of_car) + of_car) / 2;
}

/// The middle of an upright patch, as large as the windows over it take, rescaled for them.
cv::Mat rescaledMiddle(const cv::Mat& patch, cv::Size2d extent, cv::Size windows) {
    const cv::Size taken(std::clamp(cvRound(extent.width), 1, patch.cols),
                         std::clamp(cvRound(extent.height), 1, patch.rows));
    const cv::Rect middle({(patch.cols - taken.width) / 2, (patch.rows - taken.height) / 2}, taken);
    const bool smaller = windows.width <= taken.width && windows.height <= taken.height;
    cv::Mat rescaled;
    cv::resize(patch(middle), rescaled, windows, 0, 0, smaller ? cv::INTER_AREA : cv::INTER_LINEAR);
    return rescaled;
}

}  // namespace

BoxClassifier::BoxClassifier(VehicleModel model, const SlidingWindowOptions& options, const SceneScale& scale)
    : scanner_(std::move(model)),
      options_(options),
      scale_(scale),
      every_(std::max(1, static_cast<int>(std::lround(scale.frame_rate_hz / kLooksPerSecond)))) {}

double BoxClassifier::at(const cv::Mat& gray, const OrientedBox& box, double zoom) const {
    const cv::Point centre(cvRound(box.centre.x), cvRound(box.centre.y));
    if (!cv::Rect({0, 0}, gray.size()).contains(centre)) return std::numeric_limits<double>::quiet_NaN();
    const SceneScale here = scale_.zoomed(zoom).at(box.centre);
    const double length = between(box.length, here.px(options_.car_length_m), kShortest, kLongest);
    const double width = between(box.width, here.px(options_.car_width_m), kNarrowest, kWidest);
    const WindowFit& fit = scanner_.model().fit;
    const cv::Size windows(kWindowWidth + 2 * static_cast<int>(std::ceil(kReach * fit.width)),
                           kWindowHeight + 2 * static_cast<int>(std::ceil(kReach * fit.length)));
    const cv::Size2d extent(windows.width * width / fit.width, windows.height * length / fit.length);
    const UprightPatch patch =
        cutUpright(gray, {box.centre, extent.height * kLengths.back(), extent.width, box.heading});
    double highest = -std::numeric_limits<double>::infinity();
    for (const double longer : kLengths) {
        cv::Mat decision;
        scanner_.scan(rescaledMiddle(patch.image, {extent.width, extent.height * longer}, windows),
                      WindowScanner::kNothingRejected, decision);
        double here_highest = 0;
        cv::minMaxLoc(decision, nullptr, &here_highest);
        highest = std::max(highest, here_highest);
    }
    return highest;
}

void BoxClassifier::judge(std::vector<Detection>& detections, const Frame& frame, double zoom) const {
    if (!looksAt(frame.index)) return;
    cv::parallel_for_(cv::Range(0, static_cast<int>(detections.size())), [&](const cv::Range& range) {
        for (int i = range.start; i < range.end; ++i) {
            Detection& detection = detections[static_cast<std::size_t>(i)];
            if (detection.rejection == Rejection::none) detection.decision = at(frame.gray, detection.box, zoom);
        }
    });
}

}  // namespace eyrie

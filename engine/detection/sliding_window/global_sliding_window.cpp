#include "detection/sliding_window/global_sliding_window.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>

#include "core/geometry/angle.h"
#include "detection/sliding_window/window_hypotheses.h"
#include "imaging/upright_patch.h"

namespace eyrie {
namespace {

/// The smallest area with this heading that holds the whole image.
OrientedBox wholeImage(cv::Size image, double heading) {
    OrientedBox area;
    area.centre = {(image.width - 1) / 2.0, (image.height - 1) / 2.0};
    area.heading = heading;
    const double along = std::abs(std::cos(heading));
    const double across = std::abs(std::sin(heading));
    area.length = image.width * along + image.height * across;
    area.width = image.width * across + image.height * along;
    return area;
}

std::vector<Detection> inDirection(const WindowScanner& scanner, const cv::Mat& gray,
                                   const SlidingWindowOptions& options, const SceneScale& scale, double heading) {
    const UprightPatch patch = cutUpright(gray, wholeImage(gray.size(), heading));
    std::vector<Detection> found;
    for (const double factor : options.scales()) {
        cv::Mat decision;
        for (const WindowHypothesis& hypothesis : scanAtScale(scanner, patch.image, factor, options, scale, decision)) {
            Detection detection;
            detection.box = boxInImage(patch.image_from_patch, hypothesis.box);
            detection.score = hypothesis.decision;
            if (areaInImage(detection.box, gray.size()) > detection.box.area() / 2) found.push_back(detection);
        }
    }
    return found;
}

}  // namespace

std::vector<Detection> globalSlidingWindow(const WindowScanner& scanner, const cv::Mat& gray,
                                           const SlidingWindowOptions& options, const SceneScale& scale,
                                           int orientations) {
    CV_Assert(gray.type() == CV_8UC1 && !gray.empty() && orientations >= 1);
    std::vector<std::vector<Detection>> by_direction(static_cast<std::size_t>(orientations));
    cv::parallel_for_(cv::Range(0, orientations), [&](const cv::Range& range) {
        for (int i = range.start; i < range.end; ++i) {
            const double heading = kPi / 2 - kPi * i / orientations;
            by_direction[static_cast<std::size_t>(i)] = inDirection(scanner, gray, options, scale, heading);
        }
    });
    std::vector<Detection> all;
    for (const auto& found : by_direction) all.insert(all.end(), found.begin(), found.end());
    std::stable_sort(all.begin(), all.end(), [](const Detection& a, const Detection& b) { return a.score > b.score; });
    std::vector<Detection> kept;
    for (const Detection& detection : all) {
        const bool free = std::none_of(kept.begin(), kept.end(), [&](const Detection& stronger) {
            return overlap(stronger.box, detection.box) > options.overlap_threshold;
        });
        if (free) kept.push_back(detection);
    }
    return kept;
}

}  // namespace eyrie

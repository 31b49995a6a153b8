#include "detection/sliding_window/sliding_window_detector.h"

#include <algorithm>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "core/error.h"
#include "detection/motion_cluster_detector.h"
#include "detection/segmenters/component_boxes.h"
#include "detection/sliding_window/model_location.h"
#include "imaging/upright_patch.h"
#include "learning/models/window.h"

namespace eyrie {
namespace {

constexpr double kLowestDecision = -1000;  ///< the lowest threshold there can be

/// Peaks of the decision functions of all scales, in their order.
class DecisionPeaks : public PreparedArea {
 public:
    std::size_t bytes() const override { return hypotheses.capacity() * sizeof(WindowHypothesis) + sizeof *this; }
    std::vector<WindowHypothesis> hypotheses;
};

constexpr double kNoDecision = -1e30;  ///< below: windows that were given up early

/// The highest decision value that a window got in full; nothing where no window fits and where all were given up.
std::optional<double> largestOf(const std::vector<cv::Mat>& decisions) {
    std::optional<double> largest;
    for (const cv::Mat& decision : decisions) {
        double here = kNoDecision;
        if (!decision.empty()) cv::minMaxLoc(decision, nullptr, &here);
        if (here > largest.value_or(kNoDecision)) largest = here;
    }
    return largest;
}

/// The decision function laid over the search area, each value at its window's centre.
cv::Mat overArea(const cv::Mat& decision, cv::Size rescaled, cv::Size area) {
    double lowest = 0;
    cv::Mat shown = decision.clone();
    if (!decision.empty()) {
        shown.setTo(0, decision < kNoDecision);  // given up early
        cv::minMaxLoc(shown, &lowest);
        shown.setTo(lowest, decision < kNoDecision);
    }
    cv::Mat whole(rescaled, CV_32FC1, cv::Scalar(lowest));
    if (!decision.empty()) {
        shown.copyTo(whole(cv::Rect({kWindowWidth / 2 - 1, kWindowHeight / 2 - 1}, decision.size())));
    }
    cv::Mat resized;
    cv::resize(whole, resized, area, 0, 0, cv::INTER_LINEAR);
    return resized;
}

/// Whether the middle of a window shows something.
bool inVideo(const MotionRoi& roi, const WindowHypothesis& found) {
    const cv::Point centre(cvRound(found.box.x + found.box.width / 2), cvRound(found.box.y + found.box.height / 2));
    return cv::Rect({0, 0}, roi.inside.size()).contains(centre) && roi.inside.at<uchar>(centre) != 0;
}

std::vector<cv::Rect2d> boxesOf(const std::vector<WindowHypothesis>& hypotheses) {
    std::vector<cv::Rect2d> boxes;
    for (const WindowHypothesis& hypothesis : hypotheses) boxes.push_back(hypothesis.box);
    return boxes;
}

}  // namespace

SlidingWindowDetector::SlidingWindowDetector(VehicleModel model, const SlidingWindowOptions& options,
                                             const SceneScale& scale, double cluster_margin)
    : scanner_(std::move(model)), options_(options), scale_(scale), cluster_margin_(cluster_margin) {}

bool SlidingWindowDetector::accepted(const MotionRoi& roi, const WindowHypothesis& found) const {
    if (!inVideo(roi, found)) return false;
    return !options_.need_support || supportOf(found.box, roi.vectors, options_.support_share).enough();
}

std::unique_ptr<const PreparedArea> SlidingWindowDetector::prepare(const MotionRoi& roi) const {
    if (roi.image.empty()) return nullptr;
    auto peaks = std::make_unique<DecisionPeaks>();
    SlidingWindowOptions lowest = options_;
    lowest.decision_threshold = kLowestDecision;
    for (const double scale : options_.scales()) {
        cv::Mat decision;
        for (const WindowHypothesis& found : scanAtScale(scanner_, roi.image, scale, lowest, scale_, decision))
            peaks->hypotheses.push_back(found);
    }
    peaks->hypotheses.shrink_to_fit();
    return peaks;
}

std::vector<Detection> SlidingWindowDetector::decide(const MotionRoi& roi, const PreparedArea* prepared) const {
    const auto* peaks = dynamic_cast<const DecisionPeaks*>(prepared);
    if (peaks == nullptr) return detect(roi);
    std::vector<WindowHypothesis> hypotheses;
    for (const WindowHypothesis& found : peaks->hypotheses) {
        if (found.decision >= options_.decision_threshold && accepted(roi, found)) hypotheses.push_back(found);
    }
    return detectionsOf(roi, suppressOverlapping(std::move(hypotheses), options_.overlap_threshold));
}

std::vector<Detection> SlidingWindowDetector::detect(const MotionRoi& roi, DetectionTrace* trace) const {
    if (trace != nullptr) trace->add(TraceLayer::raw, roi.image);
    if (roi.image.empty()) return {};
    std::vector<WindowHypothesis> hypotheses;
    std::vector<cv::Mat> decisions;
    for (const double scale : options_.scales()) {
        cv::Mat& decision = decisions.emplace_back();
        for (const WindowHypothesis& found : scanAtScale(scanner_, roi.image, scale, options_, scale_, decision)) {
            if (accepted(roi, found)) hypotheses.push_back(found);
            if (trace != nullptr && options_.need_support && inVideo(roi, found)) {
                const BoxSupport support = supportOf(found.box, roi.vectors, options_.support_share);
                trace->checks.push_back({"motion vectors in a window", "sliding_window.support_share", support.inside,
                                         support.needed, false, support.enough(), found.box});
            }
        }
        if (trace != nullptr) {
            const cv::Size rescaled = rescaledSize(roi.image.size(), scale, options_, scale_, scanner_.model().fit);
            trace->addDecision(scale, overArea(decision, rescaled, roi.image.size()));
        }
    }
    if (const auto best = trace != nullptr ? largestOf(decisions) : std::nullopt) {
        trace->checks.insert(trace->checks.begin(),
                             {"decision value of the best window", "sliding_window.decision_threshold", *best,
                              options_.decision_threshold, false, *best >= options_.decision_threshold});
    }
    if (trace != nullptr) trace->add(TraceLayer::first_suppression, roi.image, boxesOf(hypotheses));
    hypotheses = suppressOverlapping(std::move(hypotheses), options_.overlap_threshold);
    if (trace != nullptr) trace->add(TraceLayer::second_suppression, roi.image, boxesOf(hypotheses));
    return detectionsOf(roi, hypotheses);
}

std::vector<Detection> SlidingWindowDetector::detectionsOf(const MotionRoi& roi,
                                                           const std::vector<WindowHypothesis>& hypotheses) const {
    std::vector<Detection> detections;
    for (const WindowHypothesis& hypothesis : hypotheses) {
        Detection detection;
        detection.box = boxInImage(roi.image_from_roi, hypothesis.box);
        detection.score = hypothesis.decision;
        detection.complete = true;
        detection.velocity = roi.velocity;
        detection.cluster = roi.cluster;
        detections.push_back(detection);
    }
    if (detections.empty() && options_.fall_back) return clusterDetection(roi, cluster_margin_);
    return detections;
}

std::unique_ptr<Detector> makeSlidingWindowDetector(const SlidingWindowOptions& options, const SceneScale& scale,
                                                    double cluster_margin) {
    const std::filesystem::path file = modelLocation(options.model);
    VehicleModel model = loadModel(file);
    if (!options.descriptor.empty() && descriptorFromName(options.descriptor) != model.descriptor->kind()) {
        throw Error(ErrorKind::parameter,
                    file.string() + ": this model was trained for the descriptor " + nameOf(model.descriptor->kind()) +
                        ", but sliding_window.descriptor asks for " + options.descriptor +
                        "; name a model of that descriptor in sliding_window.model, or leave the parameter empty");
    }
    return std::make_unique<SlidingWindowDetector>(std::move(model), options, scale, cluster_margin);
}

}  // namespace eyrie

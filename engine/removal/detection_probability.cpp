#include "removal/detection_probability.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/flow_limits.h"

namespace eyrie {
namespace {

constexpr double kMostDecision = 3;  ///< of the classifier
constexpr double kMostSupport = 3;   ///< vectors per vector expected

constexpr std::size_t kDetectionFigures = 9;
/// As tests/learn_track_score prints them.
constexpr std::array<double, kDetectionFigures> kDetectionWeights{-4.776, 1.027, 0.342, -0.127, 2.203,
                                                                  -1.546, 0.867, 1.394, 2.137};

std::array<double, kDetectionFigures> figuresOf(const Detection& detection, const Homography& map) {
    const cv::Point2d at = detection.box.centre;
    const cv::Point2d ground = map.apply(at) - at;
    const double ground_length = std::hypot(ground.x, ground.y);
    const double own = std::hypot(detection.velocity.x, detection.velocity.y);
    const double ratio = own / (ground_length + kFlowNoise);
    const double cosine = detection.velocity.dot(ground) / std::max(own * ground_length, 1e-6);
    const double flow = std::log1p(std::min(ground_length, kMostFlow));
    const double whole = detection.complete ? 1 : 0;
    const double against = ratio < kSticksRatio ? std::clamp(-cosine, 0.0, 1.0) : 0;
    return {1,
            whole,
            whole * std::clamp(detection.score, 0.0, kMostDecision),
            (1 - whole) * std::clamp(detection.score, 0.0, kMostSupport),
            std::log1p(static_cast<double>(detection.vectors.size())),
            flow,
            flow * against,
            flow * std::min(ratio, kMostFlowRatio),
            flow * whole};
}

}  // namespace

void judgeDetections(std::vector<Detection>& detections, const FrameMotion& motion) {
    for (Detection& detection : detections) {
        if (detection.rejection != Rejection::none) continue;
        const auto figures = figuresOf(detection, motion.registration.current_from_previous);
        double sum = 0;
        for (std::size_t i = 0; i < kDetectionFigures; ++i) sum += kDetectionWeights[i] * figures[i];
        const double probability = 1 / (1 + std::exp(-sum));
        if (std::isfinite(probability)) detection.probability = probability;
    }
}

}  // namespace eyrie

#include "detection/sliding_window/scale_votes.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <utility>

#include "detection/sliding_window/model_location.h"
#include "detection/sliding_window/window_hypotheses.h"
#include "imaging/upright_patch.h"

namespace eyrie {
namespace {

constexpr double kLookStep = 1.12;      ///< from one scale to the next
constexpr double kReachLengths = 1.9;   ///< of the searched area, in car lengths …
constexpr double kReachWidths = 2.6;    ///< … and widths: the place is that of its vectors, not its middle
constexpr double kSureVote = 5;         ///< decision value from which a window is believed
constexpr double kSmallestCarPx = 8;    ///< length below which every dot looks like a car
constexpr double kHeld = 0.7;           ///< share of the motion vectors that a window must hold
constexpr double kLeastFilled = 0.5;    ///< of the window's length that they spread over, at least …
constexpr double kMostFilled = 1.3;     ///< … and at most, and of its width
constexpr double kInPicture = 0.8;      ///< share of the searched area
constexpr double kNotLooked = -1000;
constexpr double kFarBelow = 4;         ///< decision value that stands for none beside the best

/// Where a parabola through three neighbours has its top, in steps from the middle one.
double topOf(double before, double middle, double after) {
    const double bend = before - 2 * middle + after;
    return bend < 0 ? std::clamp((before - after) / (2 * bend), -0.5, 0.5) : 0;
}

}  // namespace

ScaleLooker::ScaleLooker(const SlidingWindowOptions& options)
    : options_(options), scanner_(loadModel(modelLocation(options.model))) {}

double ScaleLooker::decisionAt(const cv::Mat& gray, const OrientedBox& moving, const std::vector<cv::Point2f>& vectors,
                               const SceneScale& scale) const {
    const double length = scale.px(options_.car_length_m);
    const double width = scale.px(options_.car_width_m);
    if (length < kSmallestCarPx || moving.length < kLeastFilled * length || moving.length > kMostFilled * length ||
        moving.width > kMostFilled * width + 1)
        return kNotLooked;
    OrientedBox area = moving;
    area.length = length * kReachLengths;
    area.width = width * kReachWidths;
    if (areaInImage(area, gray.size()) < kInPicture * area.area()) return kNotLooked;
    const UprightPatch patch = cutUpright(gray, area);
    std::vector<cv::Point2d> places;
    for (const cv::Point2f& vector : vectors) places.push_back(toPatch(patch.image_from_patch, vector));
    SlidingWindowOptions looking = options_;
    looking.decision_threshold = kSureVote;
    cv::Mat decision;
    double best = kNotLooked;
    for (const WindowHypothesis& found : scanAtScale(scanner_, patch.image, 1, looking, scale, decision)) {
        const cv::Rect2d box(found.box.x - 1, found.box.y - 1, found.box.width + 2, found.box.height + 2);
        const auto inside = std::count_if(places.begin(), places.end(), [&](cv::Point2d p) { return box.contains(p); });
        if (static_cast<double>(inside) < kHeld * static_cast<double>(places.size())) continue;
        best = std::max(best, found.decision);
    }
    return best;
}

std::optional<ScaleVote> ScaleLooker::voteOn(const cv::Mat& gray, const OrientedBox& moving,
                                             const std::vector<cv::Point2f>& vectors, const ScaleRange& range) const {
    std::vector<double> scales;
    std::vector<double> decisions;
    for (double gsd = range.finest_m_per_px; gsd <= range.coarsest_m_per_px; gsd *= kLookStep) {
        SceneScale scale;
        scale.gsd_m_per_px = gsd;
        scales.push_back(gsd);
        decisions.push_back(decisionAt(gray, moving, vectors, scale));
    }
    if (decisions.size() < 3) return std::nullopt;
    const auto best = std::max_element(decisions.begin() + 1, decisions.end() - 1);
    if (*best < kSureVote || *best < decisions.front() || *best < decisions.back()) return std::nullopt;
    const auto at = static_cast<std::size_t>(best - decisions.begin());
    ScaleVote vote;
    vote.place = moving.centre;
    vote.decision = *best;
    // Neighbours that were not looked at, or in which nothing was found, say nothing of where the top lies.
    const double before = std::max(decisions[at - 1], *best - kFarBelow);
    const double after = std::max(decisions[at + 1], *best - kFarBelow);
    vote.gsd_m_per_px = scales[at] * std::pow(kLookStep, topOf(before, *best, after));
    return vote;
}

}  // namespace eyrie

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
constexpr double kAroundLengths = 1.3;  ///< of the searched area beyond what moves, in car lengths …
constexpr double kAroundWidths = 1.6;   ///< … and widths: vectors lie on outlines, if not on one end only
constexpr double kSureVote = 6;         ///< decision value from which a window is believed
constexpr double kSmallestCarPx = 8;    ///< length below which every dot looks like a car
constexpr double kLongestCarPx = 250;   ///< and above which nothing is looked for
constexpr std::size_t kFewestHeld = 4;  ///< motion vectors in a window
constexpr double kFilledAlong = 0.6;    ///< of the window's length that they spread over …
constexpr double kFilledAcross = 0.45;  ///< … and of its width
constexpr double kBeyond = 0.15;        ///< of its sides to every side of a window, where …
constexpr double kHeldShare = 0.8;      ///< … few vectors lie: it is no part of something larger
constexpr double kOnePlace = 0.3;       ///< share of the smaller of two windows that lie on one place
constexpr double kMargin = 1;           ///< px: corners lie beside the edges they belong to

struct Hypothesis {
    cv::Rect2d box;  ///< px, in the frame of the searched thing: motion up, its middle at the origin
    double gsd_m_per_px;
    double decision;
};

bool isFilled(const cv::Rect2d& box, const std::vector<cv::Point2d>& places) {
    const cv::Rect2d around(box.x - kMargin, box.y - kMargin, box.width + 2 * kMargin, box.height + 2 * kMargin);
    const cv::Rect2d surroundings(around.x - kBeyond * box.width, around.y - kBeyond * box.height,
                                  around.width + 2 * kBeyond * box.width, around.height + 2 * kBeyond * box.height);
    std::size_t held = 0;
    std::size_t near = 0;
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    for (const cv::Point2d& place : places) {
        near += surroundings.contains(place);
        if (!around.contains(place)) continue;
        ++held;
        left = std::min(left, place.x);
        right = std::max(right, place.x);
        top = std::min(top, place.y);
        bottom = std::max(bottom, place.y);
    }
    return held >= kFewestHeld && static_cast<double>(held) >= kHeldShare * static_cast<double>(near) &&
           bottom - top >= kFilledAlong * box.height && right - left >= kFilledAcross * box.width;
}

bool onOnePlace(const cv::Rect2d& a, const cv::Rect2d& b) {
    return (a & b).area() > kOnePlace * std::min(a.area(), b.area());
}

}  // namespace

ScaleLooker::ScaleLooker(const SlidingWindowOptions& options)
    : options_(options), scanner_(loadModel(modelLocation(options.model))) {}

std::vector<ScaleVote> ScaleLooker::votesOn(const cv::Mat& gray, const OrientedBox& moving,
                                            const std::vector<cv::Point2f>& vectors, const ScaleRange& range) const {
    std::vector<cv::Point2d> places;
    for (const cv::Point2f& vector : vectors) {
        const cv::Point2d in_box = moving.toBox(vector);  // x ahead, y to the right
        places.emplace_back(in_box.y, -in_box.x);
    }
    SlidingWindowOptions looking = options_;
    looking.decision_threshold = kSureVote;
    std::vector<Hypothesis> found;
    for (double gsd = range.finest_m_per_px; gsd <= range.coarsest_m_per_px; gsd *= kLookStep) {
        SceneScale scale;
        scale.gsd_m_per_px = gsd;
        const double length = scale.px(options_.car_length_m);
        if (length < kSmallestCarPx || length > kLongestCarPx || length > moving.length / kFilledAlong) continue;
        OrientedBox area = moving;
        area.length += kAroundLengths * length;
        area.width += kAroundWidths * scale.px(options_.car_width_m);
        const UprightPatch patch = cutUpright(gray, area);
        const cv::Point2d middle = toPatch(patch.image_from_patch, moving.centre);
        cv::Mat decision;
        for (const WindowHypothesis& window : scanAtScale(scanner_, patch.image, 1, looking, scale, decision)) {
            const cv::Rect2d box(window.box.x - middle.x, window.box.y - middle.y, window.box.width, window.box.height);
            if (isFilled(box, places)) found.push_back({box, gsd, window.decision});
        }
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Hypothesis& a, const Hypothesis& b) { return a.decision > b.decision; });
    std::vector<Hypothesis> kept;
    std::vector<ScaleVote> votes;
    for (const Hypothesis& candidate : found) {
        const bool taken = std::any_of(kept.begin(), kept.end(),
                                       [&](const Hypothesis& other) { return onOnePlace(other.box, candidate.box); });
        if (taken) continue;
        kept.push_back(candidate);
        const cv::Point2d centre(candidate.box.x + candidate.box.width / 2, candidate.box.y + candidate.box.height / 2);
        votes.push_back({moving.toImage({-centre.y, centre.x}), candidate.gsd_m_per_px, candidate.decision});
    }
    return votes;
}

}  // namespace eyrie

#include "ground/track_looks.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "core/robust_statistics.h"
#include "learning/descriptors/hog_descriptor.h"

namespace eyrie {
namespace {

constexpr int kGlances = 3;                 ///< of each track
constexpr std::size_t kMostLookedAt = 400;  ///< to read, unless short tracks need more
constexpr FrameIndex kLeastGrid = 8;        ///< frames: tracks are looked at in frames that divide by it
constexpr FrameIndex kMostGrid = 4096;
const cv::Size kLookWindow(16, 32);  ///< as the descriptor wants it, heading up
constexpr double kLookFill = 0.75;   ///< of the window, by the box; the ground around it is the rest
constexpr double kColourWeight = 4;
constexpr double kGradientSpread = 0.3;
constexpr double kChromaGain = 2;  ///< colours of vehicles lie near grey

using Histogram = std::array<double, TrackLook::kBins>;

/// The box of a track in a frame; null where it has none.
const TrackedBox* boxIn(const EventTrack& track, FrameIndex frame) {
    const auto found = std::lower_bound(track.boxes.begin(), track.boxes.end(), frame,
                                        [](const TrackedBox& box, FrameIndex wanted) { return box.frame < wanted; });
    return found != track.boxes.end() && found->frame == frame ? &*found : nullptr;
}

/// Boxes spread over the life of a track, in frames that divide by `grid`; one in the middle where it has none there.
std::vector<const TrackedBox*> chosenBoxes(const EventTrack& track, FrameIndex grid) {
    std::vector<const TrackedBox*> chosen;
    for (std::size_t k = 1; k <= kGlances && !track.boxes.empty(); ++k) {
        const FrameIndex wanted = track.boxes[track.boxes.size() * k / (kGlances + 1)].frame;
        const TrackedBox* box = boxIn(track, (wanted + grid / 2) / grid * grid);
        if (box != nullptr && (chosen.empty() || chosen.back() != box)) chosen.push_back(box);
    }
    if (chosen.empty() && !track.boxes.empty()) chosen.push_back(&track.boxes[track.boxes.size() / 2]);
    return chosen;
}

cv::Matx23d imageFromWindow(const OrientedBox& box) {
    const double across = box.width / (kLookFill * kLookWindow.width);
    const double along = box.length / (kLookFill * kLookWindow.height);
    const double c = std::cos(box.heading), s = std::sin(box.heading);
    const cv::Point2d middle((kLookWindow.width - 1) / 2.0, (kLookWindow.height - 1) / 2.0);
    return {-s * across, -c * along, box.centre.x + s * across * middle.x + c * along * middle.y,
            c * across,  -s * along, box.centre.y - c * across * middle.x + s * along * middle.y};
}

cv::Mat windowOf(const cv::Mat& picture, const OrientedBox& box) {
    cv::Mat window;
    cv::warpAffine(picture, window, imageFromWindow(box), kLookWindow, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                   cv::BORDER_REPLICATE);
    return window;
}

/// 0 … 255, shared between the two nearest bins.
void countInto(Histogram& histogram, double value) {
    const double at = std::clamp(value / 256 * TrackLook::kBins - 0.5, 0.0, TrackLook::kBins - 1.0);
    const auto lower = static_cast<std::size_t>(at);
    const double share = at - static_cast<double>(lower);
    histogram.at(lower) += 1 - share;
    if (share > 0) histogram.at(lower + 1) += share;
}

void addColours(const cv::Mat& window, TrackLook& look) {
    cv::Mat lab;
    cv::cvtColor(window, lab, cv::COLOR_BGR2Lab);
    const cv::Size inner(cvRound(kLookWindow.width * kLookFill), cvRound(kLookWindow.height * kLookFill));
    const cv::Rect box((kLookWindow.width - inner.width) / 2, (kLookWindow.height - inner.height) / 2, inner.width,
                       inner.height);
    std::vector<double> around;
    for (int y = 0; y < lab.rows; ++y)
        for (int x = 0; x < lab.cols; ++x)
            if (!box.contains({x, y})) around.push_back(lab.at<cv::Vec3b>(y, x)[0]);
    const double ground = medianOf(std::move(around));
    for (int y = box.y; y < box.y + box.height; ++y) {
        for (int x = box.x; x < box.x + box.width; ++x) {
            const cv::Vec3b& pixel = lab.at<cv::Vec3b>(y, x);
            countInto(look.colours[0], 128 + pixel[0] - ground);
            countInto(look.colours[1], 128 + (pixel[1] - 128) * kChromaGain);
            countInto(look.colours[2], 128 + (pixel[2] - 128) * kChromaGain);
        }
    }
}

void addGradients(const cv::Mat& window, TrackLook& look) {
    const HogDescriptor descriptor;
    std::vector<float> values(static_cast<std::size_t>(descriptor.dimension()));
    descriptor.compute(window, values);
    look.gradients.resize(values.size(), 0);
    for (std::size_t i = 0; i < values.size(); ++i) look.gradients[i] += values[i];
}

double overlapOf(const Histogram& a, const Histogram& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::sqrt(a.at(i) * b.at(i));
    return std::min(sum, 1.0);
}

}  // namespace

double lookLikeness(const TrackLook& a, const TrackLook& b) {
    double apart = 0;
    for (std::size_t i = 0; i < a.colours.size(); ++i) apart += 1 - overlapOf(a.colours.at(i), b.colours.at(i));
    if (a.gradients.size() != b.gradients.size()) return 0;
    const double cosine =
        std::inner_product(a.gradients.begin(), a.gradients.end(), b.gradients.begin(), 0.0);  // both of length 1
    const double turned = std::max(0.0, 1 - cosine) / kGradientSpread;
    return std::sqrt(std::exp(-kColourWeight * apart) * std::exp(-0.5 * turned * turned));
}

LookTaker::LookTaker(const std::vector<EventTrack>& tracks) {
    for (FrameIndex grid = kLeastGrid; grid <= kMostGrid; grid *= 2) {
        std::map<FrameIndex, std::vector<Glance>> glances;
        for (const EventTrack& track : tracks)
            for (const TrackedBox* box : chosenBoxes(track, grid)) glances[box->frame].push_back({track.id, box->box});
        // Beyond some grid tracks fall between its frames and need their own.
        if (grid == kLeastGrid || glances.size() < glances_.size()) glances_ = std::move(glances);
        if (glances_.size() <= kMostLookedAt) return;
    }
}

std::vector<FrameIndex> LookTaker::frames() const {
    std::vector<FrameIndex> frames;
    frames.reserve(glances_.size());
    for (const auto& [frame, glances] : glances_) frames.push_back(frame);
    return frames;
}

void LookTaker::look(const Frame& frame) {
    const auto found = glances_.find(frame.index);
    if (found == glances_.end() || frame.gray.empty()) return;
    for (const Glance& glance : found->second) glanceAt(frame, glance);
}

void LookTaker::glanceAt(const Frame& frame, const Glance& glance) {
    const cv::Point2d at = glance.box.centre;
    const bool seen = at.x >= 0 && at.y >= 0 && at.x < frame.gray.cols && at.y < frame.gray.rows;
    if (!seen || !(glance.box.length > 0 && glance.box.width > 0)) return;
    TrackLook& look = sums_[glance.track];
    addGradients(windowOf(frame.gray, glance.box), look);
    cv::Mat coloured = windowOf(frame.colour.empty() ? frame.gray : frame.colour, glance.box);
    if (coloured.channels() == 1) cv::cvtColor(coloured, coloured, cv::COLOR_GRAY2BGR);
    addColours(coloured, look);
}

LooksByTrack LookTaker::looks() const {
    LooksByTrack looks = sums_;
    for (auto& [track, look] : looks) {
        for (Histogram& histogram : look.colours) {
            const double sum = std::accumulate(histogram.begin(), histogram.end(), 0.0);
            for (double& share : histogram) share /= sum > 0 ? sum : 1;
        }
        const double length =
            std::sqrt(std::inner_product(look.gradients.begin(), look.gradients.end(), look.gradients.begin(), 0.0));
        for (float& value : look.gradients) value = static_cast<float>(value / (length > 0 ? length : 1));
    }
    return looks;
}

}  // namespace eyrie

#include "tracking/appearance.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "imaging/upright_patch.h"

namespace eyrie {
namespace {

constexpr double kContrast = 5;     ///< grey levels, deviation of a chip that can be recognised
constexpr double kLargestZoom = 2;  ///< between remembering and finding
constexpr int kSmallestChip = 4;    ///< px
constexpr double kLargestReach = 64;

double contrast(const cv::Mat& chip) {
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(chip, mean, deviation);
    return deviation[0];
}

/// Where the top of a parabola through three neighbours lies, −0.5 … 0.5.
double topOf(double before, double at, double after) {
    const double bend = before - 2 * at + after;
    return bend < 0 ? std::clamp((before - after) / (2 * bend), -0.5, 0.5) : 0;
}

cv::Point2d peakAround(const cv::Mat1f& scores, cv::Point best) {
    cv::Point2d peak(best);
    if (best.x > 0 && best.x + 1 < scores.cols)
        peak.x += topOf(scores(best.y, best.x - 1), scores(best), scores(best.y, best.x + 1));
    if (best.y > 0 && best.y + 1 < scores.rows)
        peak.y += topOf(scores(best.y - 1, best.x), scores(best), scores(best.y + 1, best.x));
    return peak;
}

bool whole(const UprightPatch& patch) {
    return cv::countNonZero(patch.inside) == static_cast<int>(patch.inside.total());
}

}  // namespace

void AppearanceMemory::remember(TrackId track, const cv::Mat& gray, const OrientedBox& box) {
    if (gray.empty() || !(std::min(box.length, box.width) >= kSmallestChip)) return;
    if (areaInImage(box, gray.size()) < 0.999 * box.area()) return;
    UprightPatch patch = cutUpright(gray, box);
    if (!whole(patch) || contrast(patch.image) < kContrast) return;
    templates_[track] = {std::move(patch.image), box};
}

std::optional<OrientedBox> AppearanceMemory::find(TrackId track, const cv::Mat& gray, const OrientedBox& expected,
                                                  double reach) const {
    const auto known = templates_.find(track);
    if (known == templates_.end() || gray.empty()) return std::nullopt;
    const double zoom = std::sqrt(expected.area() / known->second.box.area());
    if (!(zoom < kLargestZoom && zoom * kLargestZoom > 1)) return std::nullopt;
    cv::Mat chip = known->second.chip;
    const cv::Size size(std::max(kSmallestChip, cvRound(chip.cols * zoom)),
                        std::max(kSmallestChip, cvRound(chip.rows * zoom)));
    if (size != chip.size()) cv::resize(chip, chip, size, 0, 0, zoom < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);

    const int margin = std::max(1, static_cast<int>(std::ceil(std::clamp(reach, 1.0, kLargestReach))));
    const OrientedBox searched{expected.centre, double(size.height + 2 * margin), double(size.width + 2 * margin),
                               expected.heading};
    const UprightPatch area = cutUpright(gray, searched);
    if (!whole(area)) return std::nullopt;
    cv::Mat1f scores;
    cv::matchTemplate(area.image, chip, scores, cv::TM_CCOEFF_NORMED);
    double best = 0;
    cv::Point place;
    cv::minMaxLoc(scores, nullptr, &best, nullptr, &place);
    if (!(best >= agreement_) || contrast(area.image(cv::Rect(place, size))) < kContrast) return std::nullopt;
    const cv::Point2d middle((size.width - 1) / 2.0, (size.height - 1) / 2.0);
    OrientedBox found = expected;
    found.centre = toImage(area.image_from_patch, peakAround(scores, place) + middle);
    return found;
}

}  // namespace eyrie

#include "motion/moving_areas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "core/corner_density.h"
#include "motion/area_matching.h"

namespace eyrie {
namespace {

constexpr CornerId kFirstInferred = CornerId{1} << 41;  ///< far above any corner's and any silhouette's
constexpr double kVectorSpacing = 0.6;                  ///< m between inferred vectors …
constexpr double kVectorSpacingPx = 2;                  ///< … px at least
constexpr int kAround = 2;            ///< px that an area grows by before it is looked for: outlines tell most
constexpr int kPictureMargin = 4;     ///< px; interpolation and blur at the edge of a picture answer to nothing
constexpr double kMaxSpeed = 40;      ///< m/s
constexpr int kLongestReach = 40;     ///< px
constexpr int kReturnReach = 2;       ///< px by which the way back may differ from the way on
constexpr std::size_t kEnough = 3;    ///< vectors with which a vehicle needs no more
constexpr double kAlike = 0.3;        ///< difference of velocities, as a share of the speed …
constexpr double kAlikePx = 0.4;      ///< … and px/frame

cv::Mat smoothed(const cv::Mat& gray) {
    cv::Mat smooth;
    cv::GaussianBlur(gray, smooth, {5, 5}, 1.0);
    return smooth;
}

/// Robust deviation of differences: median / 0.6745, since most of the picture stands still.
double noiseOf(const cv::Mat& difference) {
    constexpr double kMedianOfAbsoluteNormal = 0.6745;
    std::array<int, 256> histogram{};
    int count = 0;
    for (int y = 0; y < difference.rows; y += 4) {
        const uchar* row = difference.ptr<uchar>(y);
        for (int x = 0; x < difference.cols; ++x) ++histogram[row[x]];
        count += difference.cols;
    }
    // Within its bin the median lies where the count says.
    int below = 0;
    for (std::size_t value = 0; value < histogram.size(); ++value) {
        if (below + histogram[value] >= count / 2)
            return (static_cast<double>(value) - 0.5 + (count / 2.0 - below) / std::max(1, histogram[value])) /
                   kMedianOfAbsoluteNormal;
        below += histogram[value];
    }
    return 0;
}

/// What the picture shows, in another's coordinates, without its margin.
void leaveOutBeyond(cv::Mat& binary, const Homography& to_it, cv::Size size) {
    const double m = kPictureMargin;
    std::vector<cv::Point> corners;
    for (const cv::Point2d& corner : {cv::Point2d(m, m), cv::Point2d(size.width - 1 - m, m),
                                      cv::Point2d(size.width - 1 - m, size.height - 1 - m),
                                      cv::Point2d(m, size.height - 1 - m)}) {
        const cv::Point2d at = to_it.apply(corner);
        corners.emplace_back(cvRound(std::clamp(at.x, -1e6, 1e6)), cvRound(std::clamp(at.y, -1e6, 1e6)));
    }
    cv::Mat inside = cv::Mat::zeros(binary.size(), CV_8UC1);
    cv::fillConvexPoly(inside, corners, cv::Scalar(255));
    binary &= inside;
}

struct Area {
    std::vector<cv::Point> pixels;
    cv::Rect bounds;
};

std::vector<Area> areasOf(const cv::Mat& binary, int fewest_pixels, double longest) {
    cv::Mat labels;
    cv::Mat stats;
    cv::Mat centroids;
    const int count = cv::connectedComponentsWithStats(binary, labels, stats, centroids, 8, CV_32S);
    std::vector<Area> areas;
    for (int label = 1; label < count; ++label) {
        const cv::Rect bounds(stats.at<int>(label, cv::CC_STAT_LEFT), stats.at<int>(label, cv::CC_STAT_TOP),
                              stats.at<int>(label, cv::CC_STAT_WIDTH), stats.at<int>(label, cv::CC_STAT_HEIGHT));
        if (stats.at<int>(label, cv::CC_STAT_AREA) < fewest_pixels) continue;
        if (std::hypot(bounds.width, bounds.height) > longest) continue;
        Area area;
        area.bounds = bounds;
        for (int y = bounds.y; y < bounds.br().y; ++y) {
            for (int x = bounds.x; x < bounds.br().x; ++x) {
                if (labels.at<int>(y, x) == label) area.pixels.emplace_back(x, y);
            }
        }
        areas.push_back(std::move(area));
    }
    return areas;
}

std::vector<cv::Point> grown(const Area& area, cv::Size size) {
    const cv::Rect bounds = cv::Rect(area.bounds.x - kAround, area.bounds.y - kAround, area.bounds.width + 2 * kAround,
                                     area.bounds.height + 2 * kAround) &
                            cv::Rect({0, 0}, size);
    cv::Mat1b mask = cv::Mat1b::zeros(bounds.size());
    for (const cv::Point& p : area.pixels) mask(p - bounds.tl()) = 255;
    cv::dilate(mask, mask, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * kAround + 1, 2 * kAround + 1}));
    std::vector<cv::Point> pixels;
    for (int y = 0; y < mask.rows; ++y) {
        for (int x = 0; x < mask.cols; ++x) {
            if (mask(y, x) != 0) pixels.push_back(bounds.tl() + cv::Point(x, y));
        }
    }
    return pixels;
}

/// Places among the pixels, at least so far apart.
std::vector<cv::Point> spread(const Area& area, double spacing) {
    std::vector<cv::Point> chosen;
    for (const cv::Point& p : area.pixels) {
        const bool free = std::none_of(chosen.begin(), chosen.end(), [&](const cv::Point& other) {
            return std::hypot(p.x - other.x, p.y - other.y) < spacing;
        });
        if (free) chosen.push_back(p);
    }
    return chosen;
}

}  // namespace

void MovingAreaOptions::describe(ParameterVisitor& visitor) {
    visitor.flag("motion.areas", enabled,
                 {"",
                  "Where registered pictures differ and corners starve, as on vehicles of few pixels, measure the "
                  "motion of the whole area that differs.",
                  "Teutsch §2.2, eq. 2.2"});
    visitor.real("motion.area_max_corners", max_corners, 0, 10000,
                 {"",
                  "Only while fewer corners than this lie on a car at their mean density. Larger: also where vehicles "
                  "carry more corners, with more false areas.",
                  ""});
    visitor.real("motion.area_gap", gap_s, 0.01, 10,
                 {"s", "Time between the three pictures that are compared. Longer: slower vehicles.", ""});
    visitor.real("motion.area_noise_factor", noise_factor, 0, 100,
                 {"", "Pixels differ from this many deviations of the frame's own differences on.", ""});
    visitor.real("motion.area_contrast", min_contrast, 0, 255, {"grey", "… and from this difference on.", ""});
    visitor.real("motion.area_min_size", min_area_m2, 0, 1000, {"m²", "Smaller areas are left out.", ""});
    visitor.integer("motion.area_min_size_px", min_area_px, 1, 100000, {"px²", "… whatever the scale.", ""});
    visitor.real("motion.area_max_length", max_length_m, 0.1, 1000, {"m", "Longer areas are left out.", ""});
    visitor.real("motion.area_min_shift", min_shift_px, 0, 50,
                 {"px", "Areas that went less far between two of the pictures may be misregistered.", ""});
    visitor.real("motion.area_min_correlation", min_correlation, -1, 1,
                 {"", "An area's pixels agree at least so well with where they went and where they came from.", ""});
}

MovingAreas::MovingAreas(const MovingAreaOptions& options, const SceneScale& scale)
    : options_(options),
      scale_(scale),
      gap_(std::clamp(cvRound(options.gap_s * scale.frame_rate_hz), 1, 30)),
      frames_(2 * gap_),
      next_id_(kFirstInferred) {}

void MovingAreas::add(const Frame& frame, const Registration& registration) {
    if (!options_.enabled) return;
    if (frame.gray.empty())
        frames_.clear();
    else
        frames_.add(frame, registration);
}

std::vector<MotionVector> MovingAreas::infer(const FrameMotion& motion, double min_speed) {
    std::vector<MotionVector> inferred;
    if (!options_.enabled || frames_.count() < 2 * gap_) return inferred;
    if (cornersOnCar(motion, scale_) >= options_.max_corners) return inferred;
    const cv::Mat& now = frames_.newest();
    const cv::Mat before = frames_.past(gap_).gray;
    const cv::Mat long_before = frames_.past(2 * gap_).gray;
    cv::Mat difference;
    {
        const cv::Mat middle = smoothed(before);
        cv::Mat earlier;
        cv::absdiff(smoothed(now), middle, difference);
        cv::absdiff(middle, smoothed(long_before), earlier);
        cv::min(difference, earlier, difference);
    }
    const double threshold = std::max(options_.noise_factor * noiseOf(difference), options_.min_contrast);
    cv::Mat binary = difference > threshold;
    leaveOutBeyond(binary, frames_.pathTo(gap_).inverse(), now.size());
    leaveOutBeyond(binary, frames_.pathTo(2 * gap_).inverse(), now.size());

    const double px_per_m = scale_.px(1);
    const int fewest = std::max(options_.min_area_px, cvRound(options_.min_area_m2 * px_per_m * px_per_m));
    const std::vector<Area> areas = areasOf(binary, fewest, scale_.px(options_.max_length_m));
    const int reach = std::clamp(static_cast<int>(std::ceil(scale_.pxPerFrame(kMaxSpeed) * gap_)), 4, kLongestReach);
    std::vector<std::optional<cv::Point2d>> shifts(areas.size());
    // Written by index, so that the result does not depend on the number of threads.
    cv::parallel_for_(cv::Range(0, static_cast<int>(areas.size())), [&](const cv::Range& range) {
        for (int i = range.start; i < range.end; ++i) {
            const auto at = static_cast<std::size_t>(i);
            const std::vector<cv::Point> pixels = grown(areas[at], now.size());
            const auto on = matchArea(pixels, before, now, {0, 0}, reach);
            if (!on || on->correlation < options_.min_correlation) continue;
            const cv::Point back(-cvRound(on->shift.x), -cvRound(on->shift.y));
            const auto came = matchArea(pixels, before, long_before, back, kReturnReach);
            if (!came || came->correlation < options_.min_correlation) continue;
            const cv::Point2d shift = (on->shift - came->shift) / 2;
            const double length = std::hypot(shift.x, shift.y);
            if (length >= std::max(options_.min_shift_px, min_speed * gap_)) shifts[at] = on->shift;
        }
    });

    const double spacing = std::max(kVectorSpacingPx, scale_.px(kVectorSpacing));
    for (std::size_t i = 0; i < areas.size(); ++i) {
        if (!shifts[i]) continue;
        const cv::Point2d velocity = *shifts[i] / gap_;
        const double alike = std::max(kAlikePx, kAlike * std::hypot(velocity.x, velocity.y));
        const cv::Rect2d place(areas[i].bounds.x + shifts[i]->x - kAround, areas[i].bounds.y + shifts[i]->y - kAround,
                               areas[i].bounds.width + 2 * kAround, areas[i].bounds.height + 2 * kAround);
        std::size_t known = 0;
        for (const MotionVector& vector : motion.motion_vectors) {
            const cv::Point2d difference_of = cv::Point2d(vector.velocity) - velocity;
            if (place.contains(cv::Point2d(vector.position)) && std::hypot(difference_of.x, difference_of.y) <= alike)
                ++known;
        }
        if (known >= kEnough) continue;
        for (const cv::Point& p : spread(areas[i], spacing))
            inferred.push_back({next_id_++, cv::Point2d(p) + *shifts[i], velocity, 0});
    }
    return inferred;
}

}  // namespace eyrie

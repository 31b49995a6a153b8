#include "motion/differences/moving_areas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "core/geometry/homography_jacobian.h"
#include "core/robust_statistics.h"
#include "core/values/corner_density.h"
#include "core/values/inferred_ids.h"
#include "motion/differences/area_matching.h"

namespace eyrie {
namespace {

constexpr int kLongestOfUsual = 2;        ///< times the usual time between pictures that are compared
constexpr double kVectorSpacing = 0.6;    ///< m between inferred vectors …
constexpr double kVectorSpacingPx = 2;    ///< … px at least
constexpr int kAround = 2;                ///< px that an area grows by before it is looked for: outlines tell most
constexpr int kPictureMargin = 3;         ///< px of the halved picture, where interpolation and blur answer to nothing
constexpr std::size_t kMostAreas = 1500;  ///< the largest; more are waves or flicker
constexpr double kMaxSpeed = 40;          ///< m/s
constexpr int kLongestReach = 100;        ///< px
constexpr int kReturnReach = 2;           ///< px by which the way back may differ from the way on …
constexpr double kReturnShare = 0.1;      ///< … or this share of the way: vehicles brake and turn
constexpr double kLowerStep = 0.7;        ///< from one threshold of differences to the next lower one
constexpr std::size_t kEnough = 3;        ///< vectors with which a vehicle needs no more
constexpr double kAlike = 0.3;            ///< difference of velocities, as a share of the speed …
constexpr double kAlikePx = 0.4;          ///< … and px/frame

cv::Mat smoothed(const cv::Mat& gray) {
    cv::Mat smooth;
    cv::GaussianBlur(gray, smooth, {5, 5}, 1.0);
    return smooth;
}

/// Robust deviation of differences: their median as if they were normal, since most of the picture stands still.
double noiseOf(const cv::Mat& difference) {
    std::array<int, 256> histogram{};
    int count = 0;
    for (int y = 0; y < difference.rows; y += 4) {
        const uchar* row = difference.ptr<uchar>(y);
        for (int x = 0; x < difference.cols; ++x) ++histogram[row[x]];
        count += difference.cols;
    }
    // Within its bin the median lies where the count says.
    int below = 0;
    std::size_t median = 0;
    while (below + histogram[median] < count / 2) below += histogram[median++];
    return (static_cast<double>(median) - 0.5 + (count / 2.0 - below) / std::max(1, histogram[median])) /
           kMedianOfAbsoluteNormal;
}

/// Half the size; pixel (x, y) lies at (2x + ½, 2y + ½).
cv::Mat halved(const cv::Mat& gray) {
    cv::Mat half;
    cv::resize(gray, half, {gray.cols / 2, gray.rows / 2}, 0, 0, cv::INTER_AREA);
    return half;
}

/// The map between halved pictures that a map between the whole ones is.
cv::Matx33d forHalves(const cv::Matx33d& map) {
    const cv::Matx33d whole_from_half(2, 0, 0.5, 0, 2, 0.5, 0, 0, 1);
    return whole_from_half.inv() * map * whole_from_half;
}

cv::Point2d middleOf(const cv::Rect& bounds) {
    return cv::Point2d(bounds.x + (bounds.width - 1) / 2.0, bounds.y + (bounds.height - 1) / 2.0);
}

std::array<cv::Point2d, 4> cornersOf(cv::Size size) {
    const cv::Rect2d picture({}, cv::Size2d(size));
    const cv::Point2d end = picture.br();
    return {cv::Point2d(0, 0), cv::Point2d(end.x, 0), cv::Point2d(0, end.y), end};
}

/// Whether a map over several frames keeps the whole picture on one side of the horizon and somewhere near.
bool isSane(const Homography& map, cv::Size size) {
    for (const cv::Point2d& corner : cornersOf(size)) {
        const double w = map.matrix(2, 0) * corner.x + map.matrix(2, 1) * corner.y + map.matrix(2, 2);
        if (!(w > 0.2)) return false;
        const cv::Point2d at = map.apply(corner);
        if (!(std::abs(at.x) < 10.0 * size.width && std::abs(at.y) < 10.0 * size.height)) return false;
    }
    return true;
}

/// A part of the newest picture's area as an earlier picture shows it, which is so small that the map's first order
/// will do.
cv::Mat partOf(const cv::Mat& earlier, const Homography& earlier_from_newest, const cv::Rect& part) {
    const cv::Point2d middle((part.width - 1) / 2.0, (part.height - 1) / 2.0);
    const HomographyJacobian map(earlier_from_newest.matrix, cv::Point2d(part.tl()) + middle);
    const cv::Point2d x = map.vector({1, 0});
    const cv::Point2d y = map.vector({0, 1});
    const cv::Point2d corner = map.point() - map.vector(middle);
    cv::Mat shown;
    cv::warpAffine(earlier, shown, cv::Matx23d(x.x, y.x, corner.x, x.y, y.y, corner.y), part.size(),
                   cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
    return shown;
}

/// Sizes between which the areas at a place of the halved picture are looked at.
struct AreaLimits {
    int fewest_pixels;
    double longest;  ///< px
};

std::vector<DifferingArea> areasOf(const cv::Mat& binary, const std::function<AreaLimits(cv::Point2d)>& limits_at) {
    cv::Mat labels;
    cv::Mat stats;
    cv::Mat centroids;
    const int count = cv::connectedComponentsWithStats(binary, labels, stats, centroids, 8, CV_32S);
    std::vector<DifferingArea> areas;
    for (int label = 1; label < count; ++label) {
        const cv::Rect bounds(stats.at<int>(label, cv::CC_STAT_LEFT), stats.at<int>(label, cv::CC_STAT_TOP),
                              stats.at<int>(label, cv::CC_STAT_WIDTH), stats.at<int>(label, cv::CC_STAT_HEIGHT));
        const AreaLimits limits = limits_at(middleOf(bounds));
        if (stats.at<int>(label, cv::CC_STAT_AREA) < limits.fewest_pixels) continue;
        if (std::hypot(bounds.width, bounds.height) > limits.longest) continue;
        DifferingArea area;
        area.bounds = bounds;
        for (int y = bounds.y; y < bounds.br().y; ++y) {
            for (int x = bounds.x; x < bounds.br().x; ++x) {
                if (labels.at<int>(y, x) == label) area.pixels.emplace_back(x, y);
            }
        }
        areas.push_back(std::move(area));
    }
    if (areas.size() > kMostAreas) {
        std::stable_sort(areas.begin(), areas.end(),
                         [](const auto& a, const auto& b) { return a.pixels.size() > b.pixels.size(); });
        areas.resize(kMostAreas);
    }
    return areas;
}

/// The pixels of the whole picture that an area of the halved one and its surroundings are, from the corner of
/// `bounds` on.
std::vector<cv::Point> grownPixels(const DifferingArea& area, const cv::Rect& bounds) {
    cv::Mat1b mask = cv::Mat1b::zeros(bounds.size());
    for (const cv::Point& p : area.pixels) mask(cv::Rect(2 * p - bounds.tl(), cv::Size(2, 2))) = 255;
    cv::dilate(mask, mask, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * kAround + 1, 2 * kAround + 1}));
    std::vector<cv::Point> pixels;
    cv::findNonZero(mask, pixels);
    return pixels;
}

cv::Rect grownBounds(const DifferingArea& area) {
    return {2 * area.bounds.x - kAround, 2 * area.bounds.y - kAround, 2 * (area.bounds.width + kAround),
            2 * (area.bounds.height + kAround)};
}

/// Places in the whole picture among the pixels of an area, at least so far apart.
std::vector<cv::Point2d> spread(const DifferingArea& area, double spacing) {
    std::vector<cv::Point2d> chosen;
    for (const cv::Point& half : area.pixels) {
        const cv::Point2d p = cv::Point2d(half) * 2 + cv::Point2d(0.5, 0.5);
        const bool free = std::none_of(chosen.begin(), chosen.end(), [&](const cv::Point2d& other) {
            return std::hypot(p.x - other.x, p.y - other.y) < spacing;
        });
        if (free) chosen.push_back(p);
    }
    return chosen;
}

}  // namespace

void MovingAreaOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::motion);
    declare.flag(
        "motion.areas", areas,
        {"",
         "Where registered pictures differ and corners starve, as on vehicles of few pixels or in video of few "
         "frames a second, measure the motion of the whole area that differs.",
         "Teutsch §2.2, eq. 2.2"});
    declare.real(
        "motion.area_max_corners", area_max_corners, 0, 10000,
        {"",
         "Only while fewer corners than this lie on a car at their mean density, unless the video has fewer frames a "
         "second than motion.area_low_rate. Larger: also where vehicles carry more corners, with more false areas.",
         ""});
    declare.real(
        "motion.area_few_corners", area_few_corners, 0, 10000,
        {"", "Where a car carries at least this many corners, areas are used only if they agree very well.", ""});
    declare.real("motion.area_gap", area_gap_s, 0.01, 10,
                 {"s", "Time between the three pictures that are compared. Longer: slower vehicles.", ""});
    declare.real(
        "motion.area_noise_factor", area_noise_factor, 0, 100,
        {"", "Pixels differ where the difference exceeds this many deviations of the frame's own differences.", ""});
    declare.real("motion.area_contrast", area_contrast, 0, 255,
                 {"grey", "Pixels differ where the difference exceeds this, too.", ""});
    declare.real("motion.area_min_size", area_min_size_m2, 0, 1000, {"m²", "Smaller areas are left out.", ""});
    declare.integer("motion.area_min_size_px", area_min_size_px, 1, 100000,
                    {"px²", "Areas of fewer pixels are left out, whatever the scale.", ""});
    declare.real("motion.area_max_length", area_max_length_m, 0.1, 1000, {"m", "Longer areas are left out.", ""});
    declare.real(
        "motion.area_min_shift", area_min_shift, 0, 50,
        {"px", "Areas that moved less between two of the pictures may be misregistered and are left out.", ""});
    declare.real("motion.area_min_correlation", area_min_correlation, -1, 1,
                 {"", "Lowest correlation of an area's pixels with where they went and where they came from.", ""});
    declare.real("motion.area_sure_correlation", area_sure_correlation, -1, 1,
                 {"", "The same where a car carries motion.area_few_corners corners or more.", ""});
    declare.real("motion.area_low_rate", area_low_rate_hz, 0, 1000,
                 {"Hz",
                  "Below so many frames a second areas are used whatever corners a car carries: from frame to frame "
                  "it goes too far for them to be followed.",
                  ""});
    declare.real("motion.area_low_rate_correlation", area_low_rate_correlation, -1, 1,
                 {"",
                  "Lowest correlation below motion.area_low_rate, both ways: a vehicle looks different from picture to "
                  "picture.",
                  ""});
    declare.real("motion.area_low_rate_noise_factor", area_low_rate_noise_factor, 0.1, 100,
                 {"",
                  "Below motion.area_low_rate areas are looked for at lower and lower differences, too, down to this "
                  "many deviations, where none moves at higher ones: grey vehicles on grey roads. As large as "
                  "motion.area_noise_factor: no.",
                  ""});
}

int MovingAreaOptions::gapFrames(const SceneScale& scale) const {
    return std::clamp(cvRound(area_gap_s * scale.frame_rate_hz), 1, 30);
}

MovingAreas::MovingAreas(const MovingAreaOptions& options, const SceneScale& scale)
    : options_(options), scale_(scale), gap_(options.gapFrames(scale)), frames_(2 * gap_), next_id_(kFirstOfAreas) {}

void MovingAreas::add(const Frame& frame, const Registration& registration, const PictureMask& graphics) {
    if (!options_.areas) return;
    graphics_ = graphics;
    if (frame.gray.empty())
        frames_.clear();
    else
        frames_.add(frame, registration);
}

MovingAreas::Difference MovingAreas::difference() const {
    const cv::Mat now = halved(frames_.newest());
    // Graphics are at the same place of each of the pictures; without what blur and interpolation take of them.
    cv::Mat clear;
    if (!graphics_.empty()) {
        cv::resize(graphics_.cells == 0, clear, now.size(), 0, 0, cv::INTER_NEAREST);
        cv::erode(clear, clear, cv::Mat1b::ones(2 * kPictureMargin + 1, 2 * kPictureMargin + 1));
    }
    const auto earlier = [&](int back, cv::Mat& inside) {
        const cv::Mat half = halved(frames_.picture(back));
        const cv::Matx33d map = forHalves(frames_.pathTo(back).inverse().matrix);
        cv::Mat warped;
        cv::warpPerspective(smoothed(half), warped, map, now.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
        // Without the margin, where interpolation and blur answer to nothing.
        const cv::Rect2d shown(kPictureMargin, kPictureMargin, half.cols - 1 - 2 * kPictureMargin,
                               half.rows - 1 - 2 * kPictureMargin);
        std::vector<cv::Point> corners;
        for (const cv::Point2d& corner :
             {shown.tl(), cv::Point2d(shown.br().x, shown.y), shown.br(), cv::Point2d(shown.x, shown.br().y)}) {
            const cv::Point2d at = HomographyJacobian(map, corner).point();
            corners.emplace_back(cvRound(at.x), cvRound(at.y));
        }
        inside = cv::Mat::zeros(now.size(), CV_8UC1);
        cv::fillConvexPoly(inside, corners, cv::Scalar(255));
        if (!clear.empty()) {
            cv::Mat clear_there;
            cv::warpPerspective(clear, clear_there, map, now.size(), cv::INTER_NEAREST);
            inside &= clear_there;
        }
        return warped;
    };
    cv::Mat in_before;
    cv::Mat in_long_before;
    const cv::Mat before = earlier(gap_, in_before);
    const cv::Mat long_before = earlier(2 * gap_, in_long_before);
    cv::Mat difference;
    cv::Mat earlier_difference;
    cv::absdiff(smoothed(now), before, difference);
    cv::absdiff(before, long_before, earlier_difference);
    cv::min(difference, earlier_difference, difference);
    const double noise = noiseOf(difference);
    difference &= in_before & in_long_before;
    if (!clear.empty()) difference &= clear;
    return {difference, noise};
}

std::vector<DifferingArea> MovingAreas::areasFrom(const Difference& difference, double threshold) const {
    return areasOf(difference.gray > threshold, [&](cv::Point2d half) -> AreaLimits {
        const SceneScale here = scale_.at(2 * half);
        const double half_px_per_m = here.px(1) / 2;
        const int fewest = cvRound(options_.area_min_size_m2 * half_px_per_m * half_px_per_m);
        return {std::max(options_.area_min_size_px / 4, fewest), here.px(options_.area_max_length_m) / 2};
    });
}

std::vector<double> MovingAreas::thresholds(double noise) const {
    double factor = options_.area_noise_factor;
    std::vector<double> descending{std::max(factor * noise, options_.area_contrast)};
    while (isLowRate() && descending.back() > options_.area_contrast) {
        factor *= kLowerStep;
        if (factor < options_.area_low_rate_noise_factor) break;
        descending.push_back(std::max(factor * noise, options_.area_contrast));
    }
    return descending;
}

std::optional<cv::Point2d> MovingAreas::shiftOf(const DifferingArea& area, double min_correlation,
                                                const cv::Mat& long_before) const {
    const cv::Rect bounds = grownBounds(area);
    const std::vector<cv::Point> pixels = grownPixels(area, bounds);
    const cv::Mat before = partOf(frames_.picture(gap_), frames_.pathTo(gap_), bounds);
    const double fastest = scale_.at(middleOf(bounds)).pxPerFrame(kMaxSpeed);
    const int frames = frames_.framesTo(gap_);
    const int frames_before = frames_.framesTo(2 * gap_) - frames;
    const int reach = std::clamp(static_cast<int>(std::ceil(fastest * frames)), 4, kLongestReach);
    if (isLowRate()) {
        if (frames_before != frames) return std::nullopt;
        const auto way = matchWay(pixels, before, frames_.newest(), long_before, bounds.tl(), reach, kReturnShare);
        if (!way || way->correlation() < min_correlation) return std::nullopt;
        return way->on.shift - cv::Point2d(bounds.tl());
    }
    const auto on = matchArea(pixels, before, frames_.newest(), bounds.tl(), reach);
    if (!on || on->correlation < min_correlation) return std::nullopt;
    const cv::Point2d shift = on->shift - cv::Point2d(bounds.tl());

    const cv::Point2d came_by = shift * (1.0 * frames_before / frames);
    const cv::Point back(-cvRound(came_by.x), -cvRound(came_by.y));
    const int return_reach = std::max(kReturnReach, cvRound(kReturnShare * std::hypot(came_by.x, came_by.y)));
    const int margin = return_reach + 4;
    const cv::Rect whence(bounds.x + back.x - margin, bounds.y + back.y - margin, bounds.width + 2 * margin,
                          bounds.height + 2 * margin);
    const cv::Mat earlier = partOf(frames_.picture(2 * gap_), frames_.pathTo(2 * gap_), whence);
    const auto came = matchArea(pixels, before, earlier, {margin, margin}, return_reach);
    if (!came || came->correlation < min_correlation) return std::nullopt;
    return shift;
}

std::optional<double> MovingAreas::correlationNeeded(const FrameMotion& motion, cv::Point2d place) const {
    if (isLowRate()) return options_.area_low_rate_correlation;
    const double corners_on_car = cornersOnCar(motion, scale_.at(place));
    if (corners_on_car >= options_.area_max_corners) return std::nullopt;
    return corners_on_car < options_.area_few_corners ? options_.area_min_correlation : options_.area_sure_correlation;
}

std::vector<std::optional<cv::Point2d>> MovingAreas::shiftsOf(const std::vector<DifferingArea>& areas,
                                                              const FrameMotion& motion,
                                                              const std::function<double(cv::Point2d)>& min_speed,
                                                              const cv::Mat& long_before) const {
    std::vector<std::optional<cv::Point2d>> shifts(areas.size());
    // Written by index, so that the result does not depend on the number of threads.
    cv::parallel_for_(cv::Range(0, static_cast<int>(areas.size())), [&](const cv::Range& range) {
        for (int i = range.start; i < range.end; ++i) {
            const auto at = static_cast<std::size_t>(i);
            const cv::Point2d place = middleOf(grownBounds(areas[at]));
            const auto min_correlation = correlationNeeded(motion, place);
            if (!min_correlation) continue;
            const auto shift = shiftOf(areas[at], *min_correlation, long_before);
            if (shift && std::hypot(shift->x, shift->y) >=
                             std::max(options_.area_min_shift, min_speed(place) * frames_.framesTo(gap_)))
                shifts[at] = shift;
        }
    });
    return shifts;
}

void MovingAreas::addVectors(const DifferingArea& area, cv::Point2d shift, const FrameMotion& motion,
                             std::vector<MotionVector>& inferred) {
    const cv::Point2d velocity = shift / frames_.framesTo(gap_);
    const double alike = std::max(kAlikePx, kAlike * std::hypot(velocity.x, velocity.y));
    const cv::Rect bounds = grownBounds(area);
    const cv::Rect2d place = cv::Rect2d(bounds) + shift;
    std::size_t known = 0;
    for (const MotionVector& vector : motion.motion_vectors) {
        const cv::Point2d difference_of = cv::Point2d(vector.velocity) - velocity;
        if (place.contains(cv::Point2d(vector.position)) && std::hypot(difference_of.x, difference_of.y) <= alike)
            ++known;
    }
    if (known >= kEnough) return;
    const double spacing = std::max(kVectorSpacingPx, scale_.at(middleOf(bounds)).px(kVectorSpacing));
    for (const cv::Point2d& p : spread(area, spacing)) inferred.push_back({next_id_++, p + shift, velocity, 0});
}

std::vector<MotionVector> MovingAreas::infer(const FrameMotion& motion,
                                             const std::function<double(cv::Point2d)>& min_speed) {
    std::vector<MotionVector> inferred;
    if (!options_.areas || frames_.count() < 2 * gap_) return inferred;
    // Over a long stall much comes and goes.
    if (frames_.framesTo(2 * gap_) > kLongestOfUsual * 2 * gap_) return inferred;
    const cv::Size size = frames_.newest().size();
    // Linear over the picture, so that corners suffice everywhere where they do at its four.
    const auto corners = cornersOf(size);
    if (std::none_of(corners.begin(), corners.end(),
                     [&](cv::Point2d corner) { return correlationNeeded(motion, corner).has_value(); }))
        return inferred;
    for (const int back : {gap_, 2 * gap_}) {
        const Homography path = frames_.pathTo(back);
        if (!isSane(path, size) || !isSane(path.inverse(), size)) return inferred;
    }
    const Difference difference = this->difference();
    const cv::Mat long_before = isLowRate() ? frames_.past(2 * gap_).gray : cv::Mat();
    cv::Mat1b moving = cv::Mat1b::zeros(difference.gray.size());
    for (const double threshold : thresholds(difference.noise)) {
        std::vector<DifferingArea> areas = areasFrom(difference, threshold);
        std::erase_if(areas, [&](const DifferingArea& area) {
            return std::any_of(area.pixels.begin(), area.pixels.end(), [&](cv::Point p) { return moving(p) != 0; });
        });
        const auto shifts = shiftsOf(areas, motion, min_speed, long_before);
        for (std::size_t i = 0; i < areas.size(); ++i) {
            if (!shifts[i]) continue;
            for (const cv::Point& p : areas[i].pixels) moving(p) = 255;
            addVectors(areas[i], *shifts[i], motion, inferred);
        }
    }
    return inferred;
}

}  // namespace eyrie

#include "motion/vectors/shadow_test.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "motion/vectors/cell_means.h"

namespace eyrie {
namespace {

constexpr double kCornerBeside = 1.5;   ///< px: corners lie this close to the edges they belong to
constexpr double kVehicleBeside = 0.5;  ///< px by which the box of a vehicle's corners is smaller than it
constexpr int kLitRun = 2;              ///< half pixels of lit ground that are a gap

}  // namespace

void ShadowTestOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::motion);
    declare.flag(
        "motion.shadow_test", shadow_test,
        {"", "Leave out corners that look like the outline of a moving shadow. Helps by day, not at night.", ""});
    declare.real("motion.shadow_darkest", shadow_darkest, 0, 1,
                 {"", "A shadow is at least this share of the ground's brightness.", ""});
    declare.real("motion.shadow_brightest", shadow_brightest, 0, 1,
                 {"", "A shadow is at most this share of the ground's brightness.", ""});
    declare.real("motion.shadow_bright_near", shadow_bright_near, 0.5, 5,
                 {"", "A corner with anything brighter than this share of the ground near it is on a vehicle.", ""});
    declare.real("motion.shadow_radius", shadow_radius_m, 0, 5,
                 {"m", "What counts as near a corner; at least 2 px.", ""});
    declare.real("motion.shadow_ground", shadow_ground_m, 1, 100,
                 {"m", "Side of the window whose median is the ground's brightness.", ""});
    declare.real("motion.shadow_lit", shadow_lit, 0, 5,
                 {"",
                  "Where the ground between a shadow and its vehicle reaches this share of its usual brightness, the "
                  "dark thing is a vehicle of its own. 5: never.",
                  ""});
    declare.real("motion.shadow_min_brightness", shadow_min_brightness, 0, 255,
                 {"grey", "Where the ground is darker than this (night), the test is not used.", ""});
    declare.real("motion.shadow_reach", shadow_reach_m, 0, 100,
                 {"m",
                  "A shadow ends at most this far from a vehicle that moves like it; what looks like a shadow but lies "
                  "elsewhere is a dark vehicle. Larger for a low sun.",
                  ""});
    declare.real("motion.shadow_owner_length", shadow_owner_length_m, 0, 100,
                 {"m", "Motion vectors own a shadow when they spread over at least this length.", ""});
    declare.real("motion.shadow_owner_width", shadow_owner_width_m, 0, 100,
                 {"m", "Motion vectors own a shadow when they spread over at least this width, too.", ""});
}

ShadowTest::ShadowTest(const ShadowTestOptions& options, const SceneScale& scale)
    : options_(options),
      radius_(std::clamp(static_cast<int>(std::lround(scale.px(options.shadow_radius_m))), 2, 8)),
      block_(std::clamp(static_cast<int>(std::lround(scale.px(1.0))), 3, 16)) {
    const int cells = static_cast<int>(std::lround(scale.px(options.shadow_ground_m) / block_));
    window_ = std::clamp(cells / 2 * 2 + 1, 3, 61);
}

void ShadowTest::prepare(const cv::Mat& gray) {
    gray_ = gray;
    if (gray.empty()) return;
    const cv::Size cells((gray.cols + block_ - 1) / block_, (gray.rows + block_ - 1) / block_);
    cv::medianBlur(cellMeans(gray, cells), ground_, window_);
}

double ShadowTest::groundAt(cv::Point2d place) const {
    const int x = std::clamp(cvRound(place.x) * ground_.cols / gray_.cols, 0, ground_.cols - 1);
    const int y = std::clamp(cvRound(place.y) * ground_.rows / gray_.rows, 0, ground_.rows - 1);
    return ground_.at<uchar>(y, x);
}

bool ShadowTest::litUpTo(const OrientedBox& vehicle, cv::Point2f corner) const {
    if (gray_.empty()) return false;
    // Towards the middle: a shadow and its vehicle together are convex, so that this way stays inside.
    const cv::Point2d way = vehicle.centre - cv::Point2d(corner);
    const double length = std::hypot(way.x, way.y);
    const double ground = groundAt(corner);
    int run = 0;
    for (double gone = kCornerBeside; gone < length; gone += 0.5) {
        const cv::Point2d place = cv::Point2d(corner) + way * (gone / length);
        if (vehicle.contains(place, kVehicleBeside)) return false;
        const cv::Point pixel(cvRound(place.x), cvRound(place.y));
        if (!cv::Rect(0, 0, gray_.cols, gray_.rows).contains(pixel)) continue;
        const double brightness = gray_.at<uchar>(pixel);
        if (brightness > options_.shadow_bright_near * ground)
            return false;  // the vehicle, beyond the box of its corners
        run = brightness >= options_.shadow_lit * ground ? run + 1 : 0;
        if (run >= kLitRun) return true;
    }
    return false;
}

bool ShadowTest::isShadow(cv::Point2f corner) const {
    if (gray_.empty()) return false;
    const cv::Point pixel(cvRound(corner.x), cvRound(corner.y));
    const cv::Rect near = cv::Rect(pixel.x - radius_, pixel.y - radius_, 2 * radius_ + 1, 2 * radius_ + 1) &
                          cv::Rect(0, 0, gray_.cols, gray_.rows);
    if (near.width < 3 || near.height < 3) return false;
    const double ground = groundAt(corner);
    if (ground < options_.shadow_min_brightness) return false;

    // Means of 2×2 pixels, so that a noisy pixel decides nothing.
    int darkest = 4 * 255;
    int brightest = 0;
    for (int y = near.y; y + 1 < near.br().y; ++y) {
        const uchar* row = gray_.ptr<uchar>(y);
        const uchar* below = gray_.ptr<uchar>(y + 1);
        for (int x = near.x; x + 1 < near.br().x; ++x) {
            const int sum = row[x] + row[x + 1] + below[x] + below[x + 1];
            darkest = std::min(darkest, sum);
            brightest = std::max(brightest, sum);
        }
    }
    return darkest >= 4 * options_.shadow_darkest * ground && darkest <= 4 * options_.shadow_brightest * ground &&
           brightest <= 4 * options_.shadow_bright_near * ground;
}

}  // namespace eyrie

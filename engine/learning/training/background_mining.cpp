#include "learning/training/background_mining.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/geometry/angle.h"
#include "learning/classifiers/seeded_random.h"
#include "learning/models/window.h"
#include "learning/models/window_scanner.h"

namespace eyrie {
namespace {

constexpr int kHeadings = 3;              // per image
constexpr double kVehicleOverlap = 0.45;  // from which a window counts as one of a vehicle
constexpr double kUnclearShare = 0.2;
constexpr double kMargin = 6;  // of the soft cascade
constexpr int kApart = 3;      // px between windows taken from one scan
constexpr double kNearestDecision = 0;

struct Found {
    double decision = 0;
    std::size_t image = 0;
    OrientedBox box;
};

/// The image turned so that `heading` points up and scaled so that `typical` takes of the window what `fit` says.
struct UprightImage {
    cv::Mat gray;
    cv::Matx23d image_from_upright;
};

UprightImage uprightImage(const cv::Mat& gray, const OrientedBox& typical, const WindowFit& fit, double heading) {
    const double across = typical.width / fit.width;
    const double along = typical.length / fit.length;
    OrientedBox frame;
    frame.heading = heading;
    const cv::Point2d ahead = frame.direction();
    const cv::Point2d right(-ahead.y, ahead.x);
    const double width = std::abs(right.x) * gray.cols + std::abs(right.y) * gray.rows;
    const double height = std::abs(ahead.x) * gray.cols + std::abs(ahead.y) * gray.rows;
    const cv::Size size(std::clamp(cvRound(width / across), 1, 4096), std::clamp(cvRound(height / along), 1, 4096));
    const cv::Point2d centre((gray.cols - 1) / 2.0, (gray.rows - 1) / 2.0);
    const cv::Point2d origin =
        centre - right * (across * (size.width - 1) / 2.0) + ahead * (along * (size.height - 1) / 2.0);
    UprightImage upright;
    upright.image_from_upright = {right.x * across, -ahead.x * along, origin.x,
                                  right.y * across, -ahead.y * along, origin.y};
    cv::Mat smooth;
    const double coarser = std::max(across, along);
    // Not into a Mat that shares the picture's pixels: it is searched in other directions, and windows are cut from it.
    if (coarser > 1.3) cv::GaussianBlur(gray, smooth, {}, 0.4 * coarser);
    cv::warpAffine(smooth.empty() ? gray : smooth, upright.gray, upright.image_from_upright, size,
                   cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
    return upright;
}

bool isBackground(const OrientedBox& box, const LabelledImage& image) {
    if (areaInImage(box, image.gray.size()) < 0.95 * box.area()) return false;
    for (const OrientedBox& vehicle : image.vehicles) {
        if (overlap(box, vehicle) >= kVehicleOverlap) return false;
    }
    for (const OrientedBox& unclear : image.unclear) {
        if (intersectionArea(box, unclear) > kUnclearShare * box.area()) return false;
    }
    return true;
}

void scanImage(const WindowScanner& scanner, const LabelledImage& image, std::size_t index, const OrientedBox& typical,
               double heading, std::vector<Found>& found) {
    const UprightImage upright = uprightImage(image.gray, typical, scanner.model().fit, heading);
    cv::Mat1f decision;
    cv::Mat scanned;
    scanner.scan(upright.gray, kMargin, scanned);
    if (scanned.empty()) return;
    decision = scanned;
    cv::Mat1f highest;
    cv::dilate(decision, highest, cv::Mat::ones(2 * kApart + 1, 2 * kApart + 1, CV_8UC1));
    for (int y = 0; y < decision.rows; ++y) {
        for (int x = 0; x < decision.cols; ++x) {
            if (!(decision(y, x) > kNearestDecision) || decision(y, x) < highest(y, x)) continue;
            const cv::Vec2d centre =
                upright.image_from_upright * cv::Vec3d(x + (kWindowWidth - 1) / 2.0, y + (kWindowHeight - 1) / 2.0, 1);
            OrientedBox box = typical;
            box.centre = {centre[0], centre[1]};
            box.heading = heading;
            if (isBackground(box, image)) found.push_back({decision(y, x), index, box});
        }
    }
}

}  // namespace

SampleSet mineBackground(const VehicleModel& model, const std::vector<LabelledImage>& images,
                         const OrientedBox& typical, int wanted, std::uint64_t seed, const TrainingWatch& watch) {
    const WindowScanner scanner(model);
    SeededRandom random(seed);
    std::vector<Found> found;
    for (std::size_t i = 0; i < images.size() && !watch.stopped(); ++i) {
        const LabelledImage& image = images[i];
        const OrientedBox size = image.vehicles.empty() ? typical : medianVehicle(image.vehicles);
        if (!(size.length > 0) || !(size.width > 0)) continue;
        for (int k = 0; k < kHeadings; ++k) {
            const bool as_a_vehicle = !image.vehicles.empty() && k > 0;
            const double heading =
                as_a_vehicle
                    ? image.vehicles[static_cast<std::size_t>(random.below(static_cast<int>(image.vehicles.size())))]
                          .heading
                    : random.between(-kPi, kPi);
            scanImage(scanner, image, i, size, heading, found);
        }
        watch.show("searching the background", static_cast<double>(i + 1) / static_cast<double>(images.size()));
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Found& a, const Found& b) { return a.decision > b.decision; });
    SampleSet samples;
    for (const Found& one : found) {
        if (static_cast<int>(samples.size()) >= wanted) break;
        const LabelledImage& image = images[one.image];
        samples.push_back({cutWindow(image.gray, one.box, model.fit), false, image.source, image.group, false});
    }
    return samples;
}

}  // namespace eyrie

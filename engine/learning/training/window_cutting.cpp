#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "core/geometry/angle.h"
#include "learning/classifiers/seeded_random.h"
#include "learning/models/window.h"
#include "learning/training/sample_set.h"

namespace eyrie {
namespace {

constexpr int kFinest = 16;               // most samples per window pixel and direction
constexpr int kAttempts = 40;             // per window wanted, where the image is full of vehicles
constexpr double kNearestOverlap = 0.45;  // of windows beside a vehicle
constexpr int kNearEvery = 4;

bool overlapsMore(const OrientedBox& box, const std::vector<OrientedBox>& others, double most) {
    return std::any_of(others.begin(), others.end(),
                       [&](const OrientedBox& other) { return overlap(box, other) > most; });
}

bool covered(const OrientedBox& box, const std::vector<OrientedBox>& by, double most) {
    return std::any_of(by.begin(), by.end(),
                       [&](const OrientedBox& other) { return intersectionArea(box, other) > most * box.area(); });
}

/// A vehicle's box pushed away so that it shows only a part of it.
OrientedBox pushedAside(OrientedBox box, SeededRandom& random) {
    const bool along = random.below(2) == 0;
    const double side = random.below(2) == 0 ? 1 : -1;
    const double share = random.between(0.4, 0.9) * side;
    box.centre = box.toImage(along ? cv::Point2d(share * box.length, random.between(-0.2, 0.2) * box.width)
                                   : cv::Point2d(random.between(-0.2, 0.2) * box.length, share * box.width));
    return box;
}

}  // namespace

cv::Mat cutWindow(const cv::Mat& gray, const OrientedBox& vehicle, const WindowFit& fit) {
    CV_Assert(gray.type() == CV_8UC1 && !gray.empty());
    const bool usable = std::isfinite(vehicle.centre.x) && std::isfinite(vehicle.centre.y) && vehicle.length > 0 &&
                        vehicle.width > 0 && vehicle.length < 1e5 && vehicle.width < 1e5 &&
                        std::abs(vehicle.centre.x) < 1e5 && std::abs(vehicle.centre.y) < 1e5 &&
                        std::isfinite(vehicle.heading);
    if (!usable) throw Error(ErrorKind::input, "a labelled box has no usable place or size");
    const double across = vehicle.width / fit.width;  // image px per window px
    const double along = vehicle.length / fit.length;
    // Finer first, then averaged, so that large vehicles are not sampled with gaps.
    const int finer = std::clamp(static_cast<int>(std::ceil(std::max(across, along) - 0.25)), 1, kFinest);
    const cv::Point2d ahead = vehicle.direction();
    const cv::Point2d right(-ahead.y, ahead.x);
    const cv::Point2d step_x = right * (across / finer);
    const cv::Point2d step_y = -ahead * (along / finer);
    const cv::Size size(kWindowWidth * finer, kWindowHeight * finer);
    const cv::Point2d origin = vehicle.centre - step_x * ((size.width - 1) / 2.0) - step_y * ((size.height - 1) / 2.0);
    const cv::Matx23d image_from_window(step_x.x, step_y.x, origin.x, step_x.y, step_y.y, origin.y);
    cv::Mat fine;
    cv::warpAffine(gray, fine, image_from_window, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
    if (finer == 1) return fine;
    cv::Mat window;
    cv::resize(fine, window, cv::Size(kWindowWidth, kWindowHeight), 0, 0, cv::INTER_AREA);
    return window;
}

OrientedBox medianVehicle(const std::vector<OrientedBox>& vehicles) {
    OrientedBox median;
    if (vehicles.empty()) return median;
    const auto middleOf = [&](double OrientedBox::*side) {
        std::vector<double> values;
        for (const OrientedBox& box : vehicles) values.push_back(box.*side);
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    };
    median.length = middleOf(&OrientedBox::length);
    median.width = middleOf(&OrientedBox::width);
    return median;
}

SampleSet samplesFromImage(const LabelledImage& image, int others, const OrientedBox& typical, std::uint64_t seed,
                           const SampleCutting& cutting) {
    SeededRandom random(seed);
    SampleSet samples;
    const auto add = [&](const OrientedBox& box, bool vehicle) {
        samples.push_back({cutWindow(image.gray, box, cutting.fit), vehicle, image.source, image.group, false});
    };
    const auto in_image = [&](const OrientedBox& box) {
        return areaInImage(box, image.gray.size()) > 0.95 * box.area();
    };
    for (const OrientedBox& box : image.vehicles) {
        if (in_image(box)) add(box, true);
    }
    const OrientedBox size = image.vehicles.empty() ? typical : medianVehicle(image.vehicles);
    int taken = 0;
    for (int attempt = 0; attempt < kAttempts * others && taken < others; ++attempt) {
        const bool near = cutting.beside_vehicles && taken % kNearEvery == 0 && !image.vehicles.empty();
        OrientedBox box = size;
        if (near) {
            const auto which = static_cast<std::size_t>(random.below(static_cast<int>(image.vehicles.size())));
            box = pushedAside(image.vehicles[which], random);
        } else {
            box.centre = {random.uniform() * image.gray.cols, random.uniform() * image.gray.rows};
            box.heading = random.between(-kPi, kPi);
        }
        const bool vehicle = near ? overlapsMore(box, image.vehicles, kNearestOverlap)
                                  : covered(box, image.vehicles, cutting.most_covered);
        if (!in_image(box) || vehicle || covered(box, image.unclear, cutting.most_covered)) continue;
        add(box, false);
        ++taken;
    }
    return samples;
}

}  // namespace eyrie

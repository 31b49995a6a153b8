#pragma once

#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/geometry/oriented_box.h"

namespace eyrie::test {

/// Cars with a dark windscreen near their front on plain ground, the last one on top, with noise of one grey level.
inline cv::Mat drawnCars(const std::vector<OrientedBox>& cars, std::uint64_t seed = 7, cv::Size size = {400, 300}) {
    constexpr int kFine = 4;
    cv::Mat fine(size * kFine, CV_8UC1, cv::Scalar(90));
    const auto fill = [&](const OrientedBox& box, int level) {
        std::vector<cv::Point> corners;
        for (const cv::Point2d& c : box.corners())
            corners.emplace_back(cvRound((c.x + 0.5) * kFine - 0.5), cvRound((c.y + 0.5) * kFine - 0.5));
        cv::fillConvexPoly(fine, corners, cv::Scalar(level));
    };
    for (const OrientedBox& car : cars) {
        fill(car, 190);
        OrientedBox screen = car.scaled(0.2, 0.8);
        screen.centre = car.toImage({0.2 * car.length, 0});
        fill(screen, 30);
    }
    cv::Mat image;
    cv::resize(fine, image, size, 0, 0, cv::INTER_AREA);
    cv::Mat noise(size, CV_8UC1);
    cv::RNG random(seed);
    random.fill(noise, cv::RNG::UNIFORM, 0, 3);
    return image + noise;
}

}  // namespace eyrie::test

// How alike a place looks: the correlation done plainly, and the limits of what is looked for.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/geometry/angle.h"
#include "tracking/drawn_cars.h"
#include "tracking/vehicle_template.h"

namespace eyrie::look_reference_test {
namespace {

using test::drawnCars;

/// Grey value between pixels of a CV_8UC1 picture, its border repeated.
double between(const cv::Mat& gray, cv::Point2d p) {
    const auto at = [&](int x, int y) {
        return double(gray.at<uchar>(std::clamp(y, 0, gray.rows - 1), std::clamp(x, 0, gray.cols - 1)));
    };
    const int x = int(std::floor(p.x)), y = int(std::floor(p.y));
    const double fx = p.x - x, fy = p.y - y;
    return (1 - fy) * ((1 - fx) * at(x, y) + fx * at(x + 1, y)) +
           fy * ((1 - fx) * at(x, y + 1) + fx * at(x + 1, y + 1));
}

/// Of a box and a strip of a tenth of its size, at least a px, about it: samples in its axes, `step` px apart.
std::vector<double> samplesOf(const cv::Mat& gray, OrientedBox at, const OrientedBox& taken, double step,
                              double zoom = 1) {
    const int along = cvRound((taken.length + 2 * std::max(1.0, 0.1 * taken.length)) / step);
    const int across = cvRound((taken.width + 2 * std::max(1.0, 0.1 * taken.width)) / step);
    std::vector<double> samples;
    for (int y = 0; y < along; ++y) {
        for (int x = 0; x < across; ++x)
            samples.push_back(between(
                gray, at.toImage({-(y - (along - 1) / 2.0) * step * zoom, (x - (across - 1) / 2.0) * step * zoom})));
    }
    return samples;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    double mean_a = 0, mean_b = 0, ab = 0, aa = 0, bb = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        mean_a += a[i] / double(a.size());
        mean_b += b[i] / double(a.size());
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
        ab += (a[i] - mean_a) * (b[i] - mean_b);
        aa += std::pow(a[i] - mean_a, 2);
        bb += std::pow(b[i] - mean_b, 2);
    }
    return ab / std::sqrt(aa * bb);
}

/// A smooth pattern that looks different everywhere.
cv::Mat pattern(std::uint64_t seed, cv::Size size = {400, 300}) {
    cv::Mat noise(size, CV_8UC1), smooth;
    cv::RNG(seed).fill(noise, cv::RNG::UNIFORM, 0, 256);
    cv::GaussianBlur(noise, smooth, {}, 3);
    cv::normalize(smooth, smooth, 0, 255, cv::NORM_MINMAX);
    return smooth;
}

}  // namespace

TEST(LookReference, AgreementsArePlainCorrelations) {
    const cv::Mat before = pattern(1);
    cv::Mat now;
    cv::addWeighted(before, 0.6, pattern(2), 0.4, 0, now);
    for (const OrientedBox& box :
         {OrientedBox{{150, 120}, 24, 12, 0}, {{210, 160}, 30, 14, 2.1}, {{200, 150}, 90, 40, -0.6}}) {
        const double step = std::max(1.0, std::sqrt(box.area() / 450));
        const auto look = VehicleTemplate::of(before, box);
        ASSERT_TRUE(look);
        for (const double zoom : {1.0, 1.25}) {
            OrientedBox expected = box;
            expected.length *= zoom;
            expected.width *= zoom;
            const auto match = look->find(now, expected, 1);
            ASSERT_TRUE(match);
            const auto own = samplesOf(before, box, box, step);
            // One step to either side is looked at; the best of these nine places, in steps.
            const double apart = step * zoom;
            double best = -1;
            cv::Point2d place;
            for (int k = 0; k < 9; ++k) {
                OrientedBox there = expected;
                there.centre = expected.toImage({(1 - k / 3) * apart, (k % 3 - 1) * apart});
                const double agreement = correlation(own, samplesOf(now, there, box, step, zoom));
                if (agreement <= best) continue;
                best = agreement;
                place = there.centre;
            }
            EXPECT_NEAR(match->agreement, best, 0.02) << box.length << ", " << zoom;
            EXPECT_LT(std::hypot(match->centre.x - place.x, match->centre.y - place.y), 0.75 * apart);
            // Half a vehicle to each side of the best place.
            double beside = -1;
            for (const cv::Point2d off : {cv::Point2d(0, 1), {0, -1}, {1, 0}, {-1, 0}}) {
                OrientedBox there = expected;
                there.centre = place;
                there.centre = there.toImage({off.x * std::max(1, cvRound(expected.length / 2 / apart)) * apart,
                                              off.y * std::max(1, cvRound(expected.width / 2 / apart)) * apart});
                beside = std::max(beside, correlation(own, samplesOf(now, there, box, step, zoom)));
            }
            EXPECT_NEAR(match->beside, beside, 0.03) << box.length << ", " << zoom;
        }
    }
}

TEST(LookReference, PlacesAreToldBetweenPixels) {
    const OrientedBox box{{150, 120}, 24, 12, 0.3};
    const cv::Mat before = pattern(3);
    const auto look = VehicleTemplate::of(before, box);
    ASSERT_TRUE(look);
    for (const cv::Point2d shift : {cv::Point2d(0.3, -0.2), {-0.4, 0.4}, {1.7, 0.25}, {-2.3, -1.6}}) {
        cv::Mat now;
        cv::warpAffine(before, now, cv::Matx23d(1, 0, shift.x, 0, 1, shift.y), before.size(), cv::INTER_CUBIC);
        const auto match = look->find(now, box, 4);
        ASSERT_TRUE(match);
        EXPECT_NEAR(match->centre.x, box.centre.x + shift.x, 0.15) << shift;
        EXPECT_NEAR(match->centre.y, box.centre.y + shift.y, 0.15) << shift;
    }
}

TEST(LookReference, ALookHasFourGreyLevelsOfContrastAndFourPixelsOfSide) {
    // Halves that differ by 2 a deviate by a.
    const auto striped = [](double a) {
        cv::Mat gray(80, 80, CV_8UC1, cv::Scalar(100));
        gray.colRange(0, 40).setTo(100 + 2 * a);
        return gray;
    };
    const OrientedBox box{{39.5, 40}, 20, 10, 0};
    EXPECT_TRUE(VehicleTemplate::of(striped(4), box));
    EXPECT_FALSE(VehicleTemplate::of(striped(3.5), box));
    const auto look = VehicleTemplate::of(striped(40), box);
    ASSERT_TRUE(look);
    EXPECT_TRUE(look->find(striped(4.5), box, 1));
    EXPECT_FALSE(look->find(striped(3.5), box, 1));
    EXPECT_TRUE(VehicleTemplate::of(striped(40), {{39.5, 40}, 20, 4.01, 0}));
    EXPECT_FALSE(VehicleTemplate::of(striped(40), {{39.5, 40}, 20, 3.99, 0}));
    EXPECT_FALSE(VehicleTemplate::of(striped(40), {{39.5, 40}, 3.99, 20, 0}));
    // A thousandth of it may lie outside.
    EXPECT_TRUE(VehicleTemplate::of(striped(40), {{39.5, 4.5}, 20, 10, 0}));
    EXPECT_FALSE(VehicleTemplate::of(striped(40), {{39.5, 4.45}, 20, 10, 0}));
    EXPECT_FALSE(look->find(striped(40), {{39.5, 75}, 20, 10, 0}, 1));
}

TEST(LookReference, IsLookedForUpToAZoomOfTwoAndSixtyFourPixels) {
    const OrientedBox car{{200, 150}, 24, 12, 0};
    const auto look = VehicleTemplate::of(drawnCars({car}), car);
    ASSERT_TRUE(look);
    const auto found = [&](double zoom) {
        OrientedBox now = car;
        now.length *= zoom;
        now.width *= zoom;
        return look->find(drawnCars({now}), now, 1).has_value();
    };
    EXPECT_TRUE(found(1.98));
    EXPECT_FALSE(found(2.02));
    EXPECT_TRUE(found(1 / 1.98));
    EXPECT_FALSE(found(1 / 2.02));
    OrientedBox expected = car;
    for (const double away : {64, 68}) {
        expected.centre.x = car.centre.x - away;
        const auto match = look->find(drawnCars({car}, 8), expected, 500);
        EXPECT_EQ(match && match->agreement > 0.9, away == 64) << away;
    }
    // A reach below a pixel is one.
    expected.centre.x = car.centre.x - 1;
    const auto match = look->find(drawnCars({car}, 8), expected, 0);
    ASSERT_TRUE(match);
    EXPECT_GT(match->agreement, 0.9);
}

}  // namespace eyrie::look_reference_test

#include "learning/training/background_mining.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/geometry/angle.h"
#include "learning/drawn_windows.h"
#include "learning/training/trainer.h"

namespace eyrie::background_mining_test {
namespace {

const VehicleModel& barModel() {
    static const VehicleModel model = [] {
        TrainingOptions options;
        options.classifier_options.trees = 60;
        options.hard_negative_rounds = 1;
        return *trainModel(test::drawnSamples(80, 240, 1), options, {});
    }();
    return model;
}

/// Flat ground with bright bars like those of the samples, 21 × 9 px times `size`; the first is labelled.
LabelledImage barsAt(const std::vector<cv::Point2d>& places, double heading, double size) {
    LabelledImage image;
    image.gray = cv::Mat(260, 340, CV_8UC1, cv::Scalar(120));
    image.source = "bars";
    image.group = "drawn";
    for (const cv::Point2d& place : places) {
        const OrientedBox box{place, 21 * size, 9 * size, heading};
        std::vector<cv::Point> corners;
        for (const cv::Point2d c : box.corners()) corners.emplace_back(cvRound(16 * c.x), cvRound(16 * c.y));
        cv::fillConvexPoly(image.gray, corners, cv::Scalar(230), cv::LINE_AA, 4);
    }
    image.vehicles = {{places.front(), 21.5 * size, 10 * size, heading}};
    return image;
}

double brightShare(const cv::Mat& part) {
    return static_cast<double>(cv::countNonZero(part > 200)) / static_cast<double>(part.total());
}

TEST(BackgroundMining, FindsWhatLooksLikeAVehicleAndIsNone) {
    for (const double size : {1.0, 1.6}) {
        for (const double heading : {0.0, 0.7, -1.9}) {
            const LabelledImage image = barsAt({{90, 80}, {240, 180}}, heading, size);
            const cv::Mat before = image.gray.clone();
            const SampleSet found = mineBackground(barModel(), {image}, {}, 50, 1);
            EXPECT_EQ(cv::norm(image.gray, before, cv::NORM_INF), 0) << "searching changes no picture";
            ASSERT_FALSE(found.empty()) << heading;
            // The surest shows the whole second bar, upright: 9 × 21 px in the middle of the window.
            EXPECT_GT(brightShare(found[0].window(cv::Rect(5, 8, 6, 16))), 0.9) << heading;
            EXPECT_NEAR(brightShare(found[0].window), 9 * 21 / 512., 0.08) << heading;
            EXPECT_FALSE(found[0].vehicle);
            EXPECT_EQ(found[0].source, "bars");
            EXPECT_EQ(found[0].group, "drawn");
            EXPECT_LE(mineBackground(barModel(), {image}, {}, 1, 1).size(), 1U);
            for (std::size_t i = 1; i < found.size(); ++i)
                EXPECT_LE(barModel().decide(found[i].window), barModel().decide(found[0].window) + 3) << i;
        }
    }
}

TEST(BackgroundMining, LeavesVehiclesAndUnclearAreasAlone) {
    LabelledImage image = barsAt({{90, 80}, {240, 180}}, 0.4, 1);
    const auto whole = [&] {
        int count = 0;
        for (const Sample& sample : mineBackground(barModel(), {image}, {}, 100, 1))
            count += brightShare(sample.window(cv::Rect(5, 8, 6, 16))) > 0.9 ? 1 : 0;
        return count;
    };
    EXPECT_GE(whole(), 1);
    image.unclear = {{{240, 180}, 30, 20, 0}};
    EXPECT_EQ(whole(), 0);
    image.unclear.clear();
    image.vehicles.push_back({{240, 180}, 21.5, 10, 0.4});
    EXPECT_EQ(whole(), 0);
}

TEST(BackgroundMining, TakesNothingFromBeyondThePicture) {
    // A bar of which half is outside: its window would be half made up.
    for (const cv::Point2d place :
         {cv::Point2d(0, 180), cv::Point2d(339, 60), cv::Point2d(200, 0), cv::Point2d(200, 259)}) {
        const LabelledImage image = barsAt({{170, 130}, place}, place.x == 200 ? kPi / 2 : 0, 1);
        for (const Sample& sample : mineBackground(barModel(), {image}, {}, 100, 1))
            EXPECT_LT(brightShare(sample.window(cv::Rect(5, 8, 6, 16))), 0.9) << place;
    }
}

TEST(BackgroundMining, TakesTheTypicalVehicleWhereNoneIsLabelled) {
    LabelledImage image = barsAt({{170, 130}}, 0, 1);
    image.vehicles.clear();
    EXPECT_TRUE(mineBackground(barModel(), {image}, {}, 10, 1).empty()) << "of no size nothing can be looked for";
    EXPECT_FALSE(mineBackground(barModel(), {image, barsAt({{90, 80}, {240, 180}}, 0.4, 1)}, {}, 10, 1).empty())
        << "but the next one is looked at";
    // Headings are drawn at random; in one of many images one fits.
    const std::vector<LabelledImage> many(12, image);
    EXPECT_FALSE(mineBackground(barModel(), many, {{0, 0}, 21.5, 10, 0}, 100, 1).empty());
}

}  // namespace
}  // namespace eyrie::background_mining_test

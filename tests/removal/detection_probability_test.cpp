#include "removal/detection_probability.h"

#include <gtest/gtest.h>

#include <cmath>

namespace eyrie::detection_probability_test {
namespace {

/// The ground goes 2 px/frame to the right through the picture.
FrameMotion flyingMotion() {
    FrameMotion motion;
    motion.image_size = {800, 600};
    motion.registration.state = RegistrationState::registered;
    motion.registration.current_from_previous.matrix(0, 2) = 2;
    return motion;
}

Detection vehicleAtWork() {
    Detection detection;
    detection.box = {{400, 300}, 20, 10, 0};
    detection.velocity = {0, 4};
    detection.complete = true;
    detection.score = 1.2;
    detection.vectors = {1, 2, 3, 4, 5, 6};
    return detection;
}

double probabilityOf(const Detection& detection) {
    std::vector<Detection> one{detection};
    judgeDetections(one, flyingMotion());
    return one.front().probability;
}

}  // namespace

TEST(DetectionProbability, IsHighForWhatLooksAndMovesLikeAVehicle) {
    EXPECT_GT(probabilityOf(vehicleAtWork()), 0.8);
    EXPECT_LE(probabilityOf(vehicleAtWork()), 1);
}

TEST(DetectionProbability, FallsWithWhatSpeaksAgainstIt) {
    Detection segment = vehicleAtWork();
    segment.complete = false;
    EXPECT_LT(probabilityOf(segment), probabilityOf(vehicleAtWork()));
    Detection unsure = vehicleAtWork();
    unsure.score = 0.1;
    EXPECT_LT(probabilityOf(unsure), probabilityOf(vehicleAtWork()));
    Detection slow = segment;
    slow.velocity = {0, 0.3};
    EXPECT_LT(probabilityOf(slow), probabilityOf(segment)) << "a house under a moving camera";
}

TEST(DetectionProbability, IsTheLogisticSumOfWhatWasLearned) {
    // ln(1 + 2 px of flow) = 1.0986, ln(1 + 6 vectors) = 1.9459; ratios are of the own speed to 2.05 px.
    const auto withOf = [](bool whole, double score, cv::Point2d velocity) {
        Detection detection = vehicleAtWork();
        detection.complete = whole;
        detection.score = score;
        detection.velocity = velocity;
        return probabilityOf(detection);
    };
    // −4.776 + 1.027 + .342 · 1.2 + 2.203 · 1.9459 − 1.546 · 1.0986 + 1.394 · 1.0986 · 1.5 + 2.137 · 1.0986 = 3.8947
    EXPECT_NEAR(withOf(true, 1.2, {0, 4}), 0.9801, 1e-4) << "beyond 1.5 a ratio tells nothing more";
    // Without 1.027, .342 · 1.2 and the last, but −.127 · 1.2, .867 · 1.0986 and a ratio of .7317: −.2669
    EXPECT_NEAR(withOf(false, 1.2, {-1.5, 0}), 0.4337, 1e-4) << "against the flow";
    EXPECT_NEAR(withOf(false, 1.2, {-0.75, 0.75 * std::sqrt(3)}), 0.3223, 1e-4) << "half against it";
    EXPECT_NEAR(withOf(false, 1.2, {-2.5, 0}), 0.3841, 1e-4) << "too fast to be a thing that stands";
    EXPECT_NEAR(withOf(true, 9, {0, 4}), withOf(true, 3, {0, 4}), 1e-12);
    EXPECT_NEAR(withOf(false, 9, {0, 4}), withOf(false, 3, {0, 4}), 1e-12);
    EXPECT_NEAR(withOf(true, -2, {0, 4}), withOf(true, 0, {0, 4}), 1e-12);
    // 6 px of flow count as 4; a ratio of 4 / 6.05: −1.546, 1.394 · .6612 and 2.137 times 1.6094, a decision of
    // 3: 3.9984
    FrameMotion fast = flyingMotion();
    fast.registration.current_from_previous.matrix(0, 2) = 6;
    std::vector<Detection> one{vehicleAtWork()};
    one[0].score = 5;
    judgeDetections(one, fast);
    EXPECT_NEAR(one[0].probability, 0.9820, 1e-4);
    // Under a camera that stands nothing is told by motion: −4.776 − .127 + 2.203 · 1.9459 = −.6162
    fast.registration.current_from_previous.matrix(0, 2) = 0;
    one = {vehicleAtWork()};
    one[0].complete = false;
    one[0].score = 1;
    judgeDetections(one, fast);
    EXPECT_NEAR(one[0].probability, 0.3507, 1e-4);
}

TEST(DetectionProbability, WhatWasRejectedHasNone) {
    Detection rejected = vehicleAtWork();
    rejected.rejection = Rejection::outlier;
    EXPECT_TRUE(std::isnan(probabilityOf(rejected)));
    EXPECT_EQ(shownScore(rejected), rejected.score);
    std::vector<Detection> kept{vehicleAtWork()};
    judgeDetections(kept, flyingMotion());
    EXPECT_EQ(shownScore(kept.front()), kept.front().probability);
}

}  // namespace eyrie::detection_probability_test

#include "removal/detection_probability.h"

#include <gtest/gtest.h>

#include <cmath>

namespace eyrie {
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

TEST(DetectionProbability, WhatWasRejectedHasNone) {
    Detection rejected = vehicleAtWork();
    rejected.rejection = Rejection::outlier;
    EXPECT_TRUE(std::isnan(probabilityOf(rejected)));
    EXPECT_EQ(shownScore(rejected), rejected.score);
    std::vector<Detection> kept{vehicleAtWork()};
    judgeDetections(kept, flyingMotion());
    EXPECT_EQ(shownScore(kept.front()), kept.front().probability);
}

}  // namespace eyrie

#include "core/labels/result_box.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/evidence/classified_box.h"

namespace eyrie::result_box_test {
namespace {

const OrientedBox kBox{{30, 40}, 20, 10, 0.5};

TEST(ResultBox, aStateIsTheBoxOfATrack) {
    TrackState state;
    state.id = 7;
    state.box = kBox;
    state.velocity = {2, -1};
    state.origin = StateOrigin::standing;
    state.score = 0.25;
    const BoxRecord record = boxOf(12, state);
    EXPECT_EQ(record.frame, 12);
    EXPECT_EQ(record.id, 7);
    EXPECT_EQ(record.box.centre, kBox.centre);
    EXPECT_EQ(record.box.heading, kBox.heading);
    EXPECT_EQ(record.velocity, cv::Point2d(2, -1));
    EXPECT_EQ(record.origin, StateOrigin::standing);
    EXPECT_EQ(record.score, 0.25);
    EXPECT_TRUE(record.object_class.empty());
}

TEST(ResultBox, aDetectionIsABoxOfNoTrackWithTheScoreThatIsShown) {
    Detection detection;
    detection.box = kBox;
    detection.velocity = {2, -1};
    detection.score = 1.5;
    EXPECT_EQ(boxOf(12, detection).score, 1.5);
    detection.probability = 0.75;
    const BoxRecord record = boxOf(12, detection);
    EXPECT_EQ(record.frame, 12);
    EXPECT_FALSE(record.id);
    EXPECT_EQ(record.box.centre, kBox.centre);
    EXPECT_EQ(record.box.length, kBox.length);
    EXPECT_EQ(record.velocity, cv::Point2d(2, -1));
    EXPECT_EQ(record.score, 0.75);
}

TEST(ClassifiedBox, IsAKeptDetectionOfWhichTheClassifierSaysSomething) {
    Detection whole, looked_at, plain, fused;
    whole.complete = true;
    whole.box = kBox;
    looked_at.decision = -2.5;
    fused.complete = true;
    fused.decision = 4;
    fused.rejection = Rejection::duplicate;
    const auto boxes = classifiedOf({plain, whole, fused, looked_at, plain});
    ASSERT_EQ(boxes.size(), 2U);
    EXPECT_TRUE(boxes[0].whole);
    EXPECT_EQ(boxes[0].box.centre, kBox.centre);
    EXPECT_TRUE(std::isnan(boxes[0].decision));
    EXPECT_FALSE(boxes[1].whole);
    EXPECT_EQ(boxes[1].decision, -2.5);
}

}  // namespace
}  // namespace eyrie::result_box_test

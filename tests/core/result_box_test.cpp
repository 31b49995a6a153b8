#include "core/labels/result_box.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace eyrie::result_box_test

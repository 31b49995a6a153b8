#include "evaluation/measures/score_curve.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"

namespace eyrie::score_curve_test {
namespace {

BoxRecord trackBox(FrameIndex frame, int id, double x, double score) {
    BoxRecord record;
    record.frame = frame;
    record.id = id;
    record.box = {{x, 50}, 20, 10, 0};
    record.score = score;
    return record;
}

/// Two vehicles in ten frames.
BoxesByFrame twoVehicles() {
    BoxesByFrame boxes;
    for (int frame = 0; frame < 10; ++frame) {
        boxes[frame] = {trackBox(frame, 1, 50, 1), trackBox(frame, 2, 150, 1)};
    }
    return boxes;
}

/// Track 1 is sure and true, 2 false, 3 unsure and true in half of the frames.
BoxesByFrame threeTracks() {
    BoxesByFrame boxes;
    for (int frame = 0; frame < 10; ++frame) {
        boxes[frame] = {trackBox(frame, 1, 50, 0.9), trackBox(frame, 2, 300, 0.6)};
        if (frame < 5) boxes[frame].push_back(trackBox(frame, 3, 150, 0.3));
    }
    return boxes;
}

}  // namespace

TEST(ScoreCurve, HasAPointForEveryScore) {
    const auto curve = scoreCurve(twoVehicles(), threeTracks(), {});
    ASSERT_EQ(curve.size(), 3U);
    EXPECT_DOUBLE_EQ(curve[0].threshold, 0.3);
    EXPECT_EQ(curve[0].tracks, 3);
    EXPECT_EQ(curve[0].detection.true_positives, 15);
    EXPECT_EQ(curve[0].detection.false_positives, 10);
    EXPECT_EQ(curve[0].detection.false_negatives, 5);
    EXPECT_DOUBLE_EQ(curve[0].detection.precision, 0.6);
    EXPECT_DOUBLE_EQ(curve[0].detection.recall, 0.75);
    EXPECT_DOUBLE_EQ(curve[1].threshold, 0.6);
    EXPECT_EQ(curve[1].tracks, 2);
    EXPECT_DOUBLE_EQ(curve[1].detection.precision, 0.5);
    EXPECT_DOUBLE_EQ(curve[1].detection.recall, 0.5);
    EXPECT_DOUBLE_EQ(curve[2].threshold, 0.9);
    EXPECT_EQ(curve[2].tracks, 1);
    EXPECT_DOUBLE_EQ(curve[2].detection.precision, 1);
    EXPECT_DOUBLE_EQ(curve[2].detection.recall, 0.5);
}

TEST(ScoreCurve, RecallNeverGrowsAndTheFirstPointIsTheWholeResult) {
    BoxesByFrame result;
    for (int frame = 0; frame < 10; ++frame) {
        for (int id = 0; id < 400; ++id) {
            result[frame].push_back(trackBox(frame, id, id == 7 ? 50 : id == 300 ? 150 : 1000 + 40 * id, id / 400.0));
        }
    }
    const auto curve = scoreCurve(twoVehicles(), result, {}, 20);
    ASSERT_EQ(curve.size(), 20U);
    EXPECT_EQ(curve.front().tracks, 400);
    EXPECT_DOUBLE_EQ(curve.front().threshold, 0);
    EXPECT_DOUBLE_EQ(curve.back().threshold, 399 / 400.0);
    EXPECT_EQ(curve.back().tracks, 1);
    for (std::size_t i = 1; i < curve.size(); ++i) {
        EXPECT_GT(curve[i].threshold, curve[i - 1].threshold);
        EXPECT_LE(curve[i].detection.recall, curve[i - 1].detection.recall);
        EXPECT_NEAR(curve[i - 1].tracks - curve[i].tracks, 21, 2);
    }
}

TEST(ScoreCurve, OfNothingIsEmptyAndRefusesWhatIsNoNumber) {
    EXPECT_TRUE(scoreCurve(twoVehicles(), {}, {}).empty());
    BoxesByFrame odd{{0, {trackBox(0, 1, 50, std::numeric_limits<double>::quiet_NaN())}}};
    EXPECT_THROW(scoreCurve(twoVehicles(), odd, {}), Error);
    EvaluationOptions wrong;
    wrong.overlap = 0;
    EXPECT_THROW(scoreCurve(twoVehicles(), threeTracks(), wrong), Error);
}

}  // namespace eyrie::score_curve_test

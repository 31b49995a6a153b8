#include "evaluation/comparison/method_difference.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "evaluation/evaluate.h"

namespace eyrie::method_difference_test {
namespace {

/// Ten cars for twenty frames.
BoxesByFrame truth() {
    BoxesByFrame boxes;
    for (int frame = 0; frame < 20; ++frame) {
        for (int id = 0; id < 10; ++id) {
            BoxRecord record;
            record.frame = frame;
            record.id = id;
            record.box = {{50.0 * id, 40.0 + frame}, 20, 10, 0};
            boxes[frame].push_back(record);
        }
    }
    return boxes;
}

/// The truth without some cars, and with false boxes in every frame.
BoxesByFrame result(int missing, int false_boxes) {
    BoxesByFrame boxes = truth();
    for (auto& [frame, records] : boxes) {
        records.erase(records.begin(), records.begin() + missing);
        for (int i = 0; i < false_boxes; ++i) {
            BoxRecord record;
            record.frame = frame;
            record.id = 100 + i;
            record.box = {{50.0 * i, 400}, 20, 10, 0};
            records.push_back(record);
        }
    }
    return boxes;
}

PairedTallies tallied(const BoxesByFrame& boxes) {
    EvaluationOptions options;
    options.overlap = 0.5;
    const Measures measures = evaluateAt({0.5}, truth(), boxes, options).front();
    return pairedTallies(truth(), matchFrames(truth(), boxes, options), &measures.tracks, {0, 19}, 5);
}

}  // namespace

TEST(MethodDifference, CountsByTrackAndByTime) {
    const PairedTallies tallies = tallied(result(2, 1));
    ASSERT_EQ(tallies.units.size(), 10U + 4U);
    EXPECT_TRUE(tallies.has_switches);
    EXPECT_EQ(tallies.units[0].missed, 20);
    EXPECT_EQ(tallies.units[1].missed, 20);
    EXPECT_EQ(tallies.units[2].matched, 20);
    for (std::size_t block = 10; block < 14; ++block) EXPECT_EQ(tallies.units[block].false_positives, 5);
    // 160 hits, 40 misses, 20 false boxes.
    EXPECT_NEAR(fScoreInterval(tallies).value, 320.0 / 380, 1e-12);
}

TEST(MethodDifference, SwitchesBelongToTheirObjectAndFalseBoxesToTheirTime) {
    BoxesByFrame boxes = truth();
    for (int frame = 7; frame < 20; ++frame) boxes[frame][3].id = 44;
    for (const int frame : {0, 4, 5, 19}) {
        boxes[frame].push_back(boxes[frame][0]);
        boxes[frame].back().id = 77;
        boxes[frame].back().box.centre.y = 300;
    }
    const PairedTallies tallies = tallied(boxes);
    for (std::size_t unit = 0; unit < 10; ++unit) EXPECT_EQ(tallies.units[unit].switches, unit == 3 ? 1 : 0) << unit;
    std::vector<double> false_boxes;
    for (std::size_t block = 10; block < 14; ++block) false_boxes.push_back(tallies.units[block].false_positives);
    EXPECT_EQ(false_boxes, (std::vector<double>{2, 1, 0, 1})) << "blocks of five frames";
    const MethodDifference difference = methodDifference(tallied(truth()), tallies);
    ASSERT_TRUE(difference.mota);
    EXPECT_NEAR(difference.mota->value, 5.0 / 200, 1e-12);
}

TEST(MethodDifference, FramesWithoutTruthOrWithoutHitsCountToo) {
    BoxesByFrame boxes = truth();
    boxes[3].clear();
    const PairedTallies tallies = tallied(boxes);
    for (std::size_t unit = 0; unit < 10; ++unit) {
        EXPECT_EQ(tallies.units[unit].missed, 1) << unit;
        EXPECT_EQ(tallies.units[unit].matched, 19) << unit;
    }
    // A frame that the truth does not name, of which all is false.
    FrameMatch beyond;
    beyond.frame = 12;
    beyond.false_results = {0, 1};
    const PairedTallies false_only = pairedTallies(truth(), {beyond}, nullptr, {0, 100}, 5);
    EXPECT_EQ(false_only.units[10 + 12 / 5].false_positives, 2);
}

TEST(MethodDifference, OfEqualResultsIsExactlyZero) {
    const PairedTallies tallies = tallied(result(2, 1));
    const MethodDifference difference = methodDifference(tallies, tallies);
    EXPECT_EQ(difference.f_score.value, 0);
    EXPECT_EQ(difference.f_score.low, 0);
    EXPECT_EQ(difference.f_score.high, 0);
    ASSERT_TRUE(difference.mota);
    EXPECT_EQ(difference.mota->high, 0);
}

TEST(MethodDifference, IsSureWhereOneIsBetterEverywhere) {
    // The same cars missed, one false box a frame less: whichever tracks are drawn, it is better.
    const MethodDifference difference = methodDifference(tallied(result(2, 0)), tallied(result(2, 2)));
    EXPECT_NEAR(difference.f_score.value, 320.0 / 360 - 320.0 / 400, 1e-12);
    EXPECT_GT(difference.f_score.low, 0);
    EXPECT_NEAR(difference.mota->value, 40.0 / 200, 1e-12);
    // One car more of ten: the interval includes no difference.
    const MethodDifference unsure = methodDifference(tallied(result(0, 0)), tallied(result(1, 0)));
    EXPECT_GT(unsure.f_score.value, 0);
    EXPECT_LE(unsure.f_score.low, 0);
}

TEST(MethodDifference, DetectionsHaveNoMota) {
    EvaluationOptions options;
    const BoxesByFrame boxes = result(1, 0);
    const PairedTallies without = pairedTallies(truth(), matchFrames(truth(), boxes, options), nullptr, {0, 19}, 5);
    EXPECT_FALSE(methodDifference(without, tallied(boxes)).mota);
}

TEST(MethodDifference, RefusesDifferentGroundTruth) {
    const PairedTallies a = tallied(result(1, 0));
    PairedTallies b = a;
    b.units.pop_back();
    EXPECT_THROW(methodDifference(a, b), Error);
    EXPECT_THROW(methodDifference({}, {}), Error);
}

}  // namespace eyrie::method_difference_test

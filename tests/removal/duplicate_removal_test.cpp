#include "removal/duplicate_removal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/geometry/angle.h"
#include "removal/vectors_in_boxes.h"

namespace eyrie::duplicate_removal_test {
namespace {

using namespace test;

DuplicateRemovalOptions withoutParts() {
    DuplicateRemovalOptions options;
    options.parts.join_parts = false;
    return options;
}

int kept(const std::vector<Detection>& detections) {
    int count = 0;
    for (const Detection& d : detections) count += d.rejection == Rejection::none;
    return count;
}

TEST(DuplicateRemoval, FusesAPartIntoTheWhole) {
    FrameMotion motion = sparseMotion();
    fill(motion, {{100, 100}, 18, 7, 0}, 10, {1.02, 0});
    // 8 × 6 around (94, 100): from 90 to 98, the whole from 91 to 109: 7 of 8 px inside.
    const auto found =
        removeDuplicates({detection(100, 100, 18, 7), detection(94, 100, 8, 6)}, motion, withoutParts(), kScale);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].rejection, Rejection::none);
    EXPECT_EQ(found[1].rejection, Rejection::duplicate);
    EXPECT_NEAR(found[0].box.length, 19, 1e-9);  // 90 … 109
    EXPECT_EQ(found[0].vectors.size(), 10U);
    EXPECT_NEAR(found[0].velocity.x, 1.02, 1e-6) << "from exactly the vectors inside";
}

TEST(DuplicateRemoval, KeepsNeighboursThatOverlapALittle) {
    const FrameMotion motion = sparseMotion();
    const std::vector<Detection> queue = {detection(100, 100, 18, 7), detection(114, 100, 18, 7)};  // 22 % inside
    EXPECT_EQ(kept(removeDuplicates(queue, motion, withoutParts(), kScale)), 2);
    DuplicateRemovalOptions loose = DuplicateRemovalOptions::thesis();
    loose.threshold = 0.1;  // 4 / (18 + 18 − 4) = 0.125
    EXPECT_EQ(kept(removeDuplicates(queue, motion, loose, kScale)), 1);
}

TEST(DuplicateRemoval, BoxesThatTouchAtTheirFarthestAreCompared) {
    const FrameMotion motion = sparseMotion();
    DuplicateRemovalOptions options = DuplicateRemovalOptions::thesis();
    options.threshold = 0.01;
    // 60 × 4 px, one behind the other: the second begins 2 px before the first ends.
    EXPECT_EQ(kept(removeDuplicates({detection(100, 100, 60, 4), detection(158, 100, 60, 4)}, motion, options, kScale)),
              1);
    EXPECT_EQ(kept(removeDuplicates({detection(100, 100, 60, 4), detection(161, 100, 60, 4)}, motion, options, kScale)),
              2);
    // Corner to corner, which is as far apart as boxes may touch; side by side; and a small one at the end of a long
    // one.
    EXPECT_EQ(
        kept(removeDuplicates({detection(100, 100, 20, 20), detection(117, 117, 20, 20)}, motion, options, kScale)), 1);
    EXPECT_EQ(kept(removeDuplicates({detection(100, 100, 4, 60), detection(100, 158, 4, 60)}, motion, options, kScale)),
              1);
    EXPECT_EQ(kept(removeDuplicates({detection(100, 100, 60, 4), detection(131, 100, 6, 4)}, motion, options, kScale)),
              1);
}

TEST(DuplicateRemoval, ComparesVelocityAndHeading) {
    const FrameMotion motion = sparseMotion();
    const Detection whole = detection(100, 100, 18, 7, {1, 0});
    Detection other = detection(100, 100, 17, 6, {1.3, 0});
    EXPECT_EQ(kept(removeDuplicates({whole, other}, motion, withoutParts(), kScale)), 2);
    EXPECT_EQ(kept(removeDuplicates({whole, other}, motion, DuplicateRemovalOptions::thesis(), kScale)), 1);
    other = detection(100, 100, 6, 6, {1, 0});
    other.box.heading = 1.2;
    EXPECT_EQ(kept(removeDuplicates({whole, other}, motion, DuplicateRemovalOptions::thesis(), kScale)), 2);
}

TEST(DuplicateRemoval, VelocitiesMayDifferAsMuchAsTheParametersSay) {
    const auto left = [](const char* name, const char* value, double speed, double other) {
        DuplicateRemovalOptions options = withoutParts();
        setParameter(describeOf(options), name, value);
        return kept(
            removeDuplicates({detection(100, 100, 18, 7, {speed, 0}), detection(100, 100, 17, 6, {speed, other})},
                             sparseMotion(), options, kScale));
    };
    // So slow that a share of their speed allows nothing.
    EXPECT_EQ(left("duplicates.velocity_floor", "0.19", 0.2, 0.2), 2);
    EXPECT_EQ(left("duplicates.velocity_floor", "0.21", 0.2, 0.2), 1);
    // They differ by 0.287 of the larger speed.
    EXPECT_EQ(left("duplicates.velocity_share", "0.28", 2, 0.6), 2);
    EXPECT_EQ(left("duplicates.velocity_share", "0.3", 2, 0.6), 1);
}

TEST(DuplicateRemoval, TheUnionMayNotGrowWithoutEnd) {
    const FrameMotion motion = sparseMotion();
    DuplicateRemovalOptions options = withoutParts();
    options.threshold = 0.1;
    options.growth_limit = 1.2;
    const auto found =
        removeDuplicates({detection(100, 100, 18, 7), detection(112, 100, 18, 7)}, motion, options, kScale);
    EXPECT_EQ(kept(found), 1);
    EXPECT_DOUBLE_EQ(found[0].box.length, 18);
}

TEST(DuplicateRemoval, SuppressionKeepsTheSurer) {
    const FrameMotion motion = sparseMotion();
    DuplicateRemovalOptions options = withoutParts();
    options.strategy = DuplicateStrategy::suppress;
    Detection a = detection(100, 100, 18, 7);
    Detection b = detection(101, 100, 17, 7);
    a.score = 0.4;
    b.score = 0.9;
    const auto found = removeDuplicates({a, b}, motion, options, kScale);
    EXPECT_EQ(found[0].rejection, Rejection::duplicate);
    EXPECT_EQ(found[1].rejection, Rejection::none);
    EXPECT_DOUBLE_EQ(found[1].box.length, 17);
}

TEST(DuplicateRemoval, SuppressionGoesFromTheHighestScoreDown) {
    // In a row A, B, C with falling scores: A overlaps B by 8 / 28 = 0.29, B overlaps C by 14 / 22 = 0.64, A and C
    // share 4 / 32 = 0.13 only. B goes for A, so nothing is left that C would have to go for.
    const FrameMotion motion = sparseMotion();
    std::vector<Detection> row{detection(100, 100, 18, 7), detection(110, 100, 18, 7), detection(114, 100, 18, 7)};
    for (std::size_t i = 0; i < 3; ++i) row[i].score = 3.0 - static_cast<double>(i);
    const auto keptScores = [](const std::vector<Detection>& found) {
        std::set<double> scores;
        for (const Detection& d : found) {
            if (d.rejection == Rejection::none) scores.insert(d.score);
        }
        return scores;
    };
    for (const bool complete : {false, true}) {
        DuplicateRemovalOptions options = DuplicateRemovalOptions::thesis();
        options.strategy = complete ? DuplicateStrategy::fuse : DuplicateStrategy::suppress;
        for (Detection& d : row) d.complete = complete;
        std::vector<int> order{0, 1, 2};
        do {
            std::vector<Detection> shuffled;
            for (const int i : order) shuffled.push_back(row[static_cast<std::size_t>(i)]);
            RemovalTrace trace;
            const auto found = removeDuplicates(shuffled, motion, options, kScale, &trace);
            EXPECT_EQ(keptScores(found), (std::set<double>{3, 1})) << order[0] << order[1] << order[2];
            ASSERT_EQ(trace.duplicates.size(), 1U);
            EXPECT_EQ(shuffled[static_cast<std::size_t>(trace.duplicates[0].removed)].score, 2);
            EXPECT_EQ(shuffled[static_cast<std::size_t>(trace.duplicates[0].kept)].score, 3);
            EXPECT_NEAR(trace.duplicates[0].value, 8.0 / 28, 1e-9);
            EXPECT_EQ(found[static_cast<std::size_t>(trace.duplicates[0].kept)].box.length, 18) << "nothing is fused";
        } while (std::next_permutation(order.begin(), order.end()));
    }
}

TEST(DuplicateRemoval, EqualScoresLeaveTheFirst) {
    DuplicateRemovalOptions options = DuplicateRemovalOptions::thesis();
    options.strategy = DuplicateStrategy::suppress;
    const auto found =
        removeDuplicates({detection(100, 100, 18, 7), detection(102, 100, 18, 7)}, sparseMotion(), options, kScale);
    EXPECT_EQ(found[0].rejection, Rejection::none);
    EXPECT_EQ(found[1].rejection, Rejection::duplicate);
}

TEST(DuplicateRemoval, SegmentsInAChainFuseIntoOneUnion) {
    DuplicateRemovalOptions options = DuplicateRemovalOptions::thesis();
    options.strategy = DuplicateStrategy::fuse;
    const auto found =
        removeDuplicates({detection(100, 100, 18, 7), detection(110, 100, 18, 7), detection(120, 100, 18, 7)},
                         sparseMotion(), options, kScale);
    ASSERT_EQ(kept(found), 1);
    for (const Detection& d : found) {
        if (d.rejection != Rejection::none) continue;
        EXPECT_NEAR(d.box.length, 38, 1e-9);  // 91 … 129
    }
}

TEST(DuplicateRemoval, CountsOnlyVectorsThatMoveAlike) {
    FrameMotion motion = sparseMotion();
    fill(motion, {{100, 100}, 18, 7, 0}, 6, {1, 0});
    fill(motion, {{100, 101}, 18, 7, 0}, 5, {-2, 0});  // oncoming traffic in the same box
    const auto found = removeDuplicates({detection(100, 100, 18, 7)}, motion, withoutParts(), kScale);
    EXPECT_EQ(found[0].vectors, (std::vector<int>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(found[0].velocity, cv::Point2d(1, 0));
}

TEST(DuplicateRemoval, BoxesAreTheSameWithinLimitsOfSpeedAndTurn) {
    const auto one = [](cv::Point2d velocity, cv::Point2d other_velocity, double turn_deg) {
        Detection other = detection(100, 100, 17, 6, other_velocity);
        other.box.heading = radiansFromDegrees(turn_deg);
        return kept(removeDuplicates({detection(100, 100, 18, 7, velocity), other}, sparseMotion(), withoutParts(),
                                     kScale)) == 1;
    };
    EXPECT_TRUE(one({2, 0}, {2.2, 0}, 0)) << "0.2 of 0.22";
    EXPECT_FALSE(one({2, 0}, {2.25, 0}, 0)) << "0.25 of 0.225";
    EXPECT_TRUE(one({0, 0.2}, {0, 0.27}, 0)) << "slow ones may differ by 0.08";
    EXPECT_FALSE(one({0, 0.2}, {0, 0.29}, 0));
    DuplicateRemovalOptions thesis = DuplicateRemovalOptions::thesis();
    for (const double turn : {-29.0, 29.0, -31.0, 31.0}) {
        Detection other = detection(100, 100, 17, 6);
        other.box.heading = radiansFromDegrees(turn);
        EXPECT_EQ(kept(removeDuplicates({detection(100, 100, 18, 7), other}, sparseMotion(), thesis, kScale)),
                  std::abs(turn) < 30 ? 1 : 2)
            << turn;
    }
    thesis.max_turn_deg = 0;
    EXPECT_EQ(kept(removeDuplicates({detection(100, 100, 18, 7), detection(100, 100, 17, 6)}, sparseMotion(), thesis,
                                    kScale)),
              1)
        << "no turn at all is within any limit";
}

TEST(DuplicateRemoval, TheThesisMeasuresOverlapTheDefaultContainment) {
    const std::vector<Detection> small_in_large{detection(100, 100, 18, 7), detection(100, 100, 4, 4)};  // 16 / 126
    EXPECT_EQ(kept(removeDuplicates(small_in_large, sparseMotion(), withoutParts(), kScale)), 1);
    EXPECT_EQ(kept(removeDuplicates(small_in_large, sparseMotion(), DuplicateRemovalOptions::thesis(), kScale)), 2);
    DuplicateRemovalOptions touching = DuplicateRemovalOptions::thesis();
    touching.threshold = 0.01;  // squares that share a corner: 4 / 196
    EXPECT_EQ(kept(removeDuplicates({detection(100, 100, 10, 10), detection(108, 108, 10, 10)}, sparseMotion(),
                                    touching, kScale)),
              1);
}

TEST(DuplicateRemoval, TheUnionTakesTheLargerOnesPlaceAndHeading) {
    Detection large = detection(100, 100, 18, 8);
    large.box.heading = 0.2;
    large.score = 0.3;
    Detection small = detection(100, 100, 16, 7);
    small.score = 0.8;
    for (const bool large_first : {true, false}) {
        const std::vector<Detection> pair =
            large_first ? std::vector<Detection>{large, small} : std::vector<Detection>{small, large};
        RemovalTrace trace;
        const auto found = removeDuplicates(pair, sparseMotion(), DuplicateRemovalOptions::thesis(), kScale, &trace);
        const std::size_t stays = large_first ? 0 : 1;
        EXPECT_EQ(found[stays].rejection, Rejection::none);
        EXPECT_EQ(found[1 - stays].rejection, Rejection::duplicate);
        EXPECT_EQ(found[stays].box.heading, 0.2);
        EXPECT_GE(found[stays].box.area(), large.box.area());
        EXPECT_EQ(found[stays].score, 0.8) << "as sure as the surer one";
        ASSERT_EQ(trace.duplicates.size(), 1U);
        EXPECT_EQ(trace.duplicates[0].kept, static_cast<int>(stays));
        EXPECT_EQ(trace.duplicates[0].removed, static_cast<int>(1 - stays));
        EXPECT_NEAR(trace.duplicates[0].value, overlap(large.box, small.box), 1e-12);
        EXPECT_EQ(trace.duplicates[0].limit, 0.2);
    }
    const auto equal = removeDuplicates({small, small}, sparseMotion(), DuplicateRemovalOptions::thesis(), kScale);
    EXPECT_EQ(equal[0].rejection, Rejection::none) << "of equals the first";
}

TEST(DuplicateRemoval, TheStrongestOverlapGoesFirst) {
    // The last two overlap most; once they are one, the first overlaps them less than before.
    RemovalTrace trace;
    const auto found =
        removeDuplicates({detection(100, 100, 18, 7), detection(109, 100, 18, 7), detection(111, 100, 18, 7)},
                         sparseMotion(), DuplicateRemovalOptions::thesis(), kScale, &trace);
    ASSERT_EQ(trace.duplicates.size(), 2U);
    EXPECT_EQ(trace.duplicates[0].kept, 1);
    EXPECT_EQ(trace.duplicates[0].removed, 2);
    EXPECT_NEAR(trace.duplicates[0].value, 16.0 / 20, 1e-9);
    EXPECT_NEAR(trace.duplicates[1].value, 9.0 / 29, 1e-9) << "91 … 109 and 100 … 120";
    EXPECT_EQ(kept(found), 1);
}

TEST(DuplicateRemoval, AUnionUpToTheLimitIsFormed) {
    const std::vector<Detection> pair{detection(100, 100, 18, 7), detection(109, 100, 18, 7)};  // 27 of 18: 1.5 times
    DuplicateRemovalOptions options = withoutParts();
    options.threshold = 0.4;
    EXPECT_DOUBLE_EQ(removeDuplicates(pair, sparseMotion(), options, kScale)[0].box.length, 27);
    options.growth_limit = 1.49;
    EXPECT_DOUBLE_EQ(removeDuplicates(pair, sparseMotion(), options, kScale)[0].box.length, 18);
}

TEST(DuplicateRemoval, AsMuchOverlapAsTheThresholdIsEnough) {
    DuplicateRemovalOptions options = DuplicateRemovalOptions::thesis();
    options.threshold = 0.5;  // 12 / (18 + 18 − 12)
    const std::vector<Detection> pair{detection(100, 100, 18, 8), detection(106, 100, 18, 8)};
    for (const DuplicateStrategy strategy : {DuplicateStrategy::fuse, DuplicateStrategy::suppress}) {
        options.strategy = strategy;
        EXPECT_EQ(kept(removeDuplicates(pair, sparseMotion(), options, kScale)), 1);
    }
}

TEST(DuplicateRemoval, SuppressionJudgesEveryPair) {
    // Scores fall from group to group and back, so that each box is followed by strangers before its duplicate.
    std::vector<Detection> boxes{detection(100, 100, 18, 7), detection(200, 100, 18, 7), detection(102, 100, 18, 7),
                                 detection(202, 100, 18, 7), detection(300, 100, 18, 7), detection(302, 100, 18, 7)};
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        boxes[i].score = 5.0 - static_cast<double>(i);
        boxes[i].complete = true;
    }
    const auto found = removeDuplicates(boxes, sparseMotion(), withoutParts(), kScale);
    for (const std::size_t i : {0U, 1U, 4U}) {
        EXPECT_EQ(found[i].rejection, Rejection::none) << i;
        EXPECT_EQ(found[i].box.length, 18) << i << ": nothing is fused";
    }
    for (const std::size_t i : {2U, 3U, 5U}) EXPECT_EQ(found[i].rejection, Rejection::duplicate) << i;
}

TEST(DuplicateRemoval, AWholeVehicleStaysWhateverASegmentScores) {
    for (const DuplicateStrategy strategy : {DuplicateStrategy::fuse, DuplicateStrategy::suppress}) {
        for (const bool segment_first : {true, false}) {
            DuplicateRemovalOptions options = withoutParts();
            options.strategy = strategy;
            Detection segment = detection(103, 100, 18, 8);
            segment.score = 9;
            Detection vehicle = detection(100, 100, 18, 7);
            vehicle.score = 0.5;
            vehicle.complete = true;
            std::vector<Detection> both{vehicle, segment};
            if (segment_first) std::swap(both[0], both[1]);
            RemovalTrace trace;
            const auto found = removeDuplicates(both, sparseMotion(), options, kScale, &trace);
            const std::size_t stays = segment_first ? 1 : 0;
            EXPECT_EQ(found[stays].rejection, Rejection::none);
            EXPECT_EQ(found[stays].box.length, 18);
            EXPECT_EQ(found[stays].score, 0.5);
            EXPECT_EQ(found[1 - stays].rejection, Rejection::duplicate);
            ASSERT_EQ(trace.duplicates.size(), 1U);
            EXPECT_EQ(trace.duplicates[0].kept, static_cast<int>(stays));
        }
    }
}

TEST(DuplicateRemoval, TheThesisCountsVectorsOfAnySpeed) {
    FrameMotion motion = sparseMotion();
    fill(motion, {{100, 100}, 18, 7, 0}, 3, {1, 0});
    fill(motion, {{109, 101}, 18, 7, 0}, 3, {-2, 0});
    const std::vector<Detection> pair{detection(100, 100, 18, 7), detection(109, 100, 18, 7)};
    const auto vectorsOf = [&](DuplicateRemovalOptions options) {
        options.threshold = 0.3;
        options.parts.join_parts = false;
        return removeDuplicates(pair, motion, options, kScale)[0].vectors.size();
    };
    EXPECT_EQ(vectorsOf(DuplicateRemovalOptions::thesis()), 6U);
    DuplicateRemovalOptions alike = DuplicateRemovalOptions::thesis();
    alike.compare_speed = true;
    EXPECT_EQ(vectorsOf(alike), 3U);
}

TEST(DuplicateRemoval, TheThesisJoinsNoParts) {
    const std::vector<Detection> front_and_rear{detection(100, 100, 5, 7), detection(113, 100, 5, 7)};
    EXPECT_EQ(kept(removeDuplicates(front_and_rear, sparseMotion(), DuplicateRemovalOptions::thesis(), kScale)), 2);
    EXPECT_EQ(kept(removeDuplicates(front_and_rear, sparseMotion(), {}, kScale)), 1);
}

TEST(DuplicateRemoval, LeavesRejectedAloneAndTakesNothing) {
    EXPECT_TRUE(removeDuplicates({}, {}, {}, kScale).empty());
    Detection gone = detection(100, 100, 18, 7);
    gone.rejection = Rejection::size;
    const auto found = removeDuplicates({detection(100, 100, 18, 7), gone}, sparseMotion(), {}, kScale);
    EXPECT_EQ(found[0].rejection, Rejection::none);
    EXPECT_EQ(found[1].rejection, Rejection::size);
}

TEST(DuplicateRemoval, DoesNotDependOnTheOrder) {
    const FrameMotion motion = sparseMotion();
    const std::vector<Detection> forward = {detection(100, 100, 18, 7), detection(94, 100, 8, 6),
                                            detection(106, 100, 8, 6), detection(200, 100, 18, 7)};
    const std::vector<Detection> backward(forward.rbegin(), forward.rend());
    const auto a = removeDuplicates(forward, motion, withoutParts(), kScale);
    const auto b = removeDuplicates(backward, motion, withoutParts(), kScale);
    EXPECT_EQ(kept(a), 2);
    EXPECT_EQ(kept(b), 2);
    EXPECT_DOUBLE_EQ(a[0].box.length, 20);
    EXPECT_DOUBLE_EQ(b[3].box.length, 20);
}

}  // namespace
}  // namespace eyrie::duplicate_removal_test

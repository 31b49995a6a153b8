#include "evaluation/comparison/result_difference.h"

#include <gtest/gtest.h>

namespace eyrie::result_difference_test {
namespace {

void put(BoxesByFrame& boxes, FrameIndex frame, std::optional<int> id, double x, double length = 20) {
    BoxRecord record;
    record.frame = frame;
    record.id = id;
    record.box = {{x, 50}, length, 10, 0};
    boxes[frame].push_back(record);
}

TEST(ResultDifference, nothingBetweenAResultAndItself) {
    BoxesByFrame boxes;
    for (int f = 0; f < 5; ++f) {
        put(boxes, f, 1, 10 + f);
        put(boxes, f, std::nullopt, 80);
    }
    EXPECT_TRUE(differencesOf(boxes, boxes).empty());
    EXPECT_TRUE(differencesOf({}, {}).empty());
}

TEST(ResultDifference, objectsOfOneOnlyAreCountedOverTheirFrames) {
    BoxesByFrame a;
    BoxesByFrame b;
    for (int f = 0; f < 10; ++f) {
        put(a, f, 1, 10 + f);
        put(b, f, 7, 10 + f);
        if (f >= 3 && f != 5) put(a, f, 2, 100);  // a gap of one frame is none
        if (f < 2) put(b, f, 9, 200);
    }
    const auto found = differencesOf(a, b);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].kind, DifferenceKind::only_first);
    EXPECT_EQ(found[0].first_id, 2);
    EXPECT_EQ(found[0].first_frame, 3);
    EXPECT_EQ(found[0].last_frame, 9);
    EXPECT_EQ(found[0].size, 6);
    EXPECT_EQ(found[1].kind, DifferenceKind::only_second);
    EXPECT_EQ(found[1].second_id, 9);
    EXPECT_EQ(found[1].size, 2);
    EXPECT_FALSE(found[1].first_id);
}

TEST(ResultDifference, boxesThatDifferAreWorstWhereTheyOverlapLeast) {
    BoxesByFrame a;
    BoxesByFrame b;
    for (int f = 0; f < 4; ++f) {
        put(a, f, 1, 50, 20);
        put(b, f, 1, 50, f == 2 ? 8 : 10);  // overlaps of 0.5, and 0.4 in frame 2
    }
    const auto found = differencesOf(a, b);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].kind, DifferenceKind::box);
    EXPECT_EQ(found[0].worst_frame, 2);
    EXPECT_NEAR(found[0].size, 3 * 0.5 + 0.6, 1e-9);
    DifferenceLimits limits;
    limits.same_box = 0.5;
    const auto fewer = differencesOf(a, b, limits);
    ASSERT_EQ(fewer.size(), 1U);
    EXPECT_NEAR(fewer[0].size, 0.6, 1e-9) << "as much overlap as the limit is none";
}

TEST(ResultDifference, anIdThatChangesInOneOnly) {
    BoxesByFrame a;
    BoxesByFrame b;
    for (int f = 0; f < 6; ++f) {
        put(a, f, 1, 50);
        put(b, f, f < 3 ? 4 : 5, 50);
    }
    const auto found = differencesOf(a, b);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].kind, DifferenceKind::identity);
    EXPECT_EQ(found[0].worst_frame, 3);
    EXPECT_EQ(found[0].first_id, 1);
    EXPECT_EQ(found[0].second_id, 5);
}

TEST(ResultDifference, detectionsWithoutIdsAreJoinedByTheirPlace) {
    BoxesByFrame a;
    BoxesByFrame b;
    for (int f = 0; f < 4; ++f) {
        put(a, f, std::nullopt, 10 + 2 * f);
        put(a, f, std::nullopt, 300);
        b[f];
    }
    const auto found = differencesOf(a, b);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].size, 4);
    EXPECT_EQ(found[1].size, 4);
}

TEST(ResultDifference, placesDecideOnlyWithoutIds) {
    BoxesByFrame a;
    BoxesByFrame b;
    b[0] = {};
    put(a, 0, std::nullopt, 10);
    put(a, 1, std::nullopt, 300);
    EXPECT_EQ(differencesOf(a, b).size(), 2U);
    EXPECT_EQ(differencesOf(b, a).size(), 2U);
    BoxesByFrame known;
    put(known, 0, 5, 10);
    put(known, 1, 5, 300);
    EXPECT_EQ(differencesOf(known, b).size(), 1U);
    EXPECT_EQ(differencesOf(b, known).size(), 1U);
}

TEST(ResultDifference, twoResultsChangedRoundGiveTheSameDifferencesChangedRound) {
    BoxesByFrame a;
    BoxesByFrame b;
    put(a, 0, 1, 10);
    put(a, 1, 1, 12);
    put(b, 1, 3, 80);
    const auto there = differencesOf(a, b);
    const auto back = differencesOf(b, a);
    ASSERT_EQ(there.size(), back.size());
    EXPECT_EQ(there[0].kind, DifferenceKind::only_first);
    EXPECT_EQ(back[0].kind, DifferenceKind::only_second);
    EXPECT_EQ(there[0].size, back[0].size);
}

TEST(ResultDifference, aGapLongerThanTheLimitBeginsAnother) {
    for (const int gap : {1, 2, 3, 4}) {
        DifferenceLimits limits;
        limits.gap = 2;
        BoxesByFrame a;
        BoxesByFrame b;
        put(a, 0, 2, 100);
        put(a, 1 + gap, 2, 100);
        put(b, 50, 1, 400);
        put(a, 50, 1, 400);
        EXPECT_EQ(differencesOf(a, b, limits).size(), gap <= 2 ? 1U : 2U) << gap;
    }
}

TEST(ResultDifference, theLargestComeFirstThenTheEarliest) {
    BoxesByFrame a;
    BoxesByFrame b;
    put(a, 0, 5, 100);
    for (const FrameIndex f : {3, 4, 5}) put(a, f, 6, 200);
    put(b, 9, 7, 300);
    put(a, 9, 4, 500);
    const auto found = differencesOf(a, b);
    ASSERT_EQ(found.size(), 4U);
    EXPECT_EQ(found[0].first_id, 6);
    EXPECT_EQ(found[1].first_id, 5);
    EXPECT_EQ(found[2].second_id, 7) << "nobody before somebody";
    EXPECT_EQ(found[3].first_id, 4);
}

TEST(ResultDifference, theLargestOverlapMakesThePair) {
    BoxesByFrame a;
    BoxesByFrame b;
    put(a, 0, 1, 50);
    put(a, 0, 2, 54);
    put(b, 0, 3, 54);  // exactly the second, but on the first, too
    const auto found = differencesOf(a, b);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].kind, DifferenceKind::only_first);
    EXPECT_EQ(found[0].first_id, 1);
    EXPECT_EQ(found[0].box.centre.x, 50);
}

TEST(ResultDifference, anIdThatChangesInTheFirstOnlyIsOneToo) {
    BoxesByFrame a;
    BoxesByFrame b;
    for (int f = 0; f < 6; ++f) {
        put(a, f, f < 3 ? 4 : 5, 50);
        put(b, f, 1, 50);
    }
    const auto found = differencesOf(a, b);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].kind, DifferenceKind::identity);
    EXPECT_EQ(found[0].first_frame, 3);
    EXPECT_EQ(found[0].last_frame, 3);
    EXPECT_EQ(found[0].size, 1);
}

TEST(ResultDifference, whatHasNoIdInOneOfThemHasNoneThatChanges) {
    BoxesByFrame a;
    BoxesByFrame b;
    for (int f = 0; f < 6; ++f) {
        put(a, f, 1, 10);
        put(a, f, 2, 100);
        if (f % 2 == 0) {
            put(b, f, 7, 10);
            put(b, f, 8, 100);
        } else {
            put(b, f, std::nullopt, 10);
            put(b, f, std::nullopt, 100);
        }
    }
    EXPECT_TRUE(differencesOf(b, a).empty());
    EXPECT_TRUE(differencesOf(a, b).empty());
    put(a, 6, 2, 10);
    put(b, 6, 7, 10);
    const auto changed = differencesOf(a, b);
    ASSERT_EQ(changed.size(), 1U);
    EXPECT_EQ(changed[0].kind, DifferenceKind::identity);
    EXPECT_EQ(changed[0].first_frame, 6);
}

}  // namespace
}  // namespace eyrie::result_difference_test

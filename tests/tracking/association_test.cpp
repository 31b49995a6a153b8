#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "core/geometry/angle.h"
#include "tracking/association/best_assignment.h"
#include "tracking/association/overlap_matrix.h"
#include "tracking/association/split_merge.h"
#include "tracking/association/vector_association.h"

namespace eyrie::association_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

MovingBox at(double x, double y, double length = 20, double width = 10, cv::Point2d velocity = {2, 0}) {
    return {{{x, y}, length, width, 0}, velocity, 0, 0};
}

FrameAssociation associated(const std::vector<MovingBox>& detections, const std::vector<MovingBox>& tracks,
                            SplitMergeRule rule, double min_overlap = 0.2) {
    OverlapGate gate;
    gate.min_overlap = min_overlap;
    gate.max_turn = kPi / 2;
    gate.slow_speed = 0.1;
    const OverlapMatrix matrix(detections, tracks, gate);
    return associateDetections(matrix, detections, tracks,
                               std::vector<TrackAuthority>(tracks.size(), {true, true, true, false}), rule, 0.6);
}

double weightOf(const std::vector<WeightedPair>& pairs, const std::vector<int>& chosen) {
    double sum = 0;
    for (const int i : chosen) sum += pairs[std::size_t(i)].weight;
    return sum;
}

/// The best selection by trying all.
double bestByTrying(const std::vector<WeightedPair>& pairs, std::size_t from, std::vector<int>& rows,
                    std::vector<int>& columns) {
    if (from == pairs.size()) return 0;
    double best = bestByTrying(pairs, from + 1, rows, columns);
    const WeightedPair& pair = pairs[from];
    if (std::count(rows.begin(), rows.end(), pair.row) == 0 &&
        std::count(columns.begin(), columns.end(), pair.column) == 0) {
        rows.push_back(pair.row);
        columns.push_back(pair.column);
        best = std::max(best, pair.weight + bestByTrying(pairs, from + 1, rows, columns));
        rows.pop_back();
        columns.pop_back();
    }
    return best;
}

}  // namespace

TEST(BestAssignment, agreesWithTryingAll) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> weight(0.01, 1);
    std::uniform_int_distribution<int> index(0, 4);
    for (int round = 0; round < 200; ++round) {
        std::vector<WeightedPair> pairs;
        for (int i = 0; i < 9; ++i) {
            const int row = index(random);
            const int column = index(random);
            const bool known = std::any_of(pairs.begin(), pairs.end(),
                                           [&](const WeightedPair& p) { return p.row == row && p.column == column; });
            if (!known) pairs.push_back({row, column, weight(random)});
        }
        const auto chosen = bestAssignment(pairs);
        std::vector<int> rows;
        std::vector<int> columns;
        EXPECT_NEAR(weightOf(pairs, chosen), bestByTrying(pairs, 0, rows, columns), 1e-9);
        for (const int i : chosen) {
            EXPECT_EQ(std::count(rows.begin(), rows.end(), pairs[std::size_t(i)].row), 0);
            EXPECT_EQ(std::count(columns.begin(), columns.end(), pairs[std::size_t(i)].column), 0);
            rows.push_back(pairs[std::size_t(i)].row);
            columns.push_back(pairs[std::size_t(i)].column);
        }
    }
    EXPECT_THAT(bestAssignment({}), IsEmpty());
}

TEST(OverlapMatrix, holdsTheOverlapsOfEquation61) {
    OverlapGate gate;
    gate.min_overlap = 0.5;
    const OverlapMatrix matrix({at(0, 0), at(10, 0), at(200, 0)}, {at(1, 0)}, gate);
    ASSERT_EQ(matrix.relations().size(), 2u);
    EXPECT_NEAR(matrix.relations()[0].overlap, 19.0 / 21.0, 1e-9);
    EXPECT_TRUE(matrix.relations()[0].accepted);
    EXPECT_NEAR(matrix.relations()[1].overlap, 11.0 / 29.0, 1e-9);
    EXPECT_NEAR(matrix.relations()[1].detection_share, 11.0 / 20.0, 1e-9);
    EXPECT_FALSE(matrix.relations()[1].accepted);
    EXPECT_THAT(matrix.ofTrack(0), ElementsAre(0, 1));
    EXPECT_THAT(matrix.ofDetection(2), IsEmpty());
}

TEST(OverlapMatrix, distanceGateTakesSmallFastObjectsOfLikeSizeAndDirection) {
    OverlapGate gate;
    gate.max_turn = kPi / 2;
    gate.slow_speed = 0.1;
    MovingBox track = at(0, 0, 5, 3);
    track.gate_along = 6;
    track.gate_across = 3;
    const auto accepted = [&](const MovingBox& detection) {
        const OverlapMatrix matrix({detection}, {track}, gate);
        return !matrix.relations().empty() && matrix.relations()[0].accepted;
    };
    EXPECT_TRUE(accepted(at(5.5, 0, 5, 3)));
    EXPECT_FALSE(accepted(at(7, 0, 5, 3)));
    EXPECT_FALSE(accepted(at(0, 4, 5, 3)));
    EXPECT_FALSE(accepted(at(5.5, 0, 20, 10))) << "another size; overlaps by less than T_tov";
    EXPECT_FALSE(accepted(at(1, 0, 5, 3, {-2, 0}))) << "oncoming";
}

TEST(OverlapMatrix, overlapsAreTakenInsideTheImage) {
    OverlapGate gate;
    gate.image = {100, 100};
    MovingBox track = at(-0.5, 50, 40, 10);         // half of it is outside
    const MovingBox visible = at(9.5, 50, 20, 10);  // exactly the visible half
    const OverlapMatrix matrix({visible}, {track}, gate);
    ASSERT_EQ(matrix.relations().size(), 1u);
    EXPECT_NEAR(matrix.relations()[0].overlap, 1, 1e-9);
}

TEST(SplitMerge, unambiguousPairsMatch) {
    for (const auto rule : {SplitMergeRule::none, SplitMergeRule::overlap_matrix, SplitMergeRule::containment}) {
        const auto result =
            associated({at(101, 50), at(0, 0), at(300, 300)}, {at(0, 1), at(100, 50), at(500, 0)}, rule);
        EXPECT_EQ(result.tracks[0].kind, AssociationKind::matched);
        EXPECT_EQ(result.tracks[0].detection, 1);
        EXPECT_EQ(result.tracks[1].detection, 0);
        EXPECT_EQ(result.tracks[2].kind, AssociationKind::missed);
        EXPECT_THAT(result.used, ElementsAre(1, 1, 0));
    }
}

TEST(SplitMerge, aBoxOverTwoTracksIsMerged) {
    const std::vector<MovingBox> tracks{at(0, 0), at(0, 14)};
    const auto result = associated({at(0, 7, 22, 25)}, tracks, SplitMergeRule::containment);
    EXPECT_EQ(result.tracks[0].kind, AssociationKind::merged);
    EXPECT_EQ(result.tracks[1].kind, AssociationKind::merged);
    EXPECT_THAT(result.used, ElementsAre(1));
    const auto by_matrix = associated({at(0, 7, 22, 25)}, tracks, SplitMergeRule::overlap_matrix, 0.3);
    EXPECT_EQ(by_matrix.tracks[0].kind, AssociationKind::merged);
    EXPECT_EQ(by_matrix.tracks[1].kind, AssociationKind::merged);
}

TEST(SplitMerge, overlappingNeighboursWithTheirOwnDetectionsAreNotMerged) {
    const auto result = associated({at(0, 0), at(0, 8)}, {at(0, 0), at(0, 8)}, SplitMergeRule::containment);
    EXPECT_EQ(result.tracks[0].detection, 0);
    EXPECT_EQ(result.tracks[1].detection, 1);
}

TEST(SplitMerge, twoPartsInABoxAreFused) {
    const std::vector<MovingBox> tracks{at(0, 0, 40, 12)};
    const auto result = associated({at(-14, 0, 12, 10), at(13, 0, 14, 10)}, tracks, SplitMergeRule::containment);
    EXPECT_EQ(result.tracks[0].kind, AssociationKind::split);
    EXPECT_THAT(result.tracks[0].parts, UnorderedElementsAre(0, 1));
    EXPECT_TRUE(result.tracks[0].in_parts);
    EXPECT_THAT(result.used, ElementsAre(1, 1));
    const auto by_matrix = associated({at(-9, 0, 22, 12), at(9, 0, 22, 12)}, tracks, SplitMergeRule::overlap_matrix);
    EXPECT_EQ(by_matrix.tracks[0].kind, AssociationKind::split);
    EXPECT_THAT(by_matrix.tracks[0].parts, IsEmpty());
    EXPECT_THAT(by_matrix.used, ElementsAre(1, 1));
}

TEST(SplitMerge, aTrackThatGivesUpItsPartsLeavesThemFree) {
    const std::vector<MovingBox> tracks{at(0, 0, 40, 12)};
    const std::vector<MovingBox> detections{at(-12, 0, 16, 12), at(12, 0, 14, 12)};
    const OverlapMatrix matrix(detections, tracks, {});
    const auto result =
        associateDetections(matrix, detections, tracks, {{true, true, true, true}}, SplitMergeRule::containment, 0.6);
    EXPECT_EQ(result.tracks[0].kind, AssociationKind::matched);
    EXPECT_EQ(result.tracks[0].detection, 0);
    EXPECT_THAT(result.used, ElementsAre(1, 0));
}

TEST(SplitMerge, reconstructionIsTheMedianOfTheSuggestedBoxes) {
    // Three corners moved by (3, 1) since their places were stored; one slid away.
    const OrientedBox stored{{50, 50}, 20, 10, 0};
    std::vector<MotionVector> vectors;
    std::vector<AssociatedVector> associations;
    const std::vector<cv::Point2d> places{{-8, -3}, {8, 3}, {0, 0}, {5, -4}};
    for (std::size_t i = 0; i < places.size(); ++i) {
        cv::Point2d p = stored.toImage(places[i]) + cv::Point2d(3, 1);
        if (i == 3) p += cv::Point2d(-30, 0);
        vectors.push_back({CornerId(i), cv::Point2f(p), {3, 1}, 10});
        associations.push_back({CornerId(i), places[i], 0, int(i)});
    }
    const FrameVectors frame(vectors);
    const auto rebuilt = reconstructBox(associations, frame, {{52, 50}, 20, 10, 0}, 2, 100);
    ASSERT_TRUE(rebuilt);
    EXPECT_NEAR(rebuilt->box.centre.x, 53, 1e-4);
    EXPECT_NEAR(rebuilt->box.centre.y, 51, 1e-4);
    EXPECT_EQ(rebuilt->vectors, 3);
    EXPECT_FALSE(rebuilt->heading_known);
    EXPECT_NEAR(rebuilt->velocity.x, 3, 1e-6);
    EXPECT_FALSE(reconstructBox(associations, frame, stored, 4, 100)) << "only three agree";
    // It is 30 px off, three times the shorter side.
    EXPECT_FALSE(reconstructBox(associations, frame, stored, 4, 100, 2.9));
    EXPECT_TRUE(reconstructBox(associations, frame, stored, 4, 100, 3.1));
    const auto believed = reconstructBox(associations, frame, stored, 4, 100, 0);
    ASSERT_TRUE(believed) << "without a vote the thesis' text takes any";
    EXPECT_EQ(believed->vectors, 4);
    EXPECT_NEAR(believed->box.centre.x, 53, 1e-4) << "the median minds one of four little";
    EXPECT_FALSE(reconstructBox({}, frame, stored, 0, 100));
}

TEST(SplitMerge, reconstructionTurnsWithItsVectors) {
    const OrientedBox now{{50, 50}, 20, 10, 0.3};
    std::vector<MotionVector> vectors;
    std::vector<AssociatedVector> associations;
    for (const cv::Point2d place : {cv::Point2d(-8, -3), cv::Point2d(8, 3), cv::Point2d(7, -3)}) {
        const auto id = CornerId(vectors.size());
        vectors.push_back(
            {id, cv::Point2f(now.toImage(place)), cv::Point2f(float(2 * std::cos(0.2)), float(2 * std::sin(0.2))), 10});
        associations.push_back({id, place, 0.1, int(id)});
    }
    const FrameVectors frame(vectors);
    const auto rebuilt = reconstructBox(associations, frame, {{49, 49}, 20, 10, 0.1}, 2, 0.1);
    ASSERT_TRUE(rebuilt);
    EXPECT_TRUE(rebuilt->heading_known);
    EXPECT_NEAR(rebuilt->box.heading, 0.3, 1e-5);
    EXPECT_NEAR(rebuilt->box.centre.x, 50, 1e-4);
    EXPECT_NEAR(rebuilt->box.centre.y, 50, 1e-4);
}

TEST(SplitMerge, theRebuiltSizeIsPredictedOrTheMedianOfTheStoredOnes) {
    std::vector<MotionVector> vectors;
    std::vector<AssociatedVector> associations;
    const std::vector<cv::Size2d> stored{{22, 11}, {60, 9}, {20, 14}};
    for (const cv::Size2d& size : stored) {
        const auto id = CornerId(vectors.size());
        vectors.push_back({id, {50, 50}, {3, 1}, 10});
        associations.push_back({id, {0, 0}, 0, int(id), size.width, size.height});
    }
    const FrameVectors frame(vectors);
    const OrientedBox predicted{{50, 50}, 30, 13, 0};
    const auto kept = reconstructBox(associations, frame, predicted, 1, 100, 0);
    ASSERT_TRUE(kept);
    EXPECT_DOUBLE_EQ(kept->box.length, 30);
    EXPECT_DOUBLE_EQ(kept->box.width, 13);
    EXPECT_FALSE(kept->size_known);
    const auto told = reconstructBox(associations, frame, predicted, 1, 100, 0, RebuiltSize::stored);
    ASSERT_TRUE(told);
    EXPECT_DOUBLE_EQ(told->box.length, 22);
    EXPECT_DOUBLE_EQ(told->box.width, 11);
    EXPECT_TRUE(told->size_known);
}

TEST(SplitMerge, eachVectorPlacesItsBoxByItsOwnHeadingWhereSizesAreStored) {
    // Three boxes by hand; each vector sits 10 px before the centre of its own, and drives askew to it.
    const std::vector<OrientedBox> suggested{{{49, 50}, 20, 9, 0.5}, {{50, 51}, 26, 10, -0.5}, {{51, 52}, 22, 14, 0}};
    const double directions[] = {0.1, -0.2, 0.3};
    std::vector<MotionVector> vectors;
    std::vector<AssociatedVector> associations;
    for (std::size_t i = 0; i < suggested.size(); ++i) {
        const OrientedBox& box = suggested[i];
        const cv::Point2d velocity = 2 * cv::Point2d(std::cos(directions[i]), std::sin(directions[i]));
        vectors.push_back({CornerId(i), cv::Point2f(box.toImage({10, 0})), cv::Point2f(velocity), 10});
        associations.push_back({CornerId(i), {10, 0}, box.heading - directions[i], int(i), box.length, box.width});
    }
    const FrameVectors frame(vectors);
    const OrientedBox predicted{{50, 50}, 30, 13, 0.1};
    const auto told = reconstructBox(associations, frame, predicted, 1, 0.1, 0, RebuiltSize::stored);
    ASSERT_TRUE(told);
    EXPECT_NEAR(told->box.centre.x, 50, 1e-4);
    EXPECT_NEAR(told->box.centre.y, 51, 1e-4);
    EXPECT_NEAR(told->box.length, 22, 1e-9);
    EXPECT_NEAR(told->box.width, 10, 1e-9);
    EXPECT_NEAR(told->box.heading, 0, 1e-5);
    // Our way turns all places by the median heading.
    const auto kept = reconstructBox(associations, frame, predicted, 1, 0.1, 0);
    ASSERT_TRUE(kept);
    EXPECT_NEAR(kept->box.centre.x, 50 + 10 * (std::cos(0.5) - 1), 1e-4);
    EXPECT_NEAR(kept->box.centre.y, 52, 1e-4);
    // One too slow to tell a heading takes that of the others.
    vectors[0].velocity *= 0.1F;
    const auto slow = reconstructBox(associations, FrameVectors(vectors), predicted, 1, 0.5, 0, RebuiltSize::stored);
    ASSERT_TRUE(slow);
    EXPECT_NEAR(slow->box.heading, -0.25, 1e-5);
    EXPECT_NEAR(slow->box.centre.x, 50, 1e-4);
    EXPECT_NEAR(slow->box.centre.y, 52, 1e-4);
}

TEST(VectorAssociation, fourCriteria) {
    const std::vector<MotionVector> vectors{{1, {0, 0}, {2, 0}, 9},    // free, inside, similar
                                            {2, {12, 0}, {2, 0}, 9},   // inside both boxes
                                            {3, {0, 20}, {2, 0}, 9},   // outside
                                            {4, {-3, 0}, {0, 2}, 9},   // other motion
                                            {5, {-4, 1}, {2, 0}, 9}};  // owned by the second track
    const FrameVectors frame(vectors);
    std::vector<AssociatedVector> first;
    std::vector<AssociatedVector> second{{5, {-20, 1}, 0, 4}};
    const VectorLimits limits;
    std::vector<VectorClaim> claims{{{{0, 0}, 30, 10, 0}, {2, 0}, true, true, &first},
                                    {{{16, 0}, 50, 10, 0}, {2, 0}, true, true, &second}};
    claims[1].box.length = 12;
    claims[1].may_gain = false;
    claims[1].box = {{16, 0}, 12, 10, 0};
    // The second track's vector lies outside its box: it is dropped there and free again.
    associateVectors(claims, frame, limits);
    std::vector<CornerId> ids;
    for (const auto& v : first) ids.push_back(v.id);
    EXPECT_THAT(ids, UnorderedElementsAre(1, 5));
    EXPECT_THAT(second, IsEmpty());
    EXPECT_NEAR(first[0].in_box.x, 0, 1e-9);
}

TEST(VectorAssociation, aLivingRivalKeepsItsVectors) {
    // Beside the rival's box, but near enough to stay with it, and in nobody else's box than the first's.
    const std::vector<MotionVector> vectors{{5, {0.5, 1}, {2, 0}, 9}};
    const FrameVectors frame(vectors);
    for (const bool rival_first : {false, true}) {
        std::vector<AssociatedVector> none;
        std::vector<AssociatedVector> rivals{{5, {-7.5, 1}, 0, 0}};
        std::vector<VectorClaim> claims{{{{0, 0}, 30, 10, 0}, {2, 0}, true, true, &none},
                                        {{{8, 0}, 12, 10, 0}, {2, 0}, true, true, &rivals}};
        if (rival_first) std::swap(claims[0], claims[1]);
        associateVectors(claims, frame, {});
        EXPECT_THAT(none, IsEmpty());
        ASSERT_EQ(rivals.size(), 1U);
        EXPECT_NEAR(rivals[0].in_box.x, -7.5, 1e-9);
    }
}

TEST(VectorAssociation, keepsItsOwnAndAtMostTheGivenNumber) {
    std::vector<MotionVector> vectors;
    for (int i = 0; i < 50; ++i) vectors.push_back({i, {float(i % 10) - 5, float(i / 10) - 2}, {2, 0}, i});
    const FrameVectors frame(vectors);
    std::vector<AssociatedVector> own{{3, {-2, -2}, 0, -1}, {99, {0, 0}, 0, -1}};
    keepSeenVectors(own, frame);
    ASSERT_EQ(own.size(), 1u);
    associateVectors({{{{0, 0}, 20, 10, 0}, {2, 0}, true, true, &own}}, frame, {});
    EXPECT_EQ(own.size(), 20u);
    EXPECT_EQ(own[0].id, 3);
    EXPECT_EQ(own[1].id, 49) << "the oldest first";
}

TEST(VectorAssociation, aVectorStoresPlaceAndSizeOfTheBoxThatItJoins) {
    const std::vector<MotionVector> vectors{{1, {13, 22}, {0, 2}, 9}};
    const FrameVectors frame(vectors);
    std::vector<AssociatedVector> own;
    // Heading down the image: along is y, across is −x.
    const OrientedBox box{{10, 20}, 18, 8, kPi / 2};
    associateVectors({{box, {0, 2}, true, false, &own}}, frame, {});
    ASSERT_EQ(own.size(), 1U);
    EXPECT_NEAR(own[0].in_box.x, 2, 1e-6);
    EXPECT_NEAR(own[0].in_box.y, -3, 1e-6);
    EXPECT_NEAR(own[0].heading_offset, 0, 1e-6);
    EXPECT_DOUBLE_EQ(own[0].length, 18);
    EXPECT_DOUBLE_EQ(own[0].width, 8);

    const OrientedBox later{{11, 20}, 28, 10, kPi / 2 + 0.2};
    std::vector<AssociatedVector> replaced = own;
    storePlaces(replaced, later, frame, 1, 0.1);
    const cv::Point2d place = later.toBox({13, 22});
    EXPECT_NEAR(replaced[0].in_box.x, place.x, 1e-6);
    EXPECT_NEAR(replaced[0].in_box.y, place.y, 1e-6);
    EXPECT_NEAR(replaced[0].heading_offset, 0.2, 1e-6);
    EXPECT_DOUBLE_EQ(replaced[0].length, 28);
    EXPECT_DOUBLE_EQ(replaced[0].width, 10);
    std::vector<AssociatedVector> followed = own;
    storePlaces(followed, later, frame, 0.3, 0.1);
    EXPECT_NEAR(followed[0].in_box.x, 2 + 0.3 * (place.x - 2), 1e-6);
    EXPECT_NEAR(followed[0].heading_offset, 0.06, 1e-6);
    EXPECT_NEAR(followed[0].length, 21, 1e-9);
    EXPECT_NEAR(followed[0].width, 8.6, 1e-9);
}

TEST(SplitMerge, aMergedBoxIsAFifthLargerThanEachOfItsTracks) {
    // It covers .65 of each of two cars side by side, at 1.3 times the area of one.
    const auto result =
        associated({at(0, 5, 20, 13)}, {at(0, 0, 20, 10), at(0, 10, 20, 10)}, SplitMergeRule::containment);
    EXPECT_EQ(result.tracks[0].kind, AssociationKind::merged);
    EXPECT_EQ(result.tracks[1].kind, AssociationKind::merged);
}

TEST(VectorAssociation, aVectorLeavesItsListWithMoreThanAQuarterOfTheShorterSideOutside) {
    // 20 × 10 px: 2.5 px and one for noise.
    for (const float outside : {3.4F, 3.6F}) {
        const std::vector<MotionVector> vectors{{1, {10 + outside, 0}, {2, 0}, 9}};
        const FrameVectors frame(vectors);
        std::vector<AssociatedVector> own{{1, {10, 0}, 0, 0}};
        associateVectors({{{{0, 0}, 20, 10, 0}, {2, 0}, true, true, &own}}, frame, {});
        EXPECT_EQ(own.size(), outside < 3.5F ? 1U : 0U) << outside;
    }
}

TEST(FrameVectors, insideIsWhatASlantedBoxHolds) {
    std::mt19937 random(8);
    std::uniform_real_distribution<float> place(0, 60);
    std::vector<MotionVector> vectors;
    for (int i = 0; i < 400; ++i)
        vectors.push_back({static_cast<CornerId>(3 * i), {place(random), place(random)}, {1, 0}, 9});
    vectors[17].position.x = std::numeric_limits<float>::quiet_NaN();
    const FrameVectors frame(vectors);
    for (const double heading : {0.0, 0.4, 1.2, -0.8, 2.9}) {
        const OrientedBox box{{31.3, 28.2}, 33, 12, heading};
        std::vector<int> expected;
        for (int i = 0; i < 400; ++i) {
            const cv::Point2d in_box = box.toBox(vectors[std::size_t(i)].position);
            if (std::abs(in_box.x) <= 16.5 && std::abs(in_box.y) <= 6) expected.push_back(i);
        }
        EXPECT_GT(expected.size(), 20U);
        EXPECT_EQ(frame.inside(box), expected) << heading;
    }
    EXPECT_EQ(frame.find(30), 10);
    EXPECT_EQ(frame.find(31), -1);
    EXPECT_EQ(frame.find(3 * 400), -1);
}

TEST(SplitMerge, partsSideBySideAreThoseOfNeighbours) {
    const std::vector<MovingBox> tracks{at(0, 0, 24, 16)};
    const auto abreast = [&](const MovingBox& a, const MovingBox& b) {
        const auto result = associated({a, b}, tracks, SplitMergeRule::containment);
        EXPECT_TRUE(result.tracks[0].in_parts);
        return result.tracks[0].abreast;
    };
    EXPECT_TRUE(abreast(at(-1, -5, 20, 6), at(1, 5, 20, 6))) << "two cars";
    EXPECT_FALSE(abreast(at(-6.5, 0, 11, 14), at(6.5, 0, 11, 14))) << "front and rear";
    EXPECT_FALSE(abreast(at(-6.5, -5, 11, 6), at(6.5, 5, 11, 6))) << "too short to be cars, and not beside";
    EXPECT_FALSE(abreast(at(0, -5, 11, 6), at(0, 5, 20, 6))) << "a mirror beside its vehicle";
}

TEST(OverlapMatrix, whatStandsTakesOnlyWhatIsNearAndSlow) {
    MovingBox track = at(100, 100, 40, 40, {0, 0});
    track.farthest = 5;
    track.fastest = 0.5;
    const auto taken = [&](double dx, double dy, cv::Point2d velocity) {
        const OverlapMatrix matrix({at(100 + dx, 100 + dy, 40, 40, velocity)}, {track}, {});
        return !matrix.relations().empty();
    };
    for (const double side : {-1.0, 1.0}) {
        EXPECT_TRUE(taken(4.9 * side, 0, {0, 0}));
        EXPECT_FALSE(taken(5.1 * side, 0, {0, 0}));
        EXPECT_TRUE(taken(0, 4.9 * side, {0, 0}));
        EXPECT_FALSE(taken(0, 5.1 * side, {0, 0}));
        EXPECT_FALSE(taken(4 * side, 4, {0, 0}));
        EXPECT_TRUE(taken(0, 0, {0.49 * side, 0}));
        EXPECT_FALSE(taken(0, 0, {0, 0.51 * side}));
        EXPECT_FALSE(taken(0, 0, {0.4, 0.4 * side}));
    }
}

}  // namespace eyrie::association_test

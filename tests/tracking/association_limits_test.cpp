// What detections mean for tracks: limits on both sides, and scores by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/angle.h"
#include "tracking/association/overlap_matrix.h"
#include "tracking/association/split_merge.h"
#include "tracking/association/vector_association.h"

namespace eyrie::association_limits_test {
namespace {

const TrackAuthority kKnown{true, true, true, false};

/// A box in axes that are turned by the angle, about (200, 200).
struct Axes {
    double heading = 0;
    MovingBox operator()(double x, double y, double length, double width, double speed = 2) const {
        const OrientedBox axes{{200, 200}, 1, 1, heading};
        MovingBox box;
        box.box = {axes.toImage({x, y}), length, width, heading};
        box.velocity = speed * axes.direction();
        return box;
    }
};
constexpr double kHeadings[] = {0.0, 1.1, -kPi / 2};

FrameAssociation containing(const std::vector<MovingBox>& detections, const std::vector<MovingBox>& tracks,
                            std::vector<TrackAuthority> authority = {}, const VehicleLimit& limit = {}) {
    authority.resize(tracks.size(), kKnown);
    const OverlapMatrix matrix(detections, tracks, {});
    return associateDetections(matrix, detections, tracks, authority, SplitMergeRule::containment, 0.6, limit);
}

int mergedOf(const FrameAssociation& association) {
    int count = 0;
    for (const TrackAssociation& track : association.tracks) count += track.kind == AssociationKind::merged;
    return count;
}

}  // namespace

TEST(OverlapLimits, TheGateScoresByHowNearTheCentresAre) {
    for (const double heading : kHeadings) {
        const Axes at{heading};
        MovingBox track = at(0, 0, 6, 4);
        track.gate_along = 10;
        track.gate_across = 5;
        OverlapGate gate;
        gate.min_overlap = 0.5;
        const auto relationOf = [&](const MovingBox& detection) {
            const OverlapMatrix matrix({detection}, {track}, gate);
            return matrix.relations().empty() ? BoxRelation{} : matrix.relations()[0];
        };
        EXPECT_NEAR(relationOf(at(8, 0, 6, 4)).score, 0.2 * 0.5, 1e-9);
        EXPECT_NEAR(relationOf(at(0, 4.5, 6, 4)).score, 0.1 * 0.5, 1e-9);
        EXPECT_NEAR(relationOf(at(-6, -2, 6, 4)).score, (1 - std::hypot(0.6, 0.4)) * 0.5, 1e-9);
        EXPECT_FALSE(relationOf(at(8, 4, 6, 4)).accepted);
        // Areas of 24 px² may be three times as large or small.
        EXPECT_TRUE(relationOf(at(8, 0, 6, 11.9)).accepted);
        EXPECT_FALSE(relationOf(at(8, 0, 6, 12.1)).accepted);
        EXPECT_TRUE(relationOf(at(8, 0, 6, 1.35)).accepted);
        EXPECT_FALSE(relationOf(at(8, 0, 6, 1.3)).accepted);
        // A pair that overlaps enough has its overlap as score.
        EXPECT_NEAR(relationOf(at(1, 0, 6, 4)).score, 5 / 7., 1e-9);
        EXPECT_NEAR(relationOf(at(1, 0, 6, 4)).track_share, 5 / 6., 1e-9);
        EXPECT_NEAR(relationOf(at(0, 0, 3, 4)).track_share, 0.5, 1e-9);
        EXPECT_NEAR(relationOf(at(0, 0, 3, 4)).detection_share, 1, 1e-9);
        EXPECT_TRUE(relationOf(at(0, 0, 3, 4)).accepted) << "T_tov is enough";
        track.gate_along = 0;
        EXPECT_FALSE(relationOf(at(3, 0, 6, 4)).accepted) << "no gate";
    }
}

TEST(OverlapLimits, FastBoxesMoveIntoLikeDirections) {
    OverlapGate gate;
    gate.max_turn = 0.5;
    gate.slow_speed = 0.3;
    const auto related = [&](double turn, double speed_a, double speed_b) {
        Axes at;
        MovingBox a = at(0, 0, 10, 5, speed_a), b = at(0, 0, 10, 5, speed_b);
        b.velocity = {speed_b * std::cos(turn), speed_b * std::sin(turn)};
        return !OverlapMatrix({a}, {b}, gate).relations().empty();
    };
    EXPECT_TRUE(related(0.49, 2, 2));
    EXPECT_TRUE(related(-0.49, 2, 2));
    EXPECT_FALSE(related(0.51, 2, 2));
    EXPECT_FALSE(related(-0.51, 2, 2));
    EXPECT_TRUE(related(2, 0.29, 2)) << "too slow to tell";
    EXPECT_TRUE(related(2, 2, 0.29));
    EXPECT_FALSE(related(2, 0.31, 0.31));
    gate.max_turn = kPi;
    EXPECT_TRUE(related(3, 2, 2)) << "not tested";
}

TEST(OverlapLimits, OnlyWhatLiesInsideThePictureIsCompared) {
    OverlapGate gate;
    gate.image = {100, 80};
    // 20 × 10 px, cut to 8 × 10 by each of the borders; the other box is cut to 4 × 10 there.
    const OrientedBox cut[] = {{{-2.5, 40}, 20, 10, 0},
                               {{101.5, 40}, 20, 10, 0},
                               {{50, -2.5}, 20, 10, kPi / 2},
                               {{50, 81.5}, 20, 10, kPi / 2}};
    const cv::Point2d out[] = {{-4, 0}, {4, 0}, {0, -4}, {0, 4}};
    for (int side = 0; side < 4; ++side) {
        MovingBox track, detection;
        track.box = detection.box = cut[side];
        detection.box.centre += out[side];
        const OverlapMatrix matrix({detection}, {track}, gate);
        ASSERT_EQ(matrix.relations().size(), 1U);
        // All that is seen of the detection lies in the track: 40 of 80 px²; outside they share 80 more.
        EXPECT_NEAR(matrix.relations()[0].detection_share, 1, 1e-9) << side;
        EXPECT_NEAR(matrix.relations()[0].track_share, 0.5, 0.51) << side;
    }
}

TEST(MergeLimits, AMergedBoxIsAFifthLargerAndCoversTwoThatLieApart) {
    for (const double heading : kHeadings) {
        const Axes at{heading};
        // 200 px² each; the merged box holds .6 of both at 12 px of width: 240 px².
        const std::vector<MovingBox> side_by_side{at(0, -5, 20, 10), at(0, 5, 20, 10)};
        EXPECT_EQ(mergedOf(containing({at(0, 0, 20, 12.1)}, side_by_side)), 2);
        EXPECT_EQ(mergedOf(containing({at(0, 0, 20, 11.9)}, side_by_side)), 0);
        EXPECT_EQ(mergedOf(containing({at(0, 0, 19.7, 12.1)}, side_by_side)), 0) << "not a fifth larger";
        // Tracks that lie in each other by half are one.
        EXPECT_EQ(mergedOf(containing({at(0, 0, 26, 20)}, {at(0, -2.6, 20, 10), at(0, 2.6, 20, 10)})), 2);
        EXPECT_EQ(mergedOf(containing({at(0, 0, 26, 20)}, {at(0, -2.4, 20, 10), at(0, 2.4, 20, 10)})), 0);
        // One of the tracks must be established, both be seen often enough.
        const TrackAuthority young{true, false, true, false}, fresh{false, false, false, false};
        EXPECT_EQ(mergedOf(containing({at(0, 0, 22, 22)}, side_by_side, {kKnown, young})), 2);
        EXPECT_EQ(mergedOf(containing({at(0, 0, 22, 22)}, side_by_side, {young, young})), 0);
        EXPECT_EQ(mergedOf(containing({at(0, 0, 22, 22)}, side_by_side, {kKnown, fresh})), 0);
        // A box that holds but one vehicle holds no two.
        EXPECT_EQ(mergedOf(containing({at(0, 0, 22, 22)}, side_by_side, {}, {21.9, 40})), 2);
        EXPECT_EQ(mergedOf(containing({at(0, 0, 22, 22)}, side_by_side, {}, {40, 21.9})), 2);
        EXPECT_EQ(mergedOf(containing({at(0, 0, 22, 22)}, side_by_side, {}, {22.1, 22.1})), 0);
        // A track with a better detection of its own is not merged.
        EXPECT_EQ(mergedOf(containing({at(0, 0, 22, 22), at(0, -5, 20, 9)}, side_by_side)), 0);
    }
}

TEST(PairLimits, KnownTracksComeFirstAmongEquals) {
    const Axes at;
    const TrackAuthority tentative{false, false, false, false};
    for (const bool first_known : {true, false}) {
        const auto result = containing({at(0, 0, 20, 10)}, {at(0, 1, 20, 10), at(0, -1, 20, 10)},
                                       {first_known ? kKnown : tentative, first_known ? tentative : kKnown});
        EXPECT_EQ(result.tracks[0].kind == AssociationKind::matched, first_known);
        EXPECT_EQ(result.tracks[1].kind == AssociationKind::matched, !first_known);
    }
    // Overlaps of .9 and .88: squares differ by .036, less than the .04 that a known track is ahead.
    const auto close = containing({at(0, 0, 20, 10)}, {at(1.05, 0, 20, 10), at(-1.28, 0, 20, 10)}, {tentative, kKnown});
    EXPECT_EQ(close.tracks[1].kind, AssociationKind::matched);
    const auto apart = containing({at(0, 0, 20, 10)}, {at(1.05, 0, 20, 10), at(-1.6, 0, 20, 10)}, {tentative, kKnown});
    EXPECT_EQ(apart.tracks[0].kind, AssociationKind::matched);
}

TEST(PartLimits, PartsOfFairSizeThatLieApartAreToldFromFragments) {
    for (const double heading : kHeadings) {
        const Axes at{heading};
        const std::vector<MovingBox> lorry{at(0, 0, 50, 10)};  // 500 px²: a fair part has 40
        const auto inParts = [&](const MovingBox& piece) {
            return containing({at(-10, 0, 28, 10), piece}, lorry).tracks[0].in_parts;
        };
        EXPECT_TRUE(inParts(at(18, 0, 4.1, 10)));
        EXPECT_FALSE(inParts(at(18, 0, 3.9, 10)));
        // Half of it may lie on the other part, which ends at 4.
        EXPECT_TRUE(inParts(at(4.1, 0, 10, 9)));
        EXPECT_FALSE(inParts(at(3.9, 0, 10, 9)));
    }
}

TEST(PartLimits, PartsAbreastAreLongAndBesideEachOther) {
    for (const double heading : kHeadings) {
        const Axes at{heading};
        const std::vector<MovingBox> wide{at(0, 0, 24, 16)};
        const auto abreast = [&](const MovingBox& a, const MovingBox& b) {
            return containing({a, b}, wide).tracks[0].abreast;
        };
        // At least half as long as the track: 12 px.
        EXPECT_TRUE(abreast(at(0, -5, 12.1, 6), at(0, 5, 20, 6)));
        EXPECT_FALSE(abreast(at(0, -5, 11.9, 6), at(0, 5, 20, 6)));
        // Shifted by less than half of the shorter one: 7 px.
        EXPECT_TRUE(abreast(at(-3.4, -5, 14, 6), at(3.4, 5, 14, 6)));
        EXPECT_FALSE(abreast(at(-3.6, -5, 14, 6), at(3.6, 5, 14, 6)));
        // Beside each other by more than half of their mean width: 3 px, and in each other by less than half.
        EXPECT_TRUE(abreast(at(-3, -1.55, 14, 6), at(3, 1.55, 14, 6)));
    }
}

TEST(PartLimits, PartsAreFusedWhereThatFitsThePredictionBetter) {
    const Axes at;
    const std::vector<MovingBox> lorry{at(0, 0, 40, 12)};
    // One of 30 px alone overlaps by .75; with a piece at the end it is the whole.
    const auto fused = containing({at(-5, 0, 30, 12), at(15, 0, 10, 12)}, lorry);
    EXPECT_EQ(fused.tracks[0].kind, AssociationKind::split);
    EXPECT_EQ(fused.tracks[0].parts.size(), 2U);
    // With a piece that is mostly beside it, it is worse than alone; the piece starts no track of its own.
    const auto alone = containing({at(0, 0, 39, 12), at(0, 9, 4, 8)}, lorry);
    EXPECT_EQ(alone.tracks[0].kind, AssociationKind::matched);
    EXPECT_EQ(alone.tracks[0].detection, 0);
    // A small piece alone is all that is seen of it.
    const auto piece = containing({at(15, 0, 6, 10)}, lorry);
    EXPECT_EQ(piece.tracks[0].kind, AssociationKind::matched);
    EXPECT_EQ(piece.tracks[0].detection, 0);
    EXPECT_FALSE(piece.tracks[0].in_parts);
    const TrackAuthority young{true, false, true, false};
    EXPECT_EQ(containing({at(15, 0, 6, 10)}, lorry, {young}).tracks[0].kind, AssociationKind::missed);
    EXPECT_EQ(containing({at(15, 0, 6, 10)}, lorry, {young}).used[0], 0);
    // A track that is too young to own parts leaves them to the next one.
    const auto next = containing({at(15, 0, 6, 10)}, {at(0, 0, 40, 12), at(1, 0, 40, 12)}, {young, kKnown});
    EXPECT_EQ(next.tracks[0].kind, AssociationKind::missed);
    EXPECT_EQ(next.tracks[1].kind, AssociationKind::matched);
    // Of two tracks it is the part of the one that holds more of it.
    const auto shared = containing({at(18, 4, 5, 6)}, {at(0, 0, 40, 12), at(0, 6, 40, 12)});
    EXPECT_EQ(shared.tracks[0].kind, AssociationKind::missed);
    EXPECT_EQ(shared.tracks[1].kind, AssociationKind::matched);
}

TEST(VehicleLimit, IsAMultipleOfTheUsualCarAndThreePixels) {
    TrackerOptions options;
    options.one_vehicle = 1.5;
    options.car_length_m = 4;
    options.car_width_m = 2;
    const VehicleLimit limit = VehicleLimit::of(options, {0.25, 25, true});
    EXPECT_NEAR(limit.length, 27, 1e-9);
    EXPECT_NEAR(limit.width, 15, 1e-9);
    options.one_vehicle = 0;
    EXPECT_EQ(VehicleLimit::of(options, {0.25, 25, true}).length, 0);
}

TEST(Reconstruction, MediansOfEvenNumbersLieInTheMiddle) {
    std::vector<MotionVector> vectors;
    std::vector<AssociatedVector> associated;
    const double headings[] = {0.1, 0.2, 0.3, 0.5};
    for (int i = 0; i < 4; ++i) {
        const double speed = 1.0 + i;
        vectors.push_back({i,
                           {float(50 + i * i), float(60 - 2 * i)},
                           {float(speed * std::cos(headings[i])), float(speed * std::sin(headings[i]))},
                           9});
        associated.push_back({i, {0, 0}, 0, i, 10.0 + i * i, 4.0 + i});
    }
    const FrameVectors frame(vectors);
    const auto rebuilt = reconstructBox(associated, frame, {{50, 60}, 30, 13, 0.1}, 1, 0.5, 0, RebuiltSize::stored);
    ASSERT_TRUE(rebuilt);
    EXPECT_NEAR(rebuilt->box.centre.x, 52.5, 1e-5);
    EXPECT_NEAR(rebuilt->box.centre.y, 57, 1e-5);
    EXPECT_NEAR(rebuilt->box.length, 12.5, 1e-9);
    EXPECT_NEAR(rebuilt->box.width, 5.5, 1e-9);
    EXPECT_NEAR(rebuilt->box.heading, 0.25, 1e-5);
    EXPECT_NEAR(rebuilt->velocity.x, (2 * std::cos(0.2) + 3 * std::cos(0.3)) / 2, 1e-5);
    // Half of the vectors too slow: they tell no heading.
    EXPECT_FALSE(reconstructBox(associated, frame, {{50, 60}, 30, 13, 0.1}, 1, 2.5, 0)->heading_known);
    EXPECT_TRUE(reconstructBox(associated, frame, {{50, 60}, 30, 13, 0.1}, 1, 1.5, 0)->heading_known);
    // Small boxes: within 1.5 px they agree.
    for (const double apart : {1.4, 1.6}) {
        const std::vector<MotionVector> three{
            {0, {50, 60}, {1, 0}, 9}, {1, {50, 60}, {1, 0}, 9}, {2, {50, float(60 + apart)}, {1, 0}, 9}};
        std::vector<AssociatedVector> own{{0, {0, 0}, 0, 0}, {1, {0, 0}, 0, 1}, {2, {0, 0}, 0, 2}};
        EXPECT_EQ(reconstructBox(own, FrameVectors(three), {{50, 60}, 4, 2, 0}, 1, 0.1)->vectors, apart < 1.5 ? 3 : 2);
    }
}

TEST(VectorLimits, SpeedsMayDifferByAShareOrAFloor) {
    VectorLimits limits;
    limits.speed_difference = 0.25;
    limits.speed_floor = 0.2;
    EXPECT_TRUE(limits.similar({2, 0.49}, {2, 0}));
    EXPECT_FALSE(limits.similar({2, -0.51}, {2, 0}));
    EXPECT_TRUE(limits.similar({0.1, 0.19}, {0.1, 0}));
    EXPECT_FALSE(limits.similar({0.31, 0}, {0.1, 0}));
    EXPECT_TRUE(limits.similar({0, 2.49}, {0, 2}));
}

}  // namespace eyrie::association_limits_test

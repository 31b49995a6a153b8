/// Edits of labels on either side of each limit: who may be joined, what a correction reaches, what is told of the end.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "annotation/edits/identity_edits.h"
#include "annotation/edits/ignore_regions.h"
#include "annotation/keyframes/interpolation.h"
#include "annotation/review/attention.h"
#include "annotation/review/join_suggestions.h"
#include "annotation/review/proposals.h"
#include "annotation/scenes.h"
#include "core/error.h"

namespace eyrie::label_limits_by_hand_test {
namespace {

using test::keyframe;
using test::object;

const CameraMotion standing = CameraMotion::standing(0, 999);

/// Stands at a place over these frames.
LabelledObject parked(ObjectId id, FrameIndex first, FrameIndex last, double x = 100,
                      const OrientedBox& like = {{0, 60}, 20, 8, 0}) {
    OrientedBox box = like;
    box.centre.x = x;
    return object(id, {keyframe(first, box, true)}, last);
}

const LabelledObject& of(const IdentityChange& change, ObjectId id) {
    for (const LabelledObject& each : change.after)
        if (each.id == id) return each;
    throw std::runtime_error("no object " + std::to_string(id));
}

bool isVisible(const LabelledObject& each, FrameIndex frame) {
    return boxAt(each, frame, standing).visible();
}

LabelledObject computedTrack(const std::vector<FrameIndex>& by_hand = {}, double heading = 0) {
    LabelledObject track = object(1, {}, 40);
    for (FrameIndex frame = 0; frame <= 40; frame += 5) {
        track.keyframes.push_back(keyframe(frame, {{20.0 + 4 * frame, 50}, 24, 10, heading}, true));
        track.keyframes.back().computed = std::find(by_hand.begin(), by_hand.end(), frame) == by_hand.end();
    }
    return track;
}

Homography stepBy(const cv::Matx33d& matrix) {
    Homography step;
    step.matrix = matrix;
    step.from_frame = 0;
    step.to_frame = 1;
    return step;
}

}  // namespace

TEST(LabelLimits, OneThatBeginsRightAfterTheOtherIsJoinedWithoutAGap) {
    for (const GapFilling gap : {GapFilling::interpolate, GapFilling::outside}) {
        const LabelledObject whole = joinInTime(parked(1, 0, 9), parked(2, 10, 30), standing, gap).after.at(0);
        for (FrameIndex frame = 0; frame <= 30; ++frame) EXPECT_TRUE(isVisible(whole, frame)) << frame;
        EXPECT_EQ(whole.last_frame, 30);
    }
    const LabelledObject apart =
        joinInTime(parked(1, 0, 9), parked(2, 11, 30), standing, GapFilling::outside).after.at(0);
    EXPECT_FALSE(isVisible(apart, 10));
    EXPECT_TRUE(isVisible(apart, 9));
    EXPECT_TRUE(isVisible(apart, 11));
    EXPECT_THROW(joinInTime(parked(1, 0, 9), parked(2, 9, 30), standing), Error);
    EXPECT_THROW(joinInTime(parked(1, 5, 9), parked(2, 5, 30), standing), Error);
    const IdentityChange change = joinInTime(parked(1, 0, 9), parked(2, 10, 30), standing);
    ASSERT_EQ(change.review_moves.size(), 1U);
    EXPECT_EQ(change.review_moves[0].from, 2);
    EXPECT_EQ(change.review_moves[0].to, 1);
    EXPECT_EQ(change.review_moves[0].first_frame, 0);
    EXPECT_GT(change.review_moves[0].last_frame, 1'000'000);
}

TEST(LabelLimits, ThoseThatShareOneFrameAreFusedByTheMean) {
    const OrientedBox small{{0, 60}, 20, 8, 0.2}, large{{0, 64}, 24, 10, 0.6};
    const IdentityChange change =
        fuseInParallel(parked(1, 0, 10, 100, small), parked(2, 10, 20, 102, large), standing, FuseRule::mean);
    const LabelledObject& fused = of(change, 1);
    const OrientedBox both = boxAt(fused, 10, standing).box;
    EXPECT_NEAR(both.centre.x, 101, 1e-9);
    EXPECT_NEAR(both.centre.y, 62, 1e-9);
    EXPECT_NEAR(both.length, 22, 1e-9);
    EXPECT_NEAR(both.width, 9, 1e-9);
    EXPECT_NEAR(both.heading, 0.4, 1e-9);
    EXPECT_NEAR(boxAt(fused, 9, standing).box.centre.x, 100, 0.5);
    EXPECT_NEAR(boxAt(fused, 11, standing).box.centre.x, 102, 0.5);
    EXPECT_EQ(fused.last_frame, 20);
    ASSERT_EQ(change.review_moves.size(), 2U);
    EXPECT_EQ(change.review_moves[0].first_frame, 0);
    EXPECT_EQ(change.review_moves[0].last_frame, 9);
    EXPECT_EQ(change.review_moves[1].first_frame, 11);
    EXPECT_EQ(change.removed, std::vector<ObjectId>{2});
    EXPECT_THROW(fuseInParallel(parked(1, 0, 9), parked(2, 10, 20), standing), Error);
    EXPECT_THROW(fuseInParallel(parked(1, 0, 9), parked(1, 0, 9), standing), Error);
    LabelledObject away = parked(2, 0, 20, 102, large);
    away.keyframes[0].outside = true;
    const LabelledObject kept =
        fuseInParallel(parked(1, 0, 20, 100, small), away, standing, FuseRule::mean).after.at(0);
    EXPECT_NEAR(boxAt(kept, 10, standing).box.centre.x, 100, 1e-9) << "what is not seen has no box";
    LabelledObject hidden = parked(1, 0, 20, 100, small);
    hidden.keyframes[0].outside = true;
    EXPECT_FALSE(
        isVisible(fuseInParallel(hidden, parked(2, 0, 20, 102, large), standing, FuseRule::mean).after.at(0), 10));
}

TEST(LabelLimits, ATargetMustNotExistFromTheFrameToTheEnd) {
    const LabelledObject car = parked(1, 10, 50);
    const auto allowed = [&](const LabelledObject& target, FrameIndex frame) {
        try {
            renumberFrom(car, frame, 9, &target, standing);
            return true;
        } catch (const Error&) {
            return false;
        }
    };
    EXPECT_TRUE(allowed(parked(2, 0, 19), 20));
    EXPECT_FALSE(allowed(parked(2, 0, 20), 20));
    EXPECT_TRUE(allowed(parked(2, 51, 90), 20));
    EXPECT_FALSE(allowed(parked(2, 50, 90), 20));
    EXPECT_FALSE(allowed(parked(1, 51, 90), 20)) << "it has that number";
    EXPECT_TRUE(allowed(parked(2, 51, 90), 50));
    EXPECT_FALSE(allowed(parked(2, 60, 90), 51)) << "it does not live then";
    const LabelledObject before = parked(2, 0, 19), long_before = parked(2, 0, 15), after = parked(2, 51, 90);
    EXPECT_TRUE(isVisible(of(renumberFrom(car, 20, 9, &before, standing), 2), 20));
    const IdentityChange gap = renumberFrom(car, 20, 9, &long_before, standing);
    EXPECT_FALSE(isVisible(of(gap, 2), 16));
    EXPECT_FALSE(isVisible(of(gap, 2), 19));
    EXPECT_TRUE(isVisible(of(gap, 2), 20));
    EXPECT_EQ(of(gap, 1).last_frame, 19);
    const IdentityChange all = renumberFrom(car, 3, 9, &after, standing);
    EXPECT_EQ(all.removed, std::vector<ObjectId>{1}) << "nothing is left of it";
    EXPECT_EQ(firstFrameOf(of(all, 2)), 10);
    EXPECT_EQ(of(all, 2).last_frame, 90);
    EXPECT_TRUE(isVisible(of(all, 2), 51));
    EXPECT_EQ(all.review_moves.at(0).first_frame, 10);
    const IdentityChange fresh = renumberFrom(car, 11, 9, nullptr, standing);
    EXPECT_EQ(of(fresh, 1).last_frame, 10);
    EXPECT_EQ(renumberFrom(car, 10, 9, nullptr, standing).removed, std::vector<ObjectId>{1});
}

TEST(LabelLimits, ThoseThatAreSwappedNeedNotLiveAtTheSameTime) {
    const IdentityChange close = swapFrom(parked(1, 0, 19), parked(2, 20, 40, 130), 20, standing);
    for (FrameIndex frame = 0; frame <= 40; ++frame) EXPECT_TRUE(isVisible(of(close, 1), frame)) << frame;
    EXPECT_EQ(close.removed, std::vector<ObjectId>{2});
    EXPECT_EQ(close.review_moves.size(), 2U);
    EXPECT_EQ(close.review_moves[0].first_frame, 20);
    EXPECT_FALSE(isVisible(of(swapFrom(parked(1, 0, 18), parked(2, 20, 40), 20, standing), 1), 19));
    EXPECT_EQ(swapFrom(parked(1, 0, 19), parked(2, 0, 40), 40, standing).after.size(), 2U);
    EXPECT_THROW(swapFrom(parked(1, 0, 19), parked(2, 0, 40), 41, standing), Error);
    EXPECT_THROW(swapFrom(parked(1, 0, 19), parked(1, 0, 19), 4, standing), Error);
    EXPECT_EQ(splitAt(parked(1, 5, 19), 6, 7, standing).after.size(), 2U);
    EXPECT_EQ(splitAt(parked(1, 5, 19), 19, 7, standing).after.size(), 2U);
    for (const FrameIndex frame : {4, 5, 20}) EXPECT_THROW(splitAt(parked(1, 5, 19), frame, 7, standing), Error);
}

TEST(LabelLimits, DeletionsAndFlagsReachTheirFirstAndLastFrame) {
    EXPECT_EQ(of(deleteBefore(parked(1, 5, 19), 19, standing), 1).last_frame, 19);
    EXPECT_EQ(deleteBefore(parked(1, 5, 19), 20, standing).removed, std::vector<ObjectId>{1});
    EXPECT_EQ(of(deleteAfter(parked(1, 5, 19), 5, standing), 1).last_frame, 5);
    EXPECT_EQ(deleteAfter(parked(1, 5, 19), 4, standing).removed, std::vector<ObjectId>{1});
    FlagChange hidden;
    hidden.outside = true;
    const auto outsideIn = [&](FrameIndex first, FrameIndex last) {
        std::vector<FrameIndex> frames;
        const LabelledObject flagged = withFlags(parked(1, 5, 9), first, last, hidden, standing);
        for (FrameIndex frame = 5; frame <= 9; ++frame)
            if (!isVisible(flagged, frame)) frames.push_back(frame);
        return frames;
    };
    EXPECT_THAT(outsideIn(6, 7), testing::ElementsAre(6, 7));
    EXPECT_THAT(outsideIn(0, 5), testing::ElementsAre(5));
    EXPECT_THAT(outsideIn(9, 90), testing::ElementsAre(9));
    EXPECT_THAT(outsideIn(7, 7), testing::ElementsAre(7));
    EXPECT_THAT(outsideIn(10, 90), testing::IsEmpty());
    EXPECT_THAT(outsideIn(0, 4), testing::IsEmpty());
    EXPECT_EQ(withFlags(parked(1, 5, 9), 5, 9, hidden, standing).keyframes.size(), 1U);
    std::vector<LabelledObject> green{parked(1, 5, 9)};
    green[0].colour = 0xff00;
    EXPECT_EQ(withClass(green, "bus").at(0).colour, 0xff00U);
    EXPECT_EQ(withClass(green, "bus", 0xff).at(0).colour, 0xffU);
}

TEST(LabelLimits, MarksAreCutWhereAMoveBeginsAndEnds) {
    AnnotationSet set;
    set.objects[1] = parked(1, 0, 50);
    set.objects[2] = parked(2, 0, 50);
    set.reviews = {{2, 0, 3, ReviewState::checked, "Ada", "t0"}, {1, 10, 20, ReviewState::checked, "Ada", "t1"}};
    IdentityChange change;
    const auto marksAfter = [&](FrameIndex first, FrameIndex last) {
        change.review_moves = {{1, 7, first, last}};
        AnnotationSet after = set;
        applyEdit(after, editOf("Move", after, change));
        std::string told;
        for (const ReviewMark& mark : after.reviews)
            told += std::to_string(mark.object) + ":" + std::to_string(mark.first_frame) + "-" +
                    std::to_string(mark.last_frame) + " ";
        return told;
    };
    EXPECT_EQ(marksAfter(12, 15), "2:0-3 1:10-11 1:16-20 7:12-15 ");
    EXPECT_EQ(marksAfter(10, 20), "2:0-3 7:10-20 ");
    EXPECT_EQ(marksAfter(11, 19), "2:0-3 1:10-10 1:20-20 7:11-19 ");
    EXPECT_EQ(marksAfter(20, 30), "2:0-3 1:10-19 7:20-20 ");
    EXPECT_EQ(marksAfter(0, 10), "2:0-3 1:11-20 7:10-10 ");
    EXPECT_EQ(marksAfter(21, 30), "2:0-3 1:10-20 ");
    EXPECT_EQ(marksAfter(0, 9), "2:0-3 1:10-20 ");
    change.review_moves = {{1, 7, 12, 15}, {1, 8, 17, 18}};
    EXPECT_EQ(editOf("Move", set, change).reviews->added.size(), 5U) << "10 to 11, 16, 19 to 20, and what has moved";
    change.review_moves = {{9, 7, 0, 99}, {1, 7, 12, 20}};
    EXPECT_EQ(editOf("Move", set, change).reviews->added.size(), 2U) << "moves of others say nothing of these marks";
    EXPECT_FALSE(editOf("Nothing", set, IdentityChange{}).reviews.has_value());
    change.review_moves = {{1, 7, 12, 15}};
    EXPECT_EQ(editOf("Move", set, change).reviews->kept, 1U) << "the mark before stays as it is";
    EXPECT_FALSE(reviewEdit("Nothing", set, {}).reviews.has_value());
    EXPECT_EQ(reviewEdit("Mark", set, {{1, 0, 9, ReviewState::checked, "", ""}}).reviews->kept, 2U);
}

TEST(LabelLimits, ACorrectionGoesOnWhereATenthIsShared) {
    const auto goesOn = [](double by_px) {
        const OrientedBox box{{100 + by_px, 50}, 24, 10, 0};
        return withBoxCarriedOn(computedTrack(), 20, box, true, standing).keyframes[1].box.centre.x != 40;
    };
    EXPECT_TRUE(goesOn(19));
    EXPECT_TRUE(goesOn(-19));
    EXPECT_FALSE(goesOn(20.5));
    EXPECT_FALSE(goesOn(-20.5));
}

TEST(LabelLimits, ACorrectionFadesTowardsTheNearestHandsOnly) {
    const OrientedBox right{{100, 58}, 30, 12, 0.2};
    const LabelledObject done = withBoxCarriedOn(computedTrack({0, 10, 30, 40}), 20, right, true, standing);
    const std::vector<double> shares{0, 0, 0, 0.5, 1, 0.5, 0, 0, 0};
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const OrientedBox& box = done.keyframes[i].box;
        EXPECT_NEAR(box.centre.y, 50 + 8 * shares[i], 1e-9) << i;
        EXPECT_NEAR(box.length, 24 + 6 * shares[i], 1e-9) << i;
        EXPECT_NEAR(box.width, 10 + 2 * shares[i], 1e-9) << i;
        EXPECT_NEAR(box.heading, 0.2 * shares[i], 1e-9) << i;
    }
    // Beyond the last hand nothing is between: the frame itself had been set by hand before.
    const LabelledObject open = withBoxCarriedOn(computedTrack({20}), 20, right, true, standing);
    for (const Keyframe& each : open.keyframes) EXPECT_NEAR(each.box.centre.y, 58, 1e-9) << each.frame;
    LabelledObject outside = computedTrack();
    outside.keyframes[6].outside = true;
    EXPECT_EQ(withBoxCarriedOn(outside, 20, right, true, standing).keyframes[6].box.centre.y, 50);
}

TEST(LabelLimits, UprightBoxesMayLieAcross) {
    const LabelledObject track = computedTrack({}, 1.2);
    const OrientedBox hull = track.keyframes[4].box.upright();
    const OrientedBox across{hull.centre, hull.width, hull.length, CV_PI / 2};
    const LabelledObject done = withBoxCarriedOn(track, 20, across, true, standing);
    for (const Keyframe& each : done.keyframes) {
        EXPECT_EQ(each.box.heading, CV_PI / 2);
        EXPECT_NEAR(each.box.length, hull.width, 1e-9);
        EXPECT_NEAR(each.box.width, hull.length, 1e-9);
        EXPECT_TRUE(each.heading_set);
    }
}

TEST(LabelLimits, ABorderCutsWhatEndsWithinAPixelAndAHalfOfIt) {
    const cv::Size picture(320, 240);
    for (const double off : {1.4, -1.4, 1.6, -1.6}) {
        const bool near = std::abs(off) < 1.5;
        EXPECT_EQ(isCutByBorder({{-0.5 + 12 + off, 100}, 24, 10, 0}, picture), near) << off;
        EXPECT_EQ(isCutByBorder({{319.5 - 12 + off, 100}, 24, 10, 0}, picture), near) << off;
        EXPECT_EQ(isCutByBorder({{100, -0.5 + 5 + off}, 24, 10, 0}, picture), near) << off;
        EXPECT_EQ(isCutByBorder({{100, 239.5 - 5 + off}, 24, 10, 0}, picture), near) << off;
    }
}

TEST(LabelLimits, ABoxIsCarriedUnlessItGrowsOrShrinksTenThousandTimes) {
    const auto isCarried = [](double scale) {
        const CameraMotion zoom({stepBy({scale, 0, 0, 0, scale, 0, 0, 0, 1})});
        return carriedBox({{1, 1}, 20, 8, 0}, 0, 1, zoom).has_value();
    };
    EXPECT_TRUE(isCarried(9000));
    EXPECT_FALSE(isCarried(11000));
    EXPECT_TRUE(isCarried(1.2e-4));
    EXPECT_FALSE(isCarried(0.9e-4));
    EXPECT_EQ(carriedPoint({7, 9}, 0, 1, CameraMotion({stepBy({11000, 0, 0, 0, 11000, 0, 0, 0, 1})})),
              cv::Point2d(7, 9));
    // Beyond the horizon of x = 500 or y = 250 nothing is seen.
    const CameraMotion tilt({stepBy({1, 0, 0, 0, 1, 0, -0.002, -0.004, 1})});
    EXPECT_TRUE(carriedBox({{490, 0}, 20, 8, 0}, 0, 1, tilt).has_value());
    EXPECT_FALSE(carriedBox({{510, 0}, 20, 8, 0}, 0, 1, tilt).has_value());
    EXPECT_TRUE(carriedBox({{0, 245}, 20, 8, 0}, 0, 1, tilt).has_value());
    EXPECT_FALSE(carriedBox({{0, 255}, 20, 8, 0}, 0, 1, tilt).has_value());
}

TEST(LabelLimits, AnObjectStandsAtItsEndFromTenFramesOn) {
    EXPECT_TRUE(standsAtItsEnd(parked(1, 5, 15)));
    EXPECT_FALSE(standsAtItsEnd(parked(1, 5, 14)));
    LabelledObject gone = parked(1, 5, 50);
    gone.keyframes[0].outside = true;
    EXPECT_FALSE(standsAtItsEnd(gone));
}

TEST(LabelLimits, TheSpeedOfTheLastEightFramesTellsWhereAnObjectGoes) {
    AnnotationSet set;
    set.objects[1] = object(
        1,
        {keyframe(0, {{100, 60}, 20, 8, 0}), keyframe(10, {{110, 70}, 20, 8, 0}), keyframe(20, {{160, 130}, 20, 8, 0})},
        20);
    set.objects[2] = object(2, {keyframe(26, {{200, 190}, 20, 8, 0.5}, true)}, 40);
    const auto at = [&](FrameIndex frame) { return boxAt(set.objects.at(1), frame, standing).box.centre; };
    const cv::Point2d off = at(20) + (at(20) - at(12)) * (6.0 / 8) - cv::Point2d(200, 190);
    const auto found = suggestJoins(set, 1, standing);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].distance_px, cv::norm(off), 1e-9);
    EXPECT_NEAR(found[0].heading_turn, std::abs(boxAt(set.objects.at(1), 20, standing).box.heading - 0.5), 1e-9);
}

TEST(LabelLimits, AProposalHasTheClassOfWhatIsFiftyFramesAndItsLengthAway) {
    const auto isBus = [](FrameIndex first, FrameIndex last, double x) {
        AnnotationSet labelled;
        labelled.objects[1] = parked(1, first, last, x);
        labelled.objects[1].object_class = "bus";
        Proposal proposal;
        proposal.object = parked(0, 100, 200, 100);
        return classOfProposal(proposal, labelled, standing, "car") == "bus";
    };
    EXPECT_TRUE(isBus(0, 50, 100));
    EXPECT_FALSE(isBus(0, 49, 100));
    EXPECT_TRUE(isBus(250, 300, 100));
    EXPECT_FALSE(isBus(251, 300, 100));
    EXPECT_TRUE(isBus(0, 90, 119.9));
    EXPECT_FALSE(isBus(0, 90, 120.1));
    EXPECT_TRUE(isBus(0, 110, 110)) << "a third is shared";
    EXPECT_FALSE(isBus(0, 110, 111)) << "9 of 31 px";
    EXPECT_TRUE(isBus(190, 300, 90));
}

TEST(LabelLimits, BoxesCountFromThreeFifthsInThePictureOn) {
    const auto recordsOf = [](const LabelledObject& each, bool only_checked = false) {
        AnnotationSet set;
        set.objects[4] = each;
        set.reviews = {{4, 0, 4, ReviewState::checked, "", ""}, {4, 5, 9, ReviewState::questionable, "", ""}};
        GroundTruthOptions options;
        options.last_frame = 9;
        options.image = {320, 240};
        options.only_checked = only_checked;
        return groundTruthBoxes(set, standing, options);
    };
    const auto counts = [&](double x) { return !recordsOf(parked(4, 0, 9, x)).at(0).at(0).ignore; };
    EXPECT_TRUE(counts(1.6)) << "12.1 of 20 px";
    EXPECT_FALSE(counts(1.4));
    EXPECT_TRUE(recordsOf(parked(4, 0, 9, -11)).at(0).empty());
    const BoxesByFrame checked = recordsOf(parked(4, 0, 9), true);
    EXPECT_FALSE(checked.at(4).at(0).ignore);
    EXPECT_TRUE(checked.at(5).at(0).ignore);
    LabelledObject ignored = parked(4, 0, 9);
    ignored.keyframes[0].ignore = true;
    EXPECT_TRUE(recordsOf(ignored).at(0).at(0).ignore);
    ignored.keyframes[0].ignore = false;
    ignored.keyframes[0].occlusion = Occlusion::partly;
    EXPECT_FALSE(recordsOf(ignored).at(0).at(0).ignore) << "half hidden is not hidden";
}

TEST(LabelLimits, RegionsBecomeBoxesWithNumbersAboveAllObjects) {
    AnnotationSet set;
    set.objects[4] = parked(4, 0, 9);
    set.regions[1] = {1, {{100, 100}, {116, 100}, {116, 124}, {100, 124}}, RegionAnchor::image, 0, 2, 3, ""};
    set.regions[2] = {2, {{400, 100}, {416, 100}, {416, 124}, {400, 124}}, RegionAnchor::image, 0, 0, 9, ""};
    GroundTruthOptions options;
    options.last_frame = 4;
    options.image = {320, 240};
    const BoxesByFrame boxes = groundTruthBoxes(set, standing, options);
    EXPECT_EQ(boxes.at(1).size(), 1U);
    EXPECT_EQ(boxes.at(4).size(), 1U);
    for (const FrameIndex frame : {2, 3}) {
        const auto& records = boxes.at(frame);
        ASSERT_EQ(records.size(), 4U) << "three rows of 8 px; what lies beyond the picture is no box";
        for (std::size_t i = 1; i < 4; ++i) {
            EXPECT_EQ(*records[i].id, 4 + static_cast<int>(i));
            EXPECT_EQ(records[i].frame, frame);
            EXPECT_TRUE(records[i].ignore);
            EXPECT_NEAR(records[i].box.centre.y, 96 + 8.0 * static_cast<double>(i), 1e-9);
        }
    }
    options.image = {};
    EXPECT_EQ(groundTruthBoxes(set, standing, options).at(2).size(), 7U) << "without a picture nothing is beyond it";
}

TEST(LabelLimits, AGapIsWorthALookWhereTheObjectWasWellInside) {
    const auto gapsOf = [](double x, bool outside_before) {
        std::vector<Keyframe> keyframes;
        for (const FrameIndex frame : {0, 10, 20, 30}) keyframes.push_back(keyframe(frame, {{x, 100}, 20, 8, 0}, true));
        keyframes[1].outside = true;
        keyframes[2].outside = outside_before;
        AnnotationSet set;
        set.objects[1] = object(1, keyframes, 99);
        AttentionOptions options;
        options.image = {320, 240};
        options.frame_count = 100;
        std::size_t count = 0;
        for (const AttentionItem& item : attentionList(set, standing, options))
            count += item.kind == AttentionKind::gap;
        return count;
    };
    EXPECT_EQ(gapsOf(100, false), 1U);
    EXPECT_EQ(gapsOf(100, true), 1U) << "one gap with a keyframe in it";
    EXPECT_EQ(gapsOf(10, false), 0U) << "at the border it may be gone";
}

}  // namespace eyrie::label_limits_by_hand_test

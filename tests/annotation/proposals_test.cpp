#include "annotation/review/proposals.h"

#include <gtest/gtest.h>

#include "annotation/scenes.h"

namespace eyrie::proposals_test {
namespace {

const CameraMotion flying(test::stepsOf(test::flyingView, 200));

DenseTrack track(TrackId id, int first, int last, double y) {
    DenseTrack result;
    result.id = id;
    for (int frame = first; frame <= last; ++frame) {
        result.boxes.push_back({frame, test::seen({{2.0 * frame, y}, 20, 9, 0}, test::flyingView(frame))});
    }
    return result;
}

TEST(Proposals, AreFewKeyframesAndLeaveLabelsAlone) {
    AnnotationSet labelled;
    const auto first = proposeTracks({track(3, 0, 150, 50), track(4, 10, 12, 90)}, labelled, flying);
    ASSERT_EQ(first.size(), 1U) << "the short one is not offered";
    EXPECT_EQ(first[0].track, 3);
    EXPECT_EQ(first[0].object.keyframes.size(), 2U);
    EXPECT_LE(first[0].max_corner_px, 1.5);
    EXPECT_EQ(first[0].same_as, 0);
    const LabelledObject object = accepted(first[0], 12, 0xff00ff);
    EXPECT_EQ(object.id, 12);
    EXPECT_EQ(object.origin, ObjectOrigin::proposal_accepted);
    EXPECT_EQ(originAfterChange(object.origin), ObjectOrigin::proposal_corrected);
    EXPECT_EQ(originAfterChange(ObjectOrigin::hand), ObjectOrigin::hand);
    EXPECT_EQ(originAfterChange(ObjectOrigin::imported), ObjectOrigin::imported);
    labelled.objects[12] = object;
    const auto again = proposeTracks({track(3, 20, 150, 51), track(8, 0, 150, 200)}, labelled, flying);
    ASSERT_EQ(again.size(), 2U);
    EXPECT_EQ(again[0].same_as, 12);
    EXPECT_EQ(again[1].same_as, 0);
}

/// Shakes from frame to frame while it goes to the right before a camera that stands.
DenseTrack shaking(double length, double by_px, int frames = 60) {
    DenseTrack result;
    for (int frame = 0; frame < frames; ++frame)
        result.boxes.push_back({frame, {{50 + 3.0 * frame, 80 + (frame % 2 == 0 ? by_px : -by_px)}, length, 9, 0}});
    return result;
}

TEST(Proposals, MayBeOffByAnEighthOfTheUsualLengthAndByTheToleranceInAnyCase) {
    const CameraMotion camera = CameraMotion::standing(0, 100);
    const auto of = [&](const DenseTrack& dense, double tolerance_px = 1.5) {
        ProposalOptions options;
        options.reduction.tolerance_px = tolerance_px;
        options.reduction.min_overlap = tolerance_px > 0 ? 0 : 0.95;
        return proposeTracks({dense}, {}, camera, options).at(0);
    };
    // 12 px of 100, 2.4 px of 20, 1.5 px of 5.
    EXPECT_LE(of(shaking(100, 5)).object.keyframes.size(), 3U);
    EXPECT_GT(of(shaking(20, 5)).object.keyframes.size(), 20U);
    EXPECT_LE(of(shaking(20, 1.1)).object.keyframes.size(), 3U);
    EXPECT_LE(of(shaking(5, 0.6)).object.keyframes.size(), 3U);
    EXPECT_LE(of(shaking(20, 5), 15).object.keyframes.size(), 3U) << "as asked for";
    for (const Keyframe& keyframe : of(shaking(20, 1)).object.keyframes) EXPECT_TRUE(keyframe.computed);
    // What they are off is told.
    EXPECT_GT(of(shaking(100, 5)).max_corner_px, 4.5);
    EXPECT_LE(of(shaking(100, 5)).max_corner_px, 12);
    EXPECT_LE(of(shaking(20, 5)).max_corner_px, 2.4);
    // One odd length does not count, and where corners are not looked at, the length does not matter.
    DenseTrack odd = shaking(20, 5);
    for (const std::size_t frame : {10U, 30U, 59U}) odd.boxes[frame].box.length = 2000;
    EXPECT_GT(of(odd).object.keyframes.size(), 20U);
    EXPECT_GT(of(shaking(100, 5), 0).object.keyframes.size(), 20U);
}

TEST(Proposals, AreLabelledAlreadyWhereAThirdOfTheTrackIsByHalf) {
    const CameraMotion camera = CameraMotion::standing(0, 100);
    const DenseTrack dense = shaking(20, 0);
    AnnotationSet labelled;
    const auto add = [&](ObjectId id, FrameIndex first, FrameIndex last, double ahead_px) {
        OrientedBox begin = dense.boxes[0].box, end = dense.boxes[0].box;
        begin.centre.x += 3.0 * first + ahead_px;
        end.centre.x += 3.0 * last + ahead_px;
        labelled.objects[id] = test::object(id, {test::keyframe(first, begin), test::keyframe(last, end)}, last);
    };
    const auto same = [&] { return proposeTracks({dense}, labelled, camera).at(0).same_as; };
    EXPECT_EQ(same(), 0);
    add(4, 0, 14, 0);
    EXPECT_EQ(same(), 0) << "a quarter of 60 frames";
    add(4, 0, 19, 0);
    EXPECT_EQ(same(), 4);
    add(4, 40, 99, 0);
    EXPECT_EQ(same(), 4);
    add(4, 50, 99, 0);
    EXPECT_EQ(same(), 0);
    add(4, 0, 59, 6);
    EXPECT_EQ(same(), 4) << "14 of 26 px";
    add(4, 0, 59, 7);
    EXPECT_EQ(same(), 0) << "13 of 27 px";
    add(4, 0, 59, 5);
    add(5, 0, 59, 2);
    add(6, 0, 59, 4);
    EXPECT_EQ(same(), 5) << "the one that lies best";
    labelled.objects[5].keyframes[0].outside = true;
    EXPECT_EQ(same(), 6) << "what is not seen is not the same";
}

TEST(Proposals, AreCutToARange) {
    const auto proposal = proposeTracks({track(3, 0, 150, 50)}, {}, flying)[0];
    const LabelledObject cut = cutToRange(proposal.object, 40, 60, flying);
    EXPECT_EQ(firstFrameOf(cut), 40);
    EXPECT_EQ(cut.last_frame, 60);
    EXPECT_LT(test::cornerDistance(boxAt(cut, 50, flying).box, boxAt(proposal.object, 50, flying).box), 0.5);
    EXPECT_TRUE(cutToRange(proposal.object, 160, 180, flying).keyframes.empty());
}

TEST(Proposals, HaveTheClassOfWhatIsLabelledOfTheirVehicle) {
    AnnotationSet labelled;
    // Its vehicle is labelled up to frame 60 as a truck; another one drives far beside it as a bus.
    LabelledObject before = accepted(proposeTracks({track(1, 0, 60, 50)}, {}, flying)[0], 4, 0);
    before.object_class = "truck";
    LabelledObject beside = accepted(proposeTracks({track(2, 0, 150, 300)}, {}, flying)[0], 5, 0);
    beside.object_class = "bus";
    labelled.objects = {{4, before}, {5, beside}};
    const auto classOf = [&](const DenseTrack& dense, const char* drawn) {
        return classOfProposal(proposeTracks({dense}, labelled, flying)[0], labelled, flying, drawn);
    };
    EXPECT_EQ(classOf(track(3, 70, 150, 50), "car"), "truck") << "it begins where the truck ended";
    EXPECT_EQ(classOf(track(3, 50, 150, 50), "car"), "truck") << "it is the truck in some frames";
    EXPECT_EQ(classOf(track(3, 70, 150, 150), "van"), "van") << "nothing is known of it";
}

TEST(Proposals, TakeTheDrawnClassUnlessTheRunSaysOtherwise) {
    DenseTrack dense = track(3, 0, 150, 50);
    const auto classOf = [&](TrackClass track_class, const char* drawn) {
        dense.track_class = track_class;
        return classOfProposal(proposeTracks({dense}, {}, flying)[0], {}, flying, drawn);
    };
    EXPECT_EQ(classOf(TrackClass::unknown, "person"), "person");
    EXPECT_EQ(classOf(TrackClass::vehicle, "bus"), "bus");
    EXPECT_EQ(classOf(TrackClass::vehicle, "person"), "car");
    EXPECT_EQ(classOf(TrackClass::two_wheeler, "bicycle"), "bicycle");
    EXPECT_EQ(classOf(TrackClass::two_wheeler, "car"), "motorcycle");
    EXPECT_EQ(classOf(TrackClass::person, "car"), "person");
    EXPECT_EQ(classOf(TrackClass::person, "tractor"), "tractor") << "a class of one's own is of any kind";
}

}  // namespace
}  // namespace eyrie::proposals_test

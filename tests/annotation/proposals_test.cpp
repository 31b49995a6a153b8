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

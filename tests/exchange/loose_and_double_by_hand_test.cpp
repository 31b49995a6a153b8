#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "exchange/label_doubles.h"
#include "exchange/loose_boxes.h"

/// Which boxes are one object, and which objects one that is there already: each limit from both sides.
namespace eyrie::loose_and_double_by_hand_test {
namespace {

using testing::ElementsAre;

LabelBox boxOf(FrameIndex frame, double x, double y = 40, const std::string& object_class = "car") {
    LabelBox box;
    box.frame = frame;
    box.object_class = object_class;
    box.box = {{x, y}, 20, 10, 0};
    return box;
}

/// The ids that the first boxes of the frames get, the frames being linked.
std::vector<int> linkedIds(const std::vector<LabelBox>& boxes) {
    LabelFile labels;
    for (const LabelBox& box : boxes) labels.boxes[box.frame].push_back(box);
    gatherLooseBoxes(labels, LooseBoxes::link);
    std::vector<int> ids;
    for (const auto& [frame, records] : labels.boxes)
        for (const LabelBox& box : records) ids.push_back(box.id.value_or(-1));
    return ids;
}

TEST(LooseBoxesByHand, NeighboursThatOverlapByThreeTenthsAreOneObject) {
    // Moved by d along 20 px they share (20 − d) / (20 + d), across 10 px (10 − d) / (10 + d).
    EXPECT_THAT(linkedIds({boxOf(0, 50), boxOf(1, 60)}), ElementsAre(1, 1)) << "10 of 30";
    EXPECT_THAT(linkedIds({boxOf(0, 50), boxOf(1, 61)}), ElementsAre(1, 2)) << "9 of 31";
    EXPECT_THAT(linkedIds({boxOf(0, 50), boxOf(1, 40)}), ElementsAre(1, 1));
    EXPECT_THAT(linkedIds({boxOf(0, 50), boxOf(1, 50, 45)}), ElementsAre(1, 1)) << "5 of 15";
    EXPECT_THAT(linkedIds({boxOf(0, 50), boxOf(1, 50, 46)}), ElementsAre(1, 2)) << "4 of 16";
    EXPECT_THAT(linkedIds({boxOf(0, 50), boxOf(1, 50, 40, "bus")}), ElementsAre(1, 2)) << "another class";
    EXPECT_THAT(linkedIds({boxOf(0, 50), boxOf(2, 50)}), ElementsAre(1, 2)) << "a frame without it ends it";
}

TEST(LooseBoxesByHand, AnObjectGoesOnByItsLastStep) {
    // 10, then 20 px: only where it was to go on by 10 the third box overlaps by more than three tenths.
    EXPECT_THAT(linkedIds({boxOf(0, 50), boxOf(1, 60), boxOf(2, 80)}), ElementsAre(1, 1, 1));
    EXPECT_THAT(linkedIds({boxOf(0, 50), boxOf(1, 60), boxOf(2, 82)}), ElementsAre(1, 1, 2)) << "8 of 32";
    EXPECT_THAT(linkedIds({boxOf(0, 50, 40), boxOf(1, 50, 44), boxOf(2, 50, 52)}), ElementsAre(1, 1, 1));
}

TEST(LooseBoxesByHand, TheBestPairComesFirst) {
    // The first box of the second frame lies 8 px from the object, the second 2 px.
    EXPECT_THAT(linkedIds({boxOf(0, 50), boxOf(1, 58), boxOf(1, 52)}), ElementsAre(1, 2, 1));
    // Each box and each object belongs to one pair.
    EXPECT_THAT(linkedIds({boxOf(0, 50), boxOf(0, 56), boxOf(1, 53.5)}), ElementsAre(1, 2, 2));
}

TEST(LooseBoxesByHand, APairThatIsTakenDoesNotKeepTheOthersApart) {
    // The best pair is the first object with the first box; the next best has one of them, and then comes another.
    EXPECT_THAT(linkedIds({boxOf(0, 50), boxOf(0, 56, 42), boxOf(0, 150), boxOf(1, 50), boxOf(1, 160)}),
                ElementsAre(1, 2, 3, 1, 3));
    EXPECT_THAT(linkedIds({boxOf(0, 50), boxOf(0, 150), boxOf(1, 50), boxOf(1, 55), boxOf(1, 160)}),
                ElementsAre(1, 2, 1, 3, 2));
}

TEST(LooseBoxesByHand, WhatIsNotLinkedIsAnObjectOfOneFrame) {
    LabelFile labels;
    for (FrameIndex frame = 0; frame < 3; ++frame) labels.boxes[frame] = {boxOf(frame, 50), boxOf(frame, 100)};
    const LooseBoxCount count = gatherLooseBoxes(labels, LooseBoxes::single);
    EXPECT_EQ(count.boxes, 6);
    EXPECT_EQ(count.objects, 6);
    for (FrameIndex frame = 0; frame < 3; ++frame) {
        EXPECT_EQ(labels.boxes[frame][0].id, 2 * frame + 1);
        EXPECT_EQ(labels.boxes[frame][1].id, 2 * frame + 2);
    }
    for (auto& [frame, records] : labels.boxes)
        for (LabelBox& box : records) box.id.reset();
    EXPECT_EQ(gatherLooseBoxes(labels, LooseBoxes::link).objects, 2);
}

TEST(LooseBoxesByHand, NamedAndIgnoredBoxesAreLeftAlone) {
    LabelFile labels;
    labels.boxes[0] = {boxOf(0, 50), boxOf(0, 150), boxOf(0, 250)};
    labels.boxes[0][0].id = 7;
    labels.boxes[0][1].ignore = true;
    labels.objects.resize(1);
    const LooseBoxCount count = gatherLooseBoxes(labels, LooseBoxes::single);
    EXPECT_EQ(count.boxes, 1);
    EXPECT_EQ(count.objects, 1);
    EXPECT_EQ(labels.boxes[0][0].id, 7);
    EXPECT_FALSE(labels.boxes[0][1].id);
    EXPECT_EQ(labels.boxes[0][2].id, 8);
    EXPECT_TRUE(labels.objects.empty()) << "the boxes make the objects";
    LabelFile named;
    named.boxes[0] = {boxOf(0, 50)};
    named.boxes[0][0].id = 7;
    named.objects.resize(1);
    EXPECT_EQ(gatherLooseBoxes(named, LooseBoxes::single).boxes, 0);
    EXPECT_EQ(named.objects.size(), 1U);
}

/// An object with a keyframe in each of the frames, at x = 50 + frame.
AnnotationSet present(FrameIndex first, FrameIndex last) {
    AnnotationSet set;
    LabelledObject object;
    object.id = 3;
    for (FrameIndex frame = first; frame <= last; ++frame) {
        Keyframe keyframe;
        keyframe.frame = frame;
        keyframe.box = boxOf(frame, 50.0 + frame).box;
        keyframe.heading_set = true;
        object.keyframes.push_back(keyframe);
    }
    object.last_frame = last;
    set.objects[3] = object;
    return set;
}

/// The same in a file, of which the first `missed` boxes lie `off` px aside.
LabelFile file(FrameIndex first, FrameIndex last, int missed, double off) {
    LabelFile labels;
    for (FrameIndex frame = first; frame <= last; ++frame) {
        LabelBox box = boxOf(frame, 50.0 + frame, 40 + (frame - first < missed ? off : 0));
        box.id = 9;
        labels.boxes[frame].push_back(box);
    }
    return labels;
}

TEST(DoublesByHand, CornersMayDifferByTheToleranceInEachDirection) {
    const auto same = [](double off, double tolerance) {
        return !alreadyLabelled(file(0, 9, 10, off), present(0, 9), {}, tolerance).empty();
    };
    EXPECT_TRUE(same(1, 1));
    EXPECT_TRUE(same(-1, 1));
    EXPECT_FALSE(same(1.01, 1));
    EXPECT_FALSE(same(-1.01, 1));
    EXPECT_EQ(alreadyLabelled(file(0, 9, 0, 0), present(0, 9), {}, 1).at(9), 3);
    EXPECT_TRUE(alreadyLabelled(file(0, 9, 0, 0), {}, {}, 1).empty());
}

TEST(DoublesByHand, OneOfFiveBoxesMayDiffer) {
    const auto same = [](FrameIndex last, int missed) {
        return !alreadyLabelled(file(0, last, missed, 5), present(0, last), {}, 1).empty();
    };
    EXPECT_TRUE(same(9, 2));
    EXPECT_FALSE(same(9, 3));
    EXPECT_TRUE(same(4, 1));
    EXPECT_FALSE(same(4, 2));
    EXPECT_TRUE(same(0, 0));
    EXPECT_FALSE(same(0, 1));
    EXPECT_TRUE(same(79, 16)) << "of long objects 40 frames are looked at, spread over their lives";
    EXPECT_FALSE(same(79, 18));
}

TEST(DoublesByHand, AnObjectOfOneFrameIsOnlyItself) {
    EXPECT_FALSE(alreadyLabelled(file(4, 4, 0, 0), present(4, 4), {}, 1).empty());
    EXPECT_TRUE(alreadyLabelled(file(4, 4, 0, 0), present(5, 5), {}, 100).empty());
    EXPECT_TRUE(alreadyLabelled(file(4, 4, 0, 0), present(3, 3), {}, 100).empty());
    EXPECT_FALSE(alreadyLabelled(file(4, 4, 0, 0), present(3, 5), {}, 1).empty()) << "within a longer one";
    EXPECT_TRUE(alreadyLabelled(file(9, 12, 0, 0), present(0, 8), {}, 1).empty());
    EXPECT_TRUE(alreadyLabelled(file(0, 3, 0, 0), present(4, 8), {}, 1).empty());
}

TEST(DoublesByHand, ARegionIsTheSameInAllThatItSays) {
    IgnoreRegion region;
    region.id = 1;
    region.polygon = {{0, 0}, {9, 0}, {9, 9}};
    region.first_frame = region.reference_frame = 2;
    region.last_frame = 7;
    AnnotationSet set;
    set.regions[1] = region;
    EXPECT_TRUE(hasRegion(set, region, 1));
    EXPECT_FALSE(hasRegion({}, region, 1));
    const auto still = [&](const std::function<void(IgnoreRegion&)>& change) {
        IgnoreRegion other = region;
        change(other);
        return hasRegion(set, other, 1);
    };
    EXPECT_TRUE(still([](IgnoreRegion& r) { r.polygon[2].x += 1; }));
    EXPECT_TRUE(still([](IgnoreRegion& r) { r.polygon[2].y -= 1; }));
    EXPECT_FALSE(still([](IgnoreRegion& r) { r.polygon[2].x += 1.01; }));
    EXPECT_FALSE(still([](IgnoreRegion& r) { r.polygon[0].y -= 1.01; }));
    EXPECT_FALSE(still([](IgnoreRegion& r) { r.polygon.emplace_back(0, 9); }));
    EXPECT_FALSE(still([](IgnoreRegion& r) { r.first_frame = 1; }));
    EXPECT_FALSE(still([](IgnoreRegion& r) { r.last_frame = 8; }));
    EXPECT_FALSE(still([](IgnoreRegion& r) { r.reference_frame = 3; }));
    EXPECT_FALSE(still([](IgnoreRegion& r) { r.anchor = RegionAnchor::ground; }));
}

}  // namespace
}  // namespace eyrie::loose_and_double_by_hand_test

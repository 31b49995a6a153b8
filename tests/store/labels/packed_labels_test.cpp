#include "store/labels/packed_labels.h"

#include <gtest/gtest.h>

#include <random>

#include "store/labels/label_samples.h"

namespace eyrie::packed_labels_test {
namespace {

AnnotationSet sampleSet() {
    AnnotationSet set;
    set.objects[1] = test::sampleObject(1, 9);
    set.objects[2] = test::sampleObject(2);
    set.regions[1] = test::sampleRegion(1);
    set.reviews = {test::sampleMark(1), test::sampleMark(2)};
    set.classes = {{"tractor", true, 0x123456, 5.5, 2.25}};
    return set;
}

/// Changes everything there is to change.
AnnotationEdit sampleChange(const AnnotationSet& set) {
    AnnotationEdit edit;
    LabelledObject after = set.objects.at(1);
    after.notes = "other";
    after.last_frame = 400;
    after.keyframes.erase(after.keyframes.begin() + 3);
    after.keyframes[4].box.centre.x += 1;
    after.keyframes.push_back(test::sampleKeyframe(333));
    edit.objects.push_back({set.objects.at(1), after});
    edit.objects.push_back({set.objects.at(2), std::nullopt});
    edit.objects.push_back({std::nullopt, test::sampleObject(3, 2)});
    IgnoreRegion region = set.regions.at(1);
    region.polygon.push_back({3, 4});
    edit.regions.push_back({set.regions.at(1), region});
    edit.regions.push_back({std::nullopt, test::sampleRegion(2)});
    edit.reviews = TailChange<ReviewMark>{1, {set.reviews[1]}, {test::sampleMark(3), test::sampleMark(4)}};
    edit.classes =
        Change<std::vector<ObjectClass>>{set.classes, {{{"tram", false, 1, 20, 2.5}, {"other", false, 0, 0, 0}}}};
    return edit;
}

TEST(PackedLabels, KeyframesComeBackToTheBit) {
    const LabelledObject object = test::sampleObject(5, 200);
    const auto back = unpackKeyframes(packKeyframes(object.keyframes));
    ASSERT_TRUE(back.has_value());
    LabelledObject other = object;
    other.keyframes = *back;
    test::expectSame(object, other);
    EXPECT_EQ(packKeyframes(object.keyframes).size(), 1 + 200 * 45U) << "the layout is part of the file format";
}

TEST(PackedLabels, AStepComesBackFromBothSides) {
    const AnnotationSet before = sampleSet();
    const AnnotationEdit edit = sampleChange(before);
    AnnotationSet after = before;
    applyEdit(after, edit);
    const Bytes bytes = packEdit(edit);
    const auto done = unpackEdit(bytes, after, true);
    ASSERT_TRUE(done.has_value());
    AnnotationSet undone = after;
    applyEdit(undone, inverseOf(*done));
    test::expectSame(undone, before);
    const auto again = unpackEdit(bytes, undone, false);
    ASSERT_TRUE(again.has_value());
    applyEdit(undone, *again);
    test::expectSame(undone, after);
}

TEST(PackedLabels, AStepThatDoesNotFitTheLabelsIsNothing) {
    const AnnotationSet before = sampleSet();
    const AnnotationEdit edit = sampleChange(before);
    AnnotationSet after = before;
    applyEdit(after, edit);
    const Bytes bytes = packEdit(edit);
    EXPECT_FALSE(unpackEdit(bytes, before, true).has_value());
    EXPECT_FALSE(unpackEdit(bytes, {}, true).has_value());
    after.objects.at(1).keyframes[4].box.width += 1;
    EXPECT_FALSE(unpackEdit(bytes, after, true).has_value());
}

TEST(PackedLabels, DamagedBytesAreNothingAndNeverMore) {
    const AnnotationSet before = sampleSet();
    AnnotationSet after = before;
    const AnnotationEdit edit = sampleChange(before);
    applyEdit(after, edit);
    const Bytes whole = packEdit(edit);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        EXPECT_FALSE(unpackEdit(ByteView(whole.data(), size), after, true).has_value()) << size;
    }
    Bytes longer = whole;
    longer.push_back(std::byte{0});
    EXPECT_FALSE(unpackEdit(longer, after, true).has_value());
    // Whatever the bytes say, nothing is read beyond them and no memory is asked for that they cannot fill.
    std::mt19937 dice(3);
    for (int i = 0; i < 4000; ++i) {
        Bytes damaged = whole;
        for (unsigned hits = 1 + dice() % 3; hits > 0; --hits) {
            damaged[dice() % damaged.size()] = static_cast<std::byte>(dice());
        }
        unpackEdit(damaged, after, true);
        unpackEdit(damaged, before, false);
    }
    const Bytes keyframes = packKeyframes(test::sampleObject(1).keyframes);
    for (int i = 0; i < 5000; ++i) {
        Bytes damaged = keyframes;
        damaged[dice() % damaged.size()] = static_cast<std::byte>(dice());
        const auto back = unpackKeyframes(damaged);
        if (!back) continue;
        for (std::size_t k = 1; k < back->size(); ++k) EXPECT_LT((*back)[k - 1].frame, (*back)[k].frame);
    }
}

}  // namespace
}  // namespace eyrie::packed_labels_test

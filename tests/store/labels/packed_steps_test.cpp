#include <gtest/gtest.h>

#include <functional>

#include "store/labels/label_samples.h"
#include "store/labels/packed_labels.h"

/// Steps of work, one difference at a time: what they take and that they come back.
namespace eyrie::packed_steps_test {
namespace {

constexpr std::size_t kKeyframe = 45;  ///< bytes, as docs/project-file.md says
constexpr int kKeyframes = 30;

AnnotationSet setOf(const LabelledObject& object) {
    AnnotationSet set;
    set.objects[object.id] = object;
    return set;
}

/// The bytes of a step that makes one object another, once it is seen to come back from both sides.
std::size_t bytesOfChange(const LabelledObject& before, const LabelledObject& after) {
    AnnotationEdit edit;
    edit.objects.push_back({before, after});
    const Bytes bytes = packEdit(edit);
    const AnnotationSet there = setOf(before), done = setOf(after);
    const auto undoing = unpackEdit(bytes, done, true), doing = unpackEdit(bytes, there, false);
    EXPECT_TRUE(undoing && doing);
    if (!undoing || !doing) return 0;
    for (const AnnotationEdit& known : {*undoing, *doing}) {
        test::expectSame(*known.objects.at(0).before, before);
        test::expectSame(*known.objects.at(0).after, after);
    }
    return bytes.size();
}

std::optional<AnnotationEdit> backOf(const AnnotationEdit& edit) {
    return unpackEdit(packEdit(edit), {}, false);
}

}  // namespace

TEST(PackedSteps, OfAnObjectOnlyTheKeyframesThatDifferAreKept) {
    const LabelledObject before = test::sampleObject(1, kKeyframes);
    LabelledObject noted = before;
    noted.notes = before.notes;
    const std::size_t least = bytesOfChange(before, noted);
    const std::vector<std::function<void(Keyframe&)>> changes{
        [](Keyframe& k) { k.box.centre.x += 0.5; },
        [](Keyframe& k) { k.box.centre.y -= 0.5; },
        [](Keyframe& k) { k.box.length += 1; },
        [](Keyframe& k) { k.box.width += 1; },
        [](Keyframe& k) { k.box.heading += 0.01; },
        [](Keyframe& k) { k.heading_set = !k.heading_set; },
        [](Keyframe& k) { k.occlusion = k.occlusion == Occlusion::none ? Occlusion::partly : Occlusion::none; },
        [](Keyframe& k) { k.outside = !k.outside; },
        [](Keyframe& k) { k.ignore = !k.ignore; },
        [](Keyframe& k) { k.computed = !k.computed; }};
    for (const std::size_t at : {0, 1, 14, kKeyframes - 2, kKeyframes - 1}) {
        for (std::size_t i = 0; i < changes.size(); ++i) {
            LabelledObject after = before;
            changes[i](after.keyframes[at]);
            EXPECT_EQ(bytesOfChange(before, after), least + 2 * kKeyframe) << "field " << i << " of keyframe " << at;
        }
        LabelledObject fewer = before;
        fewer.keyframes.erase(fewer.keyframes.begin() + static_cast<std::ptrdiff_t>(at));
        EXPECT_EQ(bytesOfChange(before, fewer), least + kKeyframe) << at;
        EXPECT_EQ(bytesOfChange(fewer, before), least + kKeyframe) << at;
    }
    // Two that differ, and those between them.
    LabelledObject twice = before;
    changes[0](twice.keyframes[3]);
    changes[0](twice.keyframes[9]);
    EXPECT_EQ(bytesOfChange(before, twice), least + 2 * 7 * kKeyframe);
}

TEST(PackedSteps, TheSmallestThatThereAreComeBack) {
    AnnotationEdit edit;
    LabelledObject object;
    object.id = 1;
    edit.objects.push_back({std::nullopt, object});
    edit.objects.push_back({object, std::nullopt});
    IgnoreRegion region;
    region.id = 1;
    edit.regions.push_back({std::nullopt, region});
    edit.regions.push_back({region, std::nullopt});
    edit.reviews = TailChange<ReviewMark>{0, {ReviewMark()}, {ReviewMark(), ReviewMark()}};
    edit.classes = Change<std::vector<ObjectClass>>{{{ObjectClass()}}, {{ObjectClass(), ObjectClass()}}};
    const auto back = backOf(edit);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->objects.size(), 2U);
    EXPECT_FALSE(back->objects[0].before);
    EXPECT_FALSE(back->objects[1].after);
    EXPECT_EQ(back->regions.size(), 2U);
    EXPECT_FALSE(back->regions[0].before);
    EXPECT_FALSE(back->regions[1].after);
    EXPECT_EQ(back->reviews->removed.size(), 1U);
    EXPECT_EQ(back->reviews->added.size(), 2U);
    EXPECT_EQ(back->classes->before->size(), 1U);
    EXPECT_EQ(back->classes->after->size(), 2U);
    const auto nothing = backOf({});
    ASSERT_TRUE(nothing);
    EXPECT_FALSE(nothing->reviews);
    EXPECT_FALSE(nothing->classes);
}

TEST(PackedSteps, KindsOfChangesThatThereAreNotAreRefused) {
    // One region that is added: the format, no object, one region, of kind 0 in the tenth byte.
    AnnotationEdit edit;
    edit.regions.push_back({std::nullopt, test::sampleRegion(1)});
    Bytes bytes = packEdit(edit);
    ASSERT_TRUE(unpackEdit(bytes, {}, false));
    ASSERT_EQ(bytes.at(9), std::byte{0});
    for (int kind = 1; kind < 256; ++kind) {
        bytes.at(9) = static_cast<std::byte>(kind);
        EXPECT_EQ(unpackEdit(bytes, {}, false).has_value(), kind == 1) << kind << ": 1 is removed, which has one, too";
    }
    // The same of an object.
    edit = {};
    edit.objects.push_back({std::nullopt, test::sampleObject(1)});
    bytes = packEdit(edit);
    ASSERT_EQ(bytes.at(5), std::byte{0});
    for (int kind = 1; kind < 256; ++kind) {
        bytes.at(5) = static_cast<std::byte>(kind);
        EXPECT_EQ(unpackEdit(bytes, {}, false).has_value(), kind == 1) << kind;
    }
}

}  // namespace eyrie::packed_steps_test

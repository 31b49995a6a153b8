#pragma once

#include <gtest/gtest.h>

#include "core/labels/annotation_edit.h"

/// Made-up labels for the tests of the store.
namespace eyrie::test {

/// A keyframe in which every field differs from its default.
inline Keyframe sampleKeyframe(FrameIndex frame, double shift = 0) {
    Keyframe keyframe;
    keyframe.frame = frame;
    keyframe.box = {{100.25 + shift, 50.125 + frame}, 20.5, 9.75, 0.1 + frame * 0.01};
    keyframe.heading_set = frame % 2 == 0;
    keyframe.occlusion = static_cast<Occlusion>(frame % 3);
    keyframe.outside = frame % 5 == 0;
    keyframe.ignore = frame % 7 == 0;
    keyframe.computed = frame % 4 == 0;
    return keyframe;
}

inline LabelledObject sampleObject(ObjectId id, int keyframes = 4) {
    LabelledObject object;
    object.id = id;
    object.object_class = "truck";
    object.colour = 0xfedcba;
    object.notes = "with a trailer, \"grün\"";
    object.origin = ObjectOrigin::proposal_corrected;
    for (int i = 0; i < keyframes; ++i) object.keyframes.push_back(sampleKeyframe(3 + 10 * i, id));
    object.last_frame = 3 + 10 * keyframes;
    return object;
}

inline IgnoreRegion sampleRegion(int id) {
    IgnoreRegion region;
    region.id = id;
    region.polygon = {{1.5, 2}, {100, 3}, {50, 80.25}};
    region.anchor = RegionAnchor::ground;
    region.reference_frame = 7;
    region.first_frame = 2;
    region.last_frame = 90;
    region.notes = "car park";
    return region;
}

inline ReviewMark sampleMark(ObjectId object, FrameIndex first = 3) {
    return {object, first, first + 20, ReviewState::questionable, "Ada", "2026-11-21T08:00:00Z"};
}

/// One edit of each kind at once.
inline AnnotationEdit sampleEdit(ObjectId id) {
    AnnotationEdit edit;
    edit.name = "Draw truck " + std::to_string(id);
    edit.objects.push_back({std::nullopt, sampleObject(id)});
    return edit;
}

inline void expectSame(const LabelledObject& a, const LabelledObject& b) {
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.object_class, b.object_class);
    EXPECT_EQ(a.colour, b.colour);
    EXPECT_EQ(a.notes, b.notes);
    EXPECT_EQ(a.origin, b.origin);
    EXPECT_EQ(a.last_frame, b.last_frame);
    ASSERT_EQ(a.keyframes.size(), b.keyframes.size()) << "object " << a.id;
    for (std::size_t i = 0; i < a.keyframes.size(); ++i) {
        const Keyframe& p = a.keyframes[i];
        const Keyframe& q = b.keyframes[i];
        EXPECT_TRUE(p.frame == q.frame && p.box.centre == q.box.centre && p.box.length == q.box.length &&
                    p.box.width == q.box.width && p.box.heading == q.box.heading && p.heading_set == q.heading_set &&
                    p.occlusion == q.occlusion && p.outside == q.outside && p.ignore == q.ignore &&
                    p.computed == q.computed)
            << "object " << a.id << ", keyframe " << i;
    }
}

inline void expectSame(const AnnotationSet& a, const AnnotationSet& b) {
    ASSERT_EQ(a.objects.size(), b.objects.size());
    for (const auto& [id, object] : a.objects) {
        ASSERT_TRUE(b.objects.count(id)) << id;
        expectSame(object, b.objects.at(id));
    }
    ASSERT_EQ(a.regions.size(), b.regions.size());
    for (const auto& [id, region] : a.regions) {
        ASSERT_TRUE(b.regions.count(id)) << id;
        const IgnoreRegion& other = b.regions.at(id);
        EXPECT_TRUE(region.polygon == other.polygon && region.anchor == other.anchor &&
                    region.reference_frame == other.reference_frame && region.first_frame == other.first_frame &&
                    region.last_frame == other.last_frame && region.notes == other.notes);
    }
    ASSERT_EQ(a.reviews.size(), b.reviews.size());
    for (std::size_t i = 0; i < a.reviews.size(); ++i) {
        const ReviewMark& p = a.reviews[i];
        const ReviewMark& q = b.reviews[i];
        EXPECT_TRUE(p.object == q.object && p.first_frame == q.first_frame && p.last_frame == q.last_frame &&
                    p.state == q.state && p.person == q.person && p.when_utc == q.when_utc);
    }
    ASSERT_EQ(a.classes.size(), b.classes.size());
    for (std::size_t i = 0; i < a.classes.size(); ++i) {
        const ObjectClass& p = a.classes[i];
        const ObjectClass& q = b.classes[i];
        EXPECT_TRUE(p.name == q.name && p.vehicle == q.vehicle && p.colour == q.colour && p.length_m == q.length_m &&
                    p.width_m == q.width_m);
    }
}

}  // namespace eyrie::test

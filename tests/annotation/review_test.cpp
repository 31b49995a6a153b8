#include <gmock/gmock.h>

#include <random>

#include "annotation/edits/identity_edits.h"
#include "annotation/review/attention.h"
#include "annotation/review/review_state.h"
#include "annotation/scenes.h"

namespace eyrie::review_test {
namespace {

using test::keyframe;
using test::object;

AnnotationSet twoCars() {
    AnnotationSet set;
    set.objects[1] = object(1, {keyframe(10, {{50, 50}, 20, 9, 0})}, 29);
    set.objects[4] = object(4, {keyframe(0, {{90, 50}, 20, 9, 0})}, 39);
    return set;
}

ReviewMark mark(ObjectId id, FrameIndex first, FrameIndex last, ReviewState state, const char* person = "Ada") {
    return {id, first, last, state, person, "2026-11-21T08:00:00Z"};
}

TEST(ReviewIndex, LaterMarksReplaceEarlierOnesWhereTheyMeet) {
    AnnotationSet set = twoCars();
    set.reviews = {mark(1, 0, 100, ReviewState::checked), mark(1, 15, 19, ReviewState::questionable, "Bob"),
                   mark(1, 17, 17, ReviewState::unseen), mark(99, 0, 9, ReviewState::checked)};
    const ReviewIndex index(set);
    EXPECT_EQ(index.stateAt(1, 14), ReviewState::checked);
    EXPECT_EQ(index.stateAt(1, 15), ReviewState::questionable);
    EXPECT_EQ(index.stateAt(1, 17), ReviewState::unseen);
    EXPECT_EQ(index.stateAt(1, 19), ReviewState::questionable);
    EXPECT_EQ(index.stateAt(1, 20), ReviewState::checked);
    EXPECT_EQ(index.stateAt(1, 9), ReviewState::unseen) << "before it exists";
    EXPECT_EQ(index.stateAt(1, 30), ReviewState::unseen);
    ASSERT_EQ(index.spansOf(1).size(), 5U);
    EXPECT_EQ(index.spansOf(1)[0].first_frame, 10);
    EXPECT_EQ(index.spansOf(1)[4].last_frame, 29);
    EXPECT_EQ(index.spansOf(1)[1].person, "Bob");
    EXPECT_TRUE(index.spansOf(99).empty());
    EXPECT_DOUBLE_EQ(index.checkedShare(), 15.0 / 60);
    EXPECT_EQ(ReviewIndex({}).checkedShare(), 0);
}

TEST(ReviewIndex, AgreesWithPaintingEveryFrame) {
    std::mt19937 dice(9);
    AnnotationSet set = twoCars();
    std::map<std::pair<int, int>, ReviewState> painted;
    for (int i = 0; i < 60; ++i) {
        const int id = dice() % 2 == 0 ? 1 : 4;
        const int first = static_cast<int>(dice() % 45);
        const int last = first + static_cast<int>(dice() % 12);
        const auto state = static_cast<ReviewState>(dice() % 3);
        set.reviews.push_back(mark(id, first, last, state));
        for (int frame = first; frame <= last; ++frame) painted[{id, frame}] = state;
    }
    const ReviewIndex index(set);
    int frames = 0;
    int checked = 0;
    for (int frame = 0; frame < 50; ++frame) {
        for (const int id : {1, 4}) {
            const auto& car = set.objects.at(id);
            if (frame < car.keyframes[0].frame || frame > car.last_frame) continue;
            EXPECT_EQ(index.stateAt(id, frame), (painted[{id, frame}])) << id << " " << frame;
            ++frames;
            checked += painted[{id, frame}] == ReviewState::checked;
        }
    }
    EXPECT_DOUBLE_EQ(index.checkedShare(), 1.0 * checked / frames);
}

TEST(ReviewIndex, FindsWhatIsNotCheckedYet) {
    AnnotationSet set = twoCars();
    set.reviews = {mark(1, 10, 19, ReviewState::checked), mark(4, 0, 34, ReviewState::checked)};
    const ReviewIndex index(set);
    EXPECT_EQ(index.nextUnchecked(1, 5)->frame, 20);
    EXPECT_EQ(index.nextUnchecked(1, 22)->frame, 23);
    EXPECT_EQ(index.nextUnchecked(1, 29)->object, 4);
    EXPECT_EQ(index.nextUnchecked(1, 29)->frame, 35);
    EXPECT_EQ(index.nextUnchecked(4, 39)->object, 1);
    applyEdit(set,
              reviewEdit("Check", set, {mark(1, 0, 99, ReviewState::checked), mark(4, 0, 99, ReviewState::checked)}));
    const ReviewIndex done(set);
    EXPECT_FALSE(done.nextUnchecked(1, 0).has_value());
    EXPECT_DOUBLE_EQ(done.checkedShare(), 1);
}

TEST(Attention, ListsWhatDeservesALook) {
    AttentionOptions options;
    options.image = {320, 240};
    options.frame_count = 100;
    const auto camera = CameraMotion::standing(0, 99);
    AnnotationSet set;
    // Comes in and goes out over the border, steadily.
    set.objects[1] = object(1, {keyframe(0, {{5, 50}, 20, 9, 0}), keyframe(60, {{315, 50}, 20, 9, 0})}, 60);
    // Begins and ends in the middle, jumps in between.
    set.objects[2] = object(
        2,
        {keyframe(10, {{100, 90}, 20, 9, 0}), keyframe(20, {{110, 90}, 20, 9, 0}), keyframe(22, {{150, 90}, 20, 9, 0})},
        50);
    // Outside for a while, though in the middle; then of another size.
    set.objects[3] = object(3,
                            {keyframe(0, {{100, 150}, 20, 9, 0}), keyframe(30, {{130, 150}, 20, 9, 0}),
                             keyframe(40, {{140, 150}, 20, 9, 0}), keyframe(99, {{199, 150}, 40, 9, 0})},
                            99);
    set.objects[3].keyframes[1].outside = true;
    // Turns on the spot.
    set.objects[4] =
        object(4, {keyframe(0, {{100, 200}, 20, 9, 0}, true), keyframe(3, {{100, 200}, 20, 9, 2}, true)}, 99);
    set.reviews = {mark(1, 30, 40, ReviewState::questionable)};
    const auto items = attentionList(set, camera, options);
    std::vector<std::string> found;
    for (const auto& item : items) {
        found.push_back(std::to_string(item.frame) + " " + std::to_string(item.object) + " " + nameOf(item.kind));
        EXPECT_FALSE(item.text.empty());
    }
    EXPECT_THAT(found, testing::ElementsAre("3 4 turn", "10 2 begins inside", "20 2 jump", "30 1 questionable",
                                            "30 3 gap", "50 2 ends inside", "99 3 size"));
    EXPECT_EQ(nextAttention(items, 10, 1)->object, 2);
    EXPECT_EQ(nextAttention(items, 30, 1)->object, 3);
    EXPECT_EQ(nextAttention(items, 99, 3)->frame, 3) << "from the start again";
    EXPECT_FALSE(nextAttention({}, 0, 0).has_value());
}

}  // namespace
}  // namespace eyrie::review_test

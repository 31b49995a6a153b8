#include "annotation/edits/identity_edits.h"

#include <gmock/gmock.h>

#include <functional>

#include "annotation/keyframes/interpolation.h"
#include "annotation/review/join_suggestions.h"
#include "annotation/scenes.h"
#include "core/error.h"

namespace eyrie::identity_edits_test {
namespace {

using test::keyframe;
using test::seen;

const CameraMotion flying(test::stepsOf(test::flyingView, 200));

/// A car on a winding way over the ground.
LabelledObject winding(ObjectId id, int first, int last, double y) {
    LabelledObject car;
    car.id = id;
    car.notes = "notes of " + std::to_string(id);
    for (int frame = first; frame <= last; frame += 15) {
        const OrientedBox on_ground{{2.0 * frame, y + 25 * std::sin(frame / 25.0)}, 20, 9, 0};
        car.keyframes.push_back(keyframe(frame, seen(on_ground, test::flyingView(frame))));
    }
    car.last_frame = last;
    return car;
}

/// Expects that what one object shows in a range another did.
void expectShows(const LabelledObject& now, const LabelledObject& before, int first, int last) {
    for (int frame = first; frame <= last; ++frame) {
        const LabelledBox a = boxAt(now, frame, flying);
        const LabelledBox b = boxAt(before, frame, flying);
        ASSERT_TRUE(a.visible()) << frame;
        ASSERT_LE(test::cornerDistance(a.box, b.box), 0.5 + 1e-9) << "object " << now.id << ", frame " << frame;
    }
}

void expectRefused(const std::string& words, const std::function<void()>& action) {
    try {
        action();
        FAIL() << "expected an error with: " << words;
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::parameter);
        EXPECT_THAT(error.what(), testing::HasSubstr(words));
    }
}

AnnotationSet setOf(const std::vector<LabelledObject>& objects) {
    AnnotationSet set;
    for (const auto& object : objects) set.objects[object.id] = object;
    return set;
}

const LabelledObject& objectOf(const IdentityChange& change, ObjectId id) {
    for (const auto& object : change.after) {
        if (object.id == id) return object;
    }
    throw std::runtime_error("no object " + std::to_string(id));
}

TEST(IdentityEdits, SplitShowsTheSameBoxesAsTwoObjects) {
    const auto car = winding(1, 0, 160, 50);
    for (const int frame : {1, 15, 16, 77, 159, 160}) {
        const auto change = splitAt(car, frame, 9, flying);
        EXPECT_EQ(objectOf(change, 1).last_frame, frame - 1);
        EXPECT_EQ(firstFrameOf(objectOf(change, 9)), frame);
        EXPECT_EQ(objectOf(change, 9).last_frame, 160);
        EXPECT_EQ(objectOf(change, 9).notes, car.notes);
        expectShows(objectOf(change, 1), car, 0, frame - 1);
        expectShows(objectOf(change, 9), car, frame, 160);
        for (const auto& object : change.after) EXPECT_NO_THROW(checkObject(object));
    }
    expectRefused("nothing to split off", [&] { splitAt(car, 0, 9, flying); });
    expectRefused("does not exist in frame 161", [&] { splitAt(car, 161, 9, flying); });
}

TEST(IdentityEdits, SplittingAndJoiningGiveTheSameBoxesAgain) {
    const auto car = winding(1, 0, 160, 50);
    const auto halves = splitAt(car, 77, 9, flying);
    const auto whole = joinInTime(objectOf(halves, 9), objectOf(halves, 1), flying);
    EXPECT_EQ(whole.removed, std::vector<ObjectId>{1});
    ASSERT_EQ(whole.after.size(), 1U);
    EXPECT_EQ(whole.after[0].id, 9) << "the one to keep, although it is the later";
    for (int frame = 0; frame <= 160; ++frame) {
        EXPECT_LE(test::cornerDistance(boxAt(whole.after[0], frame, flying).box, boxAt(car, frame, flying).box), 1.1);
    }
}

TEST(IdentityEdits, JoiningOverAGapInterpolatesOrIsOutside) {
    const auto first = winding(1, 0, 60, 50);
    auto second = winding(2, 90, 150, 50);
    const auto through = joinInTime(first, second, flying).after[0];
    EXPECT_TRUE(boxAt(through, 75, flying).visible());
    EXPECT_EQ(through.last_frame, 150);
    const auto outside = joinInTime(first, second, flying, GapFilling::outside).after[0];
    EXPECT_TRUE(boxAt(outside, 60, flying).visible());
    EXPECT_FALSE(boxAt(outside, 61, flying).visible());
    EXPECT_FALSE(boxAt(outside, 89, flying).visible());
    EXPECT_TRUE(boxAt(outside, 90, flying).visible());
    expectShows(outside, first, 0, 60);
    expectShows(outside, second, 90, 150);
    second.keyframes.insert(second.keyframes.begin(), keyframe(50, {{0, 0}, 20, 9, 0}));
    expectRefused("fuse them", [&] { joinInTime(first, second, flying); });
    expectRefused("itself", [&] { joinInTime(first, first, flying); });
}

TEST(IdentityEdits, WhatStoodBeforeAGapStandsThereStill) {
    const OrientedBox parked{{200, 90}, 20, 9, 0.4};
    auto standing = test::object(1, {keyframe(0, seen(parked, test::flyingView(0)), true)}, 60);
    const auto later = winding(2, 90, 150, 90);
    const auto whole = joinInTime(standing, later, flying).after[0];
    expectShows(whole, standing, 0, 60);
}

TEST(IdentityEdits, SwapFromHereChangesHandsAndTwiceIsNothing) {
    const auto a = winding(1, 0, 160, 50);
    const auto b = winding(2, 20, 140, 80);
    const auto change = swapFrom(a, b, 77, flying);
    const auto& new_a = objectOf(change, 1);
    const auto& new_b = objectOf(change, 2);
    EXPECT_EQ(new_a.notes, a.notes);
    EXPECT_EQ(new_a.last_frame, 140);
    EXPECT_EQ(new_b.last_frame, 160);
    expectShows(new_a, a, 0, 76);
    expectShows(new_a, b, 77, 140);
    expectShows(new_b, b, 20, 76);
    expectShows(new_b, a, 77, 160);
    const auto back = swapFrom(new_a, new_b, 77, flying);
    for (int frame = 0; frame <= 160; ++frame) {
        EXPECT_LE(test::cornerDistance(boxAt(objectOf(back, 1), frame, flying).box, boxAt(a, frame, flying).box), 1.1);
    }
}

TEST(IdentityEdits, SwapWithOneThatEndedHandsOverTheRest) {
    const auto lost = winding(1, 0, 60, 50);
    const auto found = winding(2, 75, 150, 50);
    const auto change = swapFrom(lost, found, 70, flying);
    EXPECT_EQ(change.removed, std::vector<ObjectId>{2});
    EXPECT_EQ(objectOf(change, 1).last_frame, 150);
    EXPECT_FALSE(boxAt(objectOf(change, 1), 65, flying).visible()) << "nobody saw it there";
    expectRefused("neither", [&] { swapFrom(lost, found, 151, flying); });
}

TEST(IdentityEdits, RenumberFromHere) {
    const auto car = winding(1, 0, 160, 50);
    const auto fresh = renumberFrom(car, 80, 7, nullptr, flying);
    expectShows(objectOf(fresh, 7), car, 80, 160);
    const auto whole = renumberFrom(car, 0, 7, nullptr, flying);
    EXPECT_EQ(whole.removed, std::vector<ObjectId>{1});
    const auto target = winding(5, 0, 45, 200);
    const auto change = renumberFrom(car, 80, 7, &target, flying);
    EXPECT_EQ(objectOf(change, 5).last_frame, 160);
    EXPECT_EQ(objectOf(change, 5).notes, target.notes);
    expectShows(objectOf(change, 5), target, 0, 45);
    expectShows(objectOf(change, 5), car, 80, 160);
    expectShows(objectOf(change, 1), car, 0, 79);
    const auto alive = winding(6, 60, 120, 200);
    expectRefused("swap the two", [&] { renumberFrom(car, 80, 7, &alive, flying); });
}

TEST(IdentityEdits, FuseTakesWhatOnlyTheOtherHas) {
    const auto kept = winding(1, 45, 105, 50);
    const auto other = winding(2, 0, 150, 54);
    const auto change = fuseInParallel(kept, other, flying);
    ASSERT_EQ(change.after.size(), 1U);
    EXPECT_EQ(change.after[0].notes, kept.notes);
    expectShows(change.after[0], other, 0, 44);
    expectShows(change.after[0], kept, 45, 105);
    expectShows(change.after[0], other, 106, 150);
    const auto mean = fuseInParallel(kept, other, flying, FuseRule::mean).after[0];
    const cv::Point2d middle = (boxAt(kept, 60, flying).box.centre + boxAt(other, 60, flying).box.centre) * 0.5;
    EXPECT_NEAR(boxAt(mean, 60, flying).box.centre.y, middle.y, 0.3);
    expectRefused("join them", [&] { fuseInParallel(winding(1, 0, 30, 5), winding(2, 45, 60, 5), flying); });
}

TEST(IdentityEdits, DeleteBeforeAndAfter) {
    const auto car = winding(1, 0, 160, 50);
    expectShows(objectOf(deleteBefore(car, 50, flying), 1), car, 50, 160);
    expectShows(objectOf(deleteAfter(car, 50, flying), 1), car, 0, 50);
    EXPECT_FALSE(boxAt(objectOf(deleteAfter(car, 50, flying), 1), 51, flying).exists());
    EXPECT_EQ(deleteBefore(car, 161, flying).removed, std::vector<ObjectId>{1});
    EXPECT_EQ(deleteAfter(car, -1, flying).removed, std::vector<ObjectId>{1});
}

TEST(IdentityEdits, OneFrameIsLeftOfWhatIsDeletedBesideIt) {
    const auto car = winding(1, 0, 160, 50);
    expectShows(objectOf(deleteAfter(car, 0, flying), 1), car, 0, 0);
    expectShows(objectOf(deleteAfter(car, 1, flying), 1), car, 0, 1);
    expectShows(objectOf(deleteBefore(car, 160, flying), 1), car, 160, 160);
}

TEST(IdentityEdits, FlagsOfARangeEndWithTheRange) {
    auto car = winding(1, 0, 160, 50);
    car.keyframes[6].occlusion = Occlusion::partly;  // frame 90
    const auto flagged = withFlags(car, 40, 100, {Occlusion::fully, std::nullopt, true}, flying);
    for (int frame = 0; frame <= 160; ++frame) {
        const LabelledBox box = boxAt(flagged, frame, flying);
        const bool inside = frame >= 40 && frame <= 100;
        EXPECT_EQ(box.ignore, inside) << frame;
        EXPECT_EQ(box.occlusion, inside ? Occlusion::fully : boxAt(car, frame, flying).occlusion) << frame;
    }
    expectShows(flagged, car, 0, 160);
    EXPECT_EQ(withFlags(car, 170, 180, {Occlusion::fully, {}, {}}, flying).keyframes.size(), car.keyframes.size());
    EXPECT_EQ(withClass({car}, "bus", 5)[0].object_class, "bus");
}

TEST(IdentityEdits, ReviewMarksGoWithTheirFramesAndAllIsOneStepBack) {
    AnnotationSet set = setOf({winding(1, 0, 160, 50), winding(2, 0, 160, 90)});
    set.reviews = {{1, 10, 120, ReviewState::checked, "Ada", "t1"},
                   {2, 0, 160, ReviewState::questionable, "Bob", "t2"}};
    const AnnotationSet before = set;
    const AnnotationEdit edit = editOf("Split car 1", set, splitAt(set.objects.at(1), 80, 9, flying));
    applyEdit(set, edit);
    ASSERT_EQ(set.objects.size(), 3U);
    ASSERT_EQ(set.reviews.size(), 3U);
    EXPECT_EQ(set.reviews[0].object, 1);
    EXPECT_EQ(set.reviews[0].last_frame, 79);
    EXPECT_EQ(set.reviews[1].object, 9);
    EXPECT_EQ(set.reviews[1].first_frame, 80);
    EXPECT_EQ(set.reviews[1].person, "Ada");
    applyEdit(set, inverseOf(edit));
    EXPECT_EQ(set.objects.size(), 2U);
    ASSERT_EQ(set.reviews.size(), 2U);
    EXPECT_EQ(set.reviews[0].last_frame, 120);
    applyEdit(set, deletionOf("Delete car 1", set, {1}));
    ASSERT_EQ(set.reviews.size(), 1U);
    EXPECT_EQ(set.reviews[0].object, 2);
}

TEST(JoinSuggestions, AreRankedByDistanceOverTheGround) {
    // The one that goes on where the lost one would be, one that is near in the image only, one too far.
    AnnotationSet set = setOf({winding(1, 0, 60, 50), winding(2, 90, 150, 50), winding(3, 90, 150, 95)});
    const cv::Point2d last = boxAt(set.objects.at(1), 60, flying).box.centre;
    set.objects[4] = test::object(4, {keyframe(90, {last, 20, 9, 0})}, 150);
    set.objects[5] = test::object(5, {keyframe(90, {last + cv::Point2d(900, 0), 20, 9, 0})}, 150);
    set.objects[6] = winding(6, 30, 150, 50);  // lives at the same time
    const auto suggestions = suggestJoins(set, 1, flying);
    ASSERT_GE(suggestions.size(), 2U);
    EXPECT_EQ(suggestions[0].object, 2);
    EXPECT_LT(suggestions[0].distance_px, 20);
    EXPECT_EQ(suggestions[0].gap, 29);
    EXPECT_TRUE(suggestions[0].over_ground);
    EXPECT_EQ(suggestions[1].object, 3);
    for (const auto& suggestion : suggestions) EXPECT_LT(suggestion.object, 5);
    const auto backwards = suggestJoins(set, 2, flying);
    ASSERT_FALSE(backwards.empty());
    EXPECT_EQ(backwards[0].object, 1);
    EXPECT_FALSE(backwards[0].later);
    EXPECT_FALSE(suggestJoins(set, 1, CameraMotion())[0].over_ground);
    EXPECT_TRUE(suggestJoins(set, 77, flying).empty());
    const auto fusions = suggestFusions(set, 1, flying);
    ASSERT_EQ(fusions.size(), 1U);
    EXPECT_EQ(fusions[0].object, 6);
}

}  // namespace
}  // namespace eyrie::identity_edits_test

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <opencv2/core.hpp>

#include "annotation/review/attention.h"
#include "annotation/review/join_suggestions.h"
#include "imaging/following/box_patch.h"

/// What deserves a look and what may be one vehicle, each limit from both sides; and what of a picture a patch is.
namespace eyrie::labels_by_hand_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Keyframe keyframe(FrameIndex frame, double x, double y = 100, double length = 20, double width = 10) {
    Keyframe made;
    made.frame = frame;
    made.box = {{x, y}, length, width, 0};
    return made;
}

Keyframe headed(FrameIndex frame, double heading) {
    Keyframe made = keyframe(frame, 100);
    made.box.heading = heading;
    made.heading_set = true;
    return made;
}

LabelledObject objectOf(ObjectId id, std::vector<Keyframe> keyframes, FrameIndex last) {
    LabelledObject object;
    object.id = id;
    object.keyframes = std::move(keyframes);
    object.last_frame = last;
    return object;
}

/// Of one object in a video of 100 frames of 320 × 240 px.
std::vector<AttentionItem> itemsOf(std::vector<Keyframe> keyframes, FrameIndex last = 99) {
    AttentionOptions options;
    options.image = {320, 240};
    options.frame_count = 100;
    AnnotationSet set;
    set.objects[1] = objectOf(1, std::move(keyframes), last);
    return attentionList(set, CameraMotion::standing(0, 99), options);
}

std::vector<std::string> wordsOf(std::vector<Keyframe> keyframes, FrameIndex last = 99) {
    std::vector<std::string> words;
    for (const AttentionItem& item : itemsOf(std::move(keyframes), last))
        words.push_back(std::to_string(item.frame) + " " + nameOf(item.kind) + ": " + item.text);
    return words;
}

/// Values at random on a grid of so many px; black between them.
cv::Mat sparse(int spacing, const std::function<cv::Point(int x, int y)>& place) {
    cv::Mat picture(60, 60, CV_8UC1, cv::Scalar(0));
    cv::RNG dice(5);
    for (int y = -5; y <= 5; ++y)
        for (int x = -5; x <= 5; ++x) {
            const cv::Point at = cv::Point(30, 30) + place(x, y) * spacing;
            picture.at<unsigned char>(at) = static_cast<unsigned char>(dice.uniform(0, 256));
        }
    return picture;
}

cv::Point asItIs(int x, int y) {
    return {x, y};
}

}  // namespace

TEST(AttentionByHand, WithinTwelvePixelsOfTheBorderAnObjectMayBegin) {
    const auto begins = [](double x, double y) { return !itemsOf({keyframe(5, x, y)}).empty(); };
    EXPECT_FALSE(begins(22, 100)) << "its rear is at 12";
    EXPECT_TRUE(begins(22.5, 100));
    EXPECT_FALSE(begins(297, 100)) << "its front is at 307 of 0 … 319";
    EXPECT_TRUE(begins(296.5, 100));
    EXPECT_FALSE(begins(100, 17));
    EXPECT_TRUE(begins(100, 17.5));
    EXPECT_FALSE(begins(100, 222));
    EXPECT_TRUE(begins(100, 221.5));
    EXPECT_THAT(wordsOf({keyframe(1, 100)}), ElementsAre("1 begins inside: begins in the middle of the image"));
    EXPECT_THAT(wordsOf({keyframe(0, 100)}), IsEmpty());
    EXPECT_THAT(wordsOf({keyframe(0, 100)}, 98), ElementsAre("98 ends inside: ends in the middle of the image"));
    EXPECT_THAT(wordsOf({keyframe(0, 22)}, 98), IsEmpty());
}

TEST(AttentionByHand, ASpeedMayChangeByThreePixelsOrByTwoAndAHalfTimes) {
    const auto changes = [](double before, double after) {
        return wordsOf({keyframe(0, 100), keyframe(10, 100 + 10 * before), keyframe(20, 100 + 10 * (before + after))});
    };
    EXPECT_THAT(changes(1, 4), ElementsAre("10 jump: 4.0 px/frame, 1.0 before"));
    EXPECT_THAT(changes(4, 1), ElementsAre("10 jump: 1.0 px/frame, 4.0 before"));
    EXPECT_THAT(changes(1, 3.9), IsEmpty());
    EXPECT_THAT(changes(3.9, 1), IsEmpty());
    EXPECT_THAT(changes(4, 10), ElementsAre("10 jump: 10.0 px/frame, 4.0 before"));
    EXPECT_THAT(changes(4, 9.9), IsEmpty());
    std::vector<Keyframe> away{keyframe(0, 100), keyframe(10, 110), keyframe(20, 150), keyframe(30, 200)};
    away[1].outside = true;
    EXPECT_THAT(wordsOf(away), ElementsAre("10 gap: outside for 10 frames although it was inside the image"))
        << "what nobody saw has no speed";
}

TEST(AttentionByHand, SizesMayChangeByTwoFifthsAndHeadingsByAThirdOfARadianAFrame) {
    const auto grows = [](double length, double width) {
        return wordsOf({keyframe(0, 100), keyframe(50, 100, 100, length, width)});
    };
    EXPECT_THAT(grows(28.1, 10), ElementsAre("50 size: 28 px long, 20 before, 10 px wide, 10 before"));
    EXPECT_THAT(grows(27.9, 10), IsEmpty());
    EXPECT_THAT(grows(20, 14.1), ElementsAre("50 size: 20 px long, 20 before, 14 px wide, 10 before"));
    EXPECT_THAT(grows(20, 13.9), IsEmpty());
    EXPECT_THAT(grows(14.2, 10), ElementsAre("50 size: 14 px long, 20 before, 10 px wide, 10 before"));
    EXPECT_THAT(grows(14.4, 10), IsEmpty());
    EXPECT_THAT(wordsOf({headed(0, 0), headed(4, 1.41)}), ElementsAre("4 turn: turns by 81° in 4 frames"));
    EXPECT_THAT(wordsOf({headed(0, 0), headed(4, 1.39)}), IsEmpty());
    EXPECT_THAT(wordsOf({headed(0, 0.2), headed(4, -1.21)}), ElementsAre("4 turn: turns by 81° in 4 frames"));
    EXPECT_THAT(wordsOf({headed(0, 3), headed(1, -3)}), IsEmpty()) << "the shorter way round";
}

TEST(JoinsByHand, AVehicleIsExpectedWhereItStoodOrWhereItWasGoing) {
    const CameraMotion camera = CameraMotion::standing(0, 999);
    AnnotationSet set;
    set.objects[1] = objectOf(1, {keyframe(0, 100), keyframe(10, 120)}, 10);  // 2 px a frame
    set.objects[2] = objectOf(2, {keyframe(20, 141)}, 30);
    set.objects[3] = objectOf(3, {keyframe(21, 120, 130)}, 30);
    set.objects[4] = objectOf(4, {keyframe(5, 120)}, 30);  // beside it, not after it
    const auto found = suggestJoins(set, 1, camera);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].object, 2);
    EXPECT_TRUE(found[0].later);
    EXPECT_EQ(found[0].gap, 9);
    EXPECT_NEAR(found[0].distance_px, 1, 1e-9) << "going on by 20 px it would be at 140";
    EXPECT_NEAR(found[0].heading_turn, 0, 1e-9);
    EXPECT_TRUE(found[0].over_ground);
    EXPECT_EQ(found[1].object, 3);
    EXPECT_EQ(found[1].gap, 10);
    EXPECT_NEAR(found[1].distance_px, 30, 1e-9) << "had it stood";
    const auto back = suggestJoins(set, 2, camera);
    ASSERT_EQ(back.size(), 1U);
    EXPECT_EQ(back[0].object, 1);
    EXPECT_FALSE(back[0].later);
    EXPECT_EQ(back[0].gap, 9);
    EXPECT_NEAR(back[0].distance_px, 1, 1e-9);
    EXPECT_FALSE(suggestJoins(set, 1, {}).at(0).over_ground);
    EXPECT_TRUE(suggestJoins(set, 77, camera).empty());
}

TEST(JoinsByHand, TheLimitsAreThoseOfTheOptions) {
    const CameraMotion camera = CameraMotion::standing(0, 999);
    const auto isNear = [&](FrameIndex begin, double x) {
        AnnotationSet set;
        set.objects[1] = objectOf(1, {keyframe(0, 100)}, 10);
        set.objects[2] = objectOf(2, {keyframe(begin, x)}, begin + 5);
        return !suggestJoins(set, 1, camera).empty() && !suggestJoins(set, 2, camera).empty();
    };
    EXPECT_TRUE(isNear(20, 308.9)) << "200 px, and 9 for the gap";
    EXPECT_FALSE(isNear(20, 309.1));
    EXPECT_TRUE(isNear(261, 100)) << "250 frames between them";
    EXPECT_FALSE(isNear(262, 100));
    AnnotationSet many;
    many.objects[1] = objectOf(1, {keyframe(0, 100)}, 10);
    for (int id = 2; id <= 11; ++id) many.objects[id] = objectOf(id, {keyframe(20, 100 + 3.0 * id)}, 30);
    const auto found = suggestJoins(many, 1, camera);
    ASSERT_EQ(found.size(), 8U);
    EXPECT_EQ(found.back().object, 9);
}

TEST(JoinsByHand, ObjectsThatShareThreeTenthsMayBeFused) {
    AnnotationSet set;
    set.objects[1] = objectOf(1, {keyframe(0, 100)}, 99);
    set.objects[2] = objectOf(2, {keyframe(0, 110)}, 99);    // 10 of 30 px
    set.objects[3] = objectOf(3, {keyframe(90, 105)}, 200);  // 15 of 25 px
    set.objects[4] = objectOf(4, {keyframe(0, 111)}, 99);    // 9 of 31 px
    set.objects[5] = objectOf(5, {keyframe(100, 100)}, 200);
    const auto found = suggestFusions(set, 1, CameraMotion::standing(0, 999));
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].object, 3);
    EXPECT_EQ(found[0].shared_frames, 10);
    EXPECT_NEAR(found[0].mean_overlap, 0.6, 1e-9);
    EXPECT_EQ(found[1].object, 2);
    EXPECT_EQ(found[1].shared_frames, 50) << "every other of 100";
    EXPECT_NEAR(found[1].mean_overlap, 1.0 / 3, 1e-9);
    EXPECT_TRUE(suggestFusions(set, 77, {}).empty());
}

TEST(JoinsByHand, OnlyFramesInWhichBothAreSeenAreShared) {
    const auto away = [](Keyframe made) {
        made.outside = true;
        return made;
    };
    AnnotationSet set;
    set.objects[1] = objectOf(1, {keyframe(0, 100), away(keyframe(30, 100))}, 39);
    set.objects[2] = objectOf(2, {away(keyframe(0, 300)), keyframe(20, 100)}, 39);
    set.objects[3] =
        objectOf(3, {keyframe(0, 100), away(keyframe(5, 100)), keyframe(25, 300), away(keyframe(35, 9))}, 39);
    set.objects[4] = objectOf(4, {away(keyframe(0, 100)), keyframe(30, 100)}, 39);
    const CameraMotion camera = CameraMotion::standing(0, 999);
    const auto found = suggestFusions(set, 1, camera);
    ASSERT_EQ(found.size(), 2U) << "the fourth is seen only while the first is not";
    EXPECT_EQ(found[0].object, 2);
    EXPECT_EQ(found[0].shared_frames, 10);
    EXPECT_NEAR(found[0].mean_overlap, 1, 1e-9);
    EXPECT_EQ(found[1].object, 3);
    EXPECT_EQ(found[1].shared_frames, 10);
    EXPECT_NEAR(found[1].mean_overlap, 0.5, 1e-9) << "five frames at one place, five far away";
    // It does not matter which of the two is asked about.
    const auto back = suggestFusions(set, 2, camera, 0);
    ASSERT_EQ(back.size(), 3U);
    EXPECT_EQ(back[0].object, 1);
    EXPECT_EQ(back[0].shared_frames, 10);
    EXPECT_EQ(back[1].object, 4);
    EXPECT_EQ(back[1].shared_frames, 10);
}

TEST(BoxPatchByHand, HasASampleAPixelBetweenSixAndFortyEight) {
    EXPECT_EQ(BoxPatch::samplesFor({{0, 0}, 20.4, 9.6, 0}), cv::Size(20, 10));
    EXPECT_EQ(BoxPatch::samplesFor({{0, 0}, 5, 2, 0}), cv::Size(6, 6));
    EXPECT_EQ(BoxPatch::samplesFor({{0, 0}, 90, 48.6, 0}), cv::Size(48, 48));
}

TEST(BoxPatchByHand, SamplesAreSpreadOverATwelfthMoreThanTheBox) {
    // 7 samples over 1.12 · 12.5 px lie 2 px apart, over half of that 1 px.
    const cv::Size seven(7, 7);
    const BoxPatch far(sparse(2, asItIs), {{30, 30}, 12.5, 12.5, 0}, seven);
    const BoxPatch near(sparse(1, asItIs), {{30, 30}, 6.25, 6.25, 0}, seven);
    EXPECT_NEAR(far.correlation(near), 1, 1e-4);
    EXPECT_LT(std::abs(far.correlation(BoxPatch(sparse(1, asItIs), {{31, 30}, 6.25, 6.25, 0}, seven))), 0.6);
    // Along and across have their own distances.
    const auto wide = [](int x, int y) { return cv::Point(2 * x, y); };
    EXPECT_NEAR(near.correlation(BoxPatch(sparse(1, wide), {{30, 30}, 12.5, 6.25, 0}, seven)), 1, 1e-4);
    // Headed downwards, what is ahead is below, and what is at the right is to the left.
    const auto turned = [](int x, int y) { return cv::Point(-y, x); };
    EXPECT_NEAR(near.correlation(BoxPatch(sparse(1, turned), {{30, 30}, 6.25, 6.25, CV_PI / 2}, seven)), 1, 1e-4);
    // Beyond the border its value goes on.
    cv::Mat corner = sparse(1, asItIs)(cv::Rect(30, 30, 30, 30)).clone(), padded(60, 60, CV_8UC1);
    cv::copyMakeBorder(corner, padded, 30, 0, 30, 0, cv::BORDER_REPLICATE);
    EXPECT_NEAR(BoxPatch(corner, {{0, 0}, 6.25, 6.25, 0}, seven)
                    .correlation(BoxPatch(padded, {{30, 30}, 6.25, 6.25, 0}, seven)),
                1, 1e-3);
}

TEST(BoxPatchByHand, BrightnessAndContrastDoNotCount) {
    const cv::Mat picture = sparse(1, asItIs);
    cv::Mat dim, negative, grey(60, 60, CV_8UC1, cv::Scalar(90));
    picture.convertTo(dim, CV_8U, 0.5, 60);
    negative = 255 - picture;
    const OrientedBox box{{30, 30}, 6.25, 6.25, 0};
    const cv::Size seven(7, 7);
    const BoxPatch patch(picture, box, seven);
    EXPECT_NEAR(patch.correlation(patch), 1, 1e-5);
    EXPECT_NEAR(patch.correlation(BoxPatch(dim, box, seven)), 1, 1e-3);
    EXPECT_NEAR(patch.correlation(BoxPatch(negative, box, seven)), -1, 1e-5);
    EXPECT_EQ(patch.correlation(BoxPatch(grey, box, seven)), 0);
    EXPECT_EQ(patch.correlation(BoxPatch(picture, box, {6, 7})), 0) << "another number of samples";
    // Of a patch and its negative a quarter leaves half, three quarters turn it over.
    BoxPatch learnt = patch;
    learnt.learn(BoxPatch(negative, box, seven), 0.25);
    EXPECT_NEAR(learnt.correlation(patch), 1, 1e-5) << "half as strong, which does not count";
    learnt = patch;
    learnt.learn(BoxPatch(negative, box, seven), 0.75);
    EXPECT_NEAR(learnt.correlation(patch), -1, 1e-5);
}

TEST(BoxPatchByHand, PartsAreComparedByThemselves) {
    // 16 × 16 samples, a pixel apart, are four parts.
    cv::Mat picture(40, 40, CV_8UC1), other(40, 40, CV_8UC1);
    cv::RNG dice(3);
    dice.fill(picture, cv::RNG::UNIFORM, 0, 256);
    dice.fill(other, cv::RNG::UNIFORM, 0, 256);
    const OrientedBox box{{19.5, 19.5}, 16 / 1.12, 16 / 1.12, 0};
    const cv::Size samples(16, 16);
    const BoxPatch patch(picture, box, samples);
    EXPECT_EQ(patch.seenOf(patch), 1);
    EXPECT_EQ(patch.seenOf(BoxPatch(other, box, samples)), 0);
    EXPECT_EQ(patch.seenOf(BoxPatch(picture, box, {16, 15})), 0);
    cv::Mat half = picture.clone();
    other(cv::Rect(20, 0, 20, 40)).copyTo(half(cv::Rect(20, 0, 20, 40)));
    EXPECT_EQ(patch.seenOf(BoxPatch(half, box, samples)), 0.5);
    half(cv::Rect(20, 20, 20, 20)).setTo(128);
    EXPECT_NEAR(patch.seenOf(BoxPatch(half, box, samples)), 2.0 / 3, 1e-9)
        << "where the other shows nothing, nothing is compared";
    cv::Mat quarter = picture.clone();
    other(cv::Rect(0, 20, 20, 20)).copyTo(quarter(cv::Rect(0, 20, 20, 20)));
    EXPECT_EQ(patch.seenOf(BoxPatch(quarter, box, samples)), 0.75);
}

}  // namespace eyrie::labels_by_hand_test

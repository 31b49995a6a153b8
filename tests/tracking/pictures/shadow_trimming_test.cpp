// How much of a known shadow is taken out of which boxes, on numbers that can be followed by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "tracking/frame_summaries.h"
#include "tracking/pictures/cast_shadow.h"

namespace eyrie::shadow_trimming_test {
namespace {

const SceneScale kScale{0.2, 25, true};  // 5 px are 1 m
const cv::Point2d kMiddle(320, 180);

/// A resting camera, not registered in some frame.
GroundTurns resting(int cut_at = -1) {
    GroundMotion ground;
    for (FrameIndex frame = 0; frame < 40; ++frame) {
        ground.add(test::summaryOfFrame(frame));
        if (frame != cut_at) continue;
        FrameMotionSummary failed = test::summaryOfFrame(++frame);
        failed.registration.state = RegistrationState::failed;
        ground.add(failed);
    }
    return GroundTurns(ground, 0, 39);
}

/// A vehicle of 20 × 10 px whose box of 24 × 12 holds a share of what the shadow reaches beyond it, px in its own axes.
SilhouetteLook lookAt(FrameIndex frame, double heading, cv::Point2d reach, double share, TrackId track = 1) {
    SilhouetteLook look;
    look.track = track;
    look.frame = frame;
    look.box = {kMiddle, 24, 12, heading};
    const auto ends = [&](double half, double along) {
        const double vehicle = half - share * std::abs(along);
        return along > 0 ? std::pair(-half, vehicle + along) : std::pair(along - vehicle, half);
    };
    const auto [rear, front] = ends(12, reach.x);
    const auto [left, right] = ends(6, reach.y);
    look.silhouette = Silhouette{{rear, front, left, right}, {}, false};
    return look;
}

TrackPath pathOf(TrackId id, double heading, const cv::Size2d& size = {24, 12}) {
    TrackState state;
    state.id = id;
    state.box = {kMiddle, size.width, size.height, heading};
    return {id, {{0, PathState(state)}, {30, PathState(state)}}};
}

CastShadow shadowOf(cv::Point2d reach_px, FrameIndex stretch = 0) {
    return {stretch, reach_px / 5, 5, 1};
}

OrientedBox trimmed(double heading, cv::Point2d reach_px, const std::vector<SilhouetteLook>& looks) {
    std::vector<TrackPath> paths{pathOf(1, heading)};
    takeOutShadows(paths, looks, {shadowOf(reach_px)}, resting(), kScale);
    EXPECT_EQ(paths[0].states[0].second.box.length, paths[0].states[1].second.box.length);
    return paths[0].states[0].second.box;
}

void expectBox(const OrientedBox& box, cv::Point2d centre, double length, double width) {
    EXPECT_NEAR(box.centre.x, centre.x, 1e-4);
    EXPECT_NEAR(box.centre.y, centre.y, 1e-4);
    EXPECT_NEAR(box.length, length, 1e-4);
    EXPECT_NEAR(box.width, width, 1e-4);
}

}  // namespace

TEST(ShadowTrimming, MovesTheEndThatTheShadowFallsOver) {
    // Half of 6 px ahead, and what lies across is left alone, and so on.
    expectBox(trimmed(0, {6, 0}, {lookAt(0, 0, {6, 0}, 0.5), lookAt(9, 0, {6, 0}, 0.5)}), {318.5, 180}, 21, 12);
    expectBox(trimmed(0, {-6, 0}, {lookAt(0, 0, {-6, 0}, 0.5), lookAt(9, 0, {-6, 0}, 0.5)}), {321.5, 180}, 21, 12);
    expectBox(trimmed(0, {0, 5}, {lookAt(0, 0, {0, 5}, 0.4), lookAt(9, 0, {0, 5}, 0.4)}), {320, 179}, 24, 10);
    expectBox(trimmed(0, {0, -5}, {lookAt(0, 0, {0, -5}, 0.4), lookAt(9, 0, {0, -5}, 0.4)}), {320, 181}, 24, 10);
    expectBox(trimmed(0, {6, 5}, {lookAt(0, 0, {6, 5}, 0.4), lookAt(9, 0, {6, 5}, 0.4)}), {318.8, 179}, 21.6, 10);
    // It falls to the right on the screen, which is left of what drives down.
    const std::vector<SilhouetteLook> down{lookAt(0, CV_PI / 2, {0, -5}, 0.4), lookAt(9, CV_PI / 2, {0, -5}, 0.4)};
    expectBox(trimmed(CV_PI / 2, {5, 0}, down), {319, 180}, 24, 10);
}

TEST(ShadowTrimming, BelievesTheMiddleOfTwoLooksOrMore) {
    expectBox(trimmed(0, {6, 0}, {lookAt(0, 0, {6, 0}, 0.5)}), kMiddle, 24, 12);
    const std::vector<SilhouetteLook> three{lookAt(0, 0, {6, 0}, 0.2), lookAt(9, 0, {6, 0}, 0.9),
                                            lookAt(20, 0, {6, 0}, 0.4)};
    expectBox(trimmed(0, {6, 0}, three), {318.8, 180}, 21.6, 12);
    const std::vector<SilhouetteLook> others{lookAt(0, 0, {6, 0}, 0.5), lookAt(9, 0, {6, 0}, 0.5, 2)};
    expectBox(trimmed(0, {6, 0}, others), kMiddle, 24, 12);
}

TEST(ShadowTrimming, LeavesASideAloneToWhichHardlyAnyOfItFalls) {
    const auto of = [](cv::Point2d reach) {
        return trimmed(0, reach, {lookAt(0, 0, reach, 0.5), lookAt(9, 0, reach, 0.5)});
    };
    EXPECT_NEAR(of({8, 1}).width, 12, 1e-4) << "an eighth";
    EXPECT_NEAR(of({8, 1.6}).width, 11.2, 1e-4) << "a fifth";
    EXPECT_NEAR(of({1, 8}).length, 24, 1e-4);
    EXPECT_NEAR(of({1.6, 8}).length, 23.2, 1e-4);
}

TEST(ShadowTrimming, LeavesHalfOfEachSideAtLeast) {
    std::vector<TrackPath> paths{pathOf(1, 0, {8, 4})};
    const cv::Point2d reach(6, 5);
    const std::vector<SilhouetteLook> looks{lookAt(0, 0, reach, 0.9), lookAt(9, 0, reach, 0.9)};
    takeOutShadows(paths, looks, {shadowOf(reach)}, resting(), kScale);
    expectBox(paths[0].states[0].second.box, kMiddle - cv::Point2d(2, 1), 4, 2);
}

TEST(ShadowTrimming, IsEachStretchsOwn) {
    const GroundTurns turns = resting(19);  // a second one begins with frame 20
    ASSERT_EQ(turns.at(30).stretch, 20);
    const cv::Point2d reach(6, 0);
    const std::vector<SilhouetteLook> looks{lookAt(0, 0, reach, 0.5), lookAt(9, 0, reach, 0.5)};
    const auto after = [&](const std::vector<CastShadow>& shadows, const std::vector<SilhouetteLook>& seen) {
        std::vector<TrackPath> paths{pathOf(1, 0)};
        takeOutShadows(paths, seen, shadows, turns, kScale);
        return std::pair(OrientedBox(paths[0].states[0].second.box), OrientedBox(paths[0].states[1].second.box));
    };
    // The sun went on: the same share of another shadow.
    const auto both = after({shadowOf(reach), shadowOf({-4, 0}, 20)}, looks);
    expectBox(both.first, {318.5, 180}, 21, 12);
    expectBox(both.second, {321, 180}, 22, 12);
    const auto first = after({shadowOf(reach)}, looks);
    expectBox(first.first, {318.5, 180}, 21, 12);
    expectBox(first.second, kMiddle, 24, 12);
    // What is said where no shadow is known says nothing, but what comes after it does.
    const std::vector<SilhouetteLook> later{lookAt(0, 0, {-4, 0}, 0.5), lookAt(25, 0, {-4, 0}, 0.5),
                                            lookAt(30, 0, {-4, 0}, 0.5)};
    const auto second = after({shadowOf({-4, 0}, 20)}, later);
    expectBox(second.first, kMiddle, 24, 12);
    expectBox(second.second, {321, 180}, 22, 12);
}

TEST(ShadowTrimming, OneTrackWithoutAShadowDoesNotSpareTheNext) {
    std::vector<TrackPath> paths{pathOf(1, 0), pathOf(2, 0)};
    const cv::Point2d reach(6, 0);
    takeOutShadows(paths, {lookAt(0, 0, reach, 0.5, 2), lookAt(9, 0, reach, 0.5, 2)}, {shadowOf(reach)}, resting(),
                   kScale);
    expectBox(paths[0].states[0].second.box, kMiddle, 24, 12);
    expectBox(paths[1].states[0].second.box, {318.5, 180}, 21, 12);
}

}  // namespace eyrie::shadow_trimming_test

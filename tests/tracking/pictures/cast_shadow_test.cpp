// Which way shadows fall, from what looks at vehicles say, and what of them is taken out of boxes.
#include "tracking/pictures/cast_shadow.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tracking/frame_summaries.h"

namespace eyrie::cast_shadow_test {
namespace {

const SceneScale kScale{0.2, 25, true};  // 5 px are 1 m
constexpr double kPxPerMetre = 5;

/// The camera turns by `turn` radians a frame about the middle of the picture.
GroundTurns turning(double turn, int frames = 40, int cut_at = -1) {
    GroundMotion ground;
    for (FrameIndex frame = 0; frame < frames; ++frame) {
        FrameMotionSummary summary = test::summaryOfFrame(frame);
        const double c = std::cos(turn);
        const double s = std::sin(turn);
        summary.registration.current_from_previous.matrix = {
            c, -s, 320 - c * 320 + s * 180, s, c, 180 - s * 320 - c * 180, 0, 0, 1};
        if (frame == 0) summary.registration.current_from_previous.matrix = cv::Matx33d::eye();
        if (frame == cut_at) summary.registration.state = RegistrationState::failed;
        ground.add(summary);
    }
    return GroundTurns(ground, 0, frames - 1);
}

/// A look at a bright car of 4.4 × 2 m, whose shadow reaches beyond it by `reach` m in the axes of its picture. Its box
/// holds `in_box` of the shadow.
SilhouetteLook lookAt(TrackId track, FrameIndex frame, double heading, cv::Point2d reach, double in_box = 0.5) {
    const cv::Point2d along(std::cos(heading), std::sin(heading));
    const double x = kPxPerMetre * (along.x * reach.x + along.y * reach.y);
    const double y = kPxPerMetre * (-along.y * reach.x + along.x * reach.y);
    const BoxEdges car{-11, 11, -5, 5};
    BoxEdges box{car.rear + in_box * std::min(x, 0.0), car.front + in_box * std::max(x, 0.0),
                 car.left + in_box * std::min(y, 0.0), car.right + in_box * std::max(y, 0.0)};
    BoxEdges whole{car.rear + std::min(x, 0.0), car.front + std::max(x, 0.0), car.left + std::min(y, 0.0),
                   car.right + std::max(y, 0.0)};
    const cv::Point2d middle((box.rear + box.front) / 2, (box.left + box.right) / 2);
    SilhouetteLook look;
    look.track = track;
    look.frame = frame;
    look.box = OrientedBox{{320, 180}, box.front - box.rear, box.right - box.left, heading};
    const auto shifted = [&](const BoxEdges& edges) {
        return BoxEdges{edges.rear - middle.x, edges.front - middle.x, edges.left - middle.y, edges.right - middle.y};
    };
    look.silhouette = {shifted(whole), shifted(car), true};
    return look;
}

cv::Point2d turned(cv::Point2d v, double angle) {
    return {std::cos(angle) * v.x - std::sin(angle) * v.y, std::sin(angle) * v.x + std::cos(angle) * v.y};
}

/// Vehicles on a crossing, each looked at three times while the camera turns.
std::vector<SilhouetteLook> crossing(int vehicles, cv::Point2d reach, double turn, double in_box = 0.5) {
    std::vector<SilhouetteLook> looks;
    for (int i = 0; i < vehicles; ++i) {
        for (const FrameIndex frame : {0, 10, 20})
            looks.push_back(lookAt(i + 1, frame, 1.3 * i + turn * frame, turned(reach, turn * frame), in_box));
    }
    return looks;
}

const cv::Point2d kReach(0.9, 0.6);

}  // namespace

TEST(CastShadow, IsWhereVehiclesSayWhileTheCameraTurns) {
    for (const double turn : {0.0, 0.02, -0.03}) {
        const GroundTurns turns = turning(turn);
        const auto shadows = shadowsOf(readLight(crossing(6, kReach, turn), turns, kScale));
        ASSERT_EQ(shadows.size(), 1U) << turn;
        EXPECT_NEAR(shadows[0].reach_m.x, kReach.x, 0.07) << turn;
        EXPECT_NEAR(shadows[0].reach_m.y, kReach.y, 0.07) << turn;
        EXPECT_EQ(shadows[0].tracks, 6);
        EXPECT_GT(shadows[0].agreement, 0.99);
        const cv::Point2d later = reachAt(shadows[0], turns.at(20), {320, 180}, kScale);
        const cv::Point2d expected = kPxPerMetre * turned(kReach, 20 * turn);
        EXPECT_NEAR(later.x, expected.x, 0.4) << turn;
        EXPECT_NEAR(later.y, expected.y, 0.4) << turn;
    }
}

TEST(CastShadow, NeedsFourVehicles) {
    EXPECT_EQ(shadowsOf(readLight(crossing(3, kReach, 0), turning(0), kScale)).size(), 0U);
    EXPECT_EQ(shadowsOf(readLight(crossing(4, kReach, 0), turning(0), kScale)).size(), 1U);
}

TEST(CastShadow, NeedsVehiclesThatAgree) {
    std::vector<SilhouetteLook> looks;
    looks.reserve(12);
    for (int i = 0; i < 12; ++i) looks.push_back(lookAt(i + 1, 0, 0.3 * i, turned(kReach, 0.52 * i)));
    EXPECT_TRUE(shadowsOf(readLight(looks, turning(0), kScale)).empty());
    EXPECT_TRUE(shadowsOf(readLight(crossing(6, {0.1, 0.1}, 0), turning(0), kScale)).empty());
}

TEST(CastShadow, IsNoneWhereBoxesHoldAllOfIt) {
    // An oblique view shows the shaded side of the vehicles themselves, and that belongs to their boxes.
    EXPECT_EQ(shadowsOf(readLight(crossing(6, kReach, 0, 0.9), turning(0), kScale)).size(), 1U);
    EXPECT_TRUE(shadowsOf(readLight(crossing(6, kReach, 0, 1), turning(0), kScale)).empty());
}

TEST(CastShadow, WhereThereIsNoneItIsSaidWhy) {
    const auto outcomeOf = [](const std::vector<SilhouetteLook>& looks) {
        return readLight(looks, turning(0), kScale).at(0).outcome;
    };
    EXPECT_EQ(outcomeOf(crossing(3, kReach, 0)), LightOutcome::few_vehicles);
    EXPECT_EQ(outcomeOf(crossing(6, {0.1, 0.1}, 0)), LightOutcome::short_shadows);
    EXPECT_EQ(outcomeOf(crossing(6, kReach, 0, 1)), LightOutcome::shaded_sides);
    EXPECT_EQ(outcomeOf(crossing(6, kReach, 0)), LightOutcome::shadows);
    std::vector<SilhouetteLook> looks = crossing(6, kReach, 0);
    for (int i = 0; i < 4; ++i) looks.push_back(lookAt(i + 20, 0, 1.3 * i, {-kReach.x, -kReach.y}));
    EXPECT_EQ(outcomeOf(looks), LightOutcome::disagreement);
}

TEST(CastShadow, HowDarkItIsIsWhatMostSureVehiclesSay) {
    std::vector<SilhouetteLook> looks = crossing(6, kReach, 0);
    EXPECT_EQ(readLight(looks, turning(0), kScale).at(0).darkening, std::nullopt);
    for (std::size_t i = 0; i < looks.size(); ++i) looks[i].silhouette->shade = i < 3 ? 0.3 : 0.6;
    looks.push_back(lookAt(20, 0, 0, kReach));
    looks.back().silhouette->lit_vehicle = false;
    looks.back().silhouette->shade = 0;
    EXPECT_NEAR(readLight(looks, turning(0), kScale).at(0).darkening.value(), 0.4, 1e-9);
}

TEST(CastShadow, IsSoughtAnewAfterAGap) {
    std::vector<SilhouetteLook> looks = crossing(5, kReach, 0);
    for (int i = 0; i < 5; ++i) looks.push_back(lookAt(i + 10, 35, 1.3 * i, {-kReach.x, kReach.y}));
    const auto shadows = shadowsOf(readLight(looks, turning(0, 40, 30), kScale));
    ASSERT_EQ(shadows.size(), 2U);
    EXPECT_EQ(shadows[0].stretch, 0);
    EXPECT_EQ(shadows[1].stretch, 30);
    EXPECT_GT(shadows[0].reach_m.x, 0.7);
    EXPECT_LT(shadows[1].reach_m.x, -0.7);
}

TEST(CastShadow, IsTakenOutOfBoxesAsFarAsTheyHoldIt) {
    std::vector<SilhouetteLook> looks = crossing(5, kReach, 0);
    for (const FrameIndex frame : {0, 10, 20}) {
        looks.push_back(lookAt(20, frame, 0, kReach, 0.8));
        looks.push_back(lookAt(21, frame, CV_PI, kReach, 0));
    }
    looks.push_back(lookAt(22, 0, 0, kReach, 0.8));  // one look decides nothing
    std::vector<TrackPath> paths;
    for (const TrackId id : {20, 21, 22}) {
        TrackState state;
        state.id = id;
        const auto look = std::find_if(looks.begin(), looks.end(), [&](const auto& each) { return each.track == id; });
        state.box = look->box;
        paths.push_back({id, {{0, PathState(state)}, {5, PathState(state)}}});
    }
    const OrientedBox clean = paths[1].states[0].second.box;
    const OrientedBox once = paths[2].states[0].second.box;
    const GroundTurns turns = turning(0);
    const double whole = OrientedBox(paths[0].states[0].second.box).area();
    const auto trims = takeOutShadows(paths, looks, shadowsOf(readLight(looks, turns, kScale)), turns, kScale);
    ASSERT_TRUE(trims.contains(20));
    EXPECT_NEAR(trims.at(20).along, 0.8, 0.05);
    EXPECT_NEAR(trims.at(20).across, 0.8, 0.05);
    EXPECT_NEAR(trims.at(20).taken, 1 - OrientedBox(paths[0].states[0].second.box).area() / whole, 1e-6);
    EXPECT_FALSE(trims.contains(22));
    for (const auto& [frame, state] : paths[0].states) {
        const OrientedBox box = state.box;
        EXPECT_NEAR(box.length, 22, 0.4);
        EXPECT_NEAR(box.width, 10, 0.4);
        // The far ends stay, the near ones move: by .8 of 4.5 and of 3 px.
        EXPECT_NEAR(box.centre.x, 320 - 0.8 * 4.5 / 2, 0.2);
        EXPECT_NEAR(box.centre.y, 180 - 0.8 * 3 / 2, 0.2);
    }
    EXPECT_NEAR(OrientedBox(paths[1].states[0].second.box).length, clean.length, 0.3);
    EXPECT_NEAR(OrientedBox(paths[1].states[0].second.box).width, clean.width, 0.3);
    EXPECT_EQ(OrientedBox(paths[2].states[0].second.box).length, once.length);
}

TEST(CastShadow, LeavesHalfOfABoxAtLeast) {
    std::vector<SilhouetteLook> looks = crossing(5, kReach, 0);
    TrackState state;
    state.id = 1;
    state.box = {{320, 180}, 5, 2, 0};
    std::vector<TrackPath> paths{{1, {{0, PathState(state)}}}};
    const GroundTurns turns = turning(0);
    takeOutShadows(paths, looks, {{0, {4, 3}, 5, 1}}, turns, kScale);
    const OrientedBox box = paths[0].states[0].second.box;
    EXPECT_GE(box.length, 2.5 - 1e-6);
    EXPECT_GE(box.width, 1 - 1e-6);
}

}  // namespace eyrie::cast_shadow_test

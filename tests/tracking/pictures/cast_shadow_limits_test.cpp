// When vehicles are believed about the way shadows fall, and how far.
#include <gtest/gtest.h>

#include <cmath>

#include "tracking/frame_summaries.h"
#include "tracking/pictures/cast_shadow.h"

namespace eyrie::cast_shadow_limits_test {
namespace {

const SceneScale kScale{0.2, 25, true};  // 5 px are 1 m

/// The camera comes nearer by a factor a frame; it was not registered in frame 20.
GroundTurns zooming(double factor, bool cut = false) {
    GroundMotion ground;
    for (FrameIndex frame = 0; frame < 40; ++frame) {
        FrameMotionSummary summary = test::summaryOfFrame(frame);
        if (frame > 0)
            summary.registration.current_from_previous.matrix = {
                factor, 0, 320 * (1 - factor), 0, factor, 180 * (1 - factor), 0, 0, 1};
        if (cut && frame == 20) summary.registration.state = RegistrationState::failed;
        ground.add(summary);
    }
    return GroundTurns(ground, 0, 39);
}

/// What a vehicle of 4.4 × 2 m says of a shadow, m in its own axes; half of it is in its box. `metre`: px.
SilhouetteLook saying(TrackId track, cv::Point2d reach, double heading = 0, FrameIndex frame = 0, double metre = 5) {
    SilhouetteLook look;
    look.track = track;
    look.frame = frame;
    const cv::Point2d off = metre * reach;
    const BoxEdges lit{-2.2 * metre, 2.2 * metre, -metre, metre};
    const BoxEdges whole{lit.rear + std::min(off.x, 0.0), lit.front + std::max(off.x, 0.0),
                         lit.left + std::min(off.y, 0.0), lit.right + std::max(off.y, 0.0)};
    const cv::Point2d shift = off / 4;
    look.box = {{320, 180}, 4.4 * metre + std::abs(off.x) / 2, 2 * metre + std::abs(off.y) / 2, heading};
    const auto inBox = [&](const BoxEdges& edges) {
        return BoxEdges{edges.rear - shift.x, edges.front - shift.x, edges.left - shift.y, edges.right - shift.y};
    };
    look.silhouette = Silhouette{inBox(whole), inBox(lit), true};
    return look;
}

std::vector<CastShadow> found(const std::vector<SilhouetteLook>& looks, const SceneScale& scale = kScale) {
    return shadowsOf(readLight(looks, zooming(1), scale));
}

/// Vehicles that agree, with ids from 1 on.
std::vector<SilhouetteLook> agreeing(int count, cv::Point2d reach) {
    std::vector<SilhouetteLook> looks;
    for (int i = 0; i < count; ++i) looks.push_back(saying(i + 1, reach));
    return looks;
}

}  // namespace

TEST(CastShadowLimits, AShadowIsToldAFewHundredthsTooShortRatherThanTooLong) {
    for (const cv::Point2d reach : {cv::Point2d(1, 0), cv::Point2d(-0.8, 0.6), cv::Point2d(0, -1.5)}) {
        const auto shadows = found(agreeing(6, reach));
        ASSERT_EQ(shadows.size(), 1U) << reach;
        const cv::Point2d told = shadows[0].reach_m;
        EXPECT_NEAR(std::atan2(told.y, told.x), std::atan2(reach.y, reach.x), 4e-3) << reach;
        const double share = std::hypot(told.x, told.y) / std::hypot(reach.x, reach.y);
        EXPECT_GT(share, 0.93) << reach;
        EXPECT_LT(share, 0.96) << reach;
    }
}

TEST(CastShadowLimits, OneWhoSaysSomethingElseHardlyMatters) {
    std::vector<SilhouetteLook> looks = agreeing(7, {1, 0.5});
    const cv::Point2d without = found(looks).at(0).reach_m;
    looks.push_back(saying(20, {-2, -1}));
    const cv::Point2d with = found(looks).at(0).reach_m;
    EXPECT_NEAR(with.x, without.x, 0.03);
    EXPECT_NEAR(with.y, without.y, 0.03);
}

TEST(CastShadowLimits, MostVehiclesAgreeAndEachCountsOnce) {
    std::vector<SilhouetteLook> looks = agreeing(9, {1, 0});
    // Two that say nothing, however often they are looked at.
    for (int i = 0; i < 5; ++i) {
        looks.push_back(saying(20, {0, 0}));
        looks.push_back(saying(21, {0, 0}));
    }
    const auto shadows = found(looks);
    ASSERT_EQ(shadows.size(), 1U);
    EXPECT_EQ(shadows[0].tracks, 11);
    EXPECT_NEAR(shadows[0].agreement, 9.0 / 11, 1e-9);
    looks.push_back(saying(22, {0, 0}));
    EXPECT_TRUE(found(looks).empty()) << "nine of twelve";
}

TEST(CastShadowLimits, AVehicleSaysWhatMostLooksAtItSay) {
    // Looks at a shadow as short as a pixel or two miss it now and then.
    const auto agreementWith = [](int missing) {
        std::vector<SilhouetteLook> looks = agreeing(4, {0.6, 0});
        for (int i = 0; i < 5; ++i) looks.push_back(saying(20, {i < missing ? 0.0 : 0.6, 0}));
        const auto read = readLight(looks, zooming(1), kScale);
        return read.at(0).shadow.agreement;
    };
    EXPECT_NEAR(agreementWith(2), 1, 1e-9);
    EXPECT_NEAR(agreementWith(3), 0.8, 1e-9);
}

TEST(CastShadowLimits, WhoSaysNextToNothingOrTheOppositeDoesNotAgree) {
    const auto agreementWith = [](cv::Point2d said) {
        std::vector<SilhouetteLook> looks = agreeing(9, {0.6, 0});
        looks.push_back(saying(20, said));
        return found(looks).at(0).agreement;
    };
    EXPECT_NEAR(agreementWith({0.13, 0}), 1, 1e-9);
    EXPECT_NEAR(agreementWith({0.08, 0}), 0.9, 1e-9);
    EXPECT_NEAR(agreementWith({-0.5, 0}), 0.9, 1e-9);
}

TEST(CastShadowLimits, OnlySidesToWhichItFallsAreAsked) {
    const auto agreementWith = [](double angle) {
        std::vector<SilhouetteLook> looks = agreeing(9, {1, 0});
        for (int i = 0; i < 4; ++i) looks.push_back(saying(20 + i, {0, -std::sin(angle)}, angle));
        const auto shadows = found(looks);
        return shadows.empty() ? 0 : shadows[0].agreement;
    };
    // Four drive elsewhere and say nothing along their way. Of the reach .34 falls there, or .57.
    EXPECT_NEAR(agreementWith(1.22), 1, 1e-9);
    EXPECT_NEAR(agreementWith(0.96), 0, 1e-9) << "13 of 17 sides agree";
}

TEST(CastShadowLimits, ShortOnesAreNone) {
    EXPECT_TRUE(found(agreeing(6, {0.24, 0})).empty());
    EXPECT_EQ(found(agreeing(6, {0.3, 0})).size(), 1U);
    EXPECT_EQ(found(agreeing(6, {0, -0.3})).size(), 1U);
}

TEST(CastShadowLimits, AreNoneWhereVehiclesDoNotSayHowLongTheyAre) {
    const auto differing = [](double off) {
        std::vector<SilhouetteLook> looks;
        for (int i = 0; i < 8; ++i)
            looks.push_back(saying(i + 1, {i % 2 == 0 ? 1 + off : 1 - off, i < 4 ? off : -off}));
        return found(looks);
    };
    EXPECT_EQ(differing(0.3).size(), 1U);
    EXPECT_TRUE(differing(0.45).empty());
}

TEST(CastShadowLimits, OnlySureVehiclesAreAsked) {
    std::vector<SilhouetteLook> looks;
    for (int i = 0; i < 5; ++i) {
        looks.push_back(saying(50 + i, {-3, 2}));
        looks.back().silhouette->lit_vehicle = false;
        looks.push_back(saying(1, {-3, 2}));
        looks.back().silhouette->lit_vehicle = false;
    }
    EXPECT_TRUE(found(looks).empty());
    const std::vector<SilhouetteLook> sure = agreeing(4, {1, 0});
    looks.insert(looks.end(), sure.begin(), sure.end());
    const auto shadows = found(looks);
    ASSERT_EQ(shadows.size(), 1U);
    EXPECT_EQ(shadows[0].tracks, 4);
    EXPECT_GT(shadows[0].reach_m.x, 0.93);
    EXPECT_NEAR(shadows[0].agreement, 1, 1e-9);
}

TEST(CastShadowLimits, AStretchWithoutOneDoesNotKeepTheNextFromIts) {
    std::vector<SilhouetteLook> looks = agreeing(3, {1, 0});  // too few
    for (int i = 0; i < 4; ++i) looks.push_back(saying(10 + i, {0, 1}, 0, 30));
    auto shadows = shadowsOf(readLight(looks, zooming(1, true), kScale));
    ASSERT_EQ(shadows.size(), 1U);
    EXPECT_EQ(shadows[0].stretch, 20);
    const std::vector<SilhouetteLook> shorter = agreeing(6, {0.1, 0});
    looks.insert(looks.end(), shorter.begin(), shorter.end());
    shadows = shadowsOf(readLight(looks, zooming(1, true), kScale));
    ASSERT_EQ(shadows.size(), 1U);
    EXPECT_EQ(shadows[0].stretch, 20);
}

TEST(CastShadowLimits, AMetreIsOneHoweverNearTheCameraAndTheVehicle) {
    constexpr double kFactor = 1.01;
    std::vector<SilhouetteLook> looks;
    for (int i = 0; i < 6; ++i) {
        const FrameIndex frame = 6 * i;
        looks.push_back(saying(i + 1, {1, 0.4}, 0, frame, 5 * std::pow(kFactor, frame)));
    }
    const GroundTurns turns = zooming(kFactor);
    auto shadows = shadowsOf(readLight(looks, turns, kScale));
    ASSERT_EQ(shadows.size(), 1U);
    EXPECT_NEAR(shadows[0].reach_m.x, 0.945, 0.02);
    const cv::Point2d later = reachAt({0, {1, 0.4}, 6, 1}, turns.at(30), {320, 180}, kScale);
    EXPECT_NEAR(later.x, 5 * std::pow(kFactor, 30), 1e-6);
    EXPECT_NEAR(later.y, 2 * std::pow(kFactor, 30), 1e-6);

    // Seen at an angle: half as large again further down.
    SceneScale scale = kScale;
    scale.slope = {0, 0.005, 320, 180};
    looks = agreeing(6, {1, 0.4});
    for (SilhouetteLook& look : looks) look = saying(look.track, {1, 0.4}, 0, 0, 7.5);
    for (SilhouetteLook& look : looks) look.box.centre.y = 280;
    shadows = found(looks, scale);
    ASSERT_EQ(shadows.size(), 1U);
    EXPECT_NEAR(shadows[0].reach_m.x, 0.945, 0.02);
    EXPECT_NEAR(reachAt({0, {1, 0.4}, 6, 1}, zooming(1).at(0), {320, 280}, scale).x, 7.5, 1e-6);
}

TEST(CastShadowLimits, TheyTurnWithTheGround) {
    const GroundTurns::Turn quarter{0, CV_PI / 2, 1};
    const cv::Point2d reach = reachAt({0, {1, 0.4}, 6, 1}, quarter, {320, 180}, kScale);
    EXPECT_NEAR(reach.x, -2, 1e-6);
    EXPECT_NEAR(reach.y, 5, 1e-6);
}

}  // namespace eyrie::cast_shadow_limits_test

// When a box is made as long as what hides the ground about it, and whose parts go.
#include "tracking/pictures/long_vehicles.h"

#include <gtest/gtest.h>

#include "tracking/frame_summaries.h"

namespace eyrie::long_vehicles_test {
namespace {

const SceneScale kScale{0.2, 25, true};  // 5 px are 1 m
constexpr double kMetre = 5;

TrackPath pathOf(TrackId id, int frames, cv::Point2d centre = {100, 60}, FrameIndex first = 0) {
    TrackPath path{id, {}};
    for (FrameIndex frame = first; frame < first + frames; ++frame) {
        TrackState state;
        state.id = id;
        state.score = 0.9;
        state.box = {centre + cv::Point2d(2.0 * frame, 0), 4 * kMetre, 2 * kMetre, 0};
        path.states.emplace_back(frame, PathState(state));
    }
    return path;
}

/// Looks at track 1 whose box is 4 m long and 2 m wide, and what they say, m from its middle.
struct Looks {
    std::vector<SilhouetteLook> looks;
    std::vector<CastShadow> shadows;

    Looks& add(int number, double rear, double front, double lit_beyond = 1, double half_width = 1, bool cut = false) {
        for (int i = 0; i < number; ++i) {
            SilhouetteLook look;
            look.track = 1;
            look.frame = static_cast<FrameIndex>(looks.size());
            look.box = {{100 + 2.0 * look.frame, 60}, 4 * kMetre, 2 * kMetre, 0};
            look.extent = VehicleExtent{
                {rear * kMetre, front * kMetre, -half_width * kMetre, half_width * kMetre}, {}, lit_beyond, cut};
            looks.push_back(look);
        }
        return *this;
    }
    Looks& lit(double rear, double front) {
        for (SilhouetteLook& look : looks) look.extent->lit = BoxEdges{rear * kMetre, front * kMetre, -kMetre, kMetre};
        return *this;
    }
    /// One that sees nothing stand out.
    Looks& blind(int number) {
        for (int i = 0; i < number; ++i) add(1, 0, 0).looks.back().extent.reset();
        return *this;
    }
    /// The box of track 1 in its first frame, m; its centre from where it was.
    OrientedBox box() const {
        std::vector<TrackPath> paths{pathOf(1, 30), pathOf(2, 30, {100, 150})};
        GroundMotion ground;
        for (FrameIndex frame = 0; frame < 30; ++frame) ground.add(test::summaryOfFrame(frame));
        const GroundTurns turns(ground, 0, 29);
        const PartsByVehicle longer = reachWholeVehicles(paths, looks, shadows, turns, kScale);
        EXPECT_FLOAT_EQ(paths[1].states[0].second.box.length, 4 * kMetre) << "nobody looked at it";
        EXPECT_FLOAT_EQ(paths[0].states[0].second.box.length, paths[0].states[29].second.box.length);
        const OrientedBox box = paths[0].states[0].second.box;
        const PartsByVehicle alone{{1, {}}};
        EXPECT_EQ(longer, box.length > 4 * kMetre ? alone : PartsByVehicle());
        return {(box.centre - cv::Point2d(100, 60)) / kMetre, box.length / kMetre, box.width / kMetre, box.heading};
    }
    bool changes() const { return box().length > 4.001; }
};

}  // namespace

TEST(LongVehicles, BoxesReachAsFarAsMostLooksSay) {
    const OrientedBox box = Looks().add(5, -8, 2).add(2, -2, 2).box();
    EXPECT_NEAR(box.length, 10, 1e-3);
    EXPECT_NEAR(box.centre.x, -3, 1e-3);
    EXPECT_NEAR(box.centre.y, 0, 1e-3);
    EXPECT_NEAR(box.width, 2, 1e-3);
}

TEST(LongVehicles, AreAsLongInHalfOfTheLooks) {
    // What passes in the next lane is another in each of them.
    const auto beside_traffic = [](int whole) {
        Looks looks;
        looks.add(whole, -8, 2);
        for (const double rear : {-4.0, -5.3, -6.6, -9.4, -10.7}) looks.add(1, rear, 2);
        return looks;
    };
    EXPECT_TRUE(beside_traffic(5).changes());
    EXPECT_FALSE(beside_traffic(4).changes());
    // Both ends must be there in the same looks.
    EXPECT_FALSE(Looks().add(3, -8, 2).add(3, -5.5, 2).add(3, -8, 5).changes());
    EXPECT_TRUE(Looks().add(3, -8, 2).add(3, -7.1, 2).add(3, -8, 2.9).changes());
}

TEST(LongVehicles, ThereMustBeEnoughLooks) {
    EXPECT_TRUE(Looks().add(5, -8, 2).changes());
    EXPECT_FALSE(Looks().add(4, -8, 2).changes());
    EXPECT_TRUE(Looks().add(5, -8, 2).blind(5).changes());
    EXPECT_FALSE(Looks().add(5, -8, 2).blind(6).changes());
    EXPECT_TRUE(Looks().add(6, -8, 2).add(2, -8, 2, 1, 1, true).changes());
    EXPECT_FALSE(Looks().add(5, -8, 2).add(2, -8, 2, 1, 1, true).changes()) << "more than a quarter goes on beyond";
}

TEST(LongVehicles, OnlyWhatIsLongerThanACarAndNoStreetIsOne) {
    EXPECT_FALSE(Looks().add(6, -2, 3.4).changes()) << "5.4 m";
    EXPECT_TRUE(Looks().add(6, -2.3, 3.4).changes());
    EXPECT_TRUE(Looks().add(6, -2, 15.9).changes());
    EXPECT_FALSE(Looks().add(6, -2, 16.1).changes());
    EXPECT_TRUE(Looks().add(6, -8, 2, 1, 2.05).changes());
    EXPECT_FALSE(Looks().add(6, -8, 2, 1, 2.15).changes()) << "4.3 m wide";
    EXPECT_TRUE(Looks().add(6, -12, 2.4, 1, 2.35).changes()) << "a bus of 14.4 m, with the side that is seen of it";
    EXPECT_FALSE(Looks().add(6, -12, 2.4, 1, 2.45).changes());
    EXPECT_TRUE(Looks().add(6, -4.6, 2, 1, 1.6).changes());
    EXPECT_FALSE(Looks().add(6, -4.2, 2, 1, 1.6).changes()) << "less than twice as long as wide";
    EXPECT_FALSE(Looks().add(6, -9, -1).changes()) << "it is another vehicle behind this one";
    EXPECT_TRUE(Looks().add(6, -8, 1).changes());
}

TEST(LongVehicles, WhatIsSmallerThanACabIsNoPartOfOne) {
    Looks part;
    part.add(6, -8, 2);
    for (SilhouetteLook& look : part.looks) look.box.length = 2.7 * kMetre;
    EXPECT_FALSE(part.changes()) << "a motorcycle, or what its lamp lights";
    for (SilhouetteLook& look : part.looks) look.box.length = 2.9 * kMetre;
    EXPECT_TRUE(part.changes());
}

TEST(LongVehicles, WhatMayBeAShadowDoesNotCount) {
    EXPECT_FALSE(Looks().add(6, -8, 2, 0.3).changes());
    EXPECT_TRUE(Looks().add(6, -8, 2, 0.35).changes());
}

TEST(LongVehicles, WhereShadowsAreKnownOnlyWhatIsLitCounts) {
    Looks known;
    known.add(6, -8, 2, 0.9).lit(-2, 2);
    EXPECT_TRUE(known.changes());
    known.shadows = {{0, {1, 0}, 5, 1}};
    EXPECT_FALSE(known.changes());
    known.lit(-6, 2);
    EXPECT_NEAR(known.box().length, 8, 1e-3);
    for (SilhouetteLook& look : known.looks) look.extent->lit_beyond = 0;
    EXPECT_TRUE(known.changes()) << "what is lit is no shadow";
    for (SilhouetteLook& look : known.looks) look.extent->lit.reset();
    EXPECT_FALSE(known.changes());
}

TEST(LongVehicles, AreAsWideAsTheySeemAndNoWiderThanLorriesAre) {
    EXPECT_NEAR(Looks().add(6, -8, 2, 1, 1.15).box().width, 2.3, 1e-3);
    EXPECT_NEAR(Looks().add(6, -8, 2, 1, 1.8).box().width, 2.6, 1e-3);
    EXPECT_NEAR(Looks().add(6, -8, 2, 1, 0.5).box().width, 2, 1e-3);
    Looks aside;
    aside.add(6, -8, 2);
    for (SilhouetteLook& look : aside.looks) look.extent->whole.right = 1.6 * kMetre;
    const OrientedBox box = aside.box();
    EXPECT_NEAR(box.width, 2.6, 1e-3);
    EXPECT_NEAR(box.centre.y, 0.3, 1e-3);
}

TEST(LongVehicles, FragmentsReachAsFarAsThoseTheyWereJoinedTo) {
    // The cab, 20 px, is followed, then all of it, 50 px, then its rear; the car drives 2 px a frame.
    const auto joined = [](const std::set<FrameIndex>& guessed) {
        TrackPath path = pathOf(1, 30);
        for (auto& [frame, state] : path.states) {
            state.velocity = {2, 0};
            const double x = 100 + 2.0 * frame;
            if (frame >= 10 && frame < 20) state.box = OrientedBox{{x - 15, 61}, 50, 12, 0};
            if (frame >= 20) state.box = OrientedBox{{x - 30, 60}, 20, 10, 0};
            if (!guessed.contains(frame)) continue;
            state.origin = StateOrigin::predicted;
            state.box = OrientedBox{{x - 7, 60}, 33, 11, 0};
        }
        GroundMotion ground;
        for (FrameIndex frame = 0; frame < 30; ++frame) ground.add(test::summaryOfFrame(frame));
        reachAlong(path, {{10, 19}}, ground);
        return path;
    };
    for (const std::set<FrameIndex>& guessed : {std::set<FrameIndex>{}, std::set<FrameIndex>{8, 9, 20}}) {
        for (const auto& [frame, state] : joined(guessed).states) {
            EXPECT_NEAR(state.box.centre.x, 85 + 2.0 * frame, 1e-3) << frame;
            EXPECT_NEAR(state.box.centre.y, 61, 1e-3) << frame;
            EXPECT_NEAR(state.box.length, 50, 1e-3) << frame;
            EXPECT_NEAR(state.box.width, 12, 1e-3) << frame;
        }
    }
    std::set<FrameIndex> never_seen;
    for (FrameIndex frame = 20; frame < 30; ++frame) never_seen.insert(frame);
    EXPECT_NEAR(joined(never_seen).states[25].second.box.length, 33, 1e-3) << "nothing tells how it lies to it";
}

TEST(LongVehicles, WhatIsLongerAlreadyAndWhatLiesBetweenTwoSpansIsReachedFromTheEarlierOne) {
    TrackPath path = pathOf(1, 30);
    for (auto& [frame, state] : path.states) {
        state.velocity = {2, 0};
        if (frame < 5) state.box.length = 50;
        if (frame >= 20) state.box.length = 60;
        if (frame >= 25) state.box.length = 70;
    }
    GroundMotion ground;
    for (FrameIndex frame = 0; frame < 30; ++frame) ground.add(test::summaryOfFrame(frame));
    reachAlong(path, {{0, 4}, {20, 24}}, ground);
    EXPECT_NEAR(path.states[12].second.box.length, 50, 1e-3);
    EXPECT_NEAR(path.states[22].second.box.length, 60, 1e-3);
    EXPECT_NEAR(path.states[27].second.box.length, 70, 1e-3);
}

/// What becomes of a lorry whose front, of 4 m, is followed as track 1 and looked at, and of which `behind` (m) its
/// front another track may be a part.
struct LorryInParts {
    double behind = 8;
    float score = 0.5F;
    cv::Point2d apart{0, 0};  ///< px by which the other one falls behind each frame

    /// Its box, m, and which tracks it holds.
    std::pair<OrientedBox, std::set<TrackId>> seenAs(double rear, double front) const {
        const Looks looks = Looks().add(6, rear, front);
        std::vector<TrackPath> paths{pathOf(1, 60), pathOf(2, 60, {100 - behind * kMetre, 60})};
        for (TrackPath& path : paths) {
            for (auto& [frame, state] : path.states) state.velocity = {2, 0};
        }
        for (auto& [frame, state] : paths[1].states) {
            state.score = score;
            state.box.centre -= cv::Point2f(apart * static_cast<double>(frame));
        }
        GroundMotion ground;
        for (FrameIndex frame = 0; frame < 60; ++frame) ground.add(test::summaryOfFrame(frame));
        const GroundTurns turns(ground, 0, 59);
        const PartsByVehicle parts = reachWholeVehicles(paths, looks.looks, looks.shadows, turns, kScale);
        const OrientedBox box = paths[0].states[0].second.box;
        return {{(box.centre - cv::Point2d(100, 60)) / kMetre, box.length / kMetre, box.width / kMetre, box.heading},
                parts.contains(1) ? parts.at(1) : std::set<TrackId>{}};
    }
    bool isSeenWhole(double rear, double front) const { return seenAs(rear, front).second.contains(2); }
};

TEST(LongVehicles, OtherPartsTellThatItIsOneHoweverLittleOfItTheBoxHolds) {
    const auto [box, parts] = LorryInParts().seenAs(-17, 2);
    EXPECT_EQ(parts, std::set<TrackId>{2});
    EXPECT_NEAR(box.length, 19, 1e-3) << "the longest ones";
    EXPECT_NEAR(box.centre.x, -7.5, 1e-3);
    EXPECT_FALSE(LorryInParts().isSeenWhole(-18.1, 2));
    EXPECT_TRUE(LorryInParts().isSeenWhole(-12, -0.7)) << "the box reaches out over it";
    EXPECT_FALSE(LorryInParts().isSeenWhole(-12, -0.9));
    EXPECT_TRUE((LorryInParts{3, 0.5F, {}}.isSeenWhole(-3.5, 2.1))) << "5.6 m, but two tracks";
    EXPECT_FALSE((LorryInParts{3, 0.5F, {}}.isSeenWhole(-3.3, 2.1))) << "a car";
}

TEST(LongVehicles, WhatDrivesByItselfOrLiesElsewhereIsNoPart) {
    EXPECT_FALSE((LorryInParts{8, 0.85F, {}}.isSeenWhole(-17, 2))) << "it is surely a vehicle itself";
    EXPECT_FALSE((LorryInParts{8, 0.5F, {0.2, 0}}.isSeenWhole(-17, 2))) << "it falls behind";
    EXPECT_FALSE((LorryInParts{14, 0.5F, {}}.isSeenWhole(-13.5, -0.7))) << "behind it, and the box reaches out ahead";
}

TEST(LongVehicles, TracksOfTheirPartsGo) {
    const auto left = [](const TrackPath& part, const std::set<TrackId>& fixed = {}) {
        std::vector<TrackPath> paths{pathOf(1, 30), part};
        DropList dropped;
        dropPartsOf({{1, fixed}}, paths, kScale, dropped);
        EXPECT_EQ(paths.size() + dropped.size(), 2U);
        if (!dropped.empty()) {
            EXPECT_EQ(dropped[0].path.id, part.id);
            EXPECT_EQ(dropped[0].why, TrackDrop::shares_place);
            EXPECT_EQ(dropped[0].beside, 1);
        }
        return paths.size() == 2;
    };
    EXPECT_FALSE(left(pathOf(2, 30, {109, 64})));
    EXPECT_TRUE(left(pathOf(2, 30, {111, 64}))) << "ahead of it";
    EXPECT_TRUE(left(pathOf(2, 30, {109, 66}))) << "beside it";
    // Such as drive as if fixed to it reach out over its ends, by 7.5 px, and its sides.
    EXPECT_FALSE(left(pathOf(2, 30, {117, 70}), {2}));
    EXPECT_TRUE(left(pathOf(2, 30, {118, 60}), {1, 2})) << "ahead of it";
    EXPECT_FALSE(left(pathOf(2, 20, {100, 60}, 20))) << "half of its life it lies in it";
    EXPECT_TRUE(left(pathOf(2, 21, {100, 60}, 20)));
    EXPECT_TRUE(left(pathOf(2, 20, {100, 60}, 40))) << "later";
    TrackPath passes = pathOf(2, 20, {100, 60});
    for (std::size_t i = 0; i < 5; ++i) passes.states[i].second.box.centre.y = 90;
    EXPECT_TRUE(left(passes)) << "three quarters of the frames are not enough";
    passes.states[4].second.box.centre.y = 60;
    EXPECT_FALSE(left(passes));
}

TEST(LongVehicles, OfTwoThatWereMadeAsLongAtOnePlaceTheSurerOneStays) {
    for (const bool first_is_surer : {true, false}) {
        std::vector<TrackPath> paths{pathOf(1, 30), pathOf(2, 30), pathOf(3, 30, {100, 90})};
        for (auto& [frame, state] : paths[first_is_surer ? 1 : 0].states) state.score = 0.8F;
        DropList dropped;
        dropPartsOf({{1, {}}, {2, {}}, {3, {}}}, paths, kScale, dropped);
        ASSERT_EQ(paths.size(), 2U);
        EXPECT_EQ(paths[0].id, first_is_surer ? 1 : 2);
        EXPECT_EQ(paths[1].id, 3) << "beside it";
        EXPECT_EQ(dropped.at(0).beside, paths[0].id);
    }
}

}  // namespace eyrie::long_vehicles_test

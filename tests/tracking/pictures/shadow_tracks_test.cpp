// Which tracks are nothing but the shadow of another: of lorries, whose shadows are as large as cars.
#include <gtest/gtest.h>

#include <cmath>

#include "tracking/frame_summaries.h"
#include "tracking/pictures/cast_shadow.h"

namespace eyrie::shadow_tracks_test {
namespace {

const SceneScale kScale{0.2, 25, true};  // 5 px are 1 m; 10 m/s are 2 px/frame
constexpr int kFrames = 50;

/// A lorry of 40 × 13 px on its way along a heading, and what drives beside it.
struct Convoy {
    double heading = 0;
    double turn = 0;  ///< radians by which the camera turns each frame, about the middle of the picture
    std::vector<TrackPath> paths;
    std::vector<SilhouetteLook> looks;
    std::vector<DroppedPath> dropped;

    /// `beside`: px along and across; detected in one of so many frames.
    void add(TrackId id, cv::Point2d beside, int detected_every, double shaded, double drift = 0, int first = 0) {
        TrackPath path{id, {}};
        for (FrameIndex frame = first; frame < kFrames; ++frame) {
            const double angle = heading + turn * frame;
            const cv::Point2d along(std::cos(angle), std::sin(angle));
            const cv::Point2d across(-along.y, along.x);
            TrackState state;
            state.id = id;
            state.velocity = (2 + drift) * along;
            state.box = {
                cv::Point2d(320, 180) + along * (2.0 * (frame - 25) + drift * frame + beside.x) + across * beside.y, 40,
                13, angle};
            state.origin = frame % detected_every == 0 ? StateOrigin::detected : StateOrigin::predicted;
            path.states.emplace_back(frame, PathState(state));
        }
        paths.push_back(path);
        for (const FrameIndex frame : {12, 24, 36}) {
            SilhouetteLook look;
            look.track = id;
            look.frame = frame;
            look.shaded = shaded;
            looks.push_back(look);
        }
    }
    /// The tracks that stay, where shadows of cars reach so many metres from their vehicles in the first picture.
    std::vector<TrackId> left(cv::Point2d reach_m) {
        GroundMotion ground;
        const double c = std::cos(turn);
        const double s = std::sin(turn);
        for (FrameIndex frame = 0; frame < kFrames; ++frame) {
            FrameMotionSummary summary = test::summaryOfFrame(frame);
            if (frame > 0)
                summary.registration.current_from_previous.matrix = {
                    c, -s, 320 - c * 320 + s * 180, s, c, 180 - s * 320 - c * 180, 0, 0, 1};
            ground.add(summary);
        }
        std::vector<CastShadow> shadows;
        if (reach_m != cv::Point2d(0, 0)) shadows.push_back({0, reach_m, 6, 1});
        dropShadowTracks(paths, looks, shadows, GroundTurns(ground, 0, kFrames - 1), kScale, dropped);
        std::vector<TrackId> ids;
        ids.reserve(paths.size());
        for (const TrackPath& path : paths) ids.push_back(path.id);
        return ids;
    }
};

/// A lorry, and 17 px to its right, 4 px off its side, what is shaded.
Convoy lorryAndShadow(double heading = 0, double turn = 0) {
    Convoy convoy{heading, turn, {}, {}, {}};
    convoy.add(1, {0, 0}, 1, 0.1);
    convoy.add(2, {3, 17}, 3, 0.6);
    return convoy;
}

using Tracks = std::vector<TrackId>;
const cv::Point2d kRight(0.1, 0.7);  ///< of what heads to the right

}  // namespace

TEST(ShadowTracks, WhatLiesWhereTheShadowOfALorryFallsIsLeftOut) {
    Convoy convoy = lorryAndShadow();
    EXPECT_EQ(convoy.left(kRight), Tracks{1});
    ASSERT_EQ(convoy.dropped.size(), 1U);
    EXPECT_EQ(convoy.dropped[0].path.id, 2);
    EXPECT_EQ(convoy.dropped[0].why, TrackDrop::shadow);
    EXPECT_EQ(convoy.dropped[0].beside, 1);
}

TEST(ShadowTracks, WhatLayBesideAShadowLiesBesideItsVehicle) {
    Convoy convoy = lorryAndShadow();
    convoy.dropped = {{TrackPath{8, {}}, TrackDrop::shares_place, 2}, {TrackPath{9, {}}, TrackDrop::shadow, 8}};
    EXPECT_EQ(convoy.left(kRight), Tracks{1});
    ASSERT_EQ(convoy.dropped.size(), 3U);
    EXPECT_EQ(convoy.dropped[0].beside, 1);
    EXPECT_EQ(convoy.dropped[1].beside, 8) << "which is no shadow";
}

TEST(ShadowTracks, TheWayShadowsFallTurnsWithTheCamera) {
    const cv::Point2d to_the_right_of_what_heads_down(-0.7, 0.1);
    EXPECT_EQ(lorryAndShadow(1.5708).left(to_the_right_of_what_heads_down), Tracks{1});
    EXPECT_EQ(lorryAndShadow(1.5708).left(kRight), (Tracks{1, 2}));
    EXPECT_EQ(lorryAndShadow(0, 0.005).left(kRight), Tracks{1});
    EXPECT_EQ(lorryAndShadow(-1, 0.04).left(kRight), (Tracks{1, 2}))
        << "it looks so in the middle, when all has turned";
    EXPECT_EQ(lorryAndShadow(0, 0.04).left(kRight), Tracks{1}) << "both turn with the ground";
}

TEST(ShadowTracks, WhatIsLitStays) {
    const auto leftWithShade = [](double shaded) {
        Convoy convoy;
        convoy.add(1, {0, 0}, 1, 0.1);
        convoy.add(2, {3, 17}, 3, shaded);
        return convoy.left(kRight);
    };
    EXPECT_EQ(leftWithShade(0.31), Tracks{1});
    EXPECT_EQ(leftWithShade(0.29), (Tracks{1, 2}));
    Convoy not_looked_at = lorryAndShadow();
    not_looked_at.looks.clear();
    EXPECT_EQ(not_looked_at.left(kRight), (Tracks{1, 2}));
}

TEST(ShadowTracks, WhatLiesElsewhereStays) {
    EXPECT_EQ(lorryAndShadow().left({0.1, -0.7}), (Tracks{1, 2})) << "shadows fall to the other side";
    EXPECT_EQ(lorryAndShadow().left({0.7, 0.3}), (Tracks{1, 2})) << "shadows fall ahead";
    EXPECT_EQ(lorryAndShadow().left({0, 0}), (Tracks{1, 2})) << "nobody knows where they fall";
    // Shadows of lorries reach two and a half times as far as those of cars: the gap is 0.8 m and a little.
    EXPECT_EQ(lorryAndShadow().left({0.03, 0.34}), Tracks{1});
    EXPECT_EQ(lorryAndShadow().left({0.03, 0.28}), (Tracks{1, 2}));
}

TEST(ShadowTracks, WhatDrivesByItselfStays) {
    Convoy overtaking;
    overtaking.add(1, {0, 0}, 1, 0.1);
    overtaking.add(2, {-3, 17}, 3, 0.6, 0.3);
    EXPECT_EQ(overtaking.left(kRight), (Tracks{1, 2}));
    Convoy seen_well;
    seen_well.add(1, {0, 0}, 1, 0.1);
    seen_well.add(2, {3, 17}, 1, 0.6);
    EXPECT_EQ(seen_well.left(kRight), (Tracks{1, 2})) << "a dark car in the next lane";
}

}  // namespace eyrie::shadow_tracks_test

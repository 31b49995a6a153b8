#include <gtest/gtest.h>

#include <algorithm>

#include "chain/chain.h"
#include "chain/scale/slope_estimation.h"
#include "chain/scale/view_estimation.h"
#include "support/moving_scene.h"

/// What looks for a slope and for a view see, against a slow look that follows the words of their descriptions.
namespace eyrie::slow_looks_test {
namespace {

constexpr int kFrames = 130;

/// Vehicles of many sizes, from some that are hardly seen to some that fill a good part of the picture.
test::MemorySource manySizes() {
    static const std::vector<cv::Mat> pictures = [] {
        test::MovingScene scene;
        scene.frames = kFrames;
        scene.camera_per_frame = {0.4, 0.1};
        scene.vehicles = {{{40, 40}, {1.7, 0}, {9, 4}},     {{60, 80}, {1.6, 0}, {24, 11}},
                          {{290, 60}, {-0.8, 0}, {7, 4}},   {{40, 120}, {1.8, 0}, {50, 22}},
                          {{290, 140}, {-1, 0}, {16, 8}},   {{20, 200}, {1.9, 0}, {90, 40}},
                          {{280, 190}, {-1, 0.2}, {33, 15}}};
        std::vector<cv::Mat> drawn;
        drawn.reserve(kFrames);
        for (int i = 0; i < kFrames; ++i) drawn.push_back(scene.draw(i));
        return drawn;
    }();
    return {kFrames, pictures.front().size(), [](int frame) { return pictures.at(static_cast<std::size_t>(frame)); }};
}

struct Seen {
    std::vector<ScaleVote> votes;
    std::size_t most_at_once = 0;
    CameraSlope camera;
};

/// Everything that moves in some frames of stretches says at which of `scales` it looks like a vehicle.
Seen slowLook(FrameSource& source, const std::vector<std::pair<int, int>>& stretches,
              const std::function<bool(int)>& counts, const SceneScale& scale, const ScaleRange& scales) {
    const ChainOptions options;
    const ScaleLooker looker(options.detection.sliding_window);
    Seen seen{{}, 0, CameraSlope(source.info().size)};
    for (const auto& [first, last] : stretches) {
        MotionHalf half(options, scale);
        CameraWay way;
        for (int i = first; i <= last; ++i) {
            const Frame frame = source.read(i, false);
            StageTimes times{};
            const FrameMotion motion = half.next(frame, times);
            way.add(motion.registration);
            if (!counts(i - first)) continue;
            std::size_t now = 0;
            for (const MotionCluster& cluster : MotionClustering(options.clustering, scale).cluster(motion)) {
                std::vector<cv::Point2f> places;
                for (const int member : cluster.members)
                    places.push_back(motion.motion_vectors.at(static_cast<std::size_t>(member)).position);
                for (const ScaleVote& vote : looker.votesOn(frame.gray, cluster.box, places, scales)) {
                    seen.votes.push_back(vote);
                    ++now;
                }
            }
            seen.most_at_once = std::max(seen.most_at_once, now);
        }
        seen.camera.add(way.steps());
    }
    return seen;
}

void expectSame(const std::vector<ScaleVote>& votes, const CameraSlope& camera, const Seen& slow) {
    ASSERT_EQ(votes.size(), slow.votes.size());
    for (std::size_t i = 0; i < votes.size(); ++i) {
        EXPECT_EQ(votes[i].place, slow.votes[i].place) << i;
        EXPECT_EQ(votes[i].gsd_m_per_px, slow.votes[i].gsd_m_per_px) << i;
    }
    for (const double growth : {-0.9, -0.4, 0.0, 0.3, 0.7, 2.0})
        EXPECT_EQ(camera.cost(growth), slow.camera.cost(growth)) << growth;
}

}  // namespace

TEST(SlowLooks, ForASlopeAskInThreeFramesOfEachStretchAboutScalesNearTheOneThatIsKnown) {
    test::MemorySource source = manySizes();
    std::size_t votes = 0;
    for (const double gsd : {0.05, 0.2, 0.8}) {
        SCOPED_TRACE(gsd);
        const SceneScale scale{gsd, 25, true};
        const SlopeLook look = lookForSlope(source, {2, 121}, {}, scale, {});
        const auto counts = [](int frame) { return frame == 17 || frame == 25 || frame == 33; };
        expectSame(look.votes, look.camera,
                   slowLook(source, {{2, 35}, {45, 78}, {88, 121}}, counts, scale, {gsd / 3.5, gsd * 3.5}));
        for (const ScaleVote& vote : look.votes) {
            EXPECT_GT(vote.gsd_m_per_px, gsd / 3.6);
            EXPECT_LT(vote.gsd_m_per_px, gsd * 3.6);
        }
        votes += look.votes.size();
    }
    EXPECT_GT(votes, 30U);
}

TEST(SlowLooks, ForAViewAskInEveryFrameFromTheThirteenthOnAboutAnyScale) {
    test::MemorySource source = manySizes();
    const ViewLook look = lookForView(source, {2, 124}, {}, 25, {});
    const auto counts = [](int frame) { return frame >= 12; };
    SceneScale linked;
    linked.gsd_m_per_px = 0.1;
    const Seen slow = slowLook(source, {{2, 41}, {43, 82}, {85, 124}}, counts, linked, {0.02, 0.6});
    expectSame(look.votes, look.camera, slow);
    EXPECT_EQ(look.most_at_once, slow.most_at_once);
    EXPECT_GT(look.most_at_once, 2U);
    ASSERT_EQ(look.stretches.size(), 3U);
    EXPECT_EQ(look.stretches[1].first, 43);
    for (const Stretch& stretch : look.stretches) EXPECT_EQ(stretch.count, 40);
}

TEST(SlowLooks, InAShortVideoAskInItsSecondHalfForASlopeAndInAllButTheFirstThirdForAView) {
    test::MemorySource source = manySizes();
    const SceneScale scale{0.2, 25, true};
    const SlopeLook slope = lookForSlope(source, {2, 21}, {}, scale, {});
    const auto for_slope = [](int frame) { return frame == 10 || frame == 15 || frame == 19; };
    expectSame(slope.votes, slope.camera, slowLook(source, {{2, 21}}, for_slope, scale, {0.2 / 3.5, 0.2 * 3.5}));
    EXPECT_FALSE(slope.votes.empty());

    const ViewLook view = lookForView(source, {2, 21}, {}, 25, {});
    SceneScale linked;
    linked.gsd_m_per_px = 0.1;
    expectSame(view.votes, view.camera,
               slowLook(source, {{2, 21}}, [](int frame) { return frame >= 6; }, linked, {0.02, 0.6}));
    EXPECT_FALSE(view.votes.empty());
}

TEST(SlowLooks, ForAViewTakeStretchesAsOneWhereTheyTouch) {
    const auto stretches = [](int frames) {
        test::MemorySource source(frames, {64, 48}, [](int) { return cv::Mat(48, 64, CV_8UC1, cv::Scalar(90)); });
        std::vector<std::pair<int, int>> found;
        for (const Stretch& stretch : lookForView(source, {}, {}, 25, {}).stretches)
            found.emplace_back(stretch.first, stretch.count);
        return found;
    };
    using Stretches = std::vector<std::pair<int, int>>;
    EXPECT_EQ(stretches(41), (Stretches{{0, 41}}));
    EXPECT_EQ(stretches(120), (Stretches{{0, 120}}));
    EXPECT_EQ(stretches(121), (Stretches{{0, 80}, {81, 40}}));
    EXPECT_EQ(stretches(122), (Stretches{{0, 40}, {41, 40}, {82, 40}}));
}

}  // namespace eyrie::slow_looks_test

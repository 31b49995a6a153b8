#include "chain/scale_estimation.h"

#include <gtest/gtest.h>

#include "support/moving_scene.h"
#include "support/shared_data.h"

namespace eyrie {

TEST(ScaleEstimation, findsTheScaleOfRealTraffic) {
    EYRIE_NEED_SHARED_DATA("collage_day");
    const auto source = openSource(test::sharedData("collage_day/frames"));
    const SceneScale scale = chooseScale(*source, {}, ChainOptions{}, 0, {});
    EXPECT_FALSE(scale.gsd_known) << "a guess is no knowledge";
    EXPECT_GT(scale.gsd_m_per_px, 0.2 / 1.4);
    EXPECT_LT(scale.gsd_m_per_px, 0.2 * 1.4);
}

TEST(ScaleEstimation, aGivenScaleIsTakenAsItIs) {
    test::MemorySource source((test::MovingScene()));
    const SceneScale scale = chooseScale(source, {}, ChainOptions{}, 0.31, {});
    EXPECT_TRUE(scale.gsd_known);
    EXPECT_DOUBLE_EQ(scale.gsd_m_per_px, 0.31);
}

TEST(ScaleEstimation, withoutTrafficItFallsBackAndDoesNotFail) {
    test::MovingScene scene;
    scene.vehicles.clear();
    scene.frames = 20;
    test::MemorySource source(scene);
    EXPECT_DOUBLE_EQ(chooseScale(source, {}, ChainOptions{}, 0, {}).gsd_m_per_px, SceneScale{}.gsd_m_per_px);
}

TEST(ScaleEstimation, tellsHowFarItIs) {
    test::MovingScene scene;
    scene.frames = 6;
    test::MemorySource source(scene);
    std::vector<RunProgress> told;
    chooseScale(source, {}, ChainOptions{}, 0, {}, [&](const RunProgress& progress) { told.push_back(progress); });
    ASSERT_FALSE(told.empty());
    for (std::size_t i = 0; i < told.size(); ++i) {
        EXPECT_TRUE(told[i].estimating_scale);
        EXPECT_EQ(told[i].frames_done, static_cast<int>(i) + 1);
        EXPECT_EQ(told[i].frames_total, static_cast<int>(told.size()));
    }
    told.clear();
    chooseScale(source, {}, ChainOptions{}, 0.3, {}, [&](const RunProgress& progress) { told.push_back(progress); });
    EXPECT_TRUE(told.empty()) << "nothing to look for";
}

TEST(ScaleEstimation, stopsWhenAsked) {
    std::stop_source stop;
    stop.request_stop();
    test::MemorySource source((test::MovingScene()));
    EXPECT_FALSE(estimateScale(source, 0, 39, ChainOptions{}, 25, stop.get_token()));
}

}  // namespace eyrie

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/geometry/oriented_box.h"
#include "scene/preset_facts.h"
#include "scene/scene_truth.h"
#include "scene/towns/scene_preset.h"

/// What the rendered motorway promises, without painting a pixel.
namespace eyrie::motorway_test {
namespace {

constexpr std::uint32_t kSeeds[] = {3, 4, 5};

/// m/s from the first frame to the last one in which an object is there.
double speedOf(const MovingObject& object, double frame_rate_hz) {
    double way = 0;
    for (std::size_t i = 1; i < object.poses.size(); ++i) {
        const cv::Point2d step = object.poses[i].position - object.poses[i - 1].position;
        way += std::hypot(step.x, step.y);
    }
    return way * frame_rate_hz / static_cast<double>(object.poses.size() - 1);
}

}  // namespace

TEST(Motorway, TrafficIsTwiceAsFastAsInTowns) {
    for (const std::uint32_t seed : kSeeds) {
        const SceneDescription scene = scenePreset("motorway", seed);
        std::vector<double> speeds;
        for (const MovingObject& object : scene.objects) {
            if (isVehicle(object.look.kind) && object.poses.size() > 20)
                speeds.push_back(speedOf(object, scene.frame_rate_hz));
        }
        ASSERT_GE(speeds.size(), 8U) << seed;
        std::sort(speeds.begin(), speeds.end());
        EXPECT_GT(speeds[speeds.size() / 2], 20) << seed;
        EXPECT_GT(speeds.back(), 28) << seed;
        EXPECT_LT(speeds.back(), 45) << seed;
    }
}

TEST(Motorway, IsSeenObliquelyAtScalesOfTenToTwentyEightCentimetres) {
    for (const std::uint32_t seed : kSeeds) {
        const SceneDescription scene = scenePreset("motorway", seed);
        EXPECT_GE(scene.gsd_m_per_px, 0.1) << seed;
        EXPECT_LE(scene.gsd_m_per_px, 0.28) << seed;
        const double tilt = scene.camera.keys.front().tilt;
        EXPECT_GE(tilt, radiansFromDegrees(18)) << seed;
        EXPECT_LE(tilt, radiansFromDegrees(52)) << seed;
        const std::vector<StandingThing> nothing;
        int counted = 0;
        double shortest = 1e9;
        for (const SceneObject& object : SceneTruth(scene, nothing).objectsOnOpenGround(75)) {
            if (object.ignore || object.kind != ObjectKind::car) continue;
            ++counted;
            shortest = std::min(shortest, object.box.length);
        }
        EXPECT_GE(counted, 2) << seed;
        EXPECT_GE(shortest, 8) << seed;
    }
}

TEST(Motorway, PictureAndCameraAreThoseOfThePreset) {
    const SceneDescription scene = scenePreset("motorway", 3);
    EXPECT_EQ(test::pictureFacts(scene),
              "25 Hz, 150 of 960 x 540; -0.45 0.6 0.44; 0.5 0.15 1.6 0.12; 0.95 122 0.05 0.12; 80 0 1 0 0 8; 1.4 0.3 "
              "0.0009 5; 8 1600");
    EXPECT_EQ(test::keyFacts(scene, 0), "0; 11.843 62.569; 191.354; 325.342 32.152; 2230.289");
    EXPECT_EQ(test::keyFacts(scene, 1), "75; 9.474 0; 192.854; 326.488 32.61; 2230.289");
    EXPECT_EQ(test::keyFacts(scene, 2), "150; 7.106 -62.569; 190.354; 327.061 32.152; 2230.289");
    EXPECT_EQ(test::standingFacts(scene), "26 -90267; 221 -48722; 271 132448; 0 0; 43 -22527; 3763 8354866");
}

}  // namespace eyrie::motorway_test

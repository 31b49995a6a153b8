#include "scene/scene_truth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/angle.h"
#include "scene/small_scene.h"

namespace eyrie::scene_truth_test {
namespace {

std::vector<SceneObject> truthOf(const SceneDescription& scene, int frame = 0) {
    const std::vector<StandingThing> things = standingThings(scene);
    return SceneTruth(scene, things).objects(frame);
}

}  // namespace

TEST(SceneTruth, boxSpansTheVehicle) {
    SceneDescription scene = plainScene(1);
    scene.objects.push_back(driving(4, carLook(), {0, 0}, 0.7, 0, 1));
    const SceneObject car = truthOf(scene).front();
    EXPECT_EQ(car.id, 4);
    EXPECT_NEAR(car.box.heading, 0.7, 1e-9);
    // The car is seen from 300 m, its widest part 0.9 m above the ground.
    EXPECT_NEAR(car.box.length, 4.5 / 0.3 * 300 / 299.1, 0.03);
    EXPECT_NEAR(car.box.width, 1.8 / 0.3 * 300 / 299.1, 0.03);
    EXPECT_NEAR(car.box.centre.x, 79.5, 0.02);
    EXPECT_NEAR(car.box.centre.y, 59.5, 0.02);
    EXPECT_NEAR(car.inside, 1, 1e-9);
    EXPECT_DOUBLE_EQ(car.visibility, 1);
}

TEST(SceneTruth, headingTurnsWithTheCamera) {
    SceneDescription scene = plainScene(1);
    scene.camera.keys.front().heading = 0.3;
    scene.objects.push_back(driving(1, carLook(), {0, 0}, 0.7, 0, 1));
    EXPECT_NEAR(truthOf(scene).front().box.heading, 0.4, 1e-9);
}

TEST(SceneTruth, ignoresWhatStandsAndCountsWhatMoves) {
    constexpr int frames = 40;
    SceneDescription scene = plainScene(frames);
    scene.objects.push_back(driving(1, carLook(), {0, 0}, 0, 0, frames));
    scene.objects.push_back(driving(2, carLook(), {0, 5}, 0, 0.2, frames));
    scene.objects.push_back(driving(3, carLook(), {0, -5}, 0, 0.5, frames));
    const auto truth = truthOf(scene, 20);
    ASSERT_EQ(truth.size(), 3U);
    EXPECT_TRUE(truth[0].ignore);
    EXPECT_TRUE(truth[1].ignore) << "below 0.3 m/s";
    EXPECT_FALSE(truth[2].ignore);
    EXPECT_NEAR(truth[2].speed, 0.5, 1e-9);
}

TEST(SceneTruth, ignoresWhatIsTooSmallToBeLabelled) {
    constexpr int frames = 20;
    SceneDescription scene = plainScene(frames);
    scene.objects.push_back(driving(1, carLook(), {-10, 0}, 0, 8, frames));
    scene.least_length_px = 14;
    EXPECT_FALSE(truthOf(scene, 10).front().ignore) << "4.5 m are 15 px";
    scene.least_length_px = 16;
    EXPECT_TRUE(truthOf(scene, 10).front().ignore);
}

TEST(SceneTruth, ignoresWhatIsCutByTheBorder) {
    constexpr int frames = 20;
    SceneDescription scene = plainScene(frames);
    // The border is at x = 24 m.
    scene.objects.push_back(driving(1, carLook(), {22.9, 0}, kPi / 2, 5, frames));
    scene.objects.push_back(driving(2, carLook(), {23.8, 10}, kPi / 2, 0.5, frames));
    scene.objects.push_back(driving(3, carLook(), {40, 0}, kPi / 2, 5, frames));
    const auto truth = truthOf(scene, 0);
    ASSERT_EQ(truth.size(), 2U);
    EXPECT_FALSE(truth[0].ignore);
    EXPECT_TRUE(truth[1].ignore);
    EXPECT_LT(truth[1].inside, 0.65);
}

TEST(SceneTruth, treesHide) {
    constexpr int frames = 20;
    SceneDescription scene = plainScene(frames);
    Tree tree;
    tree.position = {0, 0};
    tree.height = 9;
    tree.crown_radius = 3.5;
    scene.trees.push_back(tree);
    scene.objects.push_back(driving(1, carLook(), {0, 0}, 0, 1, frames));
    scene.objects.push_back(driving(2, carLook(), {12, 0}, 0, 1, frames));
    scene.objects.push_back(driving(3, carLook(), {3.6, 0}, 0, 1, frames));
    const auto truth = truthOf(scene, 0);
    ASSERT_EQ(truth.size(), 3U);
    EXPECT_LT(truth[0].visibility, 0.4);
    EXPECT_TRUE(truth[0].ignore);
    EXPECT_DOUBLE_EQ(truth[1].visibility, 1);
    EXPECT_GT(truth[2].visibility, 0.2);
    EXPECT_LT(truth[2].visibility, 1);
}

TEST(SceneTruth, buildingsHideOnlyOnTheirFarSide) {
    constexpr int frames = 20;
    SceneDescription scene = plainScene(frames);
    scene.camera.keys.front().tilt = 0.7;
    Building building;
    building.length = 20;
    building.width = 6;
    building.height = 15;
    scene.buildings.push_back(building);
    // The camera looks to the north from the south.
    scene.objects.push_back(driving(1, carLook(), {0, -6}, 0, 1, frames));
    scene.objects.push_back(driving(2, carLook(), {0, 6}, 0, 1, frames));
    const auto truth = truthOf(scene, 0);
    ASSERT_EQ(truth.size(), 2U);
    EXPECT_DOUBLE_EQ(truth[0].visibility, 0);
    EXPECT_TRUE(truth[0].ignore);
    EXPECT_DOUBLE_EQ(truth[1].visibility, 1);
}

TEST(SceneTruth, parkedVehiclesAreNotListed) {
    SceneDescription scene = plainScene(1);
    scene.parked.push_back({carLook(), {{0, 0}, {1, 0}, 0}});
    EXPECT_TRUE(truthOf(scene).empty());
}

TEST(SceneTruth, objectsLiveFromTheirFirstToTheirLastPose) {
    SceneDescription scene = plainScene(20);
    MovingObject object = driving(1, carLook(), {0, 0}, 0, 1, 5);
    object.first_frame = 6;
    scene.objects.push_back(object);
    EXPECT_TRUE(truthOf(scene, 5).empty());
    EXPECT_EQ(truthOf(scene, 6).size(), 1U);
    EXPECT_EQ(truthOf(scene, 10).size(), 1U);
    EXPECT_TRUE(truthOf(scene, 11).empty());
}

TEST(SceneTruth, speedIsTheMeanOverTenFramesOnEitherSide) {
    constexpr int frames = 60;
    SceneDescription scene = plainScene(frames);
    MovingObject object = driving(1, carLook(), {0, 0}, 0, 0, frames);
    // It stands until frame 30 and then drives 0.2 m a frame, 5 m/s.
    for (std::size_t i = 30; i < object.poses.size(); ++i)
        object.poses[i].position.x = 0.2 * static_cast<double>(i - 30);
    scene.objects.push_back(object);
    EXPECT_NEAR(truthOf(scene, 20).front().speed, 0, 1e-9);
    EXPECT_NEAR(truthOf(scene, 21).front().speed, 0.2 / 20 * 25, 1e-9) << "one step of twenty";
    EXPECT_NEAR(truthOf(scene, 30).front().speed, 2.5, 1e-9);
    EXPECT_NEAR(truthOf(scene, 40).front().speed, 5, 1e-9);
    EXPECT_NEAR(truthOf(scene, 0).front().speed, 0, 1e-9);
    EXPECT_NEAR(truthOf(scene, frames - 1).front().speed, 5, 1e-9) << "over what there is";
}

TEST(SceneTruth, posesLieBetweenThoseOfWholeFramesAndHalfAFrameBeyond) {
    MovingObject object = driving(1, carLook(), {2, 3}, 0, 25, 3);
    object.first_frame = 10;
    object.poses[2].direction = {0, 1};
    object.poses[2].speed = 5;
    ObjectPose pose;
    ASSERT_TRUE(poseAt(object, 10.25, pose));
    EXPECT_NEAR(pose.position.x, 2.25, 1e-12);
    EXPECT_NEAR(pose.position.y, 3, 1e-12);
    ASSERT_TRUE(poseAt(object, 11.5, pose));
    EXPECT_NEAR(pose.direction.x, std::sqrt(0.5), 1e-12) << "a unit vector half way";
    EXPECT_NEAR(pose.speed, 15, 1e-12);
    ASSERT_TRUE(poseAt(object, 9.5, pose));
    EXPECT_NEAR(pose.position.x, 2, 1e-12) << "as at the first";
    ASSERT_TRUE(poseAt(object, 12.5, pose));
    EXPECT_NEAR(pose.position.x, 4, 1e-12) << "as at the last";
    EXPECT_FALSE(poseAt(object, 9.4, pose));
    EXPECT_FALSE(poseAt(object, 12.6, pose));
    EXPECT_FALSE(poseAt(MovingObject(), 0, pose));
}

}  // namespace eyrie::scene_truth_test

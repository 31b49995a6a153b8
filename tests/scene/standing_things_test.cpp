#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>

#include "core/geometry/angle.h"
#include "scene/painting/night_lights.h"
#include "scene/towns/static_world.h"

/// What stands, corner by corner, its shadows, and what shines at night.
namespace eyrie::standing_things_test {
namespace {

using Points = std::vector<cv::Point3d>;

void expectCorners(const Face& face, const Points& corners, const char* what) {
    ASSERT_EQ(face.corners.size(), corners.size()) << what;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        EXPECT_NEAR(face.corners[i].x, corners[i].x, 1e-9) << what << ", corner " << i;
        EXPECT_NEAR(face.corners[i].y, corners[i].y, 1e-9) << what << ", corner " << i;
        EXPECT_NEAR(face.corners[i].z, corners[i].z, 1e-9) << what << ", corner " << i;
    }
}

/// A box of four walls and a lid, from face `at` on.
void expectBox(const Mesh& mesh, std::size_t at, cv::Point3d low, cv::Point3d high, const char* what) {
    cv::Point3d least(1e9, 1e9, 1e9), most = -least;
    ASSERT_GE(mesh.faces.size(), at + 5) << what;
    for (std::size_t i = at; i < at + 5; ++i) {
        for (const cv::Point3d& corner : mesh.faces[i].corners) {
            least = {std::min(least.x, corner.x), std::min(least.y, corner.y), std::min(least.z, corner.z)};
            most = {std::max(most.x, corner.x), std::max(most.y, corner.y), std::max(most.z, corner.z)};
        }
    }
    EXPECT_LT(cv::norm(least - low), 1e-9) << what << " from " << least;
    EXPECT_LT(cv::norm(most - high), 1e-9) << what << " to " << most;
    for (const cv::Point3d& corner : mesh.faces[at + 4].corners) EXPECT_NEAR(corner.z, high.z, 1e-9) << what;
}

double areaOf(const std::vector<cv::Point2d>& outline) {
    double twice = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) twice += outline[i].cross(outline[(i + 1) % outline.size()]);
    return std::abs(twice) / 2;
}

Tree treeOf(double height, double radius, double density, std::uint32_t seed) {
    Tree tree;
    tree.position = {3, 4};
    tree.height = height;
    tree.crown_radius = radius;
    tree.density = density;
    tree.seed = seed;
    return tree;
}

}  // namespace

TEST(StandingThings, AHouseWithAFlatRoofIsABoxWhoseRoofIsPaintedOnTheMap) {
    SceneDescription scene;
    Building house;
    house.centre = {100, 50};
    house.direction = {0, 1};
    scene.buildings.push_back(house);
    const StandingThing thing = standingThings(scene).at(0);
    ASSERT_EQ(thing.mesh.faces.size(), 5U);
    expectBox(thing.mesh, 0, {94, 40, 0}, {106, 60, 12}, "house");
    EXPECT_NEAR(cv::norm(thing.centre - cv::Point2d(100, 50)), 0, 1e-9);
    EXPECT_NEAR(thing.reach, std::sqrt(136.0), 1e-9);
    EXPECT_NEAR(thing.height, 12, 1e-9);
    EXPECT_EQ(thing.mesh.faces[0].finish, Finish::facade);
    EXPECT_EQ(thing.mesh.faces[0].colour, cv::Vec3f(150, 160, 165));
    EXPECT_EQ(thing.mesh.faces[4].finish, Finish::map_roof);
    // Storeys differ from house to house, between 2.8 and 3.4 m.
    float least = 9, most = 0;
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
        scene.buildings[0].seed = seed;
        const Face wall = standingThings(scene).at(0).mesh.faces[0];
        EXPECT_EQ(wall.seed, seed);
        least = std::min(least, wall.storey);
        most = std::max(most, wall.storey);
    }
    EXPECT_GE(least, 2.8F);
    EXPECT_LT(least, 2.88F);
    EXPECT_LE(most, 3.41F);
    EXPECT_GT(most, 3.32F);
}

TEST(StandingThings, ARidgeIsThreeTenthsOfTheWidthAboveTheEaves) {
    SceneDescription scene;
    Building house;
    house.roof = RoofKind::gable;
    scene.buildings.push_back(house);
    const StandingThing thing = standingThings(scene).at(0);
    ASSERT_EQ(thing.mesh.faces.size(), 8U);
    expectCorners(thing.mesh.faces[4], {{-10, -6, 12}, {10, -6, 12}, {10, 0, 15.6}, {-10, 0, 15.6}}, "left slope");
    expectCorners(thing.mesh.faces[5], {{10, 6, 12}, {-10, 6, 12}, {-10, 0, 15.6}, {10, 0, 15.6}}, "right slope");
    expectCorners(thing.mesh.faces[6], {{10, -6, 12}, {10, 6, 12}, {10, 0, 15.6}}, "front gable");
    expectCorners(thing.mesh.faces[7], {{-10, 6, 12}, {-10, -6, 12}, {-10, 0, 15.6}}, "rear gable");
    EXPECT_EQ(thing.mesh.faces[5].finish, Finish::map_roof);
    EXPECT_EQ(thing.mesh.faces[7].colour, cv::Vec3f(150, 160, 165));
    EXPECT_NEAR(thing.height, 15.6, 1e-9);
    // Slopes look up and outwards: 3.6 m on 6 m.
    EXPECT_NEAR(thing.mesh.faces[4].normal.y, -3.6 / std::hypot(6, 3.6), 1e-9);
    EXPECT_NEAR(thing.mesh.faces[4].normal.z, 6 / std::hypot(6, 3.6), 1e-9);
    EXPECT_NEAR(thing.mesh.faces[5].normal.y, 3.6 / std::hypot(6, 3.6), 1e-9);
    EXPECT_NEAR(thing.mesh.faces[6].normal.x, 1, 1e-9);
    EXPECT_NEAR(thing.mesh.faces[7].normal.x, -1, 1e-9);
    // A low sun in the west: the shadow of the ridge's ends reaches farther than that of the eaves.
    scene.sun.shadow = {2, 0};
    const auto shadows = staticShadows(scene);
    ASSERT_EQ(shadows.size(), 1U);
    double farthest = 0;
    for (const cv::Point2d& p : shadows[0]) farthest = std::max(farthest, p.x);
    EXPECT_NEAR(farthest, 10 + 2 * 15.6, 1e-9);
}

TEST(StandingThings, ABlockCastsTheShadowOfItsHull) {
    SceneDescription scene;
    Block block;
    block.centre = {5, 6};
    block.bottom = 0.5;
    scene.blocks.push_back(block);
    block.bottom = 0;
    block.shines = true;
    scene.blocks.push_back(block);
    const auto things = standingThings(scene);
    ASSERT_EQ(things.size(), 2U);
    expectBox(things[0].mesh, 0, {4, 5.5, 0.5}, {6, 6.5, 2}, "block");
    EXPECT_EQ(things[0].mesh.faces[4].finish, Finish::matte);
    EXPECT_EQ(things[1].mesh.faces[4].finish, Finish::lamp);
    // Carried 1 m to the right and 0.8 m down: 2 × 1 m, and what it sweeps.
    const auto shadows = staticShadows(scene);
    ASSERT_EQ(shadows.size(), 2U);
    EXPECT_NEAR(areaOf(shadows[1]), 2 + 2 * 0.8 + 1 * 1, 1e-9);
    EXPECT_NEAR(areaOf(shadows[0]), 2 + 2 * 0.6 + 1 * 0.75, 1e-9);
    double right = 0, low = 0;
    for (const cv::Point2d& p : shadows[1]) {
        right = std::max(right, p.x);
        low = std::max(low, p.y);
    }
    EXPECT_NEAR(right, 7, 1e-9);
    EXPECT_NEAR(low, 7.3, 1e-9);
}

TEST(StandingThings, ALampHasAnArmWithALightAtItsEnd) {
    SceneDescription scene;
    LampPost post;
    post.position = {10, 20};
    post.arm = {0, 1};
    scene.posts.push_back(post);
    const StandingThing day = standingThings(scene).at(0);
    expectBox(day.mesh, 0, {9.9, 19.9, 0}, {10.1, 20.1, 8}, "post");
    expectBox(day.mesh, 5, {9.935, 20, 7.88}, {10.065, 22, 8}, "arm");
    expectBox(day.mesh, 10, {9.83, 21.6, 7.8}, {10.17, 22.4, 8}, "head");
    EXPECT_EQ(day.mesh.faces[0].colour, cv::Vec3f(118, 118, 116));
    EXPECT_EQ(day.mesh.faces[9].colour, cv::Vec3f(118, 118, 116));
    EXPECT_NEAR(day.mesh.faces[10].colour[0], 153.4, 1e-3);
    EXPECT_NEAR(day.mesh.faces[10].colour[2], 150.8, 1e-3);
    EXPECT_NEAR(day.mesh.faces[14].colour[0], 177, 1e-3);
    EXPECT_NEAR(day.mesh.faces[14].colour[2], 174, 1e-3);
    EXPECT_TRUE(day.balls.empty());

    scene.night.lamps = true;
    const StandingThing night = standingThings(scene).at(0);
    ASSERT_EQ(night.balls.size(), 1U);
    EXPECT_LT(cv::norm(night.balls[0].centre - cv::Point3d(10, 22, 7.7)), 1e-9);
    EXPECT_NEAR(night.balls[0].radius, 0.24, 1e-12);
    EXPECT_TRUE(night.balls[0].shines);
    EXPECT_NEAR(night.balls[0].colour[0], 110, 1e-3);
    EXPECT_NEAR(night.balls[0].colour[1], 187, 1e-3);
    EXPECT_NEAR(night.balls[0].colour[2], 242, 1e-3);
}

TEST(StandingThings, AParkedVehicleBringsItsOwnShadows) {
    SceneDescription scene;
    scene.sun.shadow = {0, 1};
    ParkedVehicle parked;
    parked.look.length = 4;
    parked.pose.position = {30, 40};
    scene.parked.push_back(parked);
    const StandingThing thing = standingThings(scene).at(0);
    EXPECT_EQ(thing.shadows.size(), 3U) << "skirt, body and cabin";
    double low = 0;
    for (const auto& shadow : thing.shadows)
        for (const cv::Point2d& p : shadow) low = std::max(low, p.y);
    // The roof, 0.7 of half the width from the axis and 1.45 m up; the lower and wider body does not reach as far.
    EXPECT_NEAR(low, 40 + 0.7 * 0.9 + 1.45, 1e-9);
    EXPECT_TRUE(staticShadows(scene).empty());
}

TEST(StandingThings, ATreeHasATrunkAndSwaysByItsHeight) {
    std::set<int> eighths;
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
        SceneDescription scene;
        scene.trees.push_back(treeOf(10, 4, 0.1, seed));
        const StandingThing thing = standingThings(scene).at(0);
        expectBox(thing.mesh, 0, {2.85, 3.85, 0}, {3.15, 4.15, 6}, "trunk");
        EXPECT_EQ(thing.mesh.faces[0].colour, cv::Vec3f(56, 66, 76));
        EXPECT_EQ(thing.mesh.faces[4].colour, cv::Vec3f(56, 66, 76));
        EXPECT_NEAR(thing.reach, 6.6, 1e-9);
        EXPECT_NEAR(thing.height, 11, 1e-9);
        EXPECT_NEAR(thing.sway, 0.12, 1e-9);
        EXPECT_GE(thing.sway_phase, 0);
        EXPECT_LT(thing.sway_phase, 2 * kPi);
        eighths.insert(static_cast<int>(thing.sway_phase / (2 * kPi) * 8));
    }
    EXPECT_EQ(eighths.size(), 8U) << "in any phase";
}

TEST(StandingThings, LeavesCastShadowsStretchedAwayFromTheSun) {
    SceneDescription scene;
    scene.sun.shadow = {3, 4};  // 5 m a metre: a ball's is √26 times as long as wide
    scene.trees.push_back(treeOf(10, 4, 0.1, 1));
    const auto balls = standingThings(scene).at(0).balls;
    const auto shadows = staticShadows(scene);
    ASSERT_EQ(shadows.size(), 1 + balls.size());
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const Ball& ball = balls[i];
        const cv::Point2d centre(ball.centre.x + 3 * ball.centre.z, ball.centre.y + 4 * ball.centre.z);
        const cv::Point2d along = cv::Point2d(0.6, 0.8) * (ball.radius * std::sqrt(26.0));
        const cv::Point2d across = cv::Point2d(-0.8, 0.6) * ball.radius;
        const auto& outline = shadows[1 + i];
        ASSERT_EQ(outline.size(), 8U);
        EXPECT_LT(cv::norm(outline[0] - centre - along), 1e-9);
        EXPECT_LT(cv::norm(outline[2] - centre - across), 1e-9);
        EXPECT_LT(cv::norm(outline[3] - centre + along * 0.7071 - across * 0.7071), 1e-9);
        EXPECT_LT(cv::norm(outline[4] - centre + along), 1e-9);
        EXPECT_LT(cv::norm(outline[6] - centre + across), 1e-9);
    }
}

TEST(Crown, IsALobeInTheMiddleWithFiveToEightAround) {
    // Light leaves: the lobe in the middle, 2.48 m in radius, has 0.1 · 22 · 2.48 = 5 clumps, each other one the
    // least, 4.
    std::set<std::size_t> sizes;
    const Sun sun;
    for (std::uint32_t seed = 1; seed <= 60; ++seed) sizes.insert(crownOf(treeOf(10, 4, 0.1, seed), sun).size());
    EXPECT_EQ(sizes, (std::set<std::size_t>{25, 29, 33, 37}));
}

TEST(Crown, LeavesLieInTheOuterQuarterOfTheirLobe) {
    const Sun sun;
    double nearest = 9, farthest = 0, widest = 0, lift = 0, lowest = 99, highest = 0, small = 9, large = 0;
    int count = 0;
    for (std::uint32_t seed = 1; seed <= 150; ++seed) {
        const std::vector<Ball> balls = crownOf(treeOf(10, 4, 1, seed), sun);
        // A crown is 7.5 m high, its middle at 6.25 m, its first lobe 0.9 m above that with a radius of 2.48 m: 54
        // clumps.
        ASSERT_GT(balls.size(), 54U + 5 * 28);
        for (std::size_t i = 0; i < 54; ++i) {
            const cv::Point3d out = balls[i].centre - cv::Point3d(3, 4, 7.15);
            nearest = std::min(nearest, cv::norm(out));
            farthest = std::max(farthest, cv::norm(out));
            lift += out.z / cv::norm(out);
            ++count;
        }
        for (const Ball& ball : balls) {
            widest = std::max(widest, std::hypot(ball.centre.x - 3, ball.centre.y - 4));
            lowest = std::min(lowest, ball.centre.z);
            highest = std::max(highest, ball.centre.z);
            small = std::min(small, ball.radius);
            large = std::max(large, ball.radius);
        }
    }
    EXPECT_NEAR(nearest, 0.72 * 2.48, 0.01);
    EXPECT_NEAR(farthest, 2.48, 0.01);
    EXPECT_NEAR(lift / count, 0.21, 0.025) << "a little more above than below: two thirds of 0.4 · √(2/π)";
    EXPECT_LE(widest, 4.4) << "0.6 of the radius away, half of it large";
    EXPECT_GT(widest, 4.0);
    EXPECT_GE(lowest, 2.15) << "6.25 − 0.28 · 7.5 − 2";
    EXPECT_LT(lowest, 3.1);
    EXPECT_LE(highest, 9.63);
    EXPECT_GT(highest, 9.4);
    EXPECT_NEAR(small, 0.2, 0.002);
    EXPECT_NEAR(large, 0.48, 0.002);
    const auto largestOf = [&](double density) {
        double largest = 0;
        for (const Ball& ball : crownOf(treeOf(10, 4, density, 1), sun)) largest = std::max(largest, ball.radius);
        return largest;
    };
    EXPECT_LT(largestOf(0.59), 0.288) << "0.6 of that";
    EXPECT_GT(largestOf(0.6), 0.4);
}

TEST(Crown, NarrowCrownsAreAsHighAsWideAndStayBelowTheTop) {
    const Sun sun;
    double lowest = 99, highest = 0;
    for (std::uint32_t seed = 1; seed <= 100; ++seed) {
        // 1.9 · 1 m high, its middle at 9.05 m, the first lobe at 9.278 m with a radius of 0.62 m.
        const std::vector<Ball> balls = crownOf(treeOf(10, 1, 4, seed), sun);
        for (std::size_t i = 0; i < 54; ++i) {
            lowest = std::min(lowest, balls[i].centre.z);
            highest = std::max(highest, balls[i].centre.z);
        }
    }
    EXPECT_NEAR(lowest, 9.278 - 0.62, 0.06);
    EXPECT_NEAR(highest, 9.278 + 0.62, 0.06);
    lowest = 99, highest = 0;
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        for (const Ball& ball : crownOf(treeOf(1, 4, 1, seed), sun)) {
            lowest = std::min(lowest, ball.centre.z);
            highest = std::max(highest, ball.centre.z);
        }
    }
    EXPECT_NEAR(lowest, 0.2, 1e-9) << "a fifth of the height is trunk";
    EXPECT_NEAR(highest, 1, 1e-9);
}

TEST(Crown, LeavesAreLitByTheSkyAndTowardsTheSun) {
    Sun sky, above;
    sky.ambient = 1;
    above.ambient = 0;
    above.shadow = {0, 0};
    double darkest = 9, brightest = 0, sunlit = 0, turned_away = 9;
    int black = 0, count = 0;
    for (std::uint32_t seed = 1; seed <= 100; ++seed) {
        Tree tree = treeOf(10, 4, 1, seed);
        tree.colour = {100, 50, 200};
        for (const Ball& ball : crownOf(tree, sky, {0, 0, 0})) {
            darkest = std::min(darkest, ball.colour[0] / 100.0);
            brightest = std::max(brightest, ball.colour[0] / 100.0);
            EXPECT_NEAR(ball.colour[2] / ball.colour[1], 4, 1e-4);
        }
        for (const Ball& ball : crownOf(tree, above, {0.5F, 1, 1})) {
            sunlit = std::max(sunlit, ball.colour[1] / 50.0);
            turned_away = std::min(turned_away, ball.colour[1] / 50.0);
            EXPECT_NEAR(ball.colour[0], ball.colour[1], 1e-3) << "half the light on twice the colour";
            black += ball.colour[1] == 0 ? 1 : 0;
            ++count;
        }
    }
    // A tone of 0.6 to 1.4, times 1.25; from below 0.55 of the sky's light.
    EXPECT_NEAR(darkest, 0.55 * 1.25 * 0.6, 0.01);
    EXPECT_LE(brightest, 1.751);
    EXPECT_GT(brightest, 1.65);
    EXPECT_LE(sunlit, 1.751);
    EXPECT_GT(sunlit, 1.45);
    EXPECT_EQ(turned_away, 0);
    EXPECT_NEAR(static_cast<double>(black) / count, 0.345, 0.02) << "what looks down: 0.4 deviations below the mean";
}

TEST(NightLights, ALampFadesWithTheSquareOfTheDistanceAndEndsAtItsReach) {
    EXPECT_NEAR(lampLight({0, 0}, 8), 1, 1e-12);
    // As far as high: a half to the power of 1.5.
    const double faded = 1 - 64 / (kLampReach * kLampReach);
    EXPECT_NEAR(lampLight({8, 0}, 8), 0.353553 * faded, 1e-6);
    EXPECT_NEAR(lampLight({0, -8}, 8), 0.353553 * faded, 1e-6);
    EXPECT_EQ(lampLight({kLampReach + 0.01, 0}, 8), 0);
    SceneDescription scene;
    LampPost post;
    post.arm = {0, 1};
    scene.posts.push_back(post);  // its light is 2 m below
    EXPECT_NEAR(cv::norm(lightOf(post) - cv::Point2d(0, 2)), 0, 1e-12);
    EXPECT_NEAR(lampLightAt(scene, {8, 2}), 0.353553 * faded, 1e-6);
    scene.posts.push_back(post);
    scene.night.lamp_strength = 0.5;
    EXPECT_NEAR(lampLightAt(scene, {8, 2}), 0.353553 * faded, 1e-6) << "two of half the strength";
    scene.night.lamp_strength = 3;
    EXPECT_EQ(lampLightAt(scene, {0, 2}), 1) << "no more than the sun";
}

TEST(NightLights, VehiclesHaveHeadlightsTailLightsAndBeams) {
    const ObjectPose pose{{0, 0}, {1, 0}, 0};
    ObjectLook look;
    look.length = 4;
    look.width = 2;
    look.seed = 3;
    const std::vector<Ball> lamps = lampsOf(look, pose);
    ASSERT_EQ(lamps.size(), 4U);
    EXPECT_LT(cv::norm(lamps[0].centre - cv::Point3d(2.1, -0.72, 0.68)), 1e-9);
    EXPECT_LT(cv::norm(lamps[1].centre - cv::Point3d(-2.08, -0.72, 0.85)), 1e-9);
    EXPECT_LT(cv::norm(lamps[2].centre - cv::Point3d(2.1, 0.72, 0.68)), 1e-9);
    EXPECT_LT(cv::norm(lamps[3].centre - cv::Point3d(-2.08, 0.72, 0.85)), 1e-9);
    EXPECT_EQ(lamps[0].radius, 0.2);
    EXPECT_EQ(lamps[1].radius, 0.13);
    EXPECT_EQ(lamps[0].colour, cv::Vec3f(255, 250, 240));
    EXPECT_EQ(lamps[1].colour, cv::Vec3f(40, 40, 255)) << "brakes";
    for (const Ball& lamp : lamps) EXPECT_TRUE(lamp.shines);
    look.seed = 4;
    EXPECT_EQ(lampsOf(look, pose)[1].colour, cv::Vec3f(40, 40, 170));

    const auto beams = beamsOf(look, pose);
    ASSERT_EQ(beams.size(), 7U);
    const double ends[] = {7, 9.5, 12.5, 16, 20, 25, 31};
    for (std::size_t i = 0; i < 7; ++i) {
        EXPECT_NEAR(beams[i].first[2].x, ends[i], 1e-9);
        EXPECT_NEAR(beams[i].second, 1 / 7.0, 1e-12);
    }
    const std::vector<cv::Point2d> first{{2.75, -0.84}, {5.5, -1.49}, {7, -0.894},
                                         {7, 0.894},    {5.5, 1.49},  {2.75, 0.84}};
    for (std::size_t i = 0; i < 6; ++i) EXPECT_LT(cv::norm(beams[0].first[i] - first[i]), 1e-9) << i;
    EXPECT_LT(cv::norm(beams[6].first[1] - cv::Point2d(19.42, -4.61)), 1e-9);

    look.kind = ObjectKind::motorcycle;
    ASSERT_EQ(lampsOf(look, pose).size(), 2U);
    EXPECT_LT(cv::norm(lampsOf(look, pose)[0].centre - cv::Point3d(2.1, 0, 0.68)), 1e-9);
    EXPECT_EQ(lampsOf(look, pose)[0].radius, 0.2);
    EXPECT_EQ(beamsOf(look, pose).size(), 7U);
    look.kind = ObjectKind::bicycle;
    EXPECT_EQ(lampsOf(look, pose)[0].radius, 0.06);
    EXPECT_TRUE(beamsOf(look, pose).empty());
    look.kind = ObjectKind::person;
    EXPECT_TRUE(lampsOf(look, pose).empty());
    EXPECT_TRUE(beamsOf(look, pose).empty());
}

}  // namespace eyrie::standing_things_test

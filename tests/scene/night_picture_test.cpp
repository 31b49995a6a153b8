#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "core/geometry/angle.h"
#include "scene/painting/scene_renderer.h"
#include "scene/small_scene.h"

/// Lamps, headlights, halos, haze and what sticks to the image.
namespace eyrie::night_picture_test {
namespace {

SceneDescription darkScene(int frame_count = 1) {
    SceneDescription scene = plainScene(frame_count);
    scene.base = Surface{Material::plain, 1};
    scene.night.lamps = true;
    scene.night.lamp_tint = {1, 1, 1};
    scene.sun.ambient = 0.1;
    scene.sensor.glare = 0;
    return scene;
}

/// Mean of a square around the ground point, metres from the middle of the picture.
double levelAt(const SceneDescription& scene, cv::Point2d ground, int reach = 1) {
    const SceneRenderer renderer(scene);
    Homography image_from_ground;
    image_from_ground.matrix = renderer.frameFromGround(0);
    const cv::Point at(image_from_ground.apply(ground));
    const cv::Rect square(at.x - reach, at.y - reach, 2 * reach + 1, 2 * reach + 1);
    return cv::mean(renderer.render(0).frame.gray(square))[0];
}

}  // namespace

TEST(NightPicture, aStreetLampLightsTheGroundAroundIt) {
    SceneDescription scene = darkScene();
    EXPECT_NEAR(levelAt(scene, {0, 0}), 12.8, 1.5) << "a tenth of daylight";
    LampPost post;
    post.position = {-2, 0};
    scene.posts.push_back(post);
    EXPECT_NEAR(levelAt(scene, {2, 2}), 118, 12) << "right below it nearly as bright as day";
    const double near = levelAt(scene, {0, 8});
    EXPECT_NEAR(near, 12.8 + 0.9 * 128 * std::pow(0.5, 1.5) * (1 - 64.0 / 1024), 3) << "as high as it is away";
    EXPECT_LT(levelAt(scene, {0, 16}), 0.6 * near);
}

TEST(NightPicture, vehiclesAreLitByTheLampTheyPass) {
    SceneDescription scene = darkScene();
    LampPost post;
    post.position = {-4, 3};
    scene.posts.push_back(post);
    scene.night.beams = 0;
    scene.parked.push_back({busLook(), {{0, 0}, {1, 0}, 0}});
    const double lit = levelAt(scene, {-1, 0.3});
    scene.parked.front().pose.position = {16, -10};
    EXPECT_GT(lit, 2 * levelAt(scene, {15, -9.7}));
}

TEST(NightPicture, headlightsLightTheRoadAhead) {
    SceneDescription scene = darkScene();
    scene.objects.push_back(driving(1, carLook(), {-5, 0}, 0, 0, 1));
    const double ahead = levelAt(scene, {3, 0});
    EXPECT_GT(ahead, 12.8 + 30);
    EXPECT_NEAR(levelAt(scene, {-12, 0}), 12.8, 1.5) << "not behind";
    EXPECT_NEAR(levelAt(scene, {3, 9}), 12.8, 1.5) << "nor beside";
    EXPECT_LT(levelAt(scene, {15, 0}), ahead);
    scene.night.beams = 0;
    EXPECT_NEAR(levelAt(scene, {3, 0}), 12.8, 1.5);
    EXPECT_GT(levelAt(scene, {-2.7, 0.6}, 0) + levelAt(scene, {-2.6, 0.65}, 0), 2 * 60) << "the lamp itself";
}

TEST(NightPicture, glareMakesHalosAroundLamps) {
    SceneDescription scene = darkScene();
    scene.night.beams = 0;
    scene.objects.push_back(driving(1, carLook(), {-5, 0}, 0, 0, 1));
    const double dark = levelAt(scene, {-0.5, 0});
    scene.sensor.glare = 1;
    const double halo = levelAt(scene, {-0.5, 0});
    scene.sensor.glare = 2;
    const double strong = levelAt(scene, {-0.5, 0});
    EXPECT_GT(halo, dark + 4);
    EXPECT_NEAR(strong - dark, 2 * (halo - dark), 0.25 * (strong - dark));
}

TEST(NightPicture, halosHaveTheColourOfTheirLamps) {
    SceneDescription scene = darkScene();
    scene.night.beams = 0;
    scene.objects.push_back(driving(1, carLook(), {-5, 0}, 0, 0, 1));
    const cv::Mat without = SceneRenderer(scene).render(0).frame.colour;
    scene.sensor.glare = 2;
    const SceneRenderer renderer(scene);
    Homography image_from_ground;
    image_from_ground.matrix = renderer.frameFromGround(0);
    const cv::Mat halos = renderer.render(0).frame.colour - without;
    const auto haloAt = [&](cv::Point2d ground) {
        const cv::Point at(image_from_ground.apply(ground));
        return cv::mean(halos(cv::Rect(at.x - 2, at.y - 2, 5, 5)));
    };
    const cv::Scalar ahead = haloAt({-2, 0}), behind = haloAt({-8, 0});
    EXPECT_GT(behind[2], 3) << "red behind";
    EXPECT_LT(behind[0], 0.5 * behind[2]);
    EXPECT_GT(ahead[2], 3);
    EXPECT_NEAR(ahead[0], ahead[2], 0.4 * ahead[2]) << "white ahead";
    EXPECT_NEAR(ahead[1], ahead[2], 0.4 * ahead[2]);
}

TEST(NightPicture, byDayNothingShines) {
    SceneDescription scene = plainScene(1);
    scene.sun.shadow = {0, 0};
    scene.objects.push_back(driving(1, carLook(), {-5, 0}, 0, 0, 1));
    SceneDescription without = plainScene(1);
    EXPECT_NEAR(levelAt(scene, {3, 0}), levelAt(without, {3, 0}), 0.01);
}

TEST(NightPicture, litWindowsAreAsManyAsAsked) {
    const auto bright = [](double windows) {
        SceneDescription scene = darkScene();
        scene.camera.keys.front().tilt = radiansFromDegrees(45);
        scene.night.windows = windows;
        Building building;
        building.length = 38;
        building.width = 12;
        building.height = 25;
        building.centre = {0, -14};
        scene.buildings.push_back(building);
        return cv::countNonZero(SceneRenderer(scene).render(0).frame.gray > 60);
    };
    EXPECT_EQ(bright(0), 0);
    EXPECT_GT(bright(0.2), 20);
    EXPECT_GT(bright(1), 3 * bright(0.2));
}

TEST(NightPicture, equalSeedsGiveEqualPictures) {
    SceneDescription scene = darkScene(4);
    scene.sensor.glare = 1;
    scene.sensor.read_noise = 2;
    scene.sight_m = 400;
    scene.posts.push_back({});
    scene.objects.push_back(driving(1, carLook(), {-5, 0}, 0, 9, 4));
    const cv::Mat a = SceneRenderer(scene).render(2).frame.colour;
    EXPECT_EQ(cv::norm(a, SceneRenderer(scene).render(2).frame.colour, cv::NORM_INF), 0);
}

TEST(HazePicture, contrastFadesWithDistance) {
    SceneDescription scene = plainScene(1);
    scene.camera.keys.front().tilt = radiansFromDegrees(50);
    scene.camera.keys.front().focal_px = 160;
    scene.map_margin = 400;
    scene.haze_colour = {200, 200, 200};
    const cv::Mat clear = SceneRenderer(scene).render(0).frame.gray;
    scene.sight_m = 500;
    const cv::Mat hazy = SceneRenderer(scene).render(0).frame.gray;
    const CameraPose camera = scene.camera.at(0);
    for (const int y : {5, 60, 115}) {
        Homography ground_from_image;
        ground_from_image.matrix = camera.imageFromGround().inv();
        const cv::Point2d ground = ground_from_image.apply({80.0, static_cast<double>(y)});
        const double left = std::exp(-camera.depth({ground.x, ground.y, 0}) / 500);
        EXPECT_NEAR(hazy.at<std::uint8_t>(y, 80), clear.at<std::uint8_t>(y, 80) * left + 200 * (1 - left), 3) << y;
    }
}

TEST(StickingPicture, aFixedPatternStaysWhereItIs) {
    SceneDescription scene = plainScene(2);
    scene.base = Surface{Material::plain, 1};
    scene.camera.keys.push_back(scene.camera.keys.front());
    scene.camera.keys[1].frame = 1;
    scene.camera.keys[1].target = {7, 3};
    scene.sensor.fixed_pattern = 3;
    const SceneRenderer renderer(scene);
    const cv::Mat first = renderer.render(0).frame.gray;
    EXPECT_EQ(cv::norm(first, renderer.render(1).frame.gray, cv::NORM_INF), 0);
    cv::Scalar mean, deviation;
    cv::meanStdDev(first, mean, deviation);
    EXPECT_NEAR(deviation[0], 3, 1.2);
}

TEST(StickingPicture, dirtDarkensTheSamePlacesOfEveryFrame) {
    SceneDescription scene = plainScene(2);
    scene.base = Surface{Material::plain, 1};
    const cv::Mat clean = SceneRenderer(scene).render(0).frame.gray;
    scene.sensor.smudges = 3;
    const SceneRenderer renderer(scene);
    const cv::Mat dirty = renderer.render(0).frame.gray;
    EXPECT_EQ(cv::norm(dirty, renderer.render(1).frame.gray, cv::NORM_INF), 0);
    EXPECT_EQ(cv::countNonZero(dirty > clean), 0);
    const int dark = cv::countNonZero(dirty < clean - 2);
    EXPECT_GT(dark, 20);
    EXPECT_LT(dark, 3000);
}

}  // namespace eyrie::night_picture_test

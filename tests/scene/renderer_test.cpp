#include "scene/painting/scene_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "core/error.h"
#include "core/geometry/angle.h"
#include "scene/scene_source.h"
#include "scene/small_scene.h"

namespace eyrie::renderer_test {
namespace {

bool same(const cv::Mat& a, const cv::Mat& b) {
    return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

/// A scene with a bit of everything: noise, compression, shake, a tree, a building, a post, cars.
SceneDescription mixedScene(std::uint32_t seed) {
    SceneDescription scene = plainScene(30);
    scene.seed = seed;
    scene.base = Surface{Material::grass};
    scene.sun = {{0.6, 0.4}, 0.4};
    scene.sensor = Sensor{};
    scene.sensor.jpeg_quality = 75;
    scene.sensor.samples = 8;
    scene.camera.shake = {2, 0.4, 0.002, seed};
    scene.camera.keys.push_back(scene.camera.keys.front());
    scene.camera.keys[1].frame = 29;
    scene.camera.keys[1].target = {5, 3};
    scene.camera.keys[1].tilt = 0.3;
    scene.patches.push_back({{{-30, -5}, {30, -5}, {30, 5}, {-30, 5}}, Surface{Material::asphalt}});
    Building building;
    building.centre = {-10, -12};
    building.length = 12;
    building.width = 8;
    scene.buildings.push_back(building);
    Tree tree;
    tree.position = {8, 9};
    scene.trees.push_back(tree);
    LampPost post;
    post.position = {0, 6};
    scene.posts.push_back(post);
    scene.parked.push_back({carLook(), {{12, 4}, {1, 0}, 0}});
    scene.objects.push_back(driving(1, carLook(), {-15, 1.5}, 0, 10, 30));
    scene.objects.push_back(driving(2, busLook(), {15, -1.5}, kPi, 8, 30));
    return scene;
}

}  // namespace

TEST(SceneRenderer, equalSeedsGiveEqualPictures) {
    const SceneRenderer a(mixedScene(5));
    const SceneRenderer b(mixedScene(5));
    // Asked for in different orders.
    const Frame a3 = a.render(3).frame;
    const Frame a9 = a.render(9).frame;
    const Frame b9 = b.render(9).frame;
    const Frame b3 = b.render(3).frame;
    EXPECT_TRUE(same(a3.gray, b3.gray));
    EXPECT_TRUE(same(a9.colour, b9.colour));
    EXPECT_FALSE(same(a3.gray, a9.gray));
    EXPECT_FALSE(same(a3.gray, SceneRenderer(mixedScene(6)).render(3).frame.gray));
}

TEST(SceneRenderer, framesCarryIndexTimeAndBothPictures) {
    const SceneRenderer renderer(mixedScene(1));
    const RenderedFrame rendered = renderer.render(7);
    EXPECT_EQ(rendered.frame.index, 7);
    EXPECT_EQ(rendered.frame.time_us, 280000);
    EXPECT_EQ(rendered.frame.gray.type(), CV_8UC1);
    EXPECT_EQ(rendered.frame.colour.type(), CV_8UC3);
    EXPECT_EQ(rendered.frame.gray.size(), cv::Size(160, 120));
    EXPECT_EQ(rendered.truth.size(), renderer.truth(7).size());
    EXPECT_GE(rendered.truth.size(), 2U);
}

TEST(SceneRenderer, homographiesCarryGroundPointsExactly) {
    const SceneRenderer renderer(mixedScene(2));
    Homography first_from_ground;
    first_from_ground.matrix = renderer.frameFromGround(0);
    for (const int index : {0, 1, 13, 29}) {
        Homography from_ground;
        from_ground.matrix = renderer.frameFromGround(index);
        const Homography first_from_frame = renderer.firstFromFrame(index);
        EXPECT_EQ(first_from_frame.from_frame, index);
        EXPECT_EQ(first_from_frame.to_frame, 0);
        EXPECT_DOUBLE_EQ(first_from_frame.matrix(2, 2), 1);
        for (const cv::Point2d ground : {cv::Point2d(0, 0), cv::Point2d(-20, 13), cv::Point2d(17, -15)}) {
            const cv::Point2d direct = first_from_ground.apply(ground);
            const cv::Point2d around = first_from_frame.apply(from_ground.apply(ground));
            EXPECT_NEAR(direct.x, around.x, 1e-6);
            EXPECT_NEAR(direct.y, around.y, 1e-6);
        }
    }
}

TEST(SceneRenderer, texturedGroundMovesAsTheHomographySays) {
    // The camera moves by exactly 4.5 px in x and 3 px in y between the frames. The picture of the second must be the
    // first, moved: compared at whole pixels after averaging two neighbours of the first, so that only the averaging's
    // own blur remains.
    SceneDescription scene = plainScene(2);
    scene.base = Surface{Material::asphalt};
    scene.sensor.contrast = 3;
    scene.sensor.blur_px = 0.8;
    scene.camera.keys.push_back(scene.camera.keys.front());
    scene.camera.keys[1].frame = 1;
    scene.camera.keys[1].target = {4.5 * 0.3, 3 * 0.3};
    const SceneRenderer renderer(scene);
    const cv::Mat a = renderer.render(0).frame.gray;
    const cv::Mat b = renderer.render(1).frame.gray;
    const auto rms = [&](double left_share) {
        double squares = 0;
        int count = 0;
        for (int y = 10; y < 110; ++y) {
            for (int x = 10; x < 140; ++x) {
                const double expected =
                    left_share * a.at<std::uint8_t>(y + 3, x + 4) + (1 - left_share) * a.at<std::uint8_t>(y + 3, x + 5);
                const double difference = expected - b.at<std::uint8_t>(y, x);
                squares += difference * difference;
                ++count;
            }
        }
        return std::sqrt(squares / count);
    };
    // Least at one half: half a pixel, neither more nor less.
    EXPECT_LT(rms(0.5), rms(0.4));
    EXPECT_LT(rms(0.5), rms(0.6));
    EXPECT_LT(rms(0.5), 0.5 * rms(1));
    // The minimum of the parabola through the three lies within 0.03 px of it.
    const double low = rms(0.3) * rms(0.3);
    const double mid = rms(0.5) * rms(0.5);
    const double high = rms(0.7) * rms(0.7);
    EXPECT_NEAR(0.5 + 0.1 * (low - high) / (low - 2 * mid + high), 0.5, 0.03);
}

TEST(SceneRenderer, noiseHasTheGivenSize) {
    SceneDescription scene = plainScene(2);
    scene.sensor.gray = true;
    scene.sensor.read_noise = 3;
    scene.sensor.shot_noise = 0;
    const SceneRenderer renderer(scene);
    cv::Scalar mean, deviation;
    cv::meanStdDev(renderer.render(0).frame.gray, mean, deviation);
    EXPECT_NEAR(deviation[0], 3, 0.15);
    cv::Mat difference;
    cv::subtract(renderer.render(0).frame.gray, renderer.render(1).frame.gray, difference, cv::noArray(), CV_32F);
    cv::meanStdDev(difference, mean, deviation);
    EXPECT_NEAR(deviation[0], 3 * std::sqrt(2.0), 0.2) << "noise of two frames is independent";
}

TEST(SceneRenderer, lostFramesFreezeAndJump) {
    SceneDescription scene = mixedScene(3);
    loseFrames(scene, 0.5);
    ASSERT_EQ(scene.shown.size(), 30U);
    int frozen = -1;
    int jump = -1;
    for (int i = 1; i < 25; ++i) {
        const int step = scene.shown[static_cast<std::size_t>(i)] - scene.shown[static_cast<std::size_t>(i - 1)];
        EXPECT_GE(step, 0);
        if (step == 0) frozen = i;
        if (step > 1) jump = i;
    }
    ASSERT_GT(frozen, 0);
    ASSERT_GT(jump, 0);
    const SceneRenderer renderer(scene);
    const RenderedFrame before = renderer.render(frozen - 1);
    const RenderedFrame at = renderer.render(frozen);
    EXPECT_TRUE(same(before.frame.gray, at.frame.gray)) << "noise included";
    ASSERT_EQ(before.truth.size(), at.truth.size());
    EXPECT_EQ(before.truth.front().box.centre, at.truth.front().box.centre);
    EXPECT_EQ(before.first_from_frame.matrix, at.first_from_frame.matrix);
    EXPECT_EQ(at.frame.index, frozen);
}

TEST(SceneRenderer, refusesWhatCannotBe) {
    const SceneRenderer renderer(plainScene(2));
    EXPECT_THROW(renderer.render(-1), Error);
    EXPECT_THROW(renderer.render(2), Error);
    EXPECT_THROW(SceneRenderer(plainScene(0)), Error);
    SceneDescription no_camera = plainScene();
    no_camera.camera.keys.clear();
    EXPECT_THROW(SceneRenderer{no_camera}, Error);
    SceneDescription other_size = plainScene();
    other_size.camera.image_size = {10, 10};
    EXPECT_THROW(SceneRenderer{other_size}, Error);
    SceneDescription samples = plainScene();
    samples.sensor.samples = 7;
    EXPECT_THROW(SceneRenderer{samples}, Error);
}

TEST(SceneSource, playsASceneLikeAVideo) {
    const auto source = openScene("egtest01");
    EXPECT_EQ(source->info().frame_count, 1821);
    EXPECT_EQ(source->info().size, cv::Size(320, 240));
    EXPECT_EQ(source->timeOf(30), 1000000);
    const Frame gray = source->read(4, false);
    EXPECT_TRUE(gray.colour.empty());
    EXPECT_EQ(gray.gray.size(), cv::Size(320, 240));
    EXPECT_THROW(source->read(1821, false), Error);
    EXPECT_THROW(openScene("nowhere"), Error);
}

}  // namespace eyrie::renderer_test

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "core/geometry/angle.h"
#include "scene/painting/scene_renderer.h"
#include "scene/small_scene.h"

/// Compares painted vehicles with the truth.
namespace eyrie::vehicle_picture_test {
namespace {

/// Share of each pixel that the vehicle hides. Whatever the vehicle's colours, the difference between pictures over
/// bright and dark ground remains only where the ground is seen.
cv::Mat hiddenShare(SceneDescription scene, int frame) {
    const auto difference = [&](const SceneDescription& with_objects) {
        cv::Mat pictures[2];
        for (int i = 0; i < 2; ++i) {
            SceneDescription one = with_objects;
            one.base.tone = i == 0 ? 0.3 : 1.7;
            SceneRenderer(one).render(frame).frame.gray.convertTo(pictures[i], CV_64F);
        }
        return cv::Mat(pictures[1] - pictures[0]);
    };
    SceneDescription empty = scene;
    empty.objects.clear();
    return 1 - difference(scene) / difference(empty);
}

struct Blob {
    double area;
    cv::Point2d centre;
    double heading;  ///< of the longer axis
};

Blob blobOf(const cv::Mat& share) {
    double sum = 0, x_sum = 0, y_sum = 0;
    for (int y = 0; y < share.rows; ++y) {
        for (int x = 0; x < share.cols; ++x) {
            sum += share.at<double>(y, x);
            x_sum += share.at<double>(y, x) * x;
            y_sum += share.at<double>(y, x) * y;
        }
    }
    Blob blob{sum, {x_sum / sum, y_sum / sum}, 0};
    double xx = 0, xy = 0, yy = 0;
    for (int y = 0; y < share.rows; ++y) {
        for (int x = 0; x < share.cols; ++x) {
            const double w = share.at<double>(y, x);
            const cv::Point2d d = cv::Point2d(x, y) - blob.centre;
            xx += w * d.x * d.x;
            xy += w * d.x * d.y;
            yy += w * d.y * d.y;
        }
    }
    blob.heading = std::atan2(2 * xy, xx - yy) / 2;
    return blob;
}

}  // namespace

TEST(VehiclePicture, liesInItsBox) {
    for (const double heading : {0.0, 0.4, 1.3, 2.9}) {
        SceneDescription scene = plainScene(1);
        scene.objects.push_back(driving(1, busLook(), {0.11, -0.07}, heading, 0, 1));
        const OrientedBox box = SceneRenderer(scene).truth(0).front().box;
        const Blob blob = blobOf(hiddenShare(scene, 0));
        EXPECT_NEAR(blob.centre.x, box.centre.x, 0.1) << heading;
        EXPECT_NEAR(blob.centre.y, box.centre.y, 0.1) << heading;
        EXPECT_NEAR(axisTurnBetween(box.heading, blob.heading), 0, radiansFromDegrees(0.7)) << heading;
        // The bus has rounded corners: a little less than its box.
        EXPECT_NEAR(blob.area / box.area(), 0.985, 0.02) << heading;
    }
}

TEST(VehiclePicture, leansInsideItsBoxUnderAnObliqueView) {
    SceneDescription scene = plainScene(1);
    scene.camera.keys.front().tilt = 0.6;
    scene.camera.keys.front().heading = 0.5;
    scene.objects.push_back(driving(1, busLook(), {2, 3}, 0.5, 0, 1));
    const OrientedBox box = SceneRenderer(scene).truth(0).front().box;
    const Blob blob = blobOf(hiddenShare(scene, 0));
    EXPECT_NEAR(blob.centre.x, box.centre.x, 0.4);
    EXPECT_NEAR(blob.centre.y, box.centre.y, 0.4);
    // Below the skirts the dark road under the bus is seen, which belongs to its shadow.
    EXPECT_NEAR(blob.area / box.area(), 0.99, 0.06);
}

TEST(VehiclePicture, movesBySubPixelsAsTheTruthSays) {
    constexpr int frames = 6;
    SceneDescription scene = plainScene(frames);
    // 1.7 m/s at 25 Hz and 0.3 m/px: 0.23 px a frame.
    scene.objects.push_back(driving(1, busLook(), {0, 0}, 0.35, 1.7, frames));
    const SceneRenderer renderer(scene);
    std::vector<cv::Point2d> painted;
    for (int frame = 0; frame < frames; ++frame) painted.push_back(blobOf(hiddenShare(scene, frame)).centre);
    for (int frame = 1; frame < frames; ++frame) {
        const cv::Point2d moved = painted[static_cast<std::size_t>(frame)] - painted[0];
        const cv::Point2d truth = renderer.truth(frame).front().box.centre - renderer.truth(0).front().box.centre;
        EXPECT_NEAR(moved.x, truth.x, 0.04) << frame;
        EXPECT_NEAR(moved.y, truth.y, 0.04) << frame;
        const cv::Point2d velocity = renderer.truth(frame).front().velocity;
        EXPECT_NEAR(std::hypot(velocity.x, velocity.y), 1.7 / 25 / 0.3, 0.003);
    }
}

TEST(VehiclePicture, motionBlurIsCentredOnTheTruth) {
    SceneDescription scene = plainScene(4);
    scene.sensor.exposure = 0.5;
    scene.objects.push_back(driving(1, busLook(), {-0.5, 0}, 0, 25, 4));
    const Blob blob = blobOf(hiddenShare(scene, 1));
    const OrientedBox box = SceneRenderer(scene).truth(1).front().box;
    EXPECT_NEAR(blob.centre.x, box.centre.x, 0.1);
    EXPECT_NEAR(blob.centre.y, box.centre.y, 0.1);
}

TEST(VehiclePicture, castsItsShadowAwayFromTheSun) {
    SceneDescription scene = plainScene(1);
    scene.sun = {{1.5, 0}, 0.4};
    scene.objects.push_back(driving(1, busLook(), {0, 0}, kPi / 2, 0, 1));
    const cv::Mat picture = SceneRenderer(scene).render(0).frame.gray;
    // 3 m of height: 15 px of shadow to the right of the bus, none to its left.
    EXPECT_LT(picture.at<std::uint8_t>(60, 80 + 12), picture.at<std::uint8_t>(60, 80 - 12) * 0.6);
    EXPECT_NEAR(picture.at<std::uint8_t>(60, 80 + 25), picture.at<std::uint8_t>(60, 80 - 25), 2);
}

TEST(VehiclePicture, darkensInTheShadeOfABuilding) {
    SceneDescription scene = plainScene(1);
    scene.sun = {{1, 0}, 0.4};
    Building building;
    building.centre = {-20, 0};
    building.direction = {0, 1};
    building.length = 30;
    building.width = 6;
    building.height = 30;
    scene.buildings.push_back(building);
    ObjectLook look = busLook();
    scene.objects.push_back(driving(1, look, {0, -8}, 0, 0, 1));
    const double shaded = SceneRenderer(scene).render(0).frame.gray.at<std::uint8_t>(33, 80);
    scene.objects.front() = driving(1, look, {0, 14}, 0, 0, 1);
    scene.buildings.front().centre.y = -40;
    const double sunny = SceneRenderer(scene).render(0).frame.gray.at<std::uint8_t>(106, 80);
    EXPECT_LT(shaded, 0.65 * sunny);
}

TEST(VehiclePicture, parkedVehiclesGlintWhileTheCameraMoves) {
    SceneDescription scene = plainScene(150);
    scene.sun = {{0.25, 0.1}, 0.5};
    for (int i = 0; i < 12; ++i) {
        ObjectLook look = carLook();
        look.colour = {60, 60, 60};
        look.seed = static_cast<std::uint32_t>(i);
        scene.parked.push_back({look, {{-18.0 + 3.2 * i, 0}, {0, 1}, 0}});
    }
    scene.camera.keys.push_back(scene.camera.keys.front());
    scene.camera.keys[1].frame = 149;
    scene.camera.keys[1].heading = 0;
    scene.camera.keys[1].tilt = 0.35;
    const SceneRenderer renderer(scene);
    int least = 1 << 30;
    int most = 0;
    for (int frame = 0; frame < 150; frame += 10) {
        int bright = 0;
        const cv::Mat picture = renderer.render(frame).frame.gray;
        for (int y = 0; y < picture.rows; ++y) {
            for (int x = 0; x < picture.cols; ++x) bright += picture.at<std::uint8_t>(y, x) > 150 ? 1 : 0;
        }
        least = std::min(least, bright);
        most = std::max(most, bright);
    }
    EXPECT_GT(most, least + 3);
}

}  // namespace eyrie::vehicle_picture_test

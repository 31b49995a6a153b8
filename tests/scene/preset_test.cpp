#include "scene/towns/scene_preset.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <set>

#include "core/error.h"
#include "core/geometry/angle.h"
#include "core/geometry/homography.h"
#include "core/geometry/oriented_box.h"
#include "scene/scene_truth.h"

/// The facts of Teutsch table 7.1 and §7.2, without painting a pixel.
namespace eyrie::preset_test {
namespace {

double groundSampling(const SceneDescription& scene, int frame) {
    Homography ground_from_image;
    ground_from_image.matrix = scene.camera.at(frame).imageFromGround().inv();
    return ground_from_image.scaleAt({scene.image_size.width / 2.0, scene.image_size.height / 2.0});
}

/// How much of the truth counts (is not marked ignore) on open ground.
struct SceneLoad {
    std::set<int> vehicles;  ///< ids
    std::set<int> others;
    int vehicle_boxes = 0;
    int other_boxes = 0;
    int fewest_objects = std::numeric_limits<int>::max();  ///< in a frame
    int most_objects = 0;
};

SceneLoad loadOf(const SceneDescription& scene) {
    const std::vector<StandingThing> nothing;
    const SceneTruth truth(scene, nothing);
    SceneLoad load;
    for (FrameIndex frame = 0; frame < scene.frame_count; ++frame) {
        int here = 0;
        for (const SceneObject& object : truth.objectsOnOpenGround(frame)) {
            if (object.ignore) continue;
            ++here;
            const bool vehicle = isVehicle(object.kind);
            (vehicle ? load.vehicles : load.others).insert(object.id);
            ++(vehicle ? load.vehicle_boxes : load.other_boxes);
        }
        load.fewest_objects = std::min(load.fewest_objects, here);
        load.most_objects = std::max(load.most_objects, here);
    }
    return load;
}

void expectNoCollisions(const SceneDescription& scene) {
    for (int frame = 0; frame < scene.frame_count; frame += 10) {
        std::vector<OrientedBox> footprints;
        for (const MovingObject& object : scene.objects) {
            ObjectPose pose;
            if (!isVehicle(object.look.kind) || !poseAt(object, frame, pose)) continue;
            footprints.push_back(
                {pose.position, object.look.length, object.look.width, std::atan2(pose.direction.y, pose.direction.x)});
        }
        for (std::size_t i = 0; i < footprints.size(); ++i) {
            for (std::size_t k = 0; k < i; ++k) {
                EXPECT_LT(intersectionArea(footprints[i], footprints[k]), 0.5) << scene.name << " frame " << frame;
            }
        }
    }
}

void expectRealTraffic(const SceneDescription& scene) {
    double fastest = 0;
    for (const MovingObject& object : scene.objects) {
        for (std::size_t i = 1; i < object.poses.size(); ++i) {
            const cv::Point2d step = object.poses[i].position - object.poses[i - 1].position;
            const double speed = std::hypot(step.x, step.y) * scene.frame_rate_hz;
            fastest = std::max(fastest, speed);
            ASSERT_LT(speed, 22) << object.id;
        }
    }
    EXPECT_GT(fastest, 4);
}

}  // namespace

TEST(ScenePreset, namesAreKnownAndOthersRefused) {
    EXPECT_EQ(scenePresetNames(),
              (std::vector<std::string>{"seq1", "seq2", "egtest01", "demo", "stops", "patrol", "road_flight",
                                        "road_flight_haze", "road_flight_dusk", "road_flight_night", "estate", "orbit",
                                        "city_high", "thermal", "low_rate"}));
    try {
        scenePreset("seq3");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::parameter);
        EXPECT_NE(std::string(error.what()).find("seq1, seq2, egtest01, demo"), std::string::npos);
    }
}

TEST(ScenePreset, seq1HoldsWhatTable71Says) {
    const SceneDescription scene = scenePreset("seq1");
    EXPECT_EQ(scene.frame_count, 401);
    EXPECT_EQ(scene.frame_rate_hz, 25);
    EXPECT_EQ(scene.image_size, cv::Size(768, 576));
    for (const int frame : {0, 200, 400}) EXPECT_NEAR(groundSampling(scene, frame), 0.345, 0.012);
    const SceneLoad load = loadOf(scene);
    EXPECT_EQ(load.vehicles.size(), 40U);
    EXPECT_EQ(load.others.size(), 2U);
    EXPECT_NEAR(load.vehicle_boxes, 4731, 250);
    EXPECT_GE(load.fewest_objects, 5);
    EXPECT_LE(load.most_objects, 20);
    expectNoCollisions(scene);
    expectRealTraffic(scene);
    EXPECT_GT(scene.parked.size(), 100U);
}

TEST(ScenePreset, seq2HoldsWhatTable71Says) {
    const SceneDescription scene = scenePreset("seq2");
    EXPECT_EQ(scene.frame_count, 201);
    EXPECT_EQ(scene.frame_rate_hz, 25);
    for (const int frame : {0, 100, 200}) EXPECT_NEAR(groundSampling(scene, frame), 0.284, 0.01);
    const SceneLoad load = loadOf(scene);
    EXPECT_EQ(load.vehicles.size(), 18U);
    EXPECT_EQ(load.others.size(), 21U);
    EXPECT_NEAR(load.vehicle_boxes, 1373, 150);
    // Before trees hide about a third of them: as many again as vehicles.
    EXPECT_GT(load.other_boxes, 1250);
    EXPECT_GT(std::hypot(scene.sun.shadow.x, scene.sun.shadow.y), 1.8) << "long shadows";
    expectNoCollisions(scene);
}

TEST(ScenePreset, egtest01HoldsWhatTable71Says) {
    const SceneDescription scene = scenePreset("egtest01");
    EXPECT_EQ(scene.frame_count, 1821);
    EXPECT_EQ(scene.frame_rate_hz, 30);
    EXPECT_EQ(scene.image_size, cv::Size(320, 240));
    const SceneLoad load = loadOf(scene);
    EXPECT_EQ(load.vehicles.size(), 6U);
    EXPECT_EQ(load.others.size(), 0U);
    EXPECT_NEAR(load.vehicle_boxes, 6866, 700);
    double least = 10, most = 0;
    for (int frame = 0; frame < 1821; frame += 100) {
        least = std::min(least, groundSampling(scene, frame));
        most = std::max(most, groundSampling(scene, frame));
    }
    EXPECT_GT(most / least, 1.15) << "changing height and angle";
    EXPECT_NEAR((least + most) / 2, 0.23, 0.05) << "vehicles of about 10 × 20 px";
    expectNoCollisions(scene);
    expectRealTraffic(scene);
}

TEST(ScenePreset, demoHasMixedTraffic) {
    const SceneDescription scene = scenePreset("demo");
    EXPECT_EQ(scene.frame_count, 250);
    std::set<ObjectKind> kinds;
    for (const MovingObject& object : scene.objects) kinds.insert(object.look.kind);
    EXPECT_GE(kinds.size(), 6U);
    EXPECT_GE(loadOf(scene).fewest_objects, 10);
    expectNoCollisions(scene);
}

TEST(ScenePreset, seedsGiveOtherScenesOfTheSameKind) {
    const SceneDescription a = scenePreset("seq2", 5);
    const SceneDescription b = scenePreset("seq2", 5);
    const SceneDescription c = scenePreset("seq2", 6);
    ASSERT_EQ(a.objects.size(), b.objects.size());
    EXPECT_EQ(a.objects.front().poses.front().position, b.objects.front().poses.front().position);
    EXPECT_EQ(a.trees.size(), b.trees.size());
    EXPECT_NE(a.objects.front().poses.front().position, c.objects.front().poses.front().position);
    const std::size_t vehicles = loadOf(c).vehicles.size();
    EXPECT_LE(vehicles, 18U);
    EXPECT_GE(vehicles, 12U);
}

}  // namespace eyrie::preset_test

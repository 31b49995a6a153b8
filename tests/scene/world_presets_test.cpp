#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "core/geometry/angle.h"
#include "core/geometry/homography.h"
#include "core/geometry/oriented_box.h"
#include "scene/scene_truth.h"
#include "scene/towns/scene_preset.h"

/// What the scenes of the open world promise, without painting a pixel.
namespace eyrie::world_presets_test {
namespace {

/// Built once: growing a town and its traffic takes longer than looking at them.
const SceneDescription& world(const std::string& name) {
    static std::map<std::string, SceneDescription> built;
    const auto at = built.find(name);
    return at != built.end() ? at->second : built.emplace(name, scenePreset(name, 3)).first->second;
}

std::vector<SceneObject> counted(const SceneDescription& scene, FrameIndex frame) {
    const std::vector<StandingThing> nothing;
    std::vector<SceneObject> objects;
    for (const SceneObject& object : SceneTruth(scene, nothing).objectsOnOpenGround(frame)) {
        if (!object.ignore && isVehicle(object.kind)) objects.push_back(object);
    }
    return objects;
}

int collisions(const SceneDescription& scene) {
    int found = 0;
    for (int frame = 0; frame < scene.frame_count; frame += 8) {
        std::vector<OrientedBox> footprints;
        for (const MovingObject& object : scene.objects) {
            ObjectPose pose;
            if (!isVehicle(object.look.kind) || !poseAt(object, frame, pose)) continue;
            footprints.push_back(
                {pose.position, object.look.length, object.look.width, std::atan2(pose.direction.y, pose.direction.x)});
        }
        for (std::size_t i = 0; i < footprints.size(); ++i) {
            for (std::size_t k = 0; k < i; ++k) found += intersectionArea(footprints[i], footprints[k]) > 0.5 ? 1 : 0;
        }
    }
    return found;
}

/// px that the ground point in the middle of one picture has moved in the next.
double shiftPerFrame(const SceneDescription& scene, FrameIndex frame) {
    const cv::Point2d middle((scene.image_size.width - 1) / 2.0, (scene.image_size.height - 1) / 2.0);
    Homography ground_from_image;
    ground_from_image.matrix = scene.camera.at(frame).imageFromGround().inv();
    Homography next_from_ground;
    next_from_ground.matrix = scene.camera.at(frame + 1).imageFromGround();
    const cv::Point2d moved = next_from_ground.apply(ground_from_image.apply(middle)) - middle;
    return std::hypot(moved.x, moved.y);
}

double tallest(const SceneDescription& scene) {
    double height = 0;
    for (const Building& building : scene.buildings) height = std::max(height, building.height);
    return height;
}

}  // namespace

TEST(WorldPreset, flightsPassTallHousesAlongAStreet) {
    for (const char* name : {"road_flight", "road_flight_haze", "road_flight_dusk", "road_flight_night"}) {
        const SceneDescription& scene = world(name);
        for (const int frame : {0, 75, 149}) {
            EXPECT_GT(scene.camera.at(frame).position.z, 58) << name;
            EXPECT_LT(scene.camera.at(frame).position.z, 92) << name;
            EXPECT_GT(shiftPerFrame(scene, std::min(frame, 148)), 0.4) << name;
        }
        EXPECT_GT(tallest(scene), 24) << name;
        EXPECT_LT(tallest(scene), 31) << name;
        EXPECT_GE(counted(scene, 75).size(), 6U) << name;
        EXPECT_GT(scene.posts.size(), 10U) << name;
        EXPECT_EQ(collisions(scene), 0) << name;
    }
}

TEST(WorldPreset, flightsDifferInLightAlone) {
    const SceneDescription& day = world("road_flight");
    const SceneDescription& night = world("road_flight_night");
    ASSERT_EQ(day.objects.size(), night.objects.size());
    EXPECT_EQ(day.objects.front().poses.front().position, night.objects.front().poses.front().position);
    EXPECT_EQ(day.buildings.size(), night.buildings.size());
    EXPECT_FALSE(day.night.lamps);
    EXPECT_TRUE(night.night.lamps);
    EXPECT_LT(night.sun.ambient, 0.3 * day.sun.ambient);
    EXPECT_LT(world("road_flight_haze").sight_m, 0.3 * day.sight_m);
}

TEST(WorldPreset, anEstateIsAllHousesAndHardlyAVehicleDrives) {
    const SceneDescription& scene = world("estate");
    EXPECT_GT(scene.buildings.size(), 100U);
    EXPECT_GT(scene.parked.size(), 40U);
    for (const int frame : {10, 80, 140}) EXPECT_LE(counted(scene, frame).size(), 6U);
    EXPECT_NEAR(shiftPerFrame(scene, 75), 1.3, 0.9) << "px a frame, as slow as such flights are";
}

TEST(WorldPreset, anOrbitTurnsRoundABuildingAndNothingMoves) {
    const SceneDescription& scene = world("orbit");
    EXPECT_TRUE(scene.objects.empty());
    const cv::Point3d from = scene.camera.at(0).position;
    const cv::Point3d to = scene.camera.at(119).position;
    const double turned = std::abs(wrapPi(std::atan2(to.y, to.x) - std::atan2(from.y, from.x)));
    EXPECT_GT(turned, radiansFromDegrees(35));
    EXPECT_GT(tallest(scene), 9);
}

TEST(WorldPreset, aCityFromHighHasTinyVehiclesAndHundredsParked) {
    const SceneDescription& scene = world("city_high");
    EXPECT_EQ(scene.image_size, cv::Size(1920, 1080));
    EXPECT_GT(scene.parked.size(), 400U);
    const std::vector<SceneObject> objects = counted(scene, 40);
    EXPECT_GT(objects.size(), 40U);
    int cars = 0;
    int tiny = 0;
    for (const SceneObject& object : objects) {
        if (object.kind != ObjectKind::car) continue;
        ++cars;
        tiny += object.box.length > 8 && object.box.length < 16 ? 1 : 0;
    }
    EXPECT_GT(tiny, 0.95 * cars);
    EXPECT_EQ(collisions(scene), 0);
}

TEST(WorldPreset, aThermalCameraSeesWarmAndColdVehicles) {
    const SceneDescription& scene = world("thermal");
    EXPECT_TRUE(scene.sensor.gray);
    EXPECT_GT(scene.sensor.fixed_pattern, 0);
    EXPECT_LT(scene.sensor.contrast, 0.5);
    int warm = 0;
    int cold = 0;
    for (const MovingObject& object : scene.objects) {
        if (isVehicle(object.look.kind)) ++(object.look.colour[0] > 120 ? warm : cold);
    }
    EXPECT_GT(warm, 2);
    EXPECT_GT(cold, 2);
}

TEST(WorldPreset, twoPicturesASecondLieATenthOfTheWidthApart) {
    const SceneDescription& scene = world("low_rate");
    EXPECT_EQ(scene.frame_rate_hz, 2);
    for (const int frame : {1, 14, 27}) {
        EXPECT_NEAR(shiftPerFrame(scene, frame) / scene.image_size.width, 0.1, 0.02) << frame;
        EXPECT_GE(counted(scene, frame).size(), 4U) << frame;
    }
    EXPECT_EQ(collisions(scene), 0);
    // A vehicle passes several of its lengths between two pictures.
    double fastest = 0;
    for (const MovingObject& object : scene.objects) {
        for (std::size_t i = 1; i < object.poses.size(); ++i) {
            const cv::Point2d step = object.poses[i].position - object.poses[i - 1].position;
            fastest = std::max(fastest, std::hypot(step.x, step.y));
        }
    }
    EXPECT_GT(fastest, 5);
    EXPECT_LT(fastest, 11) << "m: 80 km/h";
}

/// All objects of the first frame with their boxes, summed: a seed gives the same world on every machine, now and
/// later.
TEST(WorldPreset, aSeedGivesTheSameWorldEverywhere) {
    struct Known {
        const char* name;
        std::size_t objects;
        double x, y, length;  ///< px, of all boxes together
    };
    for (const Known& known : {Known{"road_flight", 32, 18199.41, 3789.63, 627.83},
                               {"road_flight_night", 32, 18199.41, 3789.63, 627.83},
                               {"estate", 5, 1900.13, 622.96, 68.77},
                               {"city_high", 156, 142659.79, 87264.76, 2230.53},
                               {"thermal", 26, 9272.05, 6186.45, 512.72},
                               {"low_rate", 32, 9275.15, 8685.57, 662.33}}) {
        const std::vector<StandingThing> nothing;
        const auto objects = SceneTruth(world(known.name), nothing).objectsOnOpenGround(0);
        EXPECT_EQ(objects.size(), known.objects) << known.name;
        cv::Point2d places(0, 0);
        double lengths = 0;
        for (const SceneObject& object : objects) {
            places += object.box.centre;
            lengths += object.box.length;
        }
        EXPECT_NEAR(places.x, known.x, 0.02) << known.name;
        EXPECT_NEAR(places.y, known.y, 0.02) << known.name;
        EXPECT_NEAR(lengths, known.length, 0.02) << known.name;
    }
}

}  // namespace eyrie::world_presets_test

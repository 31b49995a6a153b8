#include <cmath>

#include "core/geometry/angle.h"
#include "scene/scene_load.h"
#include "scene/towns/presets.h"
#include "scene/traffic/traffic.h"
#include "scene/traffic/vehicle_shape.h"

namespace eyrie {
namespace {

void layRunway(SceneDescription& scene, Random& random) {
    const Path axis({{-400, 0}, {400, 0}});
    const auto patch = [&](std::vector<cv::Point2d> outline, Surface surface) {
        surface.seed = random.bits();
        scene.patches.push_back({std::move(outline), surface});
    };
    // Mown and bare strips beside the runway.
    for (int i = 0; i < 60; ++i) {
        const double x = random.uniform(-350, 350);
        const double y = random.uniform(-260, 260);
        const double length = random.uniform(20, 120);
        const double width = random.uniform(6, 26);
        Surface ground{random.chance(0.6) ? Material::soil : Material::field, random.uniform(0.75, 1.0),
                       random.uniform(0.3, 0.8)};
        patch(rectangleAt({x, y}, {1, 0}, length, width), ground);
    }
    patch(stripAlong(axis, 0, 800, -30, 30), Surface{Material::worn_asphalt, 0.95});
    patch(stripAlong(axis, 0, 800, -23, 23), Surface{Material::concrete, 0.92});
    // A taxiway leaves at an angle.
    const Path taxiway = Path::rounded({{40, 10}, {40, 80}, {160, 240}}, 60);
    patch(stripAlong(taxiway, 0, taxiway.length(), -11, 11), Surface{Material::concrete, 0.85});
    for (int i = 0; i < 70; ++i) {
        // Patched slabs and tar in the joints.
        const double x = std::floor(random.uniform(-40, 40)) * 7.5;
        const double y = (std::floor(random.uniform(-3, 3)) + 0.5) * 7.5;
        patch(rectangleAt({x, y}, {1, 0}, 7.5, 7.5), Surface{Material::concrete, random.uniform(0.75, 1.12), 0.8});
    }
    for (int i = 0; i < 260; ++i) {
        // Rubber of landing aircraft.
        const double x = random.uniform(-200, 200);
        const double y = random.normal() * 4.5;
        const double length = random.uniform(8, 60);
        const double width = random.uniform(0.2, 0.7);
        const double opacity = random.uniform(0.06, 0.3);
        patch(rectangleAt({x, y}, {1, 0}, length, width), Surface{Material::stain, 1, opacity});
    }
    for (int i = 0; i < 160; ++i) {
        const double x = random.uniform(-250, 250);
        const double y = random.uniform(-23, 23);
        const bool along = random.chance(0.5);
        const double length = random.uniform(2, 14);
        patch(rectangleAt({x, y}, along ? cv::Point2d(1, 0) : cv::Point2d(0, 1), length, 0.14),
              Surface{Material::tar, 0.9, 0.7});
    }
    const Surface paint{Material::paint, 0.97};
    for (double x = -300; x < 300; x += 50) patch(rectangleAt({x, 0}, {1, 0}, 30, 0.9), paint);
    for (const double side : {-1.0, 1.0}) {
        patch(stripAlong(axis, 0, 800, side * 22 - 0.45, side * 22 + 0.45), paint);
        for (double y = 3; y < 20; y += 3.4) patch(rectangleAt({-135, side * y}, {1, 0}, 30, 1.8), paint);
    }
    patch(stripAlong(taxiway, 0, taxiway.length(), -0.1, 0.1), Surface{Material::paint, 0.9});
}

/// Up the runway, round, back, round again, as the convoy of the original does.
Path convoyWay() {
    return Path::rounded({{-125, 7}, {62, 7}, {62, -13}, {-60, -13}, {-60, 12}, {190, 12}}, 11);
}

}  // namespace

SceneDescription presetEgTest01(std::uint32_t seed) {
    SceneDescription scene;
    scene.name = "egtest01";
    scene.text =
        "Six vehicles turn on a runway and drive one behind the other, seen obliquely from changing heights (after "
        "EgTest01 of VIVID)";
    scene.seed = seed;
    scene.frame_count = 1821;
    scene.frame_rate_hz = 30;
    scene.gsd_m_per_px = 0.24;
    scene.image_size = {320, 240};
    scene.upright_truth = true;
    scene.sun = {{-0.5, 0.55}, 0.42};
    scene.base = Surface{Material::grass, 1.05};
    scene.base.seed = seed;
    scene.sensor.blur_px = 0.45;
    scene.sensor.exposure = 0.3;
    scene.sensor.read_noise = 1.6;
    scene.sensor.shot_noise = 0.12;
    scene.sensor.contrast = 0.85;
    scene.sensor.level = 125;
    scene.sensor.haze = 0.05;
    scene.sensor.jpeg_quality = 80;

    Random random(seed * 43 + 1);
    layRunway(scene, random);

    const Route route{convoyWay(), {0}, {}};
    std::vector<Driver> drivers;
    const ObjectKind kinds[6] = {ObjectKind::car, ObjectKind::van, ObjectKind::car,
                                 ObjectKind::car, ObjectKind::van, ObjectKind::car};
    double start = 146;
    for (const ObjectKind kind : kinds) {
        Driver driver;
        driver.look = randomLook(kind, random);
        driver.start = start;
        driver.desired_speed = 5.6 * random.uniform(0.98, 1.03);
        driver.headway = 0.9;
        driver.gap = 2.5;
        driver.drift = random.uniform(-0.5, 0.5);
        start -= driver.look.length + random.uniform(12, 19);
        drivers.push_back(driver);
    }
    scene.objects = driveTraffic({route}, drivers, scene.frame_count, scene.frame_rate_hz, 2);

    // The operator follows the convoy by hand: late, not quite to its middle, from changing heights and angles.
    CameraPath& camera = scene.camera;
    camera.image_size = scene.image_size;
    camera.frame_rate_hz = scene.frame_rate_hz;
    camera.shake = {2.0, 0.3, 0.002, seed + 8};
    for (int frame = 0; frame <= 1890; frame += 70) {
        cv::Point2d middle(0, 0);
        for (const MovingObject& object : scene.objects) {
            ObjectPose pose;
            poseAt(object, std::min(frame, scene.frame_count - 1), pose);
            middle += pose.position * (1.0 / 6);
        }
        CameraKey key;
        key.frame = frame;
        key.target.x = middle.x + 21 * random.normal();
        key.target.y = middle.y * 0.8 + 14 * random.normal();
        const double share = frame / 1890.0;
        key.height = 340 - 90 * share + 25 * (valueNoise(frame / 300.0, 3, seed));
        key.heading = radiansFromDegrees(-35 + 95 * share);
        key.tilt = radiansFromDegrees(18 + 30 * share * (2 - share) + 4 * valueNoise(frame / 250.0, 9, seed));
        key.focal_px = 340 / 0.215 * (1 + 0.10 * valueNoise(frame / 200.0, 5, seed));
        camera.keys.push_back(key);
    }
    return scene;
}

}  // namespace eyrie

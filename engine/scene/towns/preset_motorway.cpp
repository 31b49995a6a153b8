#include "core/geometry/angle.h"
#include "scene/portable_math.h"
#include "scene/scene_load.h"
#include "scene/towns/presets.h"
#include "scene/towns/town.h"
#include "scene/traffic/town_traffic.h"

namespace eyrie {
namespace {

/// Obliquely along a motorway that runs to −y, from a place that stands nearly still or keeps up with slow traffic.
void watchMotorway(SceneDescription& scene, Random& random) {
    scene.gsd_m_per_px = random.uniform(0.1, 0.28);
    const double tilt = radiansFromDegrees(random.uniform(18, 52));
    const double height = random.uniform(90, 220);
    const double speed = random.chance(0.5) ? random.uniform(0, 4) : random.uniform(14, 24);
    // A car across the image's centre, whose height counts as much as its length.
    const double focal = 1.05 * height / portable::cosine(tilt) / scene.gsd_m_per_px;
    const double way = speed * scene.frame_count / scene.frame_rate_hz;
    const double aside = random.uniform(-12, 12);
    const double turn = radiansFromDegrees(random.uniform(-60, 60));
    const double last = scene.frame_count;
    CameraPath& camera = scene.camera;
    camera.image_size = scene.image_size;
    camera.frame_rate_hz = scene.frame_rate_hz;
    camera.shake = {1.4, 0.3, 0.0009, scene.seed + 5};
    camera.keys = {{0, {aside, way / 2}, height, turn, tilt, focal},
                   {last / 2, {aside * 0.8, 0}, height + 1.5, turn + 0.02, tilt + 0.008, focal},
                   {last, {aside * 0.6, -way / 2}, height - 1, turn + 0.03, tilt, focal}};
}

void fillMotorway(SceneDescription& scene, const Town& town, int motorway, int beside) {
    TownTraffic traffic(town, scene.seed * 71 + 2);
    for (const bool forward : {true, false}) {
        const int route = traffic.straight(motorway, forward);
        // Lorries and who goes with them drive on the right at 80 to 90 km/h, the fastest at 140.
        for (int lane = 0; lane < 3; ++lane) {
            LaneLoad load;
            load.platoon = {1, 3};
            load.gap = {14, 45};
            load.pause = {40, 150};
            load.speed = {22.0 + 5 * lane, 26.0 + 6 * lane};
            load.motorcycles = 0.02;
            traffic.fill(route, lane, load);
        }
        LaneLoad load;
        load.platoon = {1, 2};
        load.pause = {60, 200};
        load.speed = {12, 17};
        traffic.fill(traffic.straight(beside, forward), 0, load);
    }
    scene.objects = traffic.drive(scene.frame_count, scene.frame_rate_hz, 4);
    dropColliding(scene.objects);
    thinOut(scene, {});
}

}  // namespace

SceneDescription presetMotorway(std::uint32_t seed) {
    SceneDescription scene;
    scene.name = "motorway";
    scene.text = "A motorway with lorries at 22 to 26 m/s and cars at up to 38, a country road beside it";
    scene.seed = seed;
    scene.frame_count = 150;
    scene.frame_rate_hz = 25;
    scene.image_size = {960, 540};
    scene.least_length_px = 8;
    scene.sun = {{-0.45, 0.6}, 0.44};
    scene.sensor.blur_px = 0.5;
    scene.sensor.exposure = 0.15;
    scene.sensor.read_noise = 1.6;
    scene.sensor.samples = 8;
    scene.sensor.jpeg_quality = 80;
    scene.sensor.level = 122;
    scene.sensor.contrast = 0.95;
    scene.sight_m = 1600;

    Random random(seed * 71 + 3);
    watchMotorway(scene, random);
    scene.base = Surface{Material::field, 1.0};
    scene.base.seed = seed;
    Town town(scene, mapArea(scene), seed * 71 + 1);
    const double bend = random.uniform(-30, 30);
    Street motorway;
    motorway.path = Path::rounded({{-bend, 900}, {0, 120}, {0, -120}, {bend * 2, -900}}, 900);
    motorway.lanes = 3;
    motorway.lane_width = 3.75;
    motorway.parking = 0;
    motorway.pavement = 0.5;
    motorway.tree_distance = 0;
    motorway.lamp_distance = 0;
    motorway.building_share = 0;
    const int fast = town.addStreet(motorway);
    const double apart = random.uniform(34, 60) * (random.chance(0.5) ? 1 : -1);
    Street country;
    country.path = motorway.path.shifted(apart);
    country.lanes = 1;
    country.parking = 0;
    country.pavement = 0.5;
    country.tree_distance = 15;
    country.lamp_distance = 0;
    country.building_share = 0.15;
    country.storeys = {1, 2};
    country.detached = true;
    const int beside = town.addStreet(country);
    TownStyle style;
    style.car_parks = 0.03;
    style.yard_buildings = 0.06;
    style.m2_per_try = 420;
    town.setStyle(style);
    town.build();
    fillMotorway(scene, town, fast, beside);
    return scene;
}

}  // namespace eyrie

#include "core/geometry/angle.h"
#include "scene/portable_math.h"
#include "scene/scene_load.h"
#include "scene/towns/presets.h"
#include "scene/towns/town.h"
#include "scene/traffic/town_traffic.h"

namespace eyrie {
namespace {

/// Along the street that runs to −y, over houses of 10 to 30 m.
void flyAlong(SceneDescription& scene, Random& random) {
    const double height = random.uniform(62, 88);
    const double tilt = radiansFromDegrees(random.uniform(55, 59));
    const double focal = 0.78 * scene.image_size.width;
    const double speed = random.uniform(9, 15);
    const double way = speed * scene.frame_count / scene.frame_rate_hz;
    const double aside = random.uniform(-14, 14);
    CameraPath& camera = scene.camera;
    camera.image_size = scene.image_size;
    camera.frame_rate_hz = scene.frame_rate_hz;
    camera.shake = {1.5, 0.3, 0.0012, scene.seed + 5};
    const double turn = radiansFromDegrees(random.uniform(-5, 5));
    const double last = scene.frame_count;
    camera.keys = {{0, {aside, 40}, height, turn, tilt, focal},
                   {last / 2, {aside * 0.7, 40 - way / 2}, height + 1.5, turn * 0.5, tilt + 0.01, focal},
                   {last, {aside * 0.5, 40 - way}, height - 1, -turn * 0.4, tilt, focal}};
    // A car across the image's centre, whose height counts as much as its length.
    scene.gsd_m_per_px = 1.05 * height / portable::cosine(tilt) / focal;
}

void driveAlong(SceneDescription& scene, const Town& town, int street, int cross) {
    TownTraffic traffic(town, scene.seed * 47 + 2);
    const int away = traffic.straight(street, true);
    const int towards = traffic.straight(street, false);
    traffic.redLight(away, street, cross, true, {{1.5, 99}});
    traffic.redLight(towards, street, cross, false, {{-9, 2.0}});
    for (const int route : {away, towards}) {
        for (int lane = 0; lane < 3; ++lane) {
            LaneLoad load;
            load.platoon = {1, 3};
            load.gap = {8, 25};
            load.pause = {35, 110};
            load.speed = {9.0 + 2 * lane, 12.0 + 2 * lane};
            load.eager = 0.2;
            load.motorcycles = 0.05;
            traffic.fill(route, lane, load);
        }
    }
    for (const bool forward : {true, false}) {
        const int side = traffic.straight(cross, forward);
        traffic.redLight(side, cross, street, forward, {{-99, 3.0}});
        LaneLoad load;
        load.platoon = {1, 3};
        load.pause = {40, 100};
        load.speed = {8, 11};
        traffic.fill(side, 0, load);
    }
    traffic.people(street, 1.5, 0.3);
    scene.objects = traffic.drive(scene.frame_count, scene.frame_rate_hz, 4);
    dropColliding(scene.objects);
    thinOut(scene, {});
}

SceneDescription flight(std::uint32_t seed) {
    SceneDescription scene;
    scene.seed = seed;
    scene.frame_count = 150;
    scene.frame_rate_hz = 30;
    scene.image_size = {1024, 540};
    scene.least_length_px = 8;
    scene.sun = {{0.5, 0.35}, 0.42};
    scene.sensor.blur_px = 0.5;
    scene.sensor.exposure = 0.25;
    scene.sensor.samples = 8;
    scene.sensor.jpeg_quality = 82;
    scene.sensor.level = 120;
    scene.sensor.contrast = 0.95;
    return scene;
}

/// What all flights have in common, once light and sensor are chosen.
SceneDescription built(SceneDescription scene) {
    Random random(scene.seed * 47 + 3);
    flyAlong(scene, random);
    scene.base.seed = scene.seed;
    Town town(scene, mapArea(scene), scene.seed * 47 + 1);
    Street main;
    const double bend = random.uniform(-18, 18);
    main.path = Path::rounded({{0, 260}, {0, -60}, {bend, -220}, {bend * 2.5, -620}}, 500);
    main.lanes = 3;
    main.parking = 0;
    main.pavement = 6;
    main.tree_distance = 13;
    main.lamp_distance = 30;
    main.storeys = {3, 9};
    main.building_share = 0.75;
    const int street = town.addStreet(main);
    int cross = 0;
    for (const double at : {-75.0, -330.0}) {
        Street side;
        const double lean = random.uniform(-30, 30);
        side.path = Path::rounded({{-500, at + lean}, {0, at}, {500, at - lean}}, 300);
        side.lanes = 1;
        side.pavement = 3.5;
        side.storeys = {3, 7};
        const int added = town.addStreet(side);
        if (at > -100) cross = added;
    }
    TownStyle style;
    style.car_parks = 0.2;
    style.yard_height = {4, 18};
    town.setStyle(style);
    town.build();
    driveAlong(scene, town, street, cross);
    return scene;
}

/// Coloured signs on the street's fronts.
void hangSigns(SceneDescription& scene) {
    Random random(scene.seed * 47 + 4);
    const std::size_t count = scene.buildings.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (!random.chance(0.12)) continue;
        const Building& building = scene.buildings[i];
        Block sign;
        const double side = random.chance(0.5) ? 1 : -1;
        sign.direction = building.direction;
        sign.centre = building.centre + rightOf(building.direction) * (side * (building.width / 2 + 0.25));
        sign.length = random.uniform(2, 7);
        sign.width = 0.3;
        sign.bottom = random.uniform(3, building.height - 1);
        sign.top = sign.bottom + random.uniform(0.6, 1.6);
        const int hue = random.below(3);
        sign.colour = hue == 0 ? cv::Vec3f(60, 60, 230) : hue == 1 ? cv::Vec3f(230, 180, 60) : cv::Vec3f(90, 220, 110);
        sign.shines = true;
        scene.blocks.push_back(sign);
    }
}

}  // namespace

SceneDescription presetRoadFlight(std::uint32_t seed) {
    SceneDescription scene = flight(seed);
    scene.name = "road_flight";
    scene.text = "Flight along a street between houses of 10 to 30 m by day, 60 to 90 m above it";
    scene.sight_m = 1500;
    return built(std::move(scene));
}

SceneDescription presetRoadFlightHaze(std::uint32_t seed) {
    SceneDescription scene = flight(seed);
    scene.name = "road_flight_haze";
    scene.text = "Flight along a street between houses in haze: little contrast, less with distance";
    scene.sight_m = 210;
    scene.sun = {{0.1, 0.1}, 0.85};
    scene.sensor.contrast = 0.8;
    scene.sensor.level = 128;
    scene.sensor.blur_px = 0.65;
    scene.sensor.read_noise = 2;
    return built(std::move(scene));
}

SceneDescription presetRoadFlightDusk(std::uint32_t seed) {
    SceneDescription scene = flight(seed);
    scene.name = "road_flight_dusk";
    scene.text = "Flight along a street between houses at dusk: no shadows, lamps and headlights, noise, a dirty lens";
    scene.night.lamps = true;
    scene.night.beams = 0.25;
    scene.night.lamp_strength = 0.35;
    scene.night.windows = 0.12;
    scene.sun = {{0, 0}, 0.5};
    scene.sight_m = 900;
    scene.haze_colour = {92, 80, 74};
    scene.sensor.glare = 0.6;
    scene.sensor.level = 112;
    scene.sensor.contrast = 1.05;
    scene.sensor.read_noise = 2.6;
    scene.sensor.exposure = 0.4;
    scene.sensor.smudges = 14;
    scene = built(std::move(scene));
    hangSigns(scene);
    return scene;
}

SceneDescription presetRoadFlightNight(std::uint32_t seed) {
    SceneDescription scene = flight(seed);
    scene.name = "road_flight_night";
    scene.text = "Flight along a street between houses at night: street lamps, headlights with beams, glare, noise";
    scene.night.lamps = true;
    scene.sun = {{0, 0}, 0.1};
    scene.sight_m = 520;
    scene.haze_colour = {34, 24, 20};
    scene.sensor.glare = 1.6;
    scene.sensor.level = 122;
    scene.sensor.contrast = 1.0;
    scene.sensor.read_noise = 2.8;
    scene.sensor.shot_noise = 0.25;
    scene.sensor.exposure = 0.5;
    scene.sensor.blur_px = 0.6;
    scene.sensor.jpeg_quality = 76;
    scene = built(std::move(scene));
    hangSigns(scene);
    return scene;
}

}  // namespace eyrie

#include "core/geometry/angle.h"
#include "scene/scene_load.h"
#include "scene/towns/presets.h"
#include "scene/towns/town.h"
#include "scene/traffic/town_traffic.h"

namespace eyrie {

SceneDescription presetThermal(std::uint32_t seed) {
    SceneDescription scene;
    scene.name = "thermal";
    scene.text =
        "A street as a thermal camera sees it: vehicles warmer or colder than the road, little contrast, a fixed "
        "pattern";
    scene.seed = seed;
    scene.frame_count = 150;
    scene.frame_rate_hz = 25;
    scene.gsd_m_per_px = 0.2;
    scene.image_size = {640, 480};
    scene.sun = {{0, 0}, 0.999};
    scene.base.seed = seed;
    scene.sensor.blur_px = 0.9;
    scene.sensor.exposure = 0.3;
    scene.sensor.read_noise = 2.2;
    scene.sensor.shot_noise = 0;
    scene.sensor.contrast = 0.42;
    scene.sensor.level = 112;
    scene.sensor.haze = 0;
    scene.sensor.vignette = 0.08;
    scene.sensor.fixed_pattern = 1.3;
    scene.sensor.gray = true;
    scene.sensor.samples = 8;

    Random random(seed * 67 + 3);
    const double height = 320;
    const double focal = height / scene.gsd_m_per_px;
    CameraPath& camera = scene.camera;
    camera.image_size = scene.image_size;
    camera.frame_rate_hz = scene.frame_rate_hz;
    camera.shake = {1.8, 0.3, 0.0012, seed + 5};
    const double turn = radiansFromDegrees(random.uniform(-20, 20));
    camera.keys = {{0, {-28, 3}, height, turn, radiansFromDegrees(14), focal},
                   {75, {0, -2}, height + 3, turn + 0.06, radiansFromDegrees(18), focal},
                   {150, {30, 2}, height - 3, turn + 0.1, radiansFromDegrees(15), focal}};
    Town town(scene, mapArea(scene), seed * 67 + 1);
    Street main;
    main.path = Path::rounded({{-420, 22}, {0, 0}, {420, -20}}, 250);
    main.lanes = 2;
    main.tree_distance = 13;
    main.storeys = {2, 4};
    const int street = town.addStreet(main);
    Street side;
    side.path = Path::rounded({{-26, -380}, {12, 0}, {30, 380}}, 200);
    side.lanes = 1;
    side.pavement = 3.5;
    side.storeys = {2, 4};
    const int cross = town.addStreet(side);
    town.build();

    TownTraffic traffic(town, seed * 67 + 2);
    for (const bool forward : {true, false}) {
        const int route = traffic.straight(street, forward);
        traffic.redLight(route, street, cross, forward, {{3.5, 99}});
        for (int lane = 0; lane < 2; ++lane) {
            LaneLoad load;
            load.platoon = {1, 4};
            load.gap = {5, 14};
            load.pause = {25, 80};
            load.speed = {8, 14};
            traffic.fill(route, lane, load);
        }
        const int crossing = traffic.straight(cross, forward);
        traffic.redLight(crossing, cross, street, forward, {{-99, 4.2}});
        LaneLoad load;
        load.pause = {30, 90};
        traffic.fill(crossing, 0, load);
    }
    traffic.people(street, 2, 0.2);
    scene.objects = traffic.drive(scene.frame_count, scene.frame_rate_hz, 4);
    // Driven cars are warm above their engines, parked ones as cold as the sky that they face; some were washed.
    for (MovingObject& object : scene.objects) {
        const float warm = random.chance(0.7) ? static_cast<float>(random.uniform(165, 225))
                                              : static_cast<float>(random.uniform(36, 66));
        object.look.colour = {warm, warm, warm};
    }
    for (ParkedVehicle& parked : scene.parked) {
        const float warm = random.chance(0.2) ? static_cast<float>(random.uniform(120, 190))
                                              : static_cast<float>(random.uniform(48, 92));
        parked.look.colour = {warm, warm, warm};
    }
    dropColliding(scene.objects);
    thinOut(scene, {});
    return scene;
}

}  // namespace eyrie

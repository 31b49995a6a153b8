#include "core/geometry/angle.h"
#include "scene/scene_load.h"
#include "scene/towns/presets.h"
#include "scene/towns/town.h"
#include "scene/traffic/town_traffic.h"

namespace eyrie {

SceneDescription presetStops(std::uint32_t seed) {
    SceneDescription scene;
    scene.name = "stops";
    scene.text = "A crossing with lights from a hovering camera: vehicles stand for 2 to 35 seconds and drive on";
    scene.seed = seed;
    scene.frame_count = 1300;
    scene.frame_rate_hz = 25;
    scene.gsd_m_per_px = 0.2;
    scene.image_size = {400, 300};
    scene.sun = {{0.4, 0.3}, 0.44};
    scene.sensor.blur_px = 0.4;
    scene.sensor.exposure = 0.2;
    scene.sensor.read_noise = 1.5;
    scene.sensor.shot_noise = 0.13;
    scene.sensor.haze = 0.05;
    scene.sensor.jpeg_quality = 80;
    scene.sensor.samples = 4;

    const double height = 300;
    const double focal = height / scene.gsd_m_per_px;
    CameraPath& camera = scene.camera;
    camera.image_size = scene.image_size;
    camera.frame_rate_hz = scene.frame_rate_hz;
    camera.shake = {1.2, 0.25, 0.001, seed + 8};
    camera.keys = {{0, {-6, 3}, height, radiansFromDegrees(-8), radiansFromDegrees(9), focal},
                   {450, {4, -2}, height - 5, radiansFromDegrees(3), radiansFromDegrees(6), focal * 1.02},
                   {900, {-3, -4}, height + 5, radiansFromDegrees(12), radiansFromDegrees(8), focal},
                   {1300, {3, 3}, height, radiansFromDegrees(5), radiansFromDegrees(10), focal}};
    scene.base.seed = seed;
    Town town(scene, mapArea(scene), seed * 43 + 1);
    Street main;
    main.path = Path::rounded({{-420, 20}, {0, 0}, {420, -25}}, 300);
    main.lanes = 2;
    main.tree_distance = 16;
    main.storeys = {1, 3};
    const int street = town.addStreet(main);
    Street side;
    side.path = Path::rounded({{-20, -400}, {0, 0}, {16, 400}}, 300);
    side.lanes = 1;
    side.pavement = 3.5;
    side.storeys = {1, 3};
    const int cross = town.addStreet(side);
    town.build();

    // Reds of many lengths; those who come late to one stand for a part of it. Only one street has green at a time.
    TownTraffic traffic(town, seed * 43 + 2);
    const int east = traffic.straight(street, true);
    const int west = traffic.straight(street, false);
    const int south = traffic.straight(cross, true);
    const int north = traffic.straight(cross, false);
    traffic.redLight(east, street, cross, true, {{3, 9}, {16, 19}, {26, 34}, {40, 45}});
    traffic.redLight(west, street, cross, false, {{3, 9}, {18, 30}, {39, 45}});
    traffic.redLight(south, cross, street, true, {{-9, 5.5}, {7.5, 41.5}, {43.5, 99}});
    traffic.redLight(north, cross, street, false, {{-9, 5.5}, {7.5, 41.5}, {43.5, 99}});
    for (const int route : {east, west, south, north}) {
        const int lanes = route == east || route == west ? 2 : 1;
        for (int lane = 0; lane < lanes; ++lane) {
            LaneLoad load;
            load.platoon = {1, 3};
            load.gap = {6, 20};
            load.pause = {35, 110};
            load.speed = {7, 12};
            load.eager = 0.1;
            load.motorcycles = 0.05;
            traffic.fill(route, lane, load);
        }
    }
    traffic.people(street, 1, 0.2);
    scene.objects = traffic.drive(scene.frame_count, scene.frame_rate_hz, 4);
    thinOut(scene, {});
    return scene;
}

}  // namespace eyrie

#include "core/geometry/angle.h"
#include "scene/portable_math.h"
#include "scene/scene_load.h"
#include "scene/towns/presets.h"
#include "scene/towns/town.h"
#include "scene/traffic/town_traffic.h"

namespace eyrie {

SceneDescription presetPatrol(std::uint32_t seed) {
    SceneDescription scene;
    scene.name = "patrol";
    scene.text =
        "Ten minutes over a quiet crossing: now and then somebody waits there, and one vehicle drives against the flow";
    scene.seed = seed;
    scene.frame_count = 6000;
    scene.frame_rate_hz = 10;
    scene.gsd_m_per_px = 0.2;
    scene.image_size = {640, 480};
    scene.sun = {{-0.4, 0.35}, 0.44};
    scene.sensor.blur_px = 0.4;
    scene.sensor.exposure = 0.1;
    scene.sensor.read_noise = 1.5;
    scene.sensor.shot_noise = 0.13;
    scene.sensor.jpeg_quality = 85;
    scene.sensor.samples = 4;

    const double height = 300;
    const double focal = height / scene.gsd_m_per_px;
    CameraPath& camera = scene.camera;
    camera.image_size = scene.image_size;
    camera.frame_rate_hz = scene.frame_rate_hz;
    camera.shake = {1.0, 0.2, 0.001, seed + 8};
    // Slowly round above the crossing, twice.
    for (int turn = 0; turn <= 24; ++turn) {
        const double angle = radiansFromDegrees(30.0 * turn);
        camera.keys.push_back({250.0 * turn,
                               {12 * portable::cosine(angle), 9 * portable::sine(angle)},
                               height + 4 * portable::sine(2 * angle),
                               radiansFromDegrees(10 * portable::sine(angle)),
                               radiansFromDegrees(7),
                               focal});
    }
    scene.base.seed = seed;
    Town town(scene, mapArea(scene), seed * 53 + 1);
    Street main;
    main.path = Path::rounded({{-190, 14}, {0, 0}, {190, -12}}, 200);
    main.lanes = 2;
    main.tree_distance = 18;
    main.storeys = {1, 3};
    const int street = town.addStreet(main);
    Street side;
    side.path = Path::rounded({{-12, -190}, {0, 0}, {10, 190}}, 200);
    side.lanes = 1;
    side.pavement = 3.5;
    side.storeys = {1, 3};
    const int cross = town.addStreet(side);
    town.build();

    TownTraffic traffic(town, seed * 53 + 2);
    const double duration = scene.frame_count / scene.frame_rate_hz;
    const int east = traffic.straight(street, true);
    const int west = traffic.straight(street, false);
    const int south = traffic.straight(cross, true);
    const int north = traffic.straight(cross, false);
    // The main street waits seldom; the side street has green only then.
    const std::vector<std::pair<double, double>> reds{{58, 84}, {196, 218}, {371, 399}, {502, 521}};
    std::vector<std::pair<double, double>> side_reds;
    double from = -99;
    for (const auto& red : reds) {
        side_reds.emplace_back(from, red.first + 4);
        from = red.second - 5;
    }
    side_reds.emplace_back(from, duration + 99);
    traffic.redLight(east, street, cross, true, reds);
    traffic.redLight(west, street, cross, false, reds);
    traffic.redLight(south, cross, street, true, side_reds);
    traffic.redLight(north, cross, street, false, side_reds);
    // Eastbound on the inner lane somebody comes the wrong way; it is kept free for him.
    const double wrong = 290;
    for (int lane = 0; lane < 2; ++lane) {
        const bool his = lane == 1;
        traffic.stream(east, lane, {8, 12}, {9, 26}, duration,
                       his ? std::vector<std::pair<double, double>>{{wrong - 40, wrong + 40}}
                           : std::vector<std::pair<double, double>>{});
        traffic.stream(west, lane, {8, 12}, {9, 26}, duration);
    }
    traffic.stream(south, 0, {7, 10}, {70, 130}, duration);
    traffic.stream(north, 0, {7, 10}, {80, 150}, duration);
    traffic.send(traffic.against(street, true, 1), 0, 8, ObjectKind::car, 9, wrong);
    scene.objects = traffic.drive(scene.frame_count, scene.frame_rate_hz, 4);
    thinOut(scene, {});
    return scene;
}

}  // namespace eyrie

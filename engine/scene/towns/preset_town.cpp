#include "core/geometry/angle.h"
#include "scene/scene_load.h"
#include "scene/towns/presets.h"
#include "scene/towns/town.h"
#include "scene/traffic/town_traffic.h"

namespace eyrie {
namespace {

double degrees(double value) {
    return radiansFromDegrees(value);
}

}  // namespace

SceneDescription presetSeq1(std::uint32_t seed) {
    SceneDescription scene;
    scene.name = "seq1";
    scene.text =
        "Busy urban street from 420 m, dense traffic bumper to bumper and overtaking (after SEQ 1 of Teutsch table "
        "7.1)";
    scene.seed = seed;
    scene.frame_count = 401;
    scene.frame_rate_hz = 25;
    scene.gsd_m_per_px = 0.345;
    scene.image_size = {768, 576};
    scene.sun = {{0.62, 0.5}, 0.46};
    scene.sensor = {};
    scene.sensor.blur_px = 0.5;
    scene.sensor.exposure = 0.22;
    scene.sensor.read_noise = 1.8;
    scene.sensor.shot_noise = 0.16;
    scene.sensor.contrast = 1.05;
    scene.sensor.level = 140;
    scene.sensor.haze = 0.08;
    scene.sensor.jpeg_quality = 72;
    scene.sensor.gray = true;

    const double height = 420;
    const double focal = height / 0.345;
    CameraPath& camera = scene.camera;
    camera.image_size = scene.image_size;
    camera.frame_rate_hz = scene.frame_rate_hz;
    camera.shake = {1.6, 0.35, 0.0012, seed + 5};
    camera.keys = {{0, {-105, -6}, height, degrees(14), degrees(7), focal},
                   {110, {-32, 4}, height - 3, degrees(9), degrees(8), focal},
                   {250, {62, 8}, height + 4, degrees(-6), degrees(6), focal * 1.01},
                   {401, {158, 2}, height + 2, degrees(-17), degrees(8), focal}};

    const cv::Rect2d area = mapArea(scene);
    scene.base.seed = seed;
    Town town(scene, area, seed * 31 + 1);
    Street main;
    main.path = Path::rounded({{-620, 26}, {-120, -4}, {90, 6}, {260, -22}, {760, -30}}, 260);
    main.lanes = 2;
    const int street = town.addStreet(main);
    std::vector<int> sides;
    const double at[3] = {-150, 40, 205};
    for (int i = 0; i < 3; ++i) {
        Street side;
        const double lean = i == 1 ? 30 : -22;
        side.path = Path::rounded({{at[i] - lean, -420}, {at[i], 0}, {at[i] + lean * 0.4, 420}}, 120);
        side.lanes = 1;
        side.tree_distance = i == 1 ? 0 : 14;
        side.pavement = 3;
        side.occupancy = 0.8;
        side.material = i == 2 ? Material::worn_asphalt : Material::asphalt;
        sides.push_back(town.addStreet(side));
    }
    town.build();

    TownTraffic traffic(town, seed * 31 + 2);
    const int east = traffic.straight(street, true);
    const int west = traffic.straight(street, false);
    // The middle crossing holds the main street up for a while; the queue starts, and the side street stops.
    traffic.redLight(east, street, sides[1], true, {{-9, 2.6}});
    traffic.redLight(west, street, sides[1], false, {{-9, 3.0}});
    for (const int route : {east, west}) {
        for (int lane = 0; lane < 2; ++lane) {
            LaneLoad load;
            load.platoon = {3, 6};
            load.gap = {3.5, 8};
            load.pause = lane == 0 ? std::pair<double, double>{25, 75} : std::pair<double, double>{35, 110};
            load.speed = lane == 0 ? std::pair<double, double>{8.5, 11.5} : std::pair<double, double>{11.5, 15};
            load.eager = lane == 0 ? 0.3 : 0.1;
            load.motorcycles = 0.07;
            traffic.fill(route, lane, load);
        }
    }
    for (std::size_t i = 0; i < sides.size(); ++i) {
        LaneLoad load;
        load.platoon = {1, 2};
        load.pause = {90, 240};
        load.speed = {8, 11};
        const int out = traffic.straight(sides[i], true);
        const int back = traffic.straight(sides[i], false);
        const std::pair<double, double> red =
            i == 1 ? std::pair<double, double>{4, 99} : std::pair<double, double>{-99, 99};
        traffic.redLight(out, sides[i], street, true, {red});
        traffic.redLight(back, sides[i], street, false, {red});
        traffic.fill(out, 0, load);
        traffic.fill(back, 0, load);
        const int right_in = traffic.turn(sides[i], i % 2 == 0, street, i % 2 != 0);
        const double line = traffic.lengthOf(right_in) / 3;
        traffic.send(right_in, 0, line, ObjectKind::car, 9);
        const int right_out = traffic.turn(street, true, sides[i], true);
        const double centre =
            traffic.nearestOn(right_out, town.streets()[static_cast<std::size_t>(sides[i])].path.position(420));
        traffic.send(right_out, 0, centre - 95, ObjectKind::car, 10);
        traffic.send(right_out, 0, centre - 150, ObjectKind::van, 10);
    }
    traffic.people(street, 0.7, 0.5);
    scene.objects = traffic.drive(scene.frame_count, scene.frame_rate_hz, 5);
    thinOut(scene, {40, 4731, 2, 54, 20});
    return scene;
}

SceneDescription presetSeq2(std::uint32_t seed) {
    SceneDescription scene;
    scene.name = "seq2";
    scene.text =
        "Urban street in low sun: long shadows, trees beside and over the street, persons and two-wheelers (after SEQ "
        "2 of Teutsch table 7.1)";
    scene.seed = seed;
    scene.frame_count = 201;
    scene.frame_rate_hz = 25;
    scene.gsd_m_per_px = 0.284;
    scene.image_size = {640, 480};
    scene.sun = {{1.5, 1.35}, 0.42};
    scene.sensor.blur_px = 0.45;
    scene.sensor.exposure = 0.25;
    scene.sensor.read_noise = 1.7;
    scene.sensor.shot_noise = 0.15;
    scene.sensor.contrast = 1.0;
    scene.sensor.level = 132;
    scene.sensor.haze = 0.06;
    scene.sensor.jpeg_quality = 74;
    scene.sensor.gray = true;

    const double height = 360;
    const double focal = height / 0.284;
    CameraPath& camera = scene.camera;
    camera.image_size = scene.image_size;
    camera.frame_rate_hz = scene.frame_rate_hz;
    camera.shake = {2.2, 0.5, 0.0016, seed + 6};
    camera.keys = {{0, {-44, -8}, height, degrees(-24), degrees(5), focal},
                   {90, {-6, 4}, height, degrees(-14), degrees(9), focal * 1.015},
                   {201, {46, 4}, height + 5, degrees(4), degrees(7), focal}};
    const cv::Rect2d area = mapArea(scene);
    scene.base.seed = seed;
    Town town(scene, area, seed * 37 + 1);
    Street main;
    main.path = Path::rounded({{-520, 60}, {-40, 2}, {120, -6}, {560, 40}}, 220);
    main.lanes = 2;
    main.pavement = 5;
    main.tree_distance = 8.5;
    main.tree_overhang = 2.2;
    main.occupancy = 0.8;
    main.building_share = 0.6;
    main.storeys = {1, 3};
    const int street = town.addStreet(main);
    Street side;
    side.path = Path::rounded({{-12, -380}, {22, -20}, {34, 380}}, 150);
    side.lanes = 1;
    side.pavement = 3.5;
    side.storeys = {2, 4};
    const int cross = town.addStreet(side);
    town.build();

    TownTraffic traffic(town, seed * 37 + 2);
    const int east = traffic.straight(street, true);
    const int west = traffic.straight(street, false);
    traffic.redLight(east, street, cross, true, {{3.5, 99}});
    traffic.redLight(west, street, cross, false, {{-9, 1.0}});
    for (const int route : {east, west}) {
        for (int lane = 0; lane < 2; ++lane) {
            LaneLoad load;
            load.platoon = {1, 4};
            load.gap = {3.5, 12};
            load.pause = {20, 70};
            load.speed = lane == 0 ? std::pair<double, double>{8, 11} : std::pair<double, double>{10, 14};
            load.eager = 0.25;
            load.motorcycles = 0.22;
            traffic.fill(route, lane, load);
        }
    }
    const int into_street = traffic.turn(cross, true, street, false);
    const int out_of_street = traffic.turn(street, false, cross, false);
    for (const double back : {30.0, 75.0}) {
        traffic.send(into_street, 0, traffic.nearestOn(into_street, {22, -20}) - back, ObjectKind::car, 9);
        traffic.send(out_of_street, 0, traffic.nearestOn(out_of_street, {30, 0}) - back - 15, ObjectKind::car, 10);
    }
    traffic.people(street, 5, 0.35);
    traffic.people(cross, 2.5, 0.3);
    traffic.zebraWalkers(street, cross, 8);
    scene.objects = traffic.drive(scene.frame_count, scene.frame_rate_hz, 4);
    // Trees hide about a third of the people, which the count does not know.
    thinOut(scene, {18, 1400, 21, 1750, 20});
    return scene;
}

SceneDescription presetDemo(std::uint32_t seed) {
    SceneDescription scene;
    scene.name = "demo";
    scene.text = "A crossing with mixed traffic, seen obliquely from a slowly circling camera";
    scene.seed = seed;
    scene.frame_count = 250;
    scene.frame_rate_hz = 25;
    scene.gsd_m_per_px = 0.17;
    scene.image_size = {640, 480};
    scene.sun = {{0.72, 0.42}, 0.4};
    scene.sensor.blur_px = 0.35;
    scene.sensor.exposure = 0.18;
    scene.sensor.read_noise = 1.3;
    scene.sensor.shot_noise = 0.11;
    scene.sensor.contrast = 0.98;
    scene.sensor.level = 122;
    scene.sensor.haze = 0.03;
    scene.sensor.jpeg_quality = 86;
    scene.sensor.samples = 8;

    const double height = 190;
    const double focal = height / 0.17;
    CameraPath& camera = scene.camera;
    camera.image_size = scene.image_size;
    camera.frame_rate_hz = scene.frame_rate_hz;
    camera.shake = {1.3, 0.25, 0.001, seed + 7};
    camera.keys = {{0, {-12, 4}, height, degrees(-22), degrees(24), focal},
                   {120, {2, 0}, height - 4, degrees(-10), degrees(27), focal * 1.04},
                   {250, {13, -5}, height + 4, degrees(7), degrees(24), focal}};
    const cv::Rect2d area = mapArea(scene);
    scene.base.seed = seed;
    Town town(scene, area, seed * 41 + 1);
    Street main;
    main.path = Path::rounded({{-420, 30}, {-30, 0}, {60, 2}, {430, -40}}, 200);
    main.lanes = 2;
    main.tree_distance = 12;
    main.storeys = {2, 5};
    const int street = town.addStreet(main);
    Street side;
    side.path = Path::rounded({{-30, -340}, {0, -10}, {22, 340}}, 140);
    side.lanes = 2;
    side.parking = 0;
    side.pavement = 3.5;
    side.storeys = {2, 4};
    const int cross = town.addStreet(side);
    town.build();

    TownTraffic traffic(town, seed * 41 + 2);
    const int east = traffic.straight(street, true);
    const int west = traffic.straight(street, false);
    traffic.redLight(east, street, cross, true, {{6.0, 99}});
    traffic.redLight(west, street, cross, false, {{6.5, 99}});
    for (const int route : {east, west}) {
        for (int lane = 0; lane < 2; ++lane) {
            LaneLoad load;
            load.platoon = {2, 4};
            load.gap = {4, 11};
            load.pause = {14, 45};
            load.speed = lane == 0 ? std::pair<double, double>{8, 10.5} : std::pair<double, double>{10, 13};
            load.motorcycles = 0.1;
            load.eager = 0.25;
            traffic.fill(route, lane, load);
        }
    }
    const int north = traffic.straight(cross, false);
    const int south = traffic.straight(cross, true);
    traffic.redLight(north, cross, street, false, {{-99, 8.0}});
    traffic.redLight(south, cross, street, true, {{-99, 8.4}});
    for (const int route : {north, south}) {
        LaneLoad load;
        load.platoon = {2, 3};
        load.gap = {3, 6};
        load.pause = {25, 60};
        load.speed = {8, 11};
        for (int lane = 0; lane < 2; ++lane) traffic.fill(route, lane, load);
    }
    const int right_turn = traffic.turn(street, true, cross, true);
    const int other_right_turn = traffic.turn(street, false, cross, false);
    const int into_street = traffic.turn(cross, true, street, false);
    traffic.redLight(into_street, cross, street, true, {{-99, 8.4}});
    for (const double back : {34.0, 43.0, 95.0}) {
        traffic.send(right_turn, 0, traffic.nearestOn(right_turn, {0, 0}) - back, ObjectKind::car, 9.5);
        traffic.send(other_right_turn, 0, traffic.nearestOn(other_right_turn, {0, 0}) - back - 21, ObjectKind::car, 9);
    }
    traffic.send(into_street, 0, traffic.nearestOn(into_street, {0, 0}) - 60, ObjectKind::car, 9);
    traffic.people(street, 3, 0.3);
    traffic.zebraWalkers(cross, street, 5);
    scene.objects = traffic.drive(scene.frame_count, scene.frame_rate_hz, 4);
    thinOut(scene, {});
    return scene;
}

}  // namespace eyrie

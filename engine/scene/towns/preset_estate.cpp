#include "core/geometry/angle.h"
#include "scene/portable_math.h"
#include "scene/scene_load.h"
#include "scene/towns/presets.h"
#include "scene/towns/town.h"
#include "scene/traffic/town_traffic.h"

namespace eyrie {
namespace {

/// Low walls and hedges between the gardens, and a car before every other house.
void fillGardens(SceneDescription& scene, Random& random) {
    const std::size_t houses = scene.buildings.size();
    for (std::size_t i = 0; i < houses; ++i) {
        const Building house = scene.buildings[i];
        const cv::Point2d right = rightOf(house.direction);
        for (const double side : {-1.0, 1.0}) {
            if (!random.chance(0.55)) continue;
            Block fence;
            fence.direction = right;
            fence.centre = house.centre + house.direction * (side * (house.length / 2 + 0.9));
            fence.length = house.width + random.uniform(2, 12);
            fence.width = random.chance(0.5) ? 0.15 : 0.8;
            fence.top = random.uniform(1.1, 2);
            fence.colour = fence.width > 0.5 ? cv::Vec3f(38, 70, 50) : cv::Vec3f(96, 116, 132);
            scene.blocks.push_back(fence);
        }
        // Chimney and dormer.
        Block chimney;
        chimney.direction = house.direction;
        chimney.centre = house.centre + house.direction * random.uniform(-0.35, 0.35) * house.length;
        chimney.length = 0.7;
        chimney.width = 0.7;
        chimney.bottom = house.height;
        chimney.top = house.height + house.width * 0.3 + 0.9;
        chimney.colour = {92, 98, 128};
        scene.blocks.push_back(chimney);
    }
}

}  // namespace

SceneDescription presetEstate(std::uint32_t seed) {
    SceneDescription scene;
    scene.name = "estate";
    scene.text = "Slow flight over a housing estate: relief everywhere, hardly a vehicle drives";
    scene.seed = seed;
    scene.frame_count = 150;
    scene.frame_rate_hz = 24;
    scene.image_size = {800, 450};
    scene.least_length_px = 8;
    scene.sun = {{-0.9, 0.55}, 0.44};
    scene.sight_m = 1800;
    scene.sensor.blur_px = 0.4;
    scene.sensor.exposure = 0.2;
    scene.sensor.samples = 8;
    scene.sensor.jpeg_quality = 84;
    scene.sensor.contrast = 1.0;
    scene.sensor.level = 122;

    Random random(seed * 53 + 3);
    const double height = random.uniform(55, 80);
    const double tilt = radiansFromDegrees(random.uniform(58, 62));
    const double focal = 0.8 * scene.image_size.width;
    const double turn = radiansFromDegrees(random.uniform(-16, 16));
    // Sideways along the rows, as camera operators like to.
    const double way = random.uniform(26, 40) * (random.chance(0.5) ? 1 : -1);
    CameraPath& camera = scene.camera;
    camera.image_size = scene.image_size;
    camera.frame_rate_hz = scene.frame_rate_hz;
    camera.shake = {0.8, 0.15, 0.0008, seed + 5};
    const double last = scene.frame_count;
    camera.keys = {{0, {-way / 2, 0}, height, turn, tilt, focal},
                   {last / 2, {0, -3}, height + 1, turn + 0.01, tilt, focal},
                   {last, {way / 2, -5}, height + 2, turn + 0.03, tilt, focal}};
    scene.gsd_m_per_px = 1.05 * height / portable::cosine(tilt) / focal;

    scene.base.seed = seed;
    Town town(scene, mapArea(scene), seed * 53 + 1);
    Street row;
    row.lanes = 1;
    row.lane_width = 3;
    row.parking = 2;
    row.occupancy = 0.3;
    row.pavement = 2.2;
    row.tree_distance = 24;
    row.lamp_distance = 45;
    row.building_share = 0.97;
    row.storeys = {1, 2};
    row.frontage = {9, 13};
    row.depth = {9, 12};
    row.detached = true;
    row.marked = false;
    std::vector<int> rows;
    for (int i = 0; i < 8; ++i) {
        const double y = 40 - 52.0 * i + random.uniform(-4, 4);
        const double bow = random.uniform(-12, 12);
        row.path = Path::rounded({{-620, y + bow}, {0, y}, {620, y - bow}}, 400);
        rows.push_back(town.addStreet(row));
    }
    Street through = row;
    through.marked = true;
    const double lean = random.uniform(-25, 25);
    through.path = Path::rounded({{30 + lean, 160}, {30, -60}, {30 - lean, -520}}, 300);
    const int crossing = town.addStreet(through);
    TownStyle style;
    style.car_parks = 0.01;
    style.yard_buildings = 0.12;
    style.yard_height = {2.4, 4};
    town.setStyle(style);
    town.build();
    fillGardens(scene, random);

    TownTraffic traffic(town, seed * 53 + 2);
    // One vehicle in each of three streets.
    for (const int i : {1, 2, 4}) {
        const bool forward = random.chance(0.5);
        const int route = traffic.straight(rows[static_cast<std::size_t>(i)], forward);
        const double middle = traffic.lengthOf(route) / 2;
        traffic.send(route, 0, middle + random.uniform(-90, 0), ObjectKind::car, random.uniform(6, 9));
    }
    const int route = traffic.straight(crossing, random.chance(0.5));
    traffic.send(route, 0, random.uniform(200, 330), ObjectKind::van, 8);
    traffic.people(rows[1], 0.4, 0.3);
    scene.objects = traffic.drive(scene.frame_count, scene.frame_rate_hz, 4);
    dropColliding(scene.objects);
    thinOut(scene, {});
    return scene;
}

}  // namespace eyrie

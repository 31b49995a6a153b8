#include <cmath>

#include "core/geometry/angle.h"
#include "scene/portable_math.h"
#include "scene/towns/presets.h"
#include "scene/towns/town.h"
#include "scene/traffic/path.h"
#include "scene/traffic/vehicle_shape.h"

namespace eyrie {
namespace {

void addHouse(SceneDescription& scene, cv::Point2d centre, double turn, cv::Size2d size, double height,
              Random& random) {
    Building house;
    house.centre = centre;
    house.direction = {portable::cosine(turn), portable::sine(turn)};
    house.length = size.width;
    house.width = size.height;
    house.height = height;
    house.seed = random.bits();
    house.roof_surface =
        Surface{random.chance(0.8) ? Material::roof_gravel : Material::roof_metal, random.uniform(0.8, 1.3)};
    house.roof_surface.seed = random.bits();
    house.roof_surface.direction = house.direction;
    const auto tone = static_cast<float>(random.uniform(130, 205));
    house.facade = {tone * 0.76F, tone * 0.9F, tone};
    scene.buildings.push_back(house);
}

void addWall(SceneDescription& scene, cv::Point2d from, cv::Point2d to, double height) {
    Block wall;
    const cv::Point2d way = to - from;
    wall.length = std::sqrt(way.dot(way));
    wall.direction = way * (1 / wall.length);
    wall.centre = (from + to) * 0.5;
    wall.width = 0.35;
    wall.top = height;
    wall.colour = {150, 172, 184};
    scene.blocks.push_back(wall);
}

/// The building in the middle: two wings, a hall, a pitch, walls around, machines on the roofs, palms and parked cars.
void buildCompound(SceneDescription& scene, Random& random) {
    addHouse(scene, {8, -4}, 0, {46, 17}, random.uniform(10, 16), random);
    addHouse(scene, {24, 14}, 0, {15, 20}, random.uniform(9, 13), random);
    addHouse(scene, {-30, -20}, 0, {22, 15}, random.uniform(5, 8), random);
    scene.buildings.back().roof_surface.material = Material::roof_metal;
    for (const auto& [centre, size] :
         {std::pair(cv::Point2d(8, -4), cv::Size2d(46, 17)), std::pair(cv::Point2d(24, 14), cv::Size2d(15, 20))}) {
        const double roof = scene.buildings[centre.x < 10 ? 0 : 1].height;
        for (int i = 0; i < 26; ++i) {
            Block machine;
            machine.length = random.uniform(0.8, 2.6);
            machine.width = random.uniform(0.8, 1.8);
            machine.centre = centre + cv::Point2d(random.uniform(-0.46, 0.46) * (size.width - 2),
                                                  random.uniform(-0.46, 0.46) * (size.height - 2));
            machine.bottom = roof;
            machine.top = roof + random.uniform(0.6, 2.4);
            const auto grey = static_cast<float>(random.uniform(110, 205));
            machine.colour = {grey, grey, grey};
            scene.blocks.push_back(machine);
        }
    }
    Surface pitch{Material::grass, 0.9};
    pitch.tint = {0.55F, 1.1F, 0.5F};
    scene.patches.push_back({rectangleAt({-24, 12}, {1, 0}, 38, 24), pitch});
    const Surface line{Material::paint, 0.95};
    for (const double y : {0.6, 23.4}) scene.patches.push_back({rectangleAt({-24, y}, {1, 0}, 37, 0.2), line});
    for (const double x : {-42.4, -24.0, -5.6}) scene.patches.push_back({rectangleAt({x, 12}, {1, 0}, 0.2, 23), line});
    const cv::Rect2d yard(-50, -34, 96, 66);
    const cv::Point2d corners[4] = {yard.tl(), {yard.br().x, yard.y}, yard.br(), {yard.x, yard.br().y}};
    for (int i = 0; i < 4; ++i) addWall(scene, corners[i], corners[(i + 1) % 4], 3);
    for (int i = 0; i < 26; ++i) {
        Tree palm;
        palm.position = {random.uniform(-48, 44),
                         random.chance(0.5) ? random.uniform(26, 31) : random.uniform(-33, -29)};
        palm.height = random.uniform(5, 9);
        palm.crown_radius = random.uniform(1.4, 2.4);
        palm.density = 0.8;
        palm.seed = random.bits();
        scene.trees.push_back(palm);
    }
    for (int i = 0; i < 14; ++i) {
        ParkedVehicle parked;
        parked.look = randomLook(ObjectKind::car, random);
        parked.pose.position = {-46 + 3.1 * i + random.uniform(-0.3, 0.3), 37.5};
        parked.pose.direction = {0, 1};
        scene.parked.push_back(parked);
    }
}

/// Low flat houses with yards as far as one sees, on sand.
void buildSurroundings(SceneDescription& scene, cv::Rect2d area, Random& random) {
    for (int i = 0; i < 900; ++i) {
        const cv::Point2d centre(area.x + random.uniform() * area.width, area.y + random.uniform() * area.height);
        const double turn = random.below(2) * kPi / 2 + 0.12 * random.normal();
        const cv::Size2d size(random.uniform(7, 20), random.uniform(6, 14));
        const double height = random.uniform(3, 7.5);
        // Quarters, and sand between them.
        const bool quarter = valueNoise(centre.x / 90, centre.y / 90, scene.seed + 9) > 0.05;
        if (!quarter || centre.dot(centre) < 78.0 * 78.0) continue;
        addHouse(scene, centre, turn, size, height, random);
        const cv::Point2d along = scene.buildings.back().direction * (size.width * 0.8);
        const cv::Point2d across = rightOf(scene.buildings.back().direction) * (size.height * 0.9);
        addWall(scene, centre - along - across, centre + along - across, 2);
        addWall(scene, centre - along + across, centre - along - across, 2);
        if (random.chance(0.3)) {
            ParkedVehicle parked;
            parked.look = randomLook(ObjectKind::car, random);
            parked.pose.position = centre + across * 1.25;
            parked.pose.direction = scene.buildings.back().direction;
            scene.parked.push_back(parked);
        }
        if (random.chance(0.4)) {
            Tree tree;
            tree.position = centre - across * 1.2 + along;
            tree.height = random.uniform(3, 6);
            tree.crown_radius = random.uniform(1, 2);
            tree.seed = random.bits();
            scene.trees.push_back(tree);
        }
    }
    for (int i = 0; i < 160; ++i) {
        const cv::Point2d centre(area.x + random.uniform() * area.width, area.y + random.uniform() * area.height);
        const double turn = random.uniform(0, kPi);
        Surface bare{random.chance(0.5) ? Material::gravel : Material::soil, random.uniform(0.8, 1.15), 0.5};
        bare.seed = random.bits();
        scene.patches.push_back({rectangleAt(centre, {portable::cosine(turn), portable::sine(turn)},
                                             random.uniform(15, 60), random.uniform(6, 25)),
                                 bare});
    }
}

}  // namespace

SceneDescription presetOrbit(std::uint32_t seed) {
    SceneDescription scene;
    scene.name = "orbit";
    scene.text = "Approach and orbit of a building among others on sand: strong parallax, nothing moves";
    scene.seed = seed;
    scene.frame_count = 120;
    scene.frame_rate_hz = 10;
    scene.image_size = {640, 360};
    scene.sun = {{0.7, -0.6}, 0.42};
    scene.sight_m = 1400;
    scene.haze_colour = {178, 180, 182};
    scene.base = Surface{Material::soil, 0.92};
    scene.base.tint = {0.86F, 0.95F, 1.05F};
    scene.base.seed = seed;
    scene.sensor.blur_px = 0.4;
    scene.sensor.exposure = 0.1;
    scene.sensor.samples = 8;
    scene.sensor.jpeg_quality = 84;
    scene.sensor.contrast = 1.0;

    Random random(seed * 59 + 3);
    const double height = random.uniform(48, 62);
    const double tilt = radiansFromDegrees(random.uniform(58, 61));
    const double focal = 0.8 * scene.image_size.width;
    const double start = random.uniform(0, 2 * kPi);
    const double turned = radiansFromDegrees(random.uniform(45, 75)) * (random.chance(0.5) ? 1 : -1);
    CameraPath& camera = scene.camera;
    camera.image_size = scene.image_size;
    camera.frame_rate_hz = scene.frame_rate_hz;
    camera.shake = {1.2, 0.3, 0.001, seed + 5};
    camera.keys = {{0, {-4, -3}, height * 1.25, start, tilt, focal},
                   {40, {-1, 0}, height * 1.05, start + turned * 0.2, tilt, focal},
                   {80, {2, 1}, height, start + turned * 0.6, tilt - 0.02, focal},
                   {120, {0, 0}, height, start + turned, tilt - 0.03, focal}};
    scene.gsd_m_per_px = 1.05 * height / portable::cosine(tilt) / focal;

    buildSurroundings(scene, groundSeen(camera, scene.frame_count), random);
    buildCompound(scene, random);
    return scene;
}

}  // namespace eyrie

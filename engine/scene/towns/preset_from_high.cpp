#include "core/geometry/angle.h"
#include "scene/scene_load.h"
#include "scene/towns/presets.h"
#include "scene/towns/town.h"
#include "scene/traffic/town_traffic.h"

/// Straight down from far above: a city on 1080p, and two pictures a second.
namespace eyrie {
namespace {

/// Streets along x every `distance` metres and some across, with traffic on all.
std::vector<MovingObject> growCity(SceneDescription& scene, double distance, double traffic_share, double run_up,
                                   int clock_frames, double clock_hz) {
    const cv::Rect2d area = mapArea(scene);
    Random random(scene.seed * 61 + 3);
    Town town(scene, area, scene.seed * 61 + 1);
    std::vector<int> along;
    std::vector<int> across;
    const auto street = [&](bool wide) {
        Street made;
        made.lanes = wide ? 2 : 1;
        made.parking = wide ? 0 : 2.2;
        made.occupancy = 0.75;
        made.tree_distance = random.uniform(14, 30);
        made.storeys = {2, 6};
        made.lamp_distance = 40;
        return made;
    };
    bool wide = true;
    for (double y = area.y + 0.55 * distance; y < area.br().y - 10; y += distance * random.uniform(0.85, 1.1)) {
        Street made = street(wide);
        const double bow = random.uniform(-25, 25);
        made.path = Path::rounded({{area.x - 250, y + bow},
                                   {area.x + area.width * random.uniform(0.3, 0.7), y - bow},
                                   {area.br().x + 250, y + bow * 0.5}},
                                  300);
        along.push_back(town.addStreet(made));
        wide = !wide;
    }
    for (double x = area.x + 0.8 * distance; x < area.br().x - 10; x += distance * random.uniform(1.4, 2)) {
        Street made = street(!wide);
        const double lean = random.uniform(-20, 20);
        made.path = Path::rounded(
            {{x - lean, area.y - 250}, {x, area.y + area.height / 2}, {x + lean, area.br().y + 250}}, 300);
        across.push_back(town.addStreet(made));
        wide = !wide;
    }
    TownStyle style;
    style.car_parks = 0.22;
    style.m2_per_try = 240;
    town.setStyle(style);
    town.build();
    for (Tree& tree : scene.trees) tree.density = 0.62;  // small leaves cannot be told apart from up there

    TownTraffic traffic(town, scene.seed * 61 + 2);
    const auto fill = [&](int index, bool forward) {
        const int route = traffic.straight(index, forward);
        const int lanes = town.streets()[static_cast<std::size_t>(index)].lanes;
        for (int lane = 0; lane < lanes; ++lane) {
            LaneLoad load;
            load.platoon = {1, 4};
            load.gap = {5, 16};
            load.pause = {50 / traffic_share, 190 / traffic_share};
            load.speed = {8, 15};
            load.motorcycles = 0.03;
            traffic.fill(route, lane, load);
        }
        return route;
    };
    for (const int index : along) {
        for (const bool forward : {true, false}) fill(index, forward);
    }
    // Only one direction has green: who crosses waits.
    for (const int index : across) {
        for (const bool forward : {true, false}) {
            const int route = fill(index, forward);
            for (const int other : along) traffic.redLight(route, index, other, forward, {{-99, 999}});
        }
    }
    std::vector<MovingObject> objects = traffic.drive(clock_frames, clock_hz, run_up);
    dropColliding(objects);
    return objects;
}

}  // namespace

SceneDescription presetCityHigh(std::uint32_t seed) {
    SceneDescription scene;
    scene.name = "city_high";
    scene.text = "A city from high above on 1080p: cars of 8 to 16 px, hundreds of them parked, hard shadows";
    scene.seed = seed;
    scene.frame_count = 75;
    scene.frame_rate_hz = 25;
    scene.gsd_m_per_px = 0.36;
    scene.image_size = {1920, 1080};
    scene.sun = {{0.55, 0.75}, 0.32};
    scene.base.seed = seed;
    scene.sensor.blur_px = 0.6;
    scene.sensor.exposure = 0.2;
    scene.sensor.read_noise = 1.8;
    scene.sensor.contrast = 1.15;
    scene.sensor.level = 140;
    scene.sensor.haze = 0.06;
    scene.sensor.jpeg_quality = 80;
    scene.sensor.samples = 4;

    const double height = 700;
    const double focal = height / scene.gsd_m_per_px;
    CameraPath& camera = scene.camera;
    camera.image_size = scene.image_size;
    camera.frame_rate_hz = scene.frame_rate_hz;
    camera.shake = {1.0, 0.2, 0.0004, seed + 5};
    camera.keys = {{0, {-3, 2}, height, 0, radiansFromDegrees(2), focal},
                   {75, {3, -2}, height - 2, radiansFromDegrees(1.5), radiansFromDegrees(3), focal}};
    scene.objects = growCity(scene, 95, 1, 4, scene.frame_count, scene.frame_rate_hz);
    thinOut(scene, {});
    return scene;
}

SceneDescription presetLowRate(std::uint32_t seed) {
    SceneDescription scene;
    scene.name = "low_rate";
    scene.text = "Two pictures a second from an aircraft: a tenth of the width lies between them";
    scene.seed = seed;
    scene.frame_count = 30;
    scene.frame_rate_hz = 2;
    scene.gsd_m_per_px = 0.22;
    scene.image_size = {800, 600};
    scene.sun = {{-0.5, 0.6}, 0.4};
    scene.base.seed = seed;
    scene.sensor.blur_px = 0.45;
    scene.sensor.exposure = 0.004;
    scene.sensor.read_noise = 1.6;
    scene.sensor.samples = 8;
    scene.sensor.gray = true;

    const double height = 800;
    const double focal = height / scene.gsd_m_per_px;
    CameraPath& camera = scene.camera;
    camera.image_size = scene.image_size;
    camera.frame_rate_hz = scene.frame_rate_hz;
    camera.shake = {5, 1.5, 0.004, seed + 5};
    const double step = 0.1 * scene.image_size.width * scene.gsd_m_per_px;
    const double last = scene.frame_count;
    camera.keys = {{0, {0, 0}, height, 0, radiansFromDegrees(3), focal},
                   {last / 2, {step * last / 2, 8}, height + 6, radiansFromDegrees(2), radiansFromDegrees(5), focal},
                   {last, {step * last, -4}, height - 4, radiansFromDegrees(-2), radiansFromDegrees(4), focal}};
    // Traffic needs a finer clock than the camera has.
    constexpr int kFine = 10;
    const std::vector<MovingObject> fine =
        growCity(scene, 70, 2.5, 3, scene.frame_count * kFine, scene.frame_rate_hz * kFine);
    scene.objects = everyNth(fine, kFine);
    thinOut(scene, {});
    return scene;
}

}  // namespace eyrie

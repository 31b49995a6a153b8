#include "scene/small_scene.h"

#include <cmath>

namespace eyrie {

SceneDescription plainScene(int frame_count) {
    SceneDescription scene;
    scene.name = "plain";
    scene.frame_count = frame_count;
    scene.image_size = {160, 120};
    scene.gsd_m_per_px = 0.3;
    scene.base = Surface{Material::plain, 0.5};
    scene.map_margin = 5;
    scene.sun = {{0, 0}, 0.5};
    scene.sensor = {};
    scene.sensor.blur_px = 0;
    scene.sensor.exposure = 0;
    scene.sensor.read_noise = 0;
    scene.sensor.shot_noise = 0;
    scene.sensor.contrast = 1;
    scene.sensor.level = 120;
    scene.sensor.haze = 0;
    scene.sensor.vignette = 0;
    scene.camera.image_size = scene.image_size;
    scene.camera.frame_rate_hz = scene.frame_rate_hz;
    CameraKey key;
    key.height = 300;
    key.focal_px = 1000;
    scene.camera.keys = {key};
    return scene;
}

MovingObject driving(int id, ObjectLook look, cv::Point2d start, double heading, double metres_per_second,
                     int frame_count, double frame_rate_hz) {
    MovingObject object;
    object.id = id;
    object.look = look;
    const cv::Point2d direction(std::cos(heading), std::sin(heading));
    for (int frame = 0; frame < frame_count; ++frame) {
        object.poses.push_back(
            {start + direction * (metres_per_second * frame / frame_rate_hz), direction, metres_per_second});
    }
    return object;
}

ObjectLook busLook() {
    ObjectLook look;
    look.kind = ObjectKind::bus;
    look.length = 12;
    look.width = 2.5;
    look.height = 3;
    look.colour = {180, 180, 180};
    return look;
}

ObjectLook carLook() {
    ObjectLook look;
    look.colour = {200, 200, 200};
    return look;
}

}  // namespace eyrie

#pragma once

#include <cmath>
#include <sstream>
#include <string>

#include "core/geometry/angle.h"
#include "scene/scene_description.h"

/// What a preset says, as lines that tests compare.
namespace eyrie::test {

/// To three decimals, without "-0".
inline double rounded(double value) {
    return std::round(value * 1000) / 1000 + 0.0;
}

/// Clock and picture; sun; blur, exposure, noise; contrast, level, haze, vignette; JPEG, grey, glare, pattern, smudges,
/// samples; shake and how far its seed is from the scene's; least length and sight.
inline std::string pictureFacts(const SceneDescription& scene) {
    const Sensor& s = scene.sensor;
    const CameraShake& shake = scene.camera.shake;
    std::ostringstream text;
    text << scene.frame_rate_hz << " Hz, " << scene.frame_count << " of " << scene.image_size.width << " x "
         << scene.image_size.height << "; " << scene.sun.shadow.x << " " << scene.sun.shadow.y << " "
         << scene.sun.ambient << "; " << s.blur_px << " " << s.exposure << " " << s.read_noise << " " << s.shot_noise
         << "; " << s.contrast << " " << s.level << " " << s.haze << " " << s.vignette << "; " << s.jpeg_quality << " "
         << s.gray << " " << s.glare << " " << s.fixed_pattern << " " << s.smudges << " " << s.samples << "; "
         << shake.sway_px << " " << shake.vibration_px << " " << shake.roll << " " << shake.seed - scene.seed << "; "
         << scene.least_length_px << " " << scene.sight_m;
    return text.str();
}

/// A key of the camera: frame; target; height; heading and tilt in degrees; focal length.
inline std::string keyFacts(const SceneDescription& scene, std::size_t index) {
    const CameraKey& key = scene.camera.keys.at(index);
    std::ostringstream text;
    text.precision(9);
    text << key.frame << "; " << rounded(key.target.x) << " " << rounded(key.target.y) << "; " << rounded(key.height)
         << "; " << rounded(degreesFromRadians(key.heading)) << " " << rounded(degreesFromRadians(key.tilt)) << "; "
         << rounded(key.focal_px);
    return text.str();
}

/// How many there are of what stands, each with the sum of its places (x and y) and sizes: houses, blocks, trees,
/// lamps, parked vehicles, patches of ground.
inline std::string standingFacts(const SceneDescription& scene) {
    std::ostringstream text;
    const auto tell = [&](const char* name, const auto& things, const auto& sumOf) {
        double sum = 0;
        for (const auto& thing : things) sum += sumOf(thing);
        text << name << things.size() << " " << std::llround(sum * 10);
    };
    const auto at = [](cv::Point2d place) { return place.x + 2 * place.y; };
    tell("", scene.buildings, [&](const Building& b) { return at(b.centre) + b.length + b.width + b.height; });
    tell("; ", scene.blocks, [&](const Block& b) { return at(b.centre) + b.length + b.width + b.bottom + b.top; });
    tell("; ", scene.trees, [&](const Tree& t) { return at(t.position) + t.height + t.crown_radius; });
    tell("; ", scene.posts, [&](const LampPost& post) { return at(post.position); });
    tell("; ", scene.parked, [&](const ParkedVehicle& p) { return at(p.pose.position) + p.look.length; });
    tell("; ", scene.patches, [&](const GroundPatch& patch) {
        double sum = 0;
        for (const cv::Point2d& corner : patch.outline) sum += at(corner);
        return sum;
    });
    return text.str();
}

}  // namespace eyrie::test

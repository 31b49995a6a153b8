#include "scene/painting/scene_renderer.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/core/utility.hpp>

#include "core/error.h"
#include "core/geometry/angle.h"
#include "scene/painting/glare.h"
#include "scene/painting/ground_map.h"
#include "scene/painting/night_lights.h"
#include "scene/painting/pass_geometry.h"
#include "scene/painting/sensor.h"
#include "scene/painting/tile_painter.h"
#include "scene/portable_math.h"
#include "scene/towns/static_world.h"
#include "scene/traffic/path.h"
#include "scene/traffic/vehicle_shape.h"

namespace eyrie {
namespace {

/// Six tenths of the finest pixel on the ground along the camera's path.
double mapTexel(const SceneDescription& scene) {
    double finest = 1e9;
    const cv::Point2d centre((scene.image_size.width - 1) / 2.0, (scene.image_size.height - 1) / 2.0);
    for (FrameIndex frame = 0; frame < scene.frame_count; frame += 5) {
        Homography ground_from_image;
        ground_from_image.matrix = scene.camera.at(frame).imageFromGround().inv();
        finest = std::min(finest, ground_from_image.scaleAt(centre));
    }
    return 0.6 * finest;
}

void check(const SceneDescription& scene) {
    const auto fail = [&](const std::string& what) {
        throw Error(ErrorKind::parameter, "Scene '" + scene.name + "': " + what);
    };
    if (scene.frame_count < 1) fail("frames = " + std::to_string(scene.frame_count) + ", expected at least 1");
    if (scene.image_size.width < 16 || scene.image_size.height < 16) fail("the image must be at least 16×16 px");
    if (scene.camera.keys.empty()) fail("its camera has no path");
    if (!(scene.frame_rate_hz > 0)) fail("its frame rate must be above 0");
    const int samples = scene.sensor.samples;
    if (samples != 4 && samples != 8 && samples != 16 && samples != 32) {
        fail("samples = " + std::to_string(samples) + ", expected 4, 8, 16 or 32 a pixel");
    }
    if (scene.camera.image_size != scene.image_size) fail("its camera has another image size");
}

/// Mirrors that throw the sun into the camera light up.
void addGlints(const Mesh& mesh, const Light& light, const CameraPose& camera, const GroundMap& map,
               std::vector<Ball>& out) {
    for (std::size_t i = 0; i < mesh.glints.size(); ++i) {
        const cv::Point3d place = mesh.glint_places[i];
        cv::Point3d to_camera = camera.position - place;
        to_camera *= 1 / std::sqrt(to_camera.dot(to_camera));
        cv::Point3d half = light.to_sun + to_camera;
        half *= 1 / std::sqrt(half.dot(half));
        const double aligned = half.dot(mesh.glints[i]);
        if (aligned < 0.9996) continue;
        // Half a degree wide.
        const double flash = portable::exponential(-(1 - aligned) * 12000);
        const cv::Point2d at = (map.mapFromGround(cv::Point2d(place.x, place.y) + light.shadow * place.z)) * 256;
        if (flash < 0.1 || map.sunAt(static_cast<std::int32_t>(at.x), static_cast<std::int32_t>(at.y)) < 128) continue;
        const auto white = static_cast<float>(255 * std::min(1.0, 0.5 + flash));
        out.push_back({place + cv::Point3d(0, 0, 0.15), 0.12 + 0.16 * flash, {white, white, white}});
    }
}

}  // namespace

struct SceneRenderer::World {
    SceneDescription scene;
    Light light;
    TileGrid grid;
    std::vector<StandingThing> things;
    std::vector<Mesh> bodies;  ///< one per moving object, in its own coordinates
    GroundMap map;
    SceneTruth truth;

    explicit World(SceneDescription description)
        : scene((check(description), std::move(description))),
          light(scene),
          grid{scene.image_size},
          things(standingThings(scene)),
          map(scene, mapArea(scene), mapTexel(scene)),
          truth(scene, things) {
        for (const MovingObject& object : scene.objects) bodies.push_back(bodyOf(object.look));
    }

    PassGeometry prepare(FrameIndex clock, const PassSample& sample, const std::vector<Ball>& glints) const;
    std::vector<Ball> glintsAt(FrameIndex clock) const;
    cv::Mat lightOf(FrameIndex clock) const;
    void addLights(PassBuilder& builder, const ObjectLook& look, const ObjectPose& pose) const;
};

PassGeometry SceneRenderer::World::prepare(FrameIndex clock, const PassSample& sample,
                                           const std::vector<Ball>& glints) const {
    const double moment = clock + sample.moment;
    PassBuilder builder(scene.camera.at(moment), sample.offset, grid, light, map);
    const double seconds = moment / scene.frame_rate_hz;
    const double slant = std::sqrt(light.shadow.dot(light.shadow));
    for (const StandingThing& thing : things) {
        const double shadow = thing.shadows.empty() ? 0 : slant * thing.height;
        if (!builder.sees(thing.centre, thing.reach + shadow, thing.height)) continue;
        builder.add(thing.mesh);
        for (const auto& outline : thing.shadows) builder.addShadow(outline, false);
        const double swing = thing.sway * portable::sine(2 * kPi * 0.35 * seconds + thing.sway_phase);
        const cv::Point3d shift(swing, 0.6 * swing * portable::cosine(2 * kPi * 0.21 * seconds + thing.sway_phase), 0);
        for (const Ball& ball : thing.balls) builder.add(ball, shift);
    }
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        ObjectPose pose;
        if (!poseAt(scene.objects[i], moment, pose)) continue;
        const ObjectLook& look = scene.objects[i].look;
        if (!builder.sees(pose.position, look.length + slant * look.height, look.height)) continue;
        const Mesh body = placed(bodies[i], pose);
        builder.add(body);
        for (const auto& outline : shadowsOf(body, light.shadow)) builder.addShadow(outline, false);
        if (light.night) addLights(builder, look, pose);
        if (isVehicle(look.kind)) {
            builder.addShadow(rectangleAt(pose.position, pose.direction, look.length, look.width), true);
        }
    }
    for (const Ball& glint : glints) builder.add(glint);
    return builder.finish();
}

std::vector<Ball> SceneRenderer::World::glintsAt(FrameIndex clock) const {
    std::vector<Ball> glints;
    if (light.night) return glints;
    const CameraPose camera = scene.camera.at(clock);
    for (const StandingThing& thing : things) {
        if (!thing.mesh.glints.empty()) addGlints(thing.mesh, light, camera, map, glints);
    }
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        ObjectPose pose;
        if (poseAt(scene.objects[i], clock, pose)) addGlints(placed(bodies[i], pose), light, camera, map, glints);
    }
    return glints;
}

void SceneRenderer::World::addLights(PassBuilder& builder, const ObjectLook& look, const ObjectPose& pose) const {
    for (const Ball& lamp : lampsOf(look, pose)) builder.add(lamp);
    for (const auto& [outline, share] : beamsOf(look, pose)) builder.addBeam(outline, share * scene.night.beams);
}

cv::Mat SceneRenderer::World::lightOf(FrameIndex clock) const {
    const std::vector<PassSample> samples = passesOf(scene.sensor);
    const std::vector<Ball> glints = glintsAt(clock);
    std::vector<PassGeometry> passes(samples.size());
    cv::parallel_for_(cv::Range(0, static_cast<int>(samples.size())), [&](const cv::Range& range) {
        for (int i = range.start; i < range.end; ++i) {
            const auto k = static_cast<std::size_t>(i);
            passes[k] = prepare(clock, samples[k], glints);
        }
    });

    cv::Mat mean(scene.image_size, CV_32FC3);
    cv::Mat lamps;
    if (light.night) lamps = cv::Mat(scene.image_size, CV_32SC3, cv::Scalar::all(0));
    const float share = 1.0F / static_cast<float>(samples.size());
    cv::parallel_for_(cv::Range(0, grid.count()), [&](const cv::Range& range) {
        for (int index = range.start; index < range.end; ++index) {
            const cv::Rect tile = grid.tile(index);
            TilePainter painter(tile, index);
            for (const PassGeometry& pass : passes) painter.add(pass, map, light);
            const std::uint32_t* sums = painter.sums().data();
            for (int y = tile.y; y < tile.y + tile.height; ++y) {
                float* to = mean.ptr<float>(y) + 3 * tile.x;
                // Passes hold whole levels cut off at the top: half a level was lost on average.
                for (int i = 0; i < 3 * tile.width; ++i) *to++ = static_cast<float>(*sums++) * share + 0.5F;
            }
            const std::uint32_t* shining = painter.lampSums().data();
            for (int y = tile.y; y < tile.y + tile.height && light.night; ++y) {
                std::int32_t* to = lamps.ptr<std::int32_t>(y) + 3 * tile.x;
                for (int i = 0; i < 3 * tile.width; ++i) *to++ = static_cast<std::int32_t>(*shining++);
            }
        }
    });
    if (light.night) addGlare(mean, lamps, static_cast<int>(samples.size()), scene.sensor.glare);
    return mean;
}

SceneRenderer::SceneRenderer(SceneDescription scene) : world_(std::make_unique<const World>(std::move(scene))) {}
SceneRenderer::~SceneRenderer() = default;
SceneRenderer::SceneRenderer(SceneRenderer&&) noexcept = default;
SceneRenderer& SceneRenderer::operator=(SceneRenderer&&) noexcept = default;

const SceneDescription& SceneRenderer::scene() const {
    return world_->scene;
}

int SceneRenderer::frameCount() const {
    return world_->scene.frame_count;
}

RenderedFrame SceneRenderer::render(FrameIndex index) const {
    const SceneDescription& scene = world_->scene;
    if (index < 0 || index >= scene.frame_count) {
        throw Error(ErrorKind::parameter, "Scene '" + scene.name + "' has no frame " + std::to_string(index) +
                                              ", expected 0.." + std::to_string(scene.frame_count - 1));
    }
    const FrameIndex clock = clockFrame(scene, index);
    RenderedFrame rendered;
    rendered.frame = develop(world_->lightOf(clock), scene.sensor, scene.seed, clock);
    rendered.frame.index = index;
    rendered.frame.time_us = static_cast<std::int64_t>(std::floor(index * 1e6 / scene.frame_rate_hz + 0.5));
    rendered.truth = truth(index);
    rendered.frame_from_ground = frameFromGround(index);
    rendered.first_from_frame = firstFromFrame(index);
    return rendered;
}

std::vector<SceneObject> SceneRenderer::truth(FrameIndex index) const {
    return world_->truth.objects(index);
}

cv::Matx33d SceneRenderer::frameFromGround(FrameIndex index) const {
    return world_->scene.camera.at(clockFrame(world_->scene, index)).imageFromGround();
}

Homography SceneRenderer::firstFromFrame(FrameIndex index) const {
    Homography map;
    if (index > 0) {
        map.matrix = frameFromGround(0) * frameFromGround(index).inv();
        map.matrix *= 1 / map.matrix(2, 2);
    }
    map.from_frame = index;
    map.to_frame = 0;
    return map;
}

}  // namespace eyrie

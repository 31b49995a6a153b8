#include "scene/painting/ground_map.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>

#include "core/error.h"
#include "scene/painting/night_lights.h"
#include "scene/painting/polygon_scan.h"
#include "scene/towns/static_world.h"
#include "scene/traffic/path.h"
#include "scene/traffic/vehicle_shape.h"

namespace eyrie {
namespace {

std::uint32_t packedWithSun(cv::Vec3f colour, std::uint32_t sun) {
    const auto byte = [](float value) { return static_cast<std::uint32_t>(std::clamp(value + 0.5F, 0.0F, 255.0F)); };
    return byte(colour[0]) | (byte(colour[1]) << 8) | (byte(colour[2]) << 16) | (sun << 24);
}

cv::Vec3f unpacked(std::uint32_t texel) {
    return {static_cast<float>(texel & 255), static_cast<float>((texel >> 8) & 255),
            static_cast<float>((texel >> 16) & 255)};
}

}  // namespace

GroundMap::GroundMap(const SceneDescription& scene, cv::Rect2d area, double texel)
    : origin_(area.x, area.y), texel_(texel), night_(scene.night.lamps) {
    const double columns = std::ceil(area.width / texel);
    const double rows = std::ceil(area.height / texel);
    if (!(columns >= 2) || !(rows >= 2) || columns * rows > 2e8) {
        throw Error(ErrorKind::internal, "Scene '" + scene.name + "': its ground map would have " +
                                             std::to_string(columns * rows) +
                                             " texels; keep the camera's view below 200 million.");
    }
    width_ = static_cast<int>(columns);
    height_ = static_cast<int>(rows);
    texels_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));

    const std::vector<Job> jobs = jobsOf(scene);
    constexpr int kStrip = 64;
    const int strips = (height_ + kStrip - 1) / kStrip;
    cv::parallel_for_(cv::Range(0, strips), [&](const cv::Range& range) {
        for (int strip = range.start; strip < range.end; ++strip) {
            paintRows(scene.base, jobs, strip * kStrip, std::min((strip + 1) * kStrip, height_));
        }
    });
}

GroundMap::Job GroundMap::job(const std::vector<cv::Point2d>& outline, const Surface& surface,
                              Job::Effect effect) const {
    Job made;
    made.surface = surface;
    made.effect = effect;
    made.top = 1e300;
    made.bottom = -1e300;
    for (const cv::Point2d& point : outline) {
        made.outline.push_back(mapFromGround(point));
        made.top = std::min(made.top, made.outline.back().y);
        made.bottom = std::max(made.bottom, made.outline.back().y);
    }
    return made;
}

std::vector<GroundMap::Job> GroundMap::jobsOf(const SceneDescription& scene) const {
    std::vector<Job> jobs;
    for (const GroundPatch& patch : scene.patches)
        jobs.push_back(job(patch.outline, patch.surface, Job::Effect::paint));
    if (!night_) {
        for (const auto& shadow : staticShadows(scene)) jobs.push_back(job(shadow, {}, Job::Effect::shadow));
    }
    for (const ParkedVehicle& parked : scene.parked) {
        // Little skylight reaches the ground below a vehicle.
        jobs.push_back(job(
            rectangleAt(parked.pose.position, parked.pose.direction, parked.look.length + 0.1, parked.look.width + 0.1),
            Surface{Material::plain, 0.15, 0.6}, Job::Effect::paint));
    }
    for (const Building& building : scene.buildings) {
        jobs.push_back(job(rectangleAt(building.centre, building.direction, building.length, building.width),
                           building.roof_surface, Job::Effect::roof));
        if (building.roof != RoofKind::flat) continue;
        // The lighter rim of the parapet.
        Surface rim = building.roof_surface;
        rim.tone *= 1.18;
        const cv::Point2d right = rightOf(building.direction);
        for (const double side : {-1.0, 1.0}) {
            const cv::Point2d long_side = building.centre + right * (side * (building.width / 2 - 0.2));
            const cv::Point2d short_side = building.centre + building.direction * (side * (building.length / 2 - 0.2));
            jobs.push_back(
                job(rectangleAt(long_side, building.direction, building.length, 0.4), rim, Job::Effect::roof));
            jobs.push_back(job(rectangleAt(short_side, right, building.width, 0.4), rim, Job::Effect::roof));
        }
    }
    for (const Block& block : scene.blocks) {
        // Machines on roofs darken the roof beside them.
        if (block.bottom < 2 || night_) continue;
        std::vector<cv::Point2d> corners = rectangleAt(block.centre, block.direction, block.length, block.width);
        const std::size_t count = corners.size();
        for (std::size_t i = 0; i < count; ++i)
            corners.push_back(corners[i] + scene.sun.shadow * (block.top - block.bottom));
        jobs.push_back(job(hullOf(corners), {}, Job::Effect::shadow));
    }
    for (const LampPost& post : scene.posts) {
        if (!night_) break;
        const cv::Point2d below = lightOf(post);
        Job pool = job(rectangleAt(below, {1, 0}, 2 * kLampReach, 2 * kLampReach), {}, Job::Effect::lamp);
        pool.lamp = below;
        pool.height = post.height;
        pool.strength = scene.night.lamp_strength;
        jobs.push_back(std::move(pool));
    }
    return jobs;
}

void GroundMap::paintRows(const Surface& base, const std::vector<Job>& jobs, int begin, int end) {
    const cv::Rect bounds(0, begin, width_, end - begin);
    for (int y = begin; y < end; ++y) {
        for (int x = 0; x < width_; ++x) {
            const cv::Point2d ground = origin_ + cv::Point2d(x, y) * texel_;
            texels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)] =
                packedWithSun(colourOf(base, ground), night_ ? 0 : 255);
        }
    }
    for (const Job& next : jobs) {
        if (next.bottom < begin - 1 || next.top > end) continue;
        if (next.effect == Job::Effect::shadow) {
            darken(next, bounds);
        } else if (next.effect == Job::Effect::lamp) {
            lighten(next, bounds);
        } else {
            paint(next, bounds);
        }
    }
}

void GroundMap::paint(const Job& job, cv::Rect bounds) {
    const bool is_roof = job.effect == Job::Effect::roof;
    scanPolygon(job.outline, bounds, [&](int y, int x_begin, int x_end, const float* coverage) {
        std::uint32_t* row = texels_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
        for (int x = x_begin; x < x_end; ++x) {
            float share = coverage[x - x_begin];
            if (share <= 0) continue;
            const cv::Point2d ground = origin_ + cv::Point2d(x, y) * texel_;
            // The sun reaches every roof, whatever shadow lies on the ground that it hides.
            const std::uint32_t sun = is_roof && share > 0.5F && !night_ ? 255U : row[x] >> 24;
            share *= opacityOf(job.surface, ground);
            row[x] = packedWithSun(unpacked(row[x]) * (1 - share) + colourOf(job.surface, ground) * share, sun);
        }
    });
}

void GroundMap::darken(const Job& job, cv::Rect bounds) {
    scanPolygon(job.outline, bounds, [&](int y, int x_begin, int x_end, const float* coverage) {
        std::uint32_t* row = texels_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
        for (int x = x_begin; x < x_end; ++x) {
            const float sun = static_cast<float>(row[x] >> 24) * (1 - coverage[x - x_begin]);
            row[x] = (row[x] & 0x00FFFFFFU) | (static_cast<std::uint32_t>(sun + 0.5F) << 24);
        }
    });
}

void GroundMap::lighten(const Job& job, cv::Rect bounds) {
    scanPolygon(job.outline, bounds, [&](int y, int x_begin, int x_end, const float*) {
        std::uint32_t* row = texels_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
        for (int x = x_begin; x < x_end; ++x) {
            const cv::Point2d away = origin_ + cv::Point2d(x, y) * texel_ - job.lamp;
            const double light = (row[x] >> 24) + 255 * job.strength * lampLight(away, job.height);
            row[x] = (row[x] & 0x00FFFFFFU) | (static_cast<std::uint32_t>(std::min(light + 0.5, 255.0)) << 24);
        }
    });
}

}  // namespace eyrie

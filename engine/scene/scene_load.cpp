#include "scene/scene_load.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "scene/scene_truth.h"

namespace eyrie {
namespace {

/// Per object the frames in which it counts, and whether it is ever seen.
struct Presence {
    std::vector<FrameIndex> counted;
    bool seen = false;
    bool vehicle = true;
    bool kept = true;
    std::map<int, int> near;  ///< frames that it counts close to another object, by the other's id
};

constexpr double kNear = 16;  ///< m between the centres of vehicles in a platoon

std::map<int, Presence> presences(const SceneDescription& scene) {
    std::map<int, Presence> all;
    for (const MovingObject& object : scene.objects) all[object.id].vehicle = isVehicle(object.look.kind);
    const std::vector<StandingThing> nothing;
    const SceneTruth truth(scene, nothing);
    for (FrameIndex frame = 0; frame < scene.frame_count; ++frame) {
        const std::vector<SceneObject> objects = truth.objectsOnOpenGround(frame);
        for (const SceneObject& object : objects) {
            Presence& presence = all[object.id];
            presence.seen = true;
            if (object.ignore) continue;
            presence.counted.push_back(frame);
            for (const SceneObject& other : objects) {
                const cv::Point2d way = other.box.centre - object.box.centre;
                const bool close = std::sqrt(way.dot(way)) * scene.gsd_m_per_px < kNear;
                if (close && other.id != object.id && !other.ignore) ++presence.near[other.id];
            }
        }
    }
    return all;
}

std::vector<int> crowd(const std::map<int, Presence>& all, int frames) {
    std::vector<int> counts(static_cast<std::size_t>(frames));
    for (const auto& [id, presence] : all) {
        if (!presence.kept) continue;
        for (const FrameIndex frame : presence.counted) ++counts[static_cast<std::size_t>(frame)];
    }
    return counts;
}

/// Takes out vehicles, or the others, down to `tracks` and about `boxes`.
void thinKind(std::map<int, Presence>& all, bool vehicles, int tracks, int boxes, int most, int frames) {
    while (true) {
        int left = 0;
        int left_boxes = 0;
        for (const auto& [id, presence] : all) {
            if (!presence.kept || presence.vehicle != vehicles || presence.counted.empty()) continue;
            ++left;
            left_boxes += static_cast<int>(presence.counted.size());
        }
        if (left <= tracks) return;
        const double wanted_length = static_cast<double>(left_boxes - boxes) / (left - tracks);
        const std::vector<int> counts = crowd(all, frames);
        double best = 1e300;
        Presence* victim = nullptr;
        for (auto& [id, presence] : all) {
            if (!presence.kept || presence.vehicle != vehicles || presence.counted.empty()) continue;
            const auto relieved =
                static_cast<double>(std::count_if(presence.counted.begin(), presence.counted.end(), [&](FrameIndex f) {
                    return most > 0 && counts[static_cast<std::size_t>(f)] > most;
                }));
            const double length = static_cast<double>(presence.counted.size());
            // Platoons stay together: who drives alone goes first.
            double company = 0;
            for (const auto& [other, together] : presence.near) {
                if (all.at(other).kept) company = std::max(company, together / length);
            }
            const double cost = (boxes > 0 ? std::abs(length - wanted_length) : 0) - 3 * relieved + 80 * company;
            if (cost < best) {
                best = cost;
                victim = &presence;
            }
        }
        victim->kept = false;
    }
}

}  // namespace

void thinOut(SceneDescription& scene, const LoadTarget& target) {
    std::map<int, Presence> all = presences(scene);
    for (auto& [id, presence] : all) presence.kept = presence.seen;
    if (target.vehicle_tracks > 0) {
        thinKind(all, true, target.vehicle_tracks, target.vehicle_boxes, target.most_objects, scene.frame_count);
    }
    if (target.other_tracks > 0) {
        thinKind(all, false, target.other_tracks, target.other_boxes, target.most_objects, scene.frame_count);
    }
    std::vector<MovingObject> kept;
    for (MovingObject& object : scene.objects) {
        if (!all[object.id].kept) continue;
        kept.push_back(std::move(object));
        kept.back().id = static_cast<int>(kept.size());
    }
    scene.objects = std::move(kept);
}

}  // namespace eyrie

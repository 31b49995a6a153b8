#include <algorithm>
#include <cmath>

#include "events/kinds/event_scene.h"

namespace eyrie {
namespace {

constexpr double kLeastBorder_px = 2;

/// px/frame in the picture, camera and all, over the samples nearest to one end of a path.
cv::Point2d velocityInImage(const GroundPath& path, bool at_end, double frames) {
    const std::size_t n = path.samples.size();
    const std::size_t near = at_end ? n - 1 : 0;
    std::size_t far = near;
    while (at_end ? far > 0 : far + 1 < n) {
        const std::size_t next = at_end ? far - 1 : far + 1;
        if (std::abs(path.samples[next].frame - path.samples[near].frame) > frames) break;
        far = next;
    }
    if (far == near) return {0, 0};
    const cv::Point2d way = path.box(near).box.centre - path.box(far).box.centre;
    return way * (1.0 / (path.samples[near].frame - path.samples[far].frame));
}

double depthInImage(cv::Point2d place, cv::Size size) {
    return std::min({place.x + 0.5, place.y + 0.5, size.width - 0.5 - place.x, size.height - 0.5 - place.y});
}

/// Whether the first or last box of a path lies at the border, or passes it soon, before or after.
bool isAtBorder(const EventScene& scene, const GroundPath& path, bool at_end) {
    const Footage& footage = scene.ground.footage();
    const TrackedBox& box = path.box(at_end ? path.samples.size() - 1 : 0);
    const double metres = scene.ground.metresHere(box.frame, box.box.centre);
    const double border = std::max(kLeastBorder_px, scene.options.border_distance_m / metres);
    for (const cv::Point2d& corner : box.box.corners()) {
        if (depthInImage(corner, footage.image_size) < border) return true;
    }
    const double frames = std::max(2.0, scene.options.border_time_s * scene.scale.frame_rate_hz);
    const cv::Point2d moved = velocityInImage(path, at_end, frames) * (at_end ? frames : -frames);
    OrientedBox then = box.box;
    then.centre += moved;
    for (const cv::Point2d& corner : then.corners()) {
        if (depthInImage(corner, footage.image_size) < 0) return true;
    }
    return false;
}

/// Whether the search itself began or ended here, so that nothing is known of before or after.
bool isAtEdgeOfSearch(const EventScene& scene, const GroundPath& path, bool at_end) {
    const double frames = scene.options.edge_time_s * scene.scale.frame_rate_hz;
    const FrameIndex frame = at_end ? path.samples.back().frame : path.samples.front().frame;
    const auto& stretches = scene.ground.all();
    std::size_t at = static_cast<std::size_t>(path.stretch);
    if (at_end) {
        while (!stretches[at].ends_for_good) ++at;
        return stretches[at].last_frame - frame < frames;
    }
    while (!stretches[at].begins_anew) --at;
    return frame - stretches[at].first_frame < frames;
}

}  // namespace

void findBorderEvents(const EventScene& scene, std::vector<Event>& events) {
    const cv::Size size = scene.ground.footage().image_size;
    for (const GroundPath& path : scene.paths) {
        const std::size_t last = path.samples.size() - 1;
        if (path.begins && path.samples.front().frame > scene.ground.footage().first_frame) {
            const bool at_border = isAtBorder(scene, path, false);
            if (at_border || !isAtEdgeOfSearch(scene, path, false)) {
                Event event = eventAt(scene, EventKind::appears, path, {0, 0}, 0);
                const double depth = std::max(0.0, depthInImage(event.place, size));
                setLength(event, scene, depth * scene.ground.metresHere(event.frame, event.place));
                events.push_back(event);
            }
        }
        if (!path.ends || path.samples.back().frame >= scene.ground.footage().last_frame) continue;
        const bool at_border = isAtBorder(scene, path, true);
        if (!at_border && isAtEdgeOfSearch(scene, path, true)) continue;
        Event event = eventAt(scene, at_border ? EventKind::leaves : EventKind::lost, path, {last, last}, last);
        if (path.measured) setSpeed(event, scene, path.samples.back().speed);
        events.push_back(event);
    }
}

}  // namespace eyrie

#include "formats/track_world.h"

#include <cmath>

#include "core/error.h"
#include "core/geometry/angle.h"

namespace eyrie {
namespace {

constexpr double kSlowest_km_h = 1;  ///< below, a direction is but noise

/// Metres between two pixels of a frame; nothing where neither the run nor the earth says.
std::optional<cv::Point2d> metresBetween(const TrackWorld& world, FrameIndex frame, cv::Point2d from, cv::Point2d to) {
    if (world.ground) {
        const auto a = world.ground(frame, from), b = world.ground(frame, to);
        if (a && b && a->stretch == b->stretch) return b->metres - a->metres;
    }
    if (!world.place) return std::nullopt;
    const auto a = world.place(frame, from), b = world.place(frame, to);
    return a && b ? std::optional(LocalPlane(*a).metresOf(*b)) : std::nullopt;
}

std::optional<double> lengthOf(const TrackWorld& world, const LabelBox& box, cv::Point2d axis, double length) {
    const auto metres =
        metresBetween(world, box.frame, box.box.centre - axis * (length / 2), box.box.centre + axis * (length / 2));
    return metres ? std::optional(std::hypot(metres->x, metres->y)) : std::nullopt;
}

[[noreturn]] void refuse(const std::filesystem::path& path, const char* format, const char* what,
                         const std::string& why) {
    throw Error(ErrorKind::input, path.string() + ": " + format + " needs to know " + what + ", which is not known: " +
                                      (why.empty() ? "only runs of a project have such" : why));
}

}  // namespace

GroundState groundStateOf(const TrackWorld* world, const LabelBox& box) {
    GroundState state;
    if (world == nullptr) return state;
    const cv::Point2d along(std::cos(box.box.heading), std::sin(box.box.heading));
    state.length_m = lengthOf(*world, box, along, box.box.length);
    state.width_m = lengthOf(*world, box, {-along.y, along.x}, box.box.width);
    const cv::Point2d there = box.box.centre + box.velocity;
    const auto step = metresBetween(*world, box.frame, box.box.centre, there);
    if (!step) return state;
    state.speed_km_h = std::hypot(step->x, step->y) * world->frame_rate_hz * 3.6;
    if (*state.speed_km_h < kSlowest_km_h || !world->place) return state;
    const auto a = world->place(box.frame, box.box.centre), b = world->place(box.frame, there);
    if (!a || !b) return state;
    const cv::Point2d east_north = LocalPlane(*a).metresOf(*b);
    state.course_deg = degreesFromRadians(std::atan2(east_north.x, east_north.y));
    return state;
}

const TrackWorld& neededPlaces(const LabelFile& labels, const std::filesystem::path& path, const char* format) {
    if (!labels.world) refuse(path, format, "where on earth the video was taken", "");
    if (!labels.world->place) refuse(path, format, "where on earth the video was taken", labels.world->no_place);
    return *labels.world;
}

const TrackWorld& neededTimes(const LabelFile& labels, const std::filesystem::path& path, const char* format) {
    if (!labels.world) refuse(path, format, "when the video was taken", "");
    if (!labels.world->utc_us)
        refuse(path, format, "when the video was taken",
               labels.world->no_clock +
                   "; say when it began: --start 2026-11-21T08:00:00Z on the command line, File > Start time in the "
                   "window");
    return *labels.world;
}

}  // namespace eyrie

#include "annotation/pictures/box_tracker.h"

#include <cstdio>
#include <utility>

#include "core/error.h"
#include "imaging/following/box_flow.h"

namespace eyrie {
namespace {

std::string reasonOf(FollowEnd end, FrameIndex frame, double certainty) {
    const std::string where = "stopped at frame " + std::to_string(frame) + ": ";
    char share[16];
    std::snprintf(share, sizeof share, " (%.2f)", certainty);
    switch (end) {
        case FollowEnd::end_of_range:
            return "reached frame " + std::to_string(frame);
        case FollowEnd::left_image:
            return where + "it leaves the image";
        case FollowEnd::few_corners:
            return where + "hardly any corner of it could be tracked" + share;
        case FollowEnd::appearance:
            return where + "it does not look like the object any more" + share;
        case FollowEnd::jump:
            return where + "it would have jumped";
        case FollowEnd::no_picture:
            return where + "the frame could not be read";
        case FollowEnd::stopped:
            return where + "stopped by hand";
    }
    return where;
}

bool usable(const cv::Mat& gray) {
    return !gray.empty() && gray.type() == CV_8UC1;
}

}  // namespace

FollowResult followBox(const OrientedBox& box, FrameIndex start, FrameIndex last, const GrayFrames& gray,
                       const CameraMotion& camera, const FollowOptions& options, const FollowProgress& progress,
                       std::stop_token stop) {
    if (!(box.length >= 2) || !(box.width >= 2)) {
        throw Error(ErrorKind::parameter, "a box of less than 2 px cannot be followed; draw it larger");
    }
    FollowResult result;
    const auto finish = [&](FollowEnd end, FrameIndex frame, double certainty) {
        result.end = end;
        result.end_frame = frame;
        result.reason = reasonOf(end, frame, certainty);
        return result;
    };
    cv::Mat current = gray(start);
    if (!usable(current)) return finish(FollowEnd::no_picture, start, 0);
    if (areaInImage(box, current.size()) < 0.5 * box.area()) return finish(FollowEnd::left_image, start, 0);
    BoxFollower follower(box, current, options);
    std::vector<FollowedBox> hidden;  // since it was seen last
    std::optional<FollowEnd> why_hidden;
    const auto lost = [&] { return finish(*why_hidden, hidden.front().frame, hidden.front().certainty); };
    OrientedBox at = box;
    const int direction = last >= start ? 1 : -1;
    for (FrameIndex frame = start; frame != last;) {
        const FrameIndex target = frame + direction;
        if (stop.stop_requested()) return finish(FollowEnd::stopped, target, 0);
        const cv::Mat next = gray(target);
        if (!usable(next) || next.size() != current.size()) return finish(FollowEnd::no_picture, target, 0);
        auto map = camera.map(frame, target);
        if (!map) map = cameraAround(current, next, at);
        const BoxFollower::Step step = follower.advance(current, next, *map);
        if (areaInImage(step.box, next.size()) < 0.5 * step.box.area()) {
            return finish(FollowEnd::left_image, target, step.certainty);
        }
        const FollowedBox followed{target, step.box, step.certainty};
        if (step.hidden && hidden.size() < static_cast<std::size_t>(options.max_hidden_frames)) {
            if (hidden.empty()) why_hidden = step.end;
            hidden.push_back(followed);
        } else if (step.end) {
            return hidden.empty() ? finish(*step.end, target, step.certainty) : lost();
        } else {
            hidden.push_back(followed);
            for (const FollowedBox& each : std::exchange(hidden, {})) {
                result.boxes.push_back(each);
                if (progress) progress(each);
            }
        }
        at = step.box;
        current = next;
        frame = target;
    }
    return hidden.empty() ? finish(FollowEnd::end_of_range, last, 0) : lost();
}

}  // namespace eyrie

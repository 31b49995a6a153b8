#include "peer/difference_peer.h"

namespace eyrie {
namespace {

/// Frames that could not be registered are not held without end for a picture after them.
constexpr std::size_t kMostUnregistered = 50;

}  // namespace

DifferencePeer::Result DifferencePeer::followed(const std::vector<OrientedBox>& boxes) {
    Result done = std::move(waiting_.front());
    waiting_.pop_front();
    FrameResult& result = done.second;
    const Registration& registration = result.motion.registration;
    if (registration.state == RegistrationState::first) sort_.clear();
    result.tracks = sort_.next(boxes, registration.current_from_previous);
    for (const OrientedBox& box : boxes) {
        Detection detection;
        detection.box = box;
        detection.score = 1;
        result.detections.push_back(detection);
    }
    return done;
}

std::vector<DifferencePeer::Result> DifferencePeer::next(const Frame& frame, const FrameMotion& motion) {
    FrameResult result;
    result.motion = motion;
    waiting_.emplace_back(frame, std::move(result));
    std::vector<Result> done;
    if (const auto answer = boxes_.next(frame, motion.registration)) {
        while (!waiting_.empty() && waiting_.front().first.index < answer->frame) done.push_back(followed({}));
        if (!waiting_.empty() && waiting_.front().first.index == answer->frame) done.push_back(followed(answer->boxes));
    }
    while (waiting_.size() > static_cast<std::size_t>(2 * gap_) + kMostUnregistered) done.push_back(followed({}));
    return done;
}

std::vector<DifferencePeer::Result> DifferencePeer::finish() {
    std::vector<Result> done;
    while (!waiting_.empty()) done.push_back(followed({}));
    return done;
}

}  // namespace eyrie

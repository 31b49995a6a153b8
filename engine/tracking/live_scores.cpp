#include "tracking/live_scores.h"

#include <algorithm>
#include <cmath>

#include "core/state_archive.h"
#include "tracking/finishing/vehicle_looks.h"

namespace eyrie {
namespace {

constexpr std::size_t kMostWindows = 64;

}  // namespace

void LiveScores::addState(Known& known, const TrackState& state, FrameIndex frame) const {
    const bool stands = state.origin == StateOrigin::standing;
    // As a path keeps it, in single precision.
    const cv::Point2d at(PathBox(state.box).centre);
    for (Window& window : known.open) {
        ++window.states;
        window.ended_standing = stands;
        if (window.known)
            window.flow = flowMoments(window.begin, window.carried, at, std::max(1, frame - window.first));
        window.frames = frame - window.first;
    }
    while (!known.open.empty() && known.open.front().states == kFlowWindow) {
        if (known.open.front().counts()) known.closed.push_back(known.open.front().flow);
        known.open.pop_front();
    }
    while (known.closed.size() > kMostWindows) known.closed.pop_front();
    if (known.states % kFlowWindowStep == 0) {
        Window window;
        window.begin = window.carried = at;
        window.first = frame;
        window.from_start = known.states == 0;
        window.begun_standing = stands;
        known.open.push_back(window);
    }
    ++known.states;
    known.tally.states += stands ? 0 : 1;
    known.tally.detected += state.origin == StateOrigin::detected ? 1 : 0;
}

std::optional<FlowComparison> LiveScores::comparisonOf(const Known& known) {
    std::vector<FlowMoments> windows(known.closed.begin(), known.closed.end());
    for (const Window& window : known.open) {
        if (window.counts()) windows.push_back(window.flow);
    }
    return eyrie::comparisonOf(windows);
}

void LiveScores::judge(std::vector<TrackState>& tracks, const std::vector<Detection>& detections,
                       const FrameMotion& motion) {
    const Registration& registration = motion.registration;
    const bool cut = registration.state == RegistrationState::first;
    const std::vector<ClassifiedBox> classified = classifiedOf(detections);
    std::map<TrackId, Known> still;
    for (TrackState& state : tracks) {
        Known& known = still[state.id];
        if (const auto before = known_.find(state.id); before != known_.end()) known = std::move(before->second);
        for (Window& window : known.open) {
            window.carried = registration.current_from_previous.apply(window.carried);
            window.known = window.known && !cut && std::isfinite(window.carried.x) && std::isfinite(window.carried.y);
        }
        addState(known, state, motion.frame);
        if (state.origin == StateOrigin::detected) known.tally.looks.add(state.box, classified);
        state.score = evidenceOf(known.tally, comparisonOf(known), frame_rate_hz_).score;
    }
    known_ = std::move(still);
}

template <class Archive>
void LiveScores::Window::transfer(Archive& archive) {
    archive(begin, carried, first, states, frames, known, from_start, begun_standing, ended_standing, flow);
}

template <class Archive>
void LiveScores::Known::transfer(Archive& archive) {
    archive(tally.states, tally.detected, tally.looks.alike, tally.looks.looked_at, tally.looks.decision_sum, states,
            open, closed);
}

template <class Archive>
void LiveScores::transfer(Archive& archive) {
    archive(known_);
}

template void LiveScores::transfer(StateWriter&);
template void LiveScores::transfer(StateReader&);

}  // namespace eyrie

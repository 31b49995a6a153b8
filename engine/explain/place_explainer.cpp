#include "explain/place_explainer.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "tracking/tracker.h"

namespace eyrie {
namespace {

constexpr int kTrackFrames = 120;  ///< frames before over which tracks are followed anew: longer than most lapses

}  // namespace

PlaceExplainer::PlaceExplainer(ReplaySource source)
    : source_(std::move(source)), replay_(source_), window_(source_.options.registration, source_.scale) {}

bool PlaceExplainer::followTracks(FrameIndex frame, const std::stop_token& stop) {
    Tracker tracker(source_.options.tracking, source_.scale);
    const FrameIndex first = std::max(source_.first_frame, frame - kTrackFrames);
    TrackingTrace trace;
    for (FrameIndex f = first; f < frame; ++f) {
        if (stop.stop_requested()) return false;
        if (const auto stored = source_.result_of(f))
            tracker.next(stored->motion, stored->detections, nullptr, [&] { return source_.pixels(f).gray; });
    }
    evidence_.unfinished = tracker.next(evidence_.result.motion, evidence_.result.detections, &trace,
                                        [&] { return source_.pixels(frame).gray; });
    evidence_.tracking = std::move(trace);
    return true;
}

bool PlaceExplainer::gather(FrameIndex frame, const std::stop_token& stop) {
    if (gathered_ == frame) return true;
    gathered_.reset();
    const auto stored = source_.result_of(frame);
    if (!stored) throw Error(ErrorKind::project, "the run has not processed frame " + std::to_string(frame));
    const ReplayedFrame* replayed = replay_.at(frame, stop);
    if (replayed == nullptr) return false;
    evidence_ = {};
    evidence_.result = replayed->result;
    evidence_.result.tracks = stored->tracks;
    evidence_.result.dropped = stored->dropped;
    if (source_.evidence_of) {
        const auto judge = [&](TrackId track) {
            if (const auto judged = source_.evidence_of(track)) evidence_.judged[track] = *judged;
        };
        for (const TrackState& track : stored->tracks) judge(track.id);
        for (const DroppedState& dropped : stored->dropped) {
            if (dropped.why != TrackDrop::unconfirmed) judge(dropped.id);
        }
    }
    if (source_.shadow_of) evidence_.shadow = source_.shadow_of(frame);
    if (source_.trim_of) {
        for (const TrackState& track : stored->tracks) {
            if (const auto trim = source_.trim_of(track.id)) evidence_.trims[track.id] = *trim;
        }
    }
    evidence_.clustering = replay_.clustering();
    evidence_.removal = replay_.removal();
    const int reach = MotionWindow::reachFor(source_.options.motion, source_.scale);
    if (!window_.cover(std::max(0, frame - reach), frame, source_.pixels, stop)) return false;
    CornerVerdicts verdicts;
    window_.motions(source_.options.motion, 1, &verdicts);
    if (!verdicts.empty()) evidence_.corners = std::move(verdicts);
    if (!followTracks(frame, stop)) return false;
    gathered_ = frame;
    return true;
}

std::optional<Explanation> PlaceExplainer::explain(FrameIndex frame, const OrientedBox& area,
                                                   const std::stop_token& stop) {
    if (!gather(frame, stop)) return std::nullopt;
    evidence_.area = area;
    evidence_.searches.clear();
    const auto& searched = evidence_.result.rois;  // around each cluster
    for (std::size_t k = 0; k < searched.size(); ++k) {
        if (intersectionArea(searched[k], area) <= 0 && !searched[k].contains(area.centre)) continue;
        if (stop.stop_requested()) return std::nullopt;
        for (SearchTrace& search : replay_.trace(static_cast<int>(k))) evidence_.searches.push_back(std::move(search));
    }
    return eyrie::explain(evidence_, source_.options, source_.scale);
}

}  // namespace eyrie

#include "rerun/method_run.h"

#include <algorithm>
#include <chrono>
#include <optional>

#include "chain/chain.h"
#include "chain/recording/classified_vehicles.h"
#include "core/error.h"
#include "core/labels/result_box.h"
#include "core/stopwatch.h"
#include "detection/sliding_window/global_sliding_window.h"
#include "detection/sliding_window/model_location.h"
#include "peer/difference_peer.h"

namespace eyrie {
namespace {

/// A frame and what a method found in it.
using Found = std::pair<Frame, std::shared_ptr<const FrameResult>>;

/// One method at work.
class Method {
 public:
    Method(const MethodVariant& variant, const SceneScale& scale) : variant_(variant), scale_(scale) {
        result_.name = variant.name;
        if (variant.peer) {
            peer_.emplace(*variant.peer);
        } else if (variant.global_window) {
            scanner_.emplace(loadModel(modelLocation(variant.options.detection.sliding_window.model)));
        } else {
            half_.emplace(variant.options, scale);
        }
    }

    /// What is done; the peer's results come late.
    std::vector<Found> next(const Frame& frame, const FrameMotion& motion) {
        if (peer_) {
            StageTimes times{};
            std::vector<DifferencePeer::Result> done;
            {
                const Stopwatch watch(times, Stage::detection);
                done = peer_->next(frame, motion);
            }
            return kept(std::move(done), times);
        }
        auto found = std::make_shared<FrameResult>();
        if (half_) {
            *found = half_->next(frame, motion, {});
        } else {
            found->motion = motion;
            const Stopwatch watch(found->stage_ms, Stage::detection);
            found->detections = globalSlidingWindow(*scanner_, frame.gray, variant_.options.detection.sliding_window,
                                                    scale_.zoomed(motion.registration.zoom));
        }
        keep(*found);
        return {{frame, found}};
    }

    /// What is left when no more frames come.
    std::vector<Found> rest() { return peer_ ? kept(peer_->finish(), {}) : std::vector<Found>{}; }

    MethodResult finish(const std::vector<FrameMotionSummary>& motions, const VectorsByFrame& vectors) {
        for (const auto& [frame, state] :
             finishTracks(states_, motions, variant_.options.finishing, scale_,
                          {vectorsIn(vectors), classifiedVehicles(variant_.options, classifiedIn(classified_))})) {
            result_.tracks[frame].push_back(boxOf(frame, state));
        }
        nameClasses(result_.tracks, GroundMotion(motions).zooming(scale_), variant_.options.classes);
        for (std::size_t stage = 0; stage < result_.median_ms.size() && !times_.empty(); ++stage) {
            std::vector<float> values;
            for (const StageTimes& times : times_) values.push_back(times[stage]);
            const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
            std::nth_element(values.begin(), middle, values.end());
            result_.median_ms[stage] = *middle;
        }
        return std::move(result_);
    }

 private:
    void keep(const FrameResult& found) {
        for (const Detection& detection : found.detections) {
            if (detection.rejection != Rejection::none) continue;
            result_.detections[found.motion.frame].push_back(boxOf(found.motion.frame, detection));
        }
        for (const TrackState& state : found.tracks) states_.emplace_back(found.motion.frame, state);
        classified_[found.motion.frame] = classifiedOf(found.detections);
        times_.push_back(found.stage_ms);
    }

    std::vector<Found> kept(std::vector<DifferencePeer::Result>&& results, const StageTimes& times) {
        std::vector<Found> all;
        for (auto& [frame, result] : results) {
            result.stage_ms = times;
            keep(result);
            all.emplace_back(frame, std::make_shared<FrameResult>(std::move(result)));
        }
        return all;
    }

    MethodVariant variant_;
    SceneScale scale_;
    std::optional<TrackHalf> half_;
    std::optional<WindowScanner> scanner_;
    std::optional<DifferencePeer> peer_;
    MethodResult result_;
    std::vector<TimedState> states_;
    ClassifiedByFrame classified_;
    std::vector<StageTimes> times_;
};

}  // namespace

std::vector<MethodResult> runMethods(FrameSource& source, FrameRange range, const std::vector<MethodVariant>& methods,
                                     const SceneScale& scale, const std::stop_token& stop,
                                     const std::function<void(const RunProgress&)>& progress,
                                     const MethodFrameObserver& observer) {
    if (methods.empty()) throw Error(ErrorKind::parameter, "there is no method to compare");
    const int count = source.info().frame_count;
    const FrameIndex last = range.last < 0 ? count - 1 : range.last;
    if (range.first < 0 || last >= count || range.first > last) {
        throw Error(ErrorKind::parameter, "frames " + std::to_string(range.first) + " to " + std::to_string(last) +
                                              " are not in " + source.info().path.string() +
                                              ", which has frames 0 to " + std::to_string(count - 1));
    }
    MotionHalf motion_half(methods.front().options, scale);
    std::vector<Method> running;
    running.reserve(methods.size());
    for (const MethodVariant& method : methods) running.emplace_back(method, scale);
    std::vector<FrameMotionSummary> motions;
    VectorsByFrame vectors;
    RunProgress state;
    state.frames_total = last - range.first + 1;
    const auto tell = [&](std::size_t method, const std::vector<Found>& results) {
        for (const auto& [frame, result] : results) observer(method, result, frame);
    };
    const auto start = std::chrono::steady_clock::now();
    for (FrameIndex index = range.first; index <= last && !stop.stop_requested(); ++index) {
        const Frame frame = source.read(index, false);
        StageTimes times{};
        const FrameMotion motion = motion_half.next(frame, times);
        motions.push_back({motion.frame, motion.registration, motion.image_size});
        vectors[motion.frame] = motion.motion_vectors;
        for (std::size_t i = 0; i < running.size(); ++i) {
            const auto found = running[i].next(frame, motion);
            if (observer) tell(i, found);
        }
        if (!progress) continue;
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        ++state.frames_done;
        state.frames_per_second = state.frames_done / std::max(seconds, 1e-9);
        state.seconds_left = (state.frames_total - state.frames_done) / state.frames_per_second;
        progress(state);
    }
    for (std::size_t i = 0; i < running.size(); ++i) {
        const auto found = running[i].rest();
        if (observer) tell(i, found);
    }
    std::vector<MethodResult> results;
    for (Method& method : running) results.push_back(method.finish(motions, vectors));
    return results;
}

}  // namespace eyrie

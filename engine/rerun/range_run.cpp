#include "rerun/range_run.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "chain/chain.h"
#include "chain/parameter_stage.h"
#include "chain/recording/classified_vehicles.h"
#include "core/labels/result_box.h"
#include "tracking/finishing/track_finishing.h"

namespace eyrie {
namespace {

constexpr int kLeadFrames = 40;  ///< for tracks to be confirmed and their filters to settle

/// What does one frame after the other: the whole chain, all behind motion vectors, or tracking alone.
class Worker {
 public:
    Worker(const ReplaySource& source, const ChainOptions& options, ChainStage start, FrameIndex first)
        : source_(source), start_(start), options_(options) {
        if (start_ >= ChainStage::tracking) {
            tracker_.emplace(options.tracking, source.scale);
            return;
        }
        half_.emplace(options, source.scale);
        if (start_ <= ChainStage::motion) motion_half_.emplace(options, source.scale, source.scale.zoom.at(first));
    }

    /// Nothing when the run has no such frame.
    std::optional<FrameResult> next(FrameIndex frame) {
        std::optional<FrameResult> stored = source_.result_of(frame);
        if (!stored) return std::nullopt;
        if (tracker_) {
            stored->tracks =
                tracker_->next(stored->motion, stored->detections, nullptr, [&] { return source_.pixels(frame).gray; });
            return stored;
        }
        const Frame pixels = source_.pixels(frame);
        StageTimes times{};
        FrameMotion motion = motion_half_ ? motion_half_->next(pixels, times) : std::move(stored->motion);
        return half_->next(pixels, std::move(motion), times);
    }

 private:
    const ReplaySource& source_;
    ChainStage start_;
    const ChainOptions& options_;
    std::optional<MotionHalf> motion_half_;
    std::optional<TrackHalf> half_;
    std::optional<Tracker> tracker_;
};

}  // namespace

std::optional<RangeResult> runRange(const ReplaySource& source, const ChainOptions& options, FrameRange range,
                                    const std::stop_token& stop, const OnRangeFrame& on_frame) {
    RangeResult result;
    result.start = firstDifference(source.options, options);
    result.scale = source.scale;
    result.classes = options.classes;
    const FrameIndex wanted = std::max(source.first_frame, range.first);
    const FrameIndex begin = std::max(source.first_frame, wanted - std::max(kLeadFrames, framesBefore(options)));
    const int total = std::max(0, range.last - begin + 1);
    result.exact = begin == source.first_frame;
    Worker worker(source, options, result.start, begin);
    std::vector<TimedState> states;
    std::vector<FrameMotionSummary> motions;
    VectorsByFrame vectors;
    ClassifiedByFrame classified;
    std::map<FrameIndex, std::shared_ptr<const FrameResult>> frames;
    for (FrameIndex frame = begin; frame <= range.last; ++frame) {
        if (stop.stop_requested()) return std::nullopt;
        std::optional<FrameResult> done = worker.next(frame);
        if (!done) break;
        for (const TrackState& state : done->tracks) states.emplace_back(frame, state);
        motions.push_back({frame, done->motion.registration, done->motion.image_size});
        vectors[frame] = done->motion.motion_vectors;
        classified[frame] = classifiedOf(done->detections);
        std::shared_ptr<const FrameResult> kept;
        if (frame >= wanted) kept = frames[frame] = std::make_shared<const FrameResult>(std::move(*done));
        if (on_frame) on_frame(kept, frame - begin + 1, total);
    }
    std::map<FrameIndex, std::vector<TrackState>> tracks;
    for (const auto& [frame, state] :
         finishTracks(states, motions, options.finishing, source.scale,
                      {vectorsIn(vectors), classifiedVehicles(options, classifiedIn(classified))})) {
        tracks[frame].push_back(state);
    }
    for (auto& [frame, done] : frames) {  // shared with whoever was told of it, so a copy is changed
        auto finished = std::make_shared<FrameResult>(*done);
        finished->tracks = std::move(tracks[frame]);
        done = std::move(finished);
    }
    result.frames = std::move(frames);
    result.scale = GroundMotion(motions).zooming(source.scale);
    return result;
}

BoxesByFrame trackBoxesOf(const RangeResult& result) {
    BoxesByFrame boxes;
    for (const auto& [frame, found] : result.frames) {
        for (const TrackState& state : found->tracks) boxes[frame].push_back(boxOf(frame, state));
    }
    nameClasses(boxes, result.scale, result.classes);
    return boxes;
}

BoxesByFrame detectionBoxesOf(const RangeResult& result) {
    BoxesByFrame boxes;
    for (const auto& [frame, found] : result.frames) {
        for (const Detection& detection : found->detections) {
            if (detection.rejection == Rejection::none) boxes[frame].push_back(boxOf(frame, detection));
        }
    }
    return boxes;
}

}  // namespace eyrie

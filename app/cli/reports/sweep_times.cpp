#include "cli/reports/sweep_times.h"

#include <algorithm>
#include <chrono>

#include "rerun/replay.h"
#include "sweep/sweep_runner.h"

namespace eyrie::cli {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Pictures that are in memory already.
class HeldFrames : public FrameSource {
 public:
    explicit HeldFrames(const std::vector<Frame>& frames) : frames_(frames) {
        info_.path = "bench";
        info_.size = frames.front().gray.size();
        info_.frame_count = static_cast<int>(frames.size());
    }
    const VideoInfo& info() const override { return info_; }
    Frame read(FrameIndex index, bool) override { return frames_.at(static_cast<std::size_t>(index)); }
    std::int64_t timeOf(FrameIndex index) const override { return frames_.at(static_cast<std::size_t>(index)).time_us; }

 private:
    const std::vector<Frame>& frames_;
    VideoInfo info_;
};

/// A clip with a sweep over it.
class TimedClip {
 public:
    TimedClip(const std::vector<Frame>& frames, const ChainOptions& options, const SceneScale& scale)
        : open_([&frames] { return std::make_unique<HeldFrames>(frames); }), options_(options), scale_(scale) {
        plan_.base = parameterValues(options);
        SweepClip clip;
        clip.size = frames.front().gray.size();
        clip.last_frame = static_cast<int>(frames.size()) - 1;
        clip.scale = scale;
        plan_.clips.push_back(clip);
        inputs_.resize(1);
        forget();
        inputs_[0].scoring.truth.boxes = *inputs_[0].cache->run(options, {})->tracks;
    }
    void forget() { inputs_[0].cache = std::make_unique<StageCache>(open_, FrameRange{}, scale_); }
    /// Seconds for all values of a parameter.
    double sweep(const std::string& axis) {
        plan_.axes = {parseAxis(axis, options_)};
        const auto start = Clock::now();
        runSweep(plan_, inputs_, workOrder(plan_), {}, {});
        return secondsSince(start);
    }
    int points() const { return plan_.pointCount(); }

 private:
    ClipFrames::Open open_;
    ChainOptions options_;
    SceneScale scale_;
    SweepPlan plan_;
    std::vector<SweepInput> inputs_;
};

double previewMs(const std::vector<Frame>& frames, ChainOptions options, const SceneScale& scale) {
    std::vector<FrameMotion> motions;
    MotionHalf half(options, scale);
    for (const Frame& frame : frames) {
        StageTimes times{};
        motions.push_back(half.next(frame, times));
    }
    const auto last = static_cast<FrameIndex>(frames.size()) - 1;
    std::vector<double> ms;
    for (int i = 0; i < 21; ++i) {
        options.detection.gradient.quantile = 0.1 + 0.02 * i;
        const auto start = Clock::now();
        Replay replay({options, scale, 0, [&](FrameIndex at) { return frames[static_cast<std::size_t>(at)]; },
                       [&](FrameIndex at) { return std::optional(motions[static_cast<std::size_t>(at)]); }});
        replay.at(last, {});
        ms.push_back(1000 * secondsSince(start));
    }
    std::nth_element(ms.begin(), ms.begin() + 10, ms.end());
    return ms[10];
}

}  // namespace

SweepTimes measureSweep(const std::vector<Frame>& frames, ChainOptions options, const SceneScale& scale) {
    options.detection.method = DetectionMethod::gradient;
    SweepTimes times;
    times.frames = static_cast<int>(frames.size());
    TimedClip clip(frames, options, scale);
    clip.forget();
    times.run_s = clip.sweep("gradient.quantile=0.35");
    clip.forget();
    times.sweep_s = clip.sweep("gradient.quantile=0.05:0.01:0.5");
    times.sweep_points = clip.points();
    clip.sweep("gradient.quantile=0.35");
    times.clustering_s = clip.sweep("clustering.along=3");
    times.removal_s = clip.sweep("outliers.min_vectors=5");
    times.tracking_s = clip.sweep("tracking.min_overlap=0.3");
    times.preview_ms = previewMs(frames, options, scale);
    return times;
}

}  // namespace eyrie::cli

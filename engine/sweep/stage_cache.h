#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <stop_token>
#include <vector>

#include "chain/chain_options.h"
#include "chain/parameter_stage.h"
#include "core/labels/box_record.h"
#include "core/memo.h"
#include "core/values/frame_result.h"
#include "sweep/area_table.h"
#include "sweep/clip_frames.h"
#include "tracking/finishing/track_finishing.h"

namespace eyrie {

/// What the chain finds in a clip. Parts are shared between results that agree in them.
struct ClipResult {
    std::shared_ptr<const BoxesByFrame> detections;  ///< kept ones, without ids
    std::shared_ptr<const BoxesByFrame> tracks;      ///< finished
};

/// What a cache may keep and use.
struct StageCacheOptions {
    std::size_t frame_bytes = std::size_t{1} << 31U;  ///< frames kept in memory
    std::size_t area_bytes = std::size_t{1} << 30U;   ///< what detectors prepared, kept in memory
    /// False: everything is done on the thread that asks, at its priority, for work behind a window.
    bool all_cores = true;
    /// Whether it was looked, when the scale was chosen, how it changes over the picture (view.oblique). Where not,
    /// that is done for points that ask for it; points that do not have a scale that is the same everywhere.
    bool looked_for_slope = true;
    /// How that is done; slopeFor() where nothing is given.
    std::function<ScaleSlope(const ChainOptions& options, const std::stop_token& stop)> look_for_slope = {};
};

/// Runs the chain over one clip again and again with changed parameters. Each time only what lies behind the first
/// changed parameter is done, and of that only what is not known from before: motion vectors of the clip, clusters,
/// detections of search areas that did not change, what a detector prepared in them. Results are those of ChainRun to
/// the last bit. Several threads may ask for results at once and share what they have in common; one alone uses all
/// cores.
class StageCache {
 public:
    /// Throws Error(parameter) for a range outside the video, Error(input) when it cannot be opened.
    StageCache(ClipFrames::Open open, FrameRange range, const SceneScale& scale, StageCacheOptions options = {});

    /// Motion vectors of a stored run over exactly these frames, made with `options`: used instead of computing them.
    void useStoredMotion(const ChainOptions& options, std::vector<FrameMotion> motion);

    /// Told while a stage works through the frames of the clip one by one; from any thread, must be quick. Not to be
    /// changed while run() works.
    using Progress = std::function<void(ChainStage stage, int done, int total)>;
    void tellProgress(Progress progress) { progress_ = std::move(progress); }

    /// Nothing when `stop` was requested meanwhile. Throws Error(input | parameter).
    std::optional<ClipResult> run(const ChainOptions& options, const std::stop_token& stop);

    const ClipFrames& frames() const { return frames_; }
    /// How often each stage was computed for the whole clip so far.
    int timesComputed(ChainStage stage) const { return computed_[static_cast<std::size_t>(stage)]; }
    /// Search areas in which a detector worked, and those whose detections were known already.
    long areasSearched() const { return areas_searched_; }
    long areasKnown() const { return areas_known_; }

 private:
    using Motion = std::vector<FrameMotion>;
    using Clusters = std::vector<std::vector<MotionCluster>>;
    using Detections = std::vector<std::vector<Detection>>;
    struct Prepared;
    struct Detected {
        Detections frames;   ///< kept and rejected ones
        BoxesByFrame boxes;  ///< kept ones
    };

    /// What is to be found: with which parameters, and at which scale a run with them works.
    struct Point {
        const ChainOptions& options;
        const SceneScale& scale;
        const std::stop_token& stop;
    };

    SceneScale scaleFor(const ChainOptions& options, const std::stop_token& stop);
    std::shared_ptr<const Motion> motion(const Point& point);
    std::shared_ptr<const Clusters> clusters(const Point& point, const Motion& motion);
    std::shared_ptr<const Detections> found(const Point& point, const Motion& motion);
    std::shared_ptr<const Detected> detected(const Point& point, const Motion& motion);
    std::shared_ptr<const std::vector<TimedState>> states(const Point& point, const Motion& motion,
                                                          const Detections& detections);
    std::shared_ptr<const BoxesByFrame> tracks(const Point& point, const Motion& motion, const Detections& detections,
                                               const std::vector<TimedState>& states);

    std::shared_ptr<Motion> computeMotion(const Point& point);
    std::shared_ptr<Clusters> differenceClusters(const Point& point, const Motion& motion);
    Detections detectionsByStacks(const Point& point, const Motion& motion);
    void forFrames(const std::stop_token& stop,
                   const std::function<void(std::size_t, ClipFrames::Reader&)>& work) const;
    void tell(ChainStage stage, int done) const;
    void count(ChainStage stage) { ++computed_[static_cast<std::size_t>(stage)]; }

    ClipFrames frames_;
    SceneScale scale_;
    StageCacheOptions options_;
    Progress progress_;
    Memo<ScaleSlope> slopes_{32};
    Memo<Motion> motion_{2};
    Memo<Clusters> clusters_{6};
    Memo<AreaTable<Prepared>> prepared_{2};
    Memo<AreaTable<std::vector<Detection>>> areas_{8};
    Memo<Detections> found_{6};
    Memo<Detected> detected_{6};
    Memo<std::vector<TimedState>> states_{6};
    Memo<BoxesByFrame> tracks_{6};
    std::array<std::atomic<int>, kChainStageCount> computed_{};
    std::atomic<long> areas_searched_{0};
    std::atomic<long> areas_known_{0};
};

}  // namespace eyrie

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "chain/chain_run.h"
#include "chain/recording/run_pictures.h"
#include "chain/recording/run_resume.h"
#include "store/details/recording_options.h"
#include "store/runs/result_writer.h"
#include "store/runs/run_store.h"

namespace eyrie {

/// Stores a run while it goes on: every frame as it comes, and at the end the finished tracks. Command line and window
/// record through it, so that a run means the same in both. Used on the run's thread.
class RunRecorder : public ChainObserver {
 public:
    /// Creates the project when it does not exist, and a run in it. `run` needs sequence, scale, preset, name and
    /// planned frames. `also`, if given, sees every frame after it was stored; it must outlive the recorder.
    /// `recording`: what of each frame is kept; a run that is gone on with keeps to what was said at its beginning.
    /// `may_add`: as ResultWriter takes it.
    RunRecorder(const std::filesystem::path& project, RunRecord run, const ChainOptions& options,
                ChainObserver* also = nullptr, const RecordingOptions& recording = {}, const MayAddRun& may_add = {});
    /// Goes on with a run that ended early: its frames stay until each is done again.
    RunRecorder(const std::filesystem::path& project, const ResumedRun& resumed, ChainObserver* also = nullptr);

    /// Holds the pictures of a short run for `finish` with its source, which then reads none of them again.
    void holdPictures();

    void onFrame(const std::shared_ptr<const FrameResult>& result, const Frame& frame) override;
    void onProgress(const RunProgress& progress) override;
    std::optional<StateKeeping> stateKeeping() const override { return StateKeeping{}; }
    void onState(const ChainState& state) override;

    int runId() const { return writer_.runId(); }
    /// Median time that storing a frame took; 0 before the first.
    float medianStoreMs() const;
    /// Finishes the tracks (see finishRun), closes the run with the summary's outcome and returns its record.
    /// `source`: where the pictures of the run can be read once more; null where they cannot. A stop meanwhile leaves a
    /// stopped run, as one during the run does.
    RunRecord finish(const RunSummary& summary, FrameSource* source = nullptr, std::stop_token stop = {});

 private:
    std::filesystem::path project_;
    ChainOptions options_;
    SceneScale scale_;
    FrameRange range_;
    RunPictures pictures_;
    ResultWriter writer_;
    ChainObserver* also_;
    cv::Size image_size_;
    PictureMask graphics_;         ///< as far as it was known at last
    std::vector<float> store_ms_;  ///< of every frame
};

/// Version of the engine as stored with every run, e.g. "0.1.0".
std::string engineVersion();

/// The record of a run to be made: sequence from the source, scale, planned frames. Whoever knows more of the scale
/// than it tells itself sets `scale_basis`.
RunRecord plannedRun(const VideoInfo& video, const SceneScale& scale, FrameRange range, const std::string& preset);

/// The scale of a run: `gsd_m_per_px` ≤ 0 means not given; then the source may know it, else a value is assumed.
SceneScale sceneScale(const VideoInfo& video, double gsd_m_per_px);

}  // namespace eyrie

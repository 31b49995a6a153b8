#include "chain/live/live_run.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>

#include "chain/recording/chain_state.h"
#include "chain/recording/run_recorder.h"
#include "io/tables/number_text.h"
#include "store/runs/run_end.h"

namespace eyrie {
namespace {

constexpr double kBehind = 0.5;       ///< share of the waiting frames from which fewer corners are taken
constexpr double kInPace = 0.1;       ///< and below which the chain keeps pace again …
constexpr double kPaceBefore_s = 20;  ///< … for so long, before all corners are taken again; longer every time
constexpr double kFewer = 1.5;        ///< by which corners lie farther apart: less than half of them
constexpr auto kEndEvery = std::chrono::seconds(2);

/// A live source whose reader, the first half of the chain, is made lighter while it is behind. Reading happens on the
/// thread of that half, so that it may be exchanged between two frames.
class LighterReading : public FrameSource {
 public:
    LighterReading(LiveStream& stream, const ChainOptions& options, const SceneScale& scale,
                   std::shared_ptr<ChainProgress> progress)
        : stream_(stream), options_(options), scale_(scale), progress_(std::move(progress)) {}

    const VideoInfo& info() const override { return stream_.info(); }
    std::int64_t timeOf(FrameIndex index) const override { return stream_.timeOf(index); }
    Frame read(FrameIndex index, bool with_colour) override {
        const double backlog = stream_.backlog();
        if (!lighter_ && backlog > kBehind) exchange(true);
        if (backlog > kInPace) in_pace_ = 0;
        if (lighter_ && ++in_pace_ > kPaceBefore_s * patience_ * info().frame_rate_hz) {
            exchange(false);
            patience_ *= 2;
        }
        Frame frame = stream_.read(index, with_colour);
        if (lighter_) ++fewer_corners_;
        last_ = frame;
        return frame;
    }
    int fewerCorners() const { return fewer_corners_; }

 private:
    /// The new half knows the last picture, so that the next one is registered onto it.
    void exchange(bool lighter) {
        lighter_ = lighter;
        in_pace_ = 0;
        MotionHalf half(lighter ? withFewerCorners(options_) : options_, scale_);
        StageTimes times{};
        if (!last_.gray.empty()) half.next(last_, times);
        progress_->motion_half = std::move(half);
    }

    LiveStream& stream_;
    const ChainOptions& options_;
    SceneScale scale_;
    std::shared_ptr<ChainProgress> progress_;
    Frame last_;
    bool lighter_ = false;
    double in_pace_ = 0;
    double patience_ = 1;
    std::atomic<int> fewer_corners_{0};
};

/// Records, and tells the project how far the run has come. Keeps no states: a live source cannot be read again.
class LiveRecorder : public ChainObserver {
 public:
    LiveRecorder(RunRecorder& recorder, const std::filesystem::path& project)
        : recorder_(recorder), project_(ProjectFile::open(project)) {}
    void onFrame(const std::shared_ptr<const FrameResult>& result, const Frame& frame) override {
        recorder_.onFrame(result, frame);
        last_ = frame.index;
        const auto now = std::chrono::steady_clock::now();
        if (now - told_ < kEndEvery) return;
        told_ = now;
        tellEnd();
    }
    void onProgress(const RunProgress& progress) override { recorder_.onProgress(progress); }
    void tellEnd() {
        if (last_ >= 0) setEnd(project_, recorder_.runId(), last_);
    }
    void tellRemark(const std::string& remark) {
        if (!remark.empty()) setRemark(project_, recorder_.runId(), remark);
    }

 private:
    RunRecorder& recorder_;
    ProjectFile project_;
    FrameIndex last_ = -1;
    std::chrono::steady_clock::time_point told_{};
};

}  // namespace

std::string LiveLoad::text() const {
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
    const std::string of = " of " + std::to_string(facts.frames) + " frames ";
    if (facts.skipped > 0) add(std::to_string(facts.skipped) + of + "left out, since the chain was behind");
    if (fewer_corners > 0) add(std::to_string(fewer_corners) + of + "with fewer corners");
    if (facts.reconnects > 0)
        add("connected again " + std::to_string(facts.reconnects) + "×, longest gap " +
            fixedText(facts.longest_gap_s, 1) + " s");
    if (!facts.ended.empty()) add("ended: " + facts.ended);
    return text;
}

ChainOptions withFewerCorners(ChainOptions options) {
    options.registration.corners.corner_spacing_m *= kFewer;
    return options;
}

LiveRunResult runLive(LiveStream& stream, const std::filesystem::path& project, const RunRecord& planned,
                      const ChainOptions& options, ChainObserver* also, const RecordingOptions& recording) {
    LiveRunResult result;
    RunRecorder recorder(project, planned, options, also, recording);
    LiveRecorder live(recorder, project);
    RunStart start{std::make_shared<ChainProgress>(options, planned.scale), 0};
    LighterReading source(stream, options, planned.scale, start.progress);
    RunSummary& summary = result.summary;
    // Whoever wants it to end ends the stream: what came before is still worked on.
    summary = ChainRun(options, planned.scale).run(source, {}, live, {}, false, start);
    stream.finish();
    if (summary.outcome == RunOutcome::stopped) summary.outcome = RunOutcome::finished;
    summary.frames_total = summary.frames_done;
    result.load = {stream.facts(), source.fewerCorners()};
    summary.median_ms[static_cast<std::size_t>(Stage::store)] = recorder.medianStoreMs();
    recorder.finish(summary);
    live.tellEnd();
    if (summary.outcome == RunOutcome::finished) live.tellRemark(result.load.text());
    ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
    result.record = RunStore(file).run(recorder.runId()).value();
    return result;
}

}  // namespace eyrie

#include "chain/live/live_run.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "chain/live/chain_pace.h"
#include "chain/live/read_ahead.h"
#include "chain/recording/chain_state.h"
#include "chain/recording/run_recorder.h"
#include "chain/scale/scale_estimation.h"
#include "chain/scale/scale_trial.h"
#include "core/error.h"
#include "core/project_name.h"
#include "core/time/utc_time.h"
#include "io/live/live_address.h"
#include "io/output_files.h"
#include "io/tables/number_text.h"
#include "metadata/metadata_scale.h"
#include "store/backup/database_copy.h"

namespace eyrie {
namespace {

constexpr double kFewer = 1.5;  ///< by which corners lie farther apart: less than half of them

/// A live source whose reader, the first half of the chain, is made lighter while it is behind. Reading happens on the
/// thread of that half, so that it may be exchanged between two frames.
class LighterReading : public FrameSource {
 public:
    LighterReading(LiveStream& stream, const ChainOptions& options)
        : stream_(stream), ahead_(stream), options_(options) {}

    /// The first frames, to be looked at before begin().
    std::unique_ptr<FrameSource> first(int frames) { return ahead_.first(frames); }
    /// Before the first frame is read.
    void begin(const SceneScale& scale, std::shared_ptr<ChainProgress> progress) {
        scale_ = scale;
        progress_ = std::move(progress);
    }

    const VideoInfo& info() const override { return stream_.info(); }
    std::int64_t timeOf(FrameIndex index) const override { return stream_.timeOf(index); }
    Frame read(FrameIndex index, bool with_colour) override {
        const bool lighter = pace_.isLighter(stream_.backlog());
        if (lighter != lighter_) exchange(lighter);
        Frame frame = ahead_.read(index, with_colour);
        ++frames_read_;
        if (lighter_) ++fewer_corners_;
        last_ = frame;
        return frame;
    }
    // From any thread:
    int fewerCorners() const { return fewer_corners_; }
    int framesRead() const { return frames_read_; }
    bool lighter() const { return lighter_; }

 private:
    /// The new half knows the last picture, so that the next one is registered onto it.
    void exchange(bool lighter) {
        lighter_ = lighter;
        MotionHalf half(lighter ? withFewerCorners(options_) : options_, scale_);
        StageTimes times{};
        if (!last_.gray.empty()) half.next(last_, times);
        progress_->motion_half = std::move(half);
    }

    LiveStream& stream_;
    ReadAhead ahead_;
    const ChainOptions& options_;
    SceneScale scale_;
    std::shared_ptr<ChainProgress> progress_;
    Frame last_;
    ChainPace pace_{stream_.info().frame_rate_hz};
    std::atomic<bool> lighter_{false};
    std::atomic<int> fewer_corners_{0};
    std::atomic<int> frames_read_{0};
};

/// Records without states: a live source cannot be read again.
class LiveRecorder : public ChainObserver {
 public:
    explicit LiveRecorder(RunRecorder& recorder) : recorder_(recorder) {}
    void onFrame(const std::shared_ptr<const FrameResult>& result, const Frame& frame) override {
        recorder_.onFrame(result, frame);
    }
    void onProgress(const RunProgress& progress) override { recorder_.onProgress(progress); }

 private:
    RunRecorder& recorder_;
};

/// Takes a project away again that was made for a run which then did not begin.
class ProjectOfRun {
 public:
    explicit ProjectOfRun(std::filesystem::path project)
        : project_(std::move(project)), is_new_(!std::filesystem::exists(std::filesystem::symlink_status(project_))) {}
    ~ProjectOfRun() {
        if (is_new_ && !isUsed()) removeDatabase(project_);
    }
    ProjectOfRun(const ProjectOfRun&) = delete;
    ProjectOfRun& operator=(const ProjectOfRun&) = delete;

 private:
    bool isUsed() const {
        try {
            ProjectFile file = ProjectFile::open(project_, ProjectFile::Mode::read_only);
            const std::vector<RunRecord> runs = RunStore(file).runs();
            return std::any_of(runs.begin(), runs.end(),
                               [](const RunRecord& run) { return run.frames_done > 0 || run.live; });
        } catch (const Error&) {
            return true;  // what cannot be read is left to whoever looks for the cause
        }
    }
    std::filesystem::path project_;
    bool is_new_;
};

}  // namespace

std::string LiveLoad::text() const {
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
    const std::string of = " of " + std::to_string(facts.frames) + " frames ";
    if (left_out_for_scale > 0)
        add(std::to_string(left_out_for_scale) + of + "left out while the scale was looked for");
    if (facts.skipped > left_out_for_scale)
        add(std::to_string(facts.skipped - left_out_for_scale) + of + "left out, since the chain was behind");
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

/// What a live run is made of.
struct LiveRun::Parts {
    Parts(LiveRequest wanted, std::stop_token wanted_stop)
        : request(withRecording(std::move(wanted))),
          made(request.project),
          stop(std::move(wanted_stop)),
          stream(request.address, request.stream, stop),
          source(stream, request.options) {}

    /// What the metadata say that were recorded so far, where nobody gave a scale.
    StatedScale statedSoFar() const {
        if (request.gsd_m_per_px > 0) return {request.gsd_m_per_px, ScaleOrigin::given, {}};
        try {
            const auto recorded = openSource(request.stream.recording, {}, {}, stop);
            return statedScale(*recorded, 0, -1, 0, ScaleOrigin::given, stop);
        } catch (const Error&) {
            return {};  // too little was recorded to be read; the recording as a whole is read when the run has ended
        }
    }

    /// Looks at the first pictures for what is not known of the scale. Frames that come meanwhile are left out of the
    /// run once no more can wait.
    ChosenScale chooseScaleOf(ChainObserver* also) {
        const auto told = [&](const RunProgress& progress) {
            if (also != nullptr) also->onProgress(progress);
        };
        const auto first = source.first(kFramesOfLook);
        ChosenScale chosen = chooseScale(*first, {}, request.options, statedSoFar(), stop, told);
        left_out_for_scale = stream.facts().skipped;
        return chosen;
    }

    static LiveRequest withRecording(LiveRequest request) {
        if (request.stream.recording.empty()) request.stream.recording = recordingFor(request.project);
        request.stream.also_written.push_back(request.project);
        const std::vector<OutputFile> written{{request.project, FileKind::project, true, false},
                                              {request.stream.recording, FileKind::video}};
        if (const auto there = filesToReplace(written, {}); !there.empty())
            throw Error(
                ErrorKind::output,
                shortList(there) + ": exists already; a recording never replaces a file, so choose another name");
        return request;
    }

    LiveRequest request;
    ProjectOfRun made;
    std::stop_token stop;
    LiveStream stream;
    LighterReading source;
    std::atomic<int> left_out_for_scale{0};
};

LiveRun::LiveRun(LiveRequest request, std::stop_token stop)
    : parts_(std::make_unique<Parts>(std::move(request), std::move(stop))) {}

LiveRun::~LiveRun() = default;

const VideoInfo& LiveRun::video() const {
    return parts_->stream.info();
}

const std::filesystem::path& LiveRun::recording() const {
    return parts_->request.stream.recording;
}

LiveStatus LiveRun::status() const {
    LiveStatus status;
    status.load = {parts_->stream.facts(), parts_->source.fewerCorners(), parts_->left_out_for_scale};
    status.lighter = parts_->source.lighter();
    status.behind_s = (status.load.facts.frames - parts_->source.framesRead()) / video().frame_rate_hz;
    return status;
}

LiveRunResult LiveRun::run(ChainObserver* also, const Begun& begun) {
    const LiveRequest& request = parts_->request;
    LiveRunResult result;
    const ChosenScale chosen = parts_->chooseScaleOf(also);
    const SceneScale& scale = chosen.scale;
    RunRecord planned = plannedRun(video(), scale, {}, request.preset);
    planned.scale_basis = chosen.basis;
    planned.name = request.name.empty() ? shownAddress(request.address) : request.name;
    RunRecorder recorder(request.project, planned, request.options, also, request.details);
    LiveRecorder live(recorder);
    planned.id = recorder.runId();
    if (begun) begun(planned);
    const RunStart start{std::make_shared<ChainProgress>(request.options, scale), 0};
    parts_->source.begin(scale, start.progress);
    RunSummary& summary = result.summary;
    // Whoever wants it to end ends the stream: what came before is still worked on.
    summary = ChainRun(request.options, scale).run(parts_->source, {}, live, {}, request.stream.with_colour, start);
    parts_->stream.finish();
    if (summary.outcome == RunOutcome::stopped) summary.outcome = RunOutcome::finished;
    summary.frames_total = summary.frames_done;
    result.load = status().load;
    summary.median_ms[static_cast<std::size_t>(Stage::store)] = recorder.medianStoreMs();
    RunSummary stored = summary;
    if (const std::string load = result.load.text(); summary.outcome == RunOutcome::finished && !load.empty())
        stored.message = load;
    recorder.finish(stored);
    ProjectFile file = ProjectFile::open(request.project, ProjectFile::Mode::read_only);
    result.record = RunStore(file).run(recorder.runId()).value();
    return result;
}

std::filesystem::path timedProjectName() {
    std::string digits;
    for (const char c : nowUtc())
        if (c >= '0' && c <= '9') digits += c;
    return "live-" + digits.substr(0, 8) + "-" + digits.substr(8, 6) + kProjectEnding;
}

std::filesystem::path recordingFor(const std::filesystem::path& project) {
    std::filesystem::path path = std::filesystem::absolute(project).replace_extension(".ts");
    const std::string stem = path.stem().string();
    std::error_code ignored;
    for (int number = 2; std::filesystem::exists(std::filesystem::symlink_status(path, ignored)); ++number)
        path.replace_filename(stem + "-" + std::to_string(number) + ".ts");
    return path;
}

std::string remarkOnRecording(int recorded_frames, int run_frames) {
    if (recorded_frames == run_frames) return {};
    return "the recording shows " + std::to_string(recorded_frames) + " frames, the run has " +
           std::to_string(run_frames) + ": packets were damaged or lost, and boxes may lie some frames off";
}

}  // namespace eyrie

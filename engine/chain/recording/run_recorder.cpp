#include "chain/recording/run_recorder.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "chain/recording/classified_vehicles.h"
#include "core/error.h"
#include "io/file_digest.h"
#include "io/folder.h"
#include "io/video/frame_source.h"
#include "io/video/image_sequence.h"
#include "store/project/project_file.h"
#include "store/runs/run_state_store.h"
#include "store/runs/source_digest.h"
#include "tracking/ground_motion.h"

namespace eyrie {
namespace {

/// Makes the project when it does not exist, and shows early whether it can be used.
const std::filesystem::path& prepared(const std::filesystem::path& project) {
    ProjectFile::openOrCreate(project);
    return project;
}

std::vector<std::pair<std::string, std::string>> storedParameters(const ChainOptions& options,
                                                                  const RecordingOptions& recording) {
    auto values = parameterValues(options);
    for (auto& changed : recording.changed()) values.push_back(std::move(changed));
    return values;
}

/// Whether a folder holds as many pictures as when it was opened; of others it is so. Where one came or went meanwhile
/// their number tells later what no digest of now could.
bool holdsItsPictures(const SequenceRecord& video) {
    if (!isFolder(video.path)) return true;
    try {
        return imagesIn(video.path).size() == static_cast<std::size_t>(video.frame_count);
    } catch (const Error&) {
        return false;
    }
}

}  // namespace

RunRecorder::RunRecorder(const std::filesystem::path& project, RunRecord run, const ChainOptions& options,
                         ChainObserver* also, const RecordingOptions& recording, const MayAddRun& may_add)
    : project_(prepared(project)),
      options_(options),
      scale_(run.scale),
      range_{run.first_frame, run.last_frame},
      writer_(project, std::move(run), storedParameters(options, recording), may_add),
      also_(also) {
    ProjectFile file = ProjectFile::open(project_);
    const RunRecord begun = RunStore(file).run(runId()).value();
    // What comes live is no file yet, or one that grows.
    const bool is_live = begun.last_frame < begun.first_frame;
    if (!is_live && holdsItsPictures(begun.sequence))
        storeSourceDigest(file, runId(), listingDigestOf(begun.sequence.path));
}

RunRecorder::RunRecorder(const std::filesystem::path& project, const ResumedRun& resumed, ChainObserver* also)
    : project_(project),
      options_(resumed.options),
      scale_(resumed.run.scale),
      range_(resumed.range()),
      writer_(project, resumed.run.id, resumed.last_done),
      also_(also),
      image_size_(resumed.run.sequence.size) {}

void RunRecorder::holdPictures() {
    // Without a classifier nothing is judged, and tracks are not finished by pictures.
    if (options_.finishing.looksAtPictures() && looksThroughWindows(options_.detection.method))
        pictures_ = RunPictures(range_);
}

void RunRecorder::onFrame(const std::shared_ptr<const FrameResult>& result, const Frame& frame) {
    store_ms_.push_back(writer_.write(*result));
    image_size_ = result->motion.image_size;
    if (!result->motion.graphics.empty()) graphics_ = result->motion.graphics;
    pictures_.take(result->motion.frame, frame.gray);
    if (also_) also_->onFrame(result, frame);
}

void RunRecorder::onProgress(const RunProgress& progress) {
    if (also_) also_->onProgress(progress);
}

void RunRecorder::onState(const ChainState& state) {
    writer_.keepState(state.last_done, state.bytes);
}

float RunRecorder::medianStoreMs() const {
    if (store_ms_.empty()) return 0;
    std::vector<float> times = store_ms_;
    const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
    std::nth_element(times.begin(), middle, times.end());
    return *middle;
}

RunRecord RunRecorder::finish(const RunSummary& summary, FrameSource* source, std::stop_token stop) {
    RunState state = summary.outcome == RunOutcome::finished  ? RunState::finished
                     : summary.outcome == RunOutcome::stopped ? RunState::stopped
                                                              : RunState::failed;
    // Whenever the program is killed here, the run can be gone on with: finished tracks without the others beside them
    // are those of a finished run.
    if (state != RunState::finished) writer_.finish(state, summary.message);
    ProjectFile project = ProjectFile::open(project_);
    RunStore store(project);
    // Nothing of the frames is held while the run goes on: an hour of them would not fit beside the chain.
    GroundMotion ground;
    ground.seenAt(scale_.slope);
    store.visitRegistrations(writer_.runId(), [&](const Registration& registration) {
        ground.add({registration.current_from_previous.to_frame, registration, image_size_});
    });
    const StatesOfRun followed = [&](const StateVisitor& visitor) { store.visitTrackStates(writer_.runId(), visitor); };
    const VectorsAt vectors_at = [&](FrameIndex frame) { return store.motionVectors(writer_.runId(), frame); };
    const ClassifiedAt classified_at = [&](FrameIndex frame) { return store.classifiedBoxes(writer_.runId(), frame); };
    FoundInFrames found(vectors_at, classifiedVehicles(options_, classified_at));
    found.graphics = graphics_;
    // Whoever stopped a run does not wait for its pictures once more.
    std::optional<PicturesOnceMore> pictures;
    if (state == RunState::finished && source != nullptr) {
        const RunRecord run = store.run(writer_.runId()).value();
        pictures.emplace(pictures_, *source, run.first_frame, run.last_frame, also_, std::move(stop));
        found.gray_at = [&](FrameIndex frame) { return (*pictures)(frame); };
    }
    const FinishedTracks finished = finishRun(followed, ground, options_.finishing, scale_, found);
    std::string message = summary.message;
    if (pictures && pictures->stopped()) {
        // As if it had been stopped in its last frame, so that whoever goes on with it gets the whole.
        state = RunState::stopped;
        message = "stopped while its tracks were finished";
        writer_.finish(state, message);
    }
    if (pictures && pictures->lost() > 0) {
        message += (message.empty() ? "" : ". Also, ") + std::to_string(pictures->lost()) +
                   " pictures could not be read again to finish the tracks";
    }
    RunStateStore(project).keepTracks(writer_.runId());
    TracksOfRun tracks;
    tracks.states = [&](const StateVisitor& visitor) { finished.visit(visitor); };
    tracks.dropped = [&](const DropVisitor& visitor) { finished.visitDropped(followed, visitor); };
    tracks.doubtful = [&](const StateVisitor& visitor) { finished.visitDoubtful(visitor); };
    tracks.evidence = finished.evidence;
    tracks.light = finished.light;
    store.replaceTracks(writer_.runId(), tracks);
    if (state == RunState::finished) writer_.finish(state, message);
    return store.run(writer_.runId()).value();
}

std::string engineVersion() {
    return EYRIE_VERSION;
}

RunRecord plannedRun(const VideoInfo& video, const SceneScale& scale, FrameRange range, const std::string& preset) {
    RunRecord run;
    run.sequence.path = video.path.string();
    run.sequence.size = video.size;
    run.sequence.frame_count = video.frame_count;
    run.sequence.frame_rate_hz = video.frame_rate_hz;
    run.sequence.rate_assumed = video.frame_rate_assumed;
    run.rate_assumed = video.frame_rate_assumed;
    run.engine_version = engineVersion();
    run.preset = preset;
    run.scale = scale;
    run.scale_basis = basisOf(scale);
    run.first_frame = range.first;
    run.last_frame = range.last < 0 ? video.frame_count - 1 : range.last;
    return run;
}

SceneScale sceneScale(const VideoInfo& video, double gsd_m_per_px) {
    SceneScale scale;
    scale.frame_rate_hz = video.frame_rate_hz;
    const double gsd = gsd_m_per_px > 0 ? gsd_m_per_px : video.gsd_m_per_px;
    scale.gsd_known = gsd > 0;
    if (scale.gsd_known) scale.gsd_m_per_px = gsd;
    return scale;
}

}  // namespace eyrie

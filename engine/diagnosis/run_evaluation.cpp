#include "diagnosis/run_evaluation.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "rerun/replay.h"
#include "scoring/scoring.h"
#include "store/details/kept_details.h"
#include "store/runs/doubtful_tracks.h"

namespace eyrie {
namespace {

constexpr double kBlock_s = 1;  ///< false alarms are drawn by stretches of this length

RunRecord existingRun(const RunStore& store, int id) {
    const auto run = store.run(id);
    if (!run) throw Error(ErrorKind::parameter, "The project has no run " + std::to_string(id) + ".");
    if (run->frames_done == 0)
        throw Error(ErrorKind::input, "The run has no frame yet. Let it go on, or choose another run.");
    return *run;
}

/// Comparison of one set of boxes, as far as differences of runs need it.
struct Scored {
    EvaluationInput input;
    std::vector<FrameMatch> matches;
    TrackTallies tracks;
    PairedTallies paired;
};
Scored score(const Scoring& scoring, const BoxesByFrame& result, double frame_rate_hz) {
    const BoxesByFrame& truth = scoring.truth.boxes;
    const EvaluationOptions& options = scoring.options;
    Scored scored;
    scored.input = prepareEvaluation(truth, result, options);
    scored.matches = matchFrames(scored.input, options);
    if (scored.input.has_tracks) scored.tracks = tallyTracks(scored.input, scored.matches, options);
    const int block = std::max(1, static_cast<int>(std::lround(kBlock_s * frame_rate_hz)));
    scored.paired = pairedTallies(truth, scored.matches, scored.input.has_tracks ? &scored.tracks : nullptr,
                                  {truth.begin()->first, truth.rbegin()->first}, block);
    return scored;
}

RunDifference differenceTo(int other_id, const RunStore& store, const Scoring& scoring,
                           const RunEvaluation& evaluation) {
    RunDifference difference;
    difference.other = existingRun(store, other_id);
    const RunRecord& other = difference.other;
    if (other.sequence.id != evaluation.run.sequence.id)
        throw Error(ErrorKind::input,
                    "Run " + std::to_string(other_id) + " is over another video. Choose a run over the same one.");
    const Scoring common = scoringOf(scoring.truth, scoring.options, coveredFrames(other));
    const double rate = other.sequence.frame_rate_hz;
    const BoxesByFrame boxes = evaluation.detections ? store.detectionBoxes(other_id) : store.trackBoxes(other_id);
    const Scored own = score(common, evaluation.result, rate);
    const Scored others = score(common, boxes, rate);
    difference.difference = methodDifference(own.paired, others.paired);
    return difference;
}

}  // namespace

DiagnosisSource diagnosisSource(const RunStore& store, const RunRecord& run) {
    DiagnosisSource source;
    source.options = storedOptions(store.parameters(run.id));
    source.scale = run.scale;
    source.first_frame = run.first_frame;
    source.frame_result = [&store, id = run.id](FrameIndex frame) { return store.frameResult(id, frame); };
    return source;
}

std::vector<ScorePoint> scoreCurveOf(const RunEvaluation& evaluation, const RunStore& store,
                                     const std::stop_token& stop) {
    constexpr std::size_t kMostPoints = 50;
    BoxesByFrame boxes = evaluation.result;
    if (!evaluation.detections) {
        for (auto& [frame, doubtful] : store.doubtful().boxes(evaluation.run.id))
            boxes[frame].insert(boxes[frame].end(), doubtful.begin(), doubtful.end());
    }
    return scoreCurve(evaluation.truth, boxes, evaluation.options, kMostPoints, stop);
}

struct RunEvaluator::Kept {
    std::filesystem::path path;
    std::optional<ProjectFile> project;
    std::optional<RunStore> store;
    int run_id = 0;
    int frames_done = 0;
    RunState state = RunState::running;
    bool detections = false;
    BoxesByFrame result;
    std::optional<Diagnoser> diagnoser;

    void openProject(const std::filesystem::path& wanted) {
        if (project && path == wanted) return;
        diagnoser.reset();
        store.reset();
        project.reset();
        run_id = 0;
        project = ProjectFile::open(wanted, ProjectFile::Mode::read_only);
        store.emplace(*project);
        path = wanted;
    }
    /// Frames of which the run kept tracks only tell nothing of causes.
    DiagnosisSource sourceOf(const RunRecord& run) {
        DiagnosisSource source = diagnosisSource(*store, run);
        source.frame_result = [this, all = source.frame_result, id = run.id](FrameIndex frame) {
            return hasDetails(*project, id, frame) ? all(frame) : std::nullopt;
        };
        return source;
    }
    void readRun(const RunRecord& run, bool wants_detections) {
        const bool same_run = run_id == run.id && frames_done == run.frames_done && state == run.state;
        if (same_run && detections == wants_detections) return;
        if (!same_run) diagnoser.emplace(sourceOf(run));
        run_id = 0;
        result = wants_detections ? store->detectionBoxes(run.id) : store->trackBoxes(run.id);
        run_id = run.id;
        frames_done = run.frames_done;
        state = run.state;
        detections = wants_detections;
    }
};

RunEvaluator::RunEvaluator() : kept_(std::make_unique<Kept>()) {}
RunEvaluator::~RunEvaluator() = default;

std::shared_ptr<const RunEvaluation> RunEvaluator::evaluate(const EvaluationRequest& request,
                                                            const std::stop_token& stop) {
    kept_->openProject(request.project);
    const auto evaluation = std::make_shared<RunEvaluation>();
    RunEvaluation& e = *evaluation;
    e.run = existingRun(*kept_->store, request.run_id);
    e.detections = request.detections;
    kept_->readRun(e.run, request.detections);
    e.parameters = kept_->store->parameters(e.run.id);
    e.result = kept_->result;

    EvaluationOptions wishes = request.options;
    wishes.image_size = e.run.sequence.size;
    Scoring scoring = scoringOf(readGroundTruth(request.truth, *kept_->project, e.run), wishes, coveredFrames(e.run));
    e.truth_name = request.truth.file.empty() ? "labels of the project" : request.truth.file.filename().string();
    e.remarks = scoring.truth.remarks;
    if (const int kept = detailedFrames(*kept_->project, e.run.id); kept < e.run.frames_done)
        e.remarks.push_back("causes of errors are found from tracks alone where " + lackOfDetails(e.run, kept));
    e.options = scoring.options;
    const BoxesByFrame& truth = scoring.truth.boxes;
    if (stop.stop_requested()) return nullptr;
    std::vector<double> overlaps = request.overlaps;
    overlaps.push_back(e.options.overlap);
    e.table = evaluateAt(overlaps, truth, e.result, e.options);
    e.shown = std::move(e.table.back());
    e.table.pop_back();
    for (std::string& remark : remarksOn(e.shown)) e.remarks.push_back(std::move(remark));
    if (stop.stop_requested()) return nullptr;

    Scored scored = score(scoring, e.result, e.run.sequence.frame_rate_hz);
    for (const FrameMatch& match : scored.matches)
        e.frames.push_back({match.frame, static_cast<int>(match.pairs.size()), static_cast<int>(match.missed.size()),
                            static_cast<int>(match.false_results.size())});
    e.f_score = fScoreInterval(scored.paired);
    if (scored.input.has_tracks && !scored.tracks.truth.empty()) e.mota = bootstrapTracks(scored.tracks).mota;
    if (request.other_run && *request.other_run != e.run.id)
        e.difference = differenceTo(*request.other_run, *kept_->store, scoring, e);
    if (stop.stop_requested()) return nullptr;

    std::vector<ResultError> errors = listErrors(truth, e.result, scored.input, scored.matches, e.options);
    if (request.with_causes) {
        e.errors = kept_->diagnoser->diagnose(std::move(errors),
                                              {truth, e.result, scored.input, scored.matches, e.options}, stop);
    } else {
        for (ResultError& error : errors) {
            e.errors.emplace_back();
            e.errors.back().error = std::move(error);
        }
    }
    if (stop.stop_requested()) return nullptr;
    e.matches = std::move(scored.matches);
    e.truth = std::move(scoring.truth.boxes);
    return evaluation;
}

}  // namespace eyrie

#include "diagnosis/run_evaluation.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "diagnosis/label_truth.h"
#include "formats/label_formats.h"
#include "rerun/replay.h"

namespace eyrie {
namespace {

constexpr double kBlock_s = 1;  ///< false alarms are drawn by stretches of this length

std::string rangeText(FrameIndex first, FrameIndex last) {
    return std::to_string(first) + " to " + std::to_string(last);
}

/// Ground truth as it was read.
struct Truth {
    BoxesByFrame boxes;
    std::string name;
    bool without_headings = false;   ///< from a format that cannot turn boxes
    std::vector<std::string> notes;  ///< of reading it, such as what was left out
};

Truth truthOfProject(ProjectFile& project, const RunRecord& run) {
    Truth truth;
    truth.boxes = labelTruth(project, run);
    truth.name = "labels of the project";
    return truth;
}

Truth truthOfFile(const std::filesystem::path& file, const RunRecord& run) {
    ImportOptions options;
    options.image_size = run.sequence.size;
    const LabelFile labels = readLabels(file, "auto", options);
    Truth truth;
    truth.boxes = plainBoxes(labels.boxes);
    truth.notes = labels.notes;
    truth.name = file.filename().string();
    if (truth.boxes.empty()) throw Error(ErrorKind::input, file.string() + ": holds no box. Choose another file.");
    for (const LabelFormatInfo& format : labelFormats())
        if (format.name == labels.format) truth.without_headings = !format.carries.rotation;
    return truth;
}

/// Leaves the frames that the run reached.
void keepFrames(Truth& truth, FrameIndex first, FrameIndex end, std::vector<std::string>* remarks) {
    const std::size_t all = truth.boxes.size();
    const std::string truth_range =
        all > 0 ? rangeText(truth.boxes.begin()->first, truth.boxes.rbegin()->first) : std::string("none");
    std::erase_if(truth.boxes, [&](const auto& entry) { return entry.first < first || entry.first >= end; });
    if (truth.boxes.empty())
        throw Error(ErrorKind::input, "Ground truth (frames " + truth_range + ") and run (frames " +
                                          rangeText(first, end - 1) +
                                          ") have no frame in common. Run those frames, or import the file with its "
                                          "frames shifted.");
    if (truth.boxes.size() < all && remarks != nullptr)
        remarks->push_back("the run covers frames " + rangeText(first, end - 1) + ", so " +
                           std::to_string(all - truth.boxes.size()) + " of " + std::to_string(all) +
                           " frames of the ground truth were left out");
}

RunRecord existingRun(const RunStore& store, int id) {
    const auto run = store.run(id);
    if (!run) throw Error(ErrorKind::parameter, "The project has no run " + std::to_string(id) + ".");
    if (run->frames_done == 0)
        throw Error(ErrorKind::input, "The run has no frame yet. Let it work, or choose another run.");
    return *run;
}

/// Comparison of one set of boxes, as far as differences of runs need it.
struct Scored {
    EvaluationInput input;
    std::vector<FrameMatch> matches;
    TrackTallies tracks;
    PairedTallies paired;
};
Scored score(const BoxesByFrame& truth, const BoxesByFrame& result, const EvaluationOptions& options,
             double frame_rate_hz) {
    Scored scored;
    scored.input = prepareEvaluation(truth, result, options);
    scored.matches = matchFrames(scored.input, options);
    if (scored.input.has_tracks) scored.tracks = tallyTracks(scored.input, scored.matches, options);
    const int block = std::max(1, static_cast<int>(std::lround(kBlock_s * frame_rate_hz)));
    scored.paired = pairedTallies(truth, scored.matches, scored.input.has_tracks ? &scored.tracks : nullptr,
                                  {truth.begin()->first, truth.rbegin()->first}, block);
    return scored;
}

RunDifference differenceTo(int other_id, const RunStore& store, const Truth& truth, const RunEvaluation& evaluation) {
    RunDifference difference;
    difference.other = existingRun(store, other_id);
    const RunRecord& other = difference.other;
    if (other.sequence.id != evaluation.run.sequence.id)
        throw Error(ErrorKind::input,
                    "Run " + std::to_string(other_id) + " is over another video. Choose a run over the same one.");
    Truth common = truth;
    keepFrames(common, other.first_frame, other.first_frame + other.frames_done, nullptr);
    const double rate = other.sequence.frame_rate_hz;
    const BoxesByFrame boxes = evaluation.detections ? store.detectionBoxes(other_id) : store.trackBoxes(other_id);
    const Scored own = score(common.boxes, evaluation.result, evaluation.options, rate);
    const Scored others = score(common.boxes, boxes, evaluation.options, rate);
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
    void readRun(const RunRecord& run, bool wants_detections) {
        const bool same_run = run_id == run.id && frames_done == run.frames_done && state == run.state;
        if (same_run && detections == wants_detections) return;
        if (!same_run) diagnoser.emplace(diagnosisSource(*store, run));
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

    Truth truth =
        request.truth_file.empty() ? truthOfProject(*kept_->project, e.run) : truthOfFile(request.truth_file, e.run);
    e.remarks = truth.notes;
    keepFrames(truth, e.run.first_frame, e.run.first_frame + e.run.frames_done, &e.remarks);
    e.truth_name = truth.name;
    e.options = request.options;
    e.options.overlap = request.shown_overlap;
    e.options.image_size = e.run.sequence.size;
    if (!e.options.upright && allUpright(truth.boxes) && !allUpright(e.result)) {
        if (truth.without_headings) {
            e.options.upright = true;
            e.remarks.push_back(
                "the ground truth has upright boxes, so the enclosing boxes of the result are compared");
        } else {
            e.remarks.push_back(
                "the ground truth has upright boxes only; if it has no headings, compare upright boxes");
        }
    }
    if (stop.stop_requested()) return nullptr;
    std::vector<double> overlaps = request.overlaps;
    overlaps.push_back(request.shown_overlap);
    e.table = evaluateAt(overlaps, truth.boxes, e.result, e.options);
    e.shown = std::move(e.table.back());
    e.table.pop_back();
    for (std::string& remark : remarksOn(e.shown)) e.remarks.push_back(std::move(remark));
    if (stop.stop_requested()) return nullptr;

    Scored scored = score(truth.boxes, e.result, e.options, e.run.sequence.frame_rate_hz);
    for (const FrameMatch& match : scored.matches)
        e.frames.push_back({match.frame, static_cast<int>(match.pairs.size()), static_cast<int>(match.missed.size()),
                            static_cast<int>(match.false_results.size())});
    e.f_score = fScoreInterval(scored.paired);
    if (scored.input.has_tracks && !scored.tracks.truth.empty()) e.mota = bootstrapTracks(scored.tracks).mota;
    if (request.other_run && *request.other_run != e.run.id)
        e.difference = differenceTo(*request.other_run, *kept_->store, truth, e);
    if (stop.stop_requested()) return nullptr;

    std::vector<Mistake> mistakes = listMistakes(truth.boxes, e.result, scored.input, scored.matches, e.options);
    if (request.with_causes) {
        e.mistakes = kept_->diagnoser->diagnose(std::move(mistakes),
                                                {truth.boxes, e.result, scored.input, scored.matches, e.options}, stop);
    } else {
        for (Mistake& mistake : mistakes) {
            e.mistakes.emplace_back();
            e.mistakes.back().mistake = std::move(mistake);
        }
    }
    if (stop.stop_requested()) return nullptr;
    e.matches = std::move(scored.matches);
    e.truth = std::move(truth.boxes);
    return evaluation;
}

}  // namespace eyrie

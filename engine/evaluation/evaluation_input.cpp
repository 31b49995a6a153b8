#include "evaluation/evaluation_input.h"

#include <algorithm>
#include <set>
#include <string>

#include "core/error.h"

namespace eyrie {
namespace {

bool countsNeitherWay(const BoxRecord& object, const EvaluationOptions& options) {
    if (object.ignore || (options.vehicles_only && !isVehicleClass(object.object_class))) return true;
    return options.one_class && trackClassOf(object.object_class) != *options.one_class;
}

/// A result that does not say what it is may be anything.
bool isOfOtherClass(const BoxRecord& result, const EvaluationOptions& options) {
    return options.one_class && !result.object_class.empty() && trackClassOf(result.object_class) != *options.one_class;
}

bool awayFromBorder(const OrientedBox& box, double border, cv::Size image) {
    const OrientedBox u = box.upright();
    return u.centre.x - u.length / 2 >= border && u.centre.y - u.width / 2 >= border &&
           u.centre.x + u.length / 2 <= image.width - 1 - border &&
           u.centre.y + u.width / 2 <= image.height - 1 - border;
}

std::vector<OrientedBox> comparedBoxes(const std::vector<BoxRecord>& records, const std::vector<int>& indices,
                                       bool upright) {
    std::vector<OrientedBox> boxes;
    boxes.reserve(indices.size());
    for (const int index : indices) {
        const OrientedBox& box = records[static_cast<std::size_t>(index)].box;
        boxes.push_back(upright ? box.upright() : box);
    }
    return boxes;
}

EvaluationFrame sortFrame(FrameIndex frame, const std::vector<BoxRecord>& truth, const std::vector<BoxRecord>& result,
                          const EvaluationOptions& options) {
    EvaluationFrame sorted;
    sorted.frame = frame;
    for (int i = 0; i < static_cast<int>(truth.size()); ++i) {
        const bool ignored = countsNeitherWay(truth[static_cast<std::size_t>(i)], options);
        (ignored ? sorted.ignored_truth : sorted.truth).push_back(i);
    }
    for (int i = 0; i < static_cast<int>(result.size()); ++i) {
        if (isOfOtherClass(result[static_cast<std::size_t>(i)], options)) {
            sorted.other_class_results.push_back(i);
            continue;
        }
        const bool kept = !options.border ||
                          awayFromBorder(result[static_cast<std::size_t>(i)].box, *options.border, options.image_size);
        (kept ? sorted.results : sorted.border_results).push_back(i);
    }
    const auto rows = comparedBoxes(truth, sorted.truth, options.upright);
    const auto columns = comparedBoxes(result, sorted.results, options.upright);
    sorted.overlap.resize(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t j = 0; j < columns.size(); ++j) {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            sorted.overlap(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = overlap(rows[i], columns[j]);
        }
    }
    sorted.forgivable.assign(columns.size(), 0);
    if (options.convention == Convention::thesis) {
        const auto ignored = comparedBoxes(truth, sorted.ignored_truth, options.upright);
        for (std::size_t j = 0; j < columns.size(); ++j) {
            sorted.forgivable[j] = std::any_of(ignored.begin(), ignored.end(), [&](const OrientedBox& object) {
                return overlap(object, columns[j]) > 0;
            });
        }
    }
    return sorted;
}

/// Collects the ids of the boxes that take part and notices repeated ones.
class IdCensus {
 public:
    void add(const std::vector<BoxRecord>& records, const std::vector<int>& indices) {
        std::set<int> in_frame;
        for (const int index : indices) {
            const BoxRecord& record = records[static_cast<std::size_t>(index)];
            if (!record.id) {
                complete_ = false;
                continue;
            }
            ids_.insert(*record.id);
            if (in_frame.insert(*record.id).second) continue;
            ++repeated_;
            if (first_repeated_.empty()) {
                first_repeated_ =
                    "id " + std::to_string(*record.id) + " occurs twice in frame " + std::to_string(record.frame);
            }
        }
    }
    bool complete() const { return complete_; }
    int repeated() const { return repeated_; }
    const std::string& firstRepeated() const { return first_repeated_; }
    std::vector<int> ids() const { return {ids_.begin(), ids_.end()}; }

 private:
    std::set<int> ids_;
    bool complete_ = true;
    int repeated_ = 0;
    std::string first_repeated_;
};

std::vector<int> trackNumbers(const std::vector<BoxRecord>& records, const std::vector<int>& indices,
                              const std::vector<int>& ids) {
    std::vector<int> numbers;
    numbers.reserve(indices.size());
    for (const int index : indices) {
        const int id = *records[static_cast<std::size_t>(index)].id;
        numbers.push_back(static_cast<int>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin()));
    }
    return numbers;
}

/// The frames that are evaluated, ascending.
std::vector<FrameIndex> framesToEvaluate(const BoxesByFrame& truth, const BoxesByFrame& result, bool only_truth,
                                         int frame_count) {
    std::set<FrameIndex> frames;
    for (const auto& entry : truth) frames.insert(entry.first);
    if (only_truth) return {frames.begin(), frames.end()};
    for (const auto& entry : result) frames.insert(entry.first);
    std::vector<FrameIndex> inside;
    for (const FrameIndex frame : frames) {
        if (frame >= 0 && frame < frame_count) inside.push_back(frame);
    }
    return inside;
}

}  // namespace

EvaluationInput prepareEvaluation(const BoxesByFrame& truth, const BoxesByFrame& result,
                                  const EvaluationOptions& options) {
    check(options);
    const bool thesis = options.convention == Convention::thesis;
    static const std::vector<BoxRecord> nothing;
    const auto recordsOf = [](const BoxesByFrame& boxes, FrameIndex frame) -> const std::vector<BoxRecord>& {
        const auto found = boxes.find(frame);
        return found == boxes.end() ? nothing : found->second;
    };

    EvaluationInput input;
    const int last_true_frame = truth.empty() ? -1 : truth.rbegin()->first;
    input.frame_count = thesis ? static_cast<int>(truth.size()) : options.frame_count.value_or(last_true_frame + 1);
    IdCensus truth_ids;
    IdCensus result_ids;
    int results = 0;
    for (const FrameIndex frame : framesToEvaluate(truth, result, thesis, input.frame_count)) {
        const auto& true_records = recordsOf(truth, frame);
        const auto& result_records = recordsOf(result, frame);
        EvaluationFrame sorted = sortFrame(frame, true_records, result_records, options);
        truth_ids.add(true_records, sorted.truth);
        result_ids.add(result_records, sorted.results);
        results += static_cast<int>(result_records.size());
        if (!true_records.empty() && !result_records.empty()) ++input.shared_frames;
        input.frames.push_back(std::move(sorted));
    }
    for (const auto& entry : result) input.results_not_counted += static_cast<int>(entry.second.size());
    input.results_not_counted -= results;

    input.repeated_ids = truth_ids.repeated() + result_ids.repeated();
    if (!thesis && input.repeated_ids > 0) {
        const bool in_truth = truth_ids.repeated() > 0;
        throw Error(ErrorKind::input,
                    std::string(in_truth ? "ground truth: " : "result: ") +
                        (in_truth ? truth_ids : result_ids).firstRepeated() +
                        "; under the convention trackeval an id may occur once a frame: renumber the boxes");
    }
    input.has_tracks = truth_ids.complete() && result_ids.complete();
    if (!input.has_tracks) return input;
    input.truth_ids = truth_ids.ids();
    input.result_ids = result_ids.ids();
    for (EvaluationFrame& frame : input.frames) {
        frame.truth_tracks = trackNumbers(recordsOf(truth, frame.frame), frame.truth, input.truth_ids);
        frame.result_tracks = trackNumbers(recordsOf(result, frame.frame), frame.results, input.result_ids);
    }
    return input;
}

}  // namespace eyrie

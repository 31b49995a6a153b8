#include "evaluation/matching.h"

#include <limits>

#include "evaluation/hungarian.h"

namespace eyrie {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// Matches frame after frame and remembers which result each true track had in the frame before.
class Matcher {
 public:
    Matcher(const EvaluationInput& input, const EvaluationOptions& options)
        : has_tracks_(input.has_tracks),
          convention_(options.convention),
          threshold_(options.overlap),
          result_before_(input.truth_ids.size(), -1) {}

    /// The column of every row of the frame, −1 for a missed object.
    std::vector<int> match(const EvaluationFrame& frame) {
        const bool thesis = convention_ == Convention::thesis;
        if (!thesis && (frame.truth.empty() || frame.results.empty())) {
            return std::vector<int>(frame.truth.size(), -1);  // TrackEval passes over such frames and keeps its memory
        }
        std::vector<int> column_of_row = thesis ? carriedOver(frame) : weighted(frame);
        if (thesis) completeByOverlap(frame, column_of_row);
        remember(frame, column_of_row);
        return column_of_row;
    }

 private:
    int before(const EvaluationFrame& frame, std::size_t row) const {
        return has_tracks_ ? result_before_[static_cast<std::size_t>(frame.truth_tracks[row])] : -1;
    }

    std::vector<int> carriedOver(const EvaluationFrame& frame) const {
        std::vector<int> column_of_row(frame.truth.size(), -1);
        std::vector<char> used(frame.results.size(), 0);
        for (std::size_t i = 0; i < frame.truth.size(); ++i) {
            const int track = before(frame, i);
            if (track < 0) continue;
            for (std::size_t j = 0; j < frame.results.size(); ++j) {
                if (frame.result_tracks[j] != track) continue;
                if (used[j] == 0 &&
                    frame.overlap(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) >= threshold_) {
                    used[j] = 1;
                    column_of_row[i] = static_cast<int>(j);
                }
                break;
            }
        }
        return column_of_row;
    }

    void completeByOverlap(const EvaluationFrame& frame, std::vector<int>& column_of_row) const {
        std::vector<char> used(frame.results.size(), 0);
        std::vector<int> rows;
        for (std::size_t i = 0; i < column_of_row.size(); ++i) {
            if (column_of_row[i] < 0) {
                rows.push_back(static_cast<int>(i));
            } else {
                used[static_cast<std::size_t>(column_of_row[i])] = 1;
            }
        }
        std::vector<int> columns;
        for (std::size_t j = 0; j < used.size(); ++j) {
            if (used[j] == 0) columns.push_back(static_cast<int>(j));
        }
        const Eigen::MatrixXd left = frame.overlap(rows, columns);
        const std::vector<int> found = matchByOverlap(left, threshold_);
        for (std::size_t k = 0; k < found.size(); ++k) {
            if (found[k] >= 0) {
                column_of_row[static_cast<std::size_t>(rows[k])] = columns[static_cast<std::size_t>(found[k])];
            }
        }
    }

    std::vector<int> weighted(const EvaluationFrame& frame) const {
        Eigen::MatrixXd score = frame.overlap;
        for (Eigen::Index i = 0; i < score.rows(); ++i) {
            const int track = before(frame, static_cast<std::size_t>(i));
            for (Eigen::Index j = 0; j < score.cols(); ++j) {
                if (score(i, j) < threshold_ - kEpsilon) {
                    score(i, j) = 0;
                } else if (track >= 0 && frame.result_tracks[static_cast<std::size_t>(j)] == track) {
                    score(i, j) += 1000;
                }
            }
        }
        std::vector<int> column_of_row = assignMaximum(score);
        for (std::size_t i = 0; i < column_of_row.size(); ++i) {
            if (column_of_row[i] >= 0 && !(score(static_cast<Eigen::Index>(i), column_of_row[i]) > kEpsilon)) {
                column_of_row[i] = -1;
            }
        }
        return column_of_row;
    }

    void remember(const EvaluationFrame& frame, const std::vector<int>& column_of_row) {
        if (!has_tracks_) return;
        std::fill(result_before_.begin(), result_before_.end(), -1);
        for (std::size_t i = 0; i < column_of_row.size(); ++i) {
            if (column_of_row[i] < 0) continue;
            result_before_[static_cast<std::size_t>(frame.truth_tracks[i])] =
                frame.result_tracks[static_cast<std::size_t>(column_of_row[i])];
        }
    }

    bool has_tracks_;
    Convention convention_;
    double threshold_;
    std::vector<int> result_before_;
};

FrameMatch describeMatch(const EvaluationFrame& frame, const std::vector<int>& column_of_row) {
    FrameMatch match;
    match.frame = frame.frame;
    match.ignored_truth = frame.ignored_truth;
    match.border_results = frame.border_results;
    match.other_class_results = frame.other_class_results;
    std::vector<char> used(frame.results.size(), 0);
    for (std::size_t i = 0; i < column_of_row.size(); ++i) {
        const int column = column_of_row[i];
        if (column < 0) {
            match.missed.push_back(frame.truth[i]);
            continue;
        }
        used[static_cast<std::size_t>(column)] = 1;
        match.pairs.push_back({frame.truth[i], frame.results[static_cast<std::size_t>(column)],
                               frame.overlap(static_cast<Eigen::Index>(i), column)});
    }
    for (std::size_t j = 0; j < used.size(); ++j) {
        if (used[j] == 0)
            (frame.forgivable[j] ? match.ignored_results : match.false_results).push_back(frame.results[j]);
    }
    return match;
}

}  // namespace

std::vector<int> matchByOverlap(const Eigen::MatrixXd& overlap, double threshold) {
    Eigen::MatrixXd score = overlap;
    for (Eigen::Index k = 0; k < score.size(); ++k) {
        double& value = score.data()[k];
        value = value >= threshold ? value + 1 : 0;
    }
    std::vector<int> column_of_row = assignMaximum(score);
    for (std::size_t i = 0; i < column_of_row.size(); ++i) {
        if (column_of_row[i] >= 0 && score(static_cast<Eigen::Index>(i), column_of_row[i]) == 0) column_of_row[i] = -1;
    }
    return column_of_row;
}

std::vector<FrameMatch> matchFrames(const EvaluationInput& input, const EvaluationOptions& options) {
    Matcher matcher(input, options);
    std::vector<FrameMatch> matches;
    matches.reserve(input.frames.size());
    for (const EvaluationFrame& frame : input.frames) matches.push_back(describeMatch(frame, matcher.match(frame)));
    return matches;
}

std::vector<FrameMatch> matchFrames(const BoxesByFrame& truth, const BoxesByFrame& result,
                                    const EvaluationOptions& options) {
    return matchFrames(prepareEvaluation(truth, result, options), options);
}

}  // namespace eyrie

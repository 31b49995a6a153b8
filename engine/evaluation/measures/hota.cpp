#include "evaluation/measures/hota.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "evaluation/hungarian.h"
#include "evaluation/matching.h"

namespace eyrie {
namespace {

constexpr double kHotaEpsilon = std::numeric_limits<double>::epsilon();

/// A frame without ignored results; rows and columns as numbers of tracks.
struct HotaFrame {
    std::vector<int> truth;
    std::vector<int> results;
    Eigen::MatrixXd overlap;
};

HotaFrame withoutIgnored(const EvaluationFrame& frame) {
    std::vector<char> keep(frame.results.size(), 1);
    if (std::count(frame.forgivable.begin(), frame.forgivable.end(), 0) < static_cast<long>(keep.size())) {
        for (std::size_t j = 0; j < keep.size(); ++j) keep[j] = frame.forgivable[j] ? 0 : 1;
        for (const int column : matchByOverlap(frame.overlap, hotaThreshold(0))) {
            if (column >= 0) keep[static_cast<std::size_t>(column)] = 1;
        }
    }
    HotaFrame kept;
    kept.truth = frame.truth_tracks;
    std::vector<int> columns;
    for (std::size_t j = 0; j < keep.size(); ++j) {
        if (keep[j] == 0) continue;
        columns.push_back(static_cast<int>(j));
        kept.results.push_back(frame.result_tracks[j]);
    }
    kept.overlap = frame.overlap(Eigen::all, columns);
    return kept;
}

/// How often and how well two tracks fit over the whole sequence, before any decision.
struct Alignment {
    Eigen::MatrixXd score;
    std::vector<double> truth_frames;
    std::vector<double> result_frames;
};

Alignment alignTracks(const std::vector<HotaFrame>& frames, std::size_t truth_tracks, std::size_t result_tracks) {
    Alignment alignment{
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(truth_tracks), static_cast<Eigen::Index>(result_tracks)),
        std::vector<double>(truth_tracks, 0), std::vector<double>(result_tracks, 0)};
    for (const HotaFrame& frame : frames) {
        for (const int truth : frame.truth) alignment.truth_frames[static_cast<std::size_t>(truth)] += 1;
        for (const int result : frame.results) alignment.result_frames[static_cast<std::size_t>(result)] += 1;
        const Eigen::VectorXd of_truth = frame.overlap.rowwise().sum();
        const Eigen::VectorXd of_result = frame.overlap.colwise().sum().transpose();
        for (Eigen::Index j = 0; j < frame.overlap.cols(); ++j) {
            for (Eigen::Index i = 0; i < frame.overlap.rows(); ++i) {
                const double shared = frame.overlap(i, j);
                const double competing = of_truth(i) + of_result(j) - shared;
                if (competing > kHotaEpsilon) {
                    alignment.score(frame.truth[static_cast<std::size_t>(i)],
                                    frame.results[static_cast<std::size_t>(j)]) += shared / competing;
                }
            }
        }
    }
    for (Eigen::Index j = 0; j < alignment.score.cols(); ++j) {
        for (Eigen::Index i = 0; i < alignment.score.rows(); ++i) {
            double& score = alignment.score(i, j);
            score /= alignment.truth_frames[static_cast<std::size_t>(i)] +
                     alignment.result_frames[static_cast<std::size_t>(j)] - score;
        }
    }
    return alignment;
}

/// Overlaps of all pairs that the frames' assignments made, by pair of tracks.
using PairOverlaps = std::map<std::pair<int, int>, std::vector<double>>;

PairOverlaps pairTracks(const std::vector<HotaFrame>& frames, const Alignment& alignment) {
    PairOverlaps pairs;
    for (const HotaFrame& frame : frames) {
        if (frame.truth.empty() || frame.results.empty()) continue;
        const Eigen::MatrixXd score = alignment.score(frame.truth, frame.results).cwiseProduct(frame.overlap);
        const std::vector<int> column_of_row = assignMaximum(score);
        for (std::size_t i = 0; i < column_of_row.size(); ++i) {
            const int column = column_of_row[i];
            if (column < 0) continue;
            pairs[{frame.truth[i], frame.results[static_cast<std::size_t>(column)]}].push_back(
                frame.overlap(static_cast<Eigen::Index>(i), column));
        }
    }
    return pairs;
}

double total(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

double hotaThreshold(int index) {
    return 0.05 + 0.05 * index;
}

double meanOf(const HotaCurve& curve) {
    return std::accumulate(curve.begin(), curve.end(), 0.0) / kHotaThresholds;
}

HotaMeasures hotaMeasures(const EvaluationInput& input) {
    std::vector<HotaFrame> frames;
    frames.reserve(input.frames.size());
    for (const EvaluationFrame& frame : input.frames) frames.push_back(withoutIgnored(frame));
    const Alignment alignment = alignTracks(frames, input.truth_ids.size(), input.result_ids.size());
    const PairOverlaps pairs = pairTracks(frames, alignment);
    const double objects = total(alignment.truth_frames);
    const double results = total(alignment.result_frames);

    HotaMeasures m;
    for (int k = 0; k < kHotaThresholds; ++k) {
        const auto a = static_cast<std::size_t>(k);
        const double threshold = hotaThreshold(k) - kHotaEpsilon;
        double found = 0;
        double overlaps = 0;
        double accuracy = 0;
        double recall = 0;
        double precision = 0;
        for (const auto& [tracks, values] : pairs) {
            double count = 0;
            for (const double value : values) {
                if (value < threshold) continue;
                count += 1;
                overlaps += value;
            }
            const double of_truth = alignment.truth_frames[static_cast<std::size_t>(tracks.first)];
            const double of_result = alignment.result_frames[static_cast<std::size_t>(tracks.second)];
            found += count;
            accuracy += count * count / std::max(1.0, of_truth + of_result - count);
            recall += count * count / std::max(1.0, of_truth);
            precision += count * count / std::max(1.0, of_result);
        }
        m.true_positives[a] = found;
        m.false_negatives[a] = objects - found;
        m.false_positives[a] = results - found;
        m.ass_a[a] = accuracy / std::max(1.0, found);
        m.ass_re[a] = recall / std::max(1.0, found);
        m.ass_pr[a] = precision / std::max(1.0, found);
        m.loc_a[a] = found > 0 ? overlaps / found : 1;
        m.det_re[a] = found / std::max(1.0, objects);
        m.det_pr[a] = found / std::max(1.0, results);
        m.det_a[a] = found / std::max(1.0, objects + results - found);
        m.hota[a] = std::sqrt(m.det_a[a] * m.ass_a[a]);
        m.owta[a] = std::sqrt(m.det_re[a] * m.ass_a[a]);
    }
    return m;
}

}  // namespace eyrie

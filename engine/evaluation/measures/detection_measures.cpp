#include "evaluation/measures/detection_measures.h"

#include <algorithm>

namespace eyrie {

DetectionMeasures detectionMeasures(const EvaluationInput& input, const std::vector<FrameMatch>& matches) {
    DetectionMeasures m;
    for (const FrameMatch& match : matches) {
        m.true_positives += static_cast<int>(match.pairs.size());
        m.false_negatives += static_cast<int>(match.missed.size());
        m.false_positives += static_cast<int>(match.false_results.size());
        m.ignored_results += static_cast<int>(match.ignored_results.size() + match.border_results.size() +
                                              match.other_class_results.size());
        for (const MatchedPair& pair : match.pairs) m.overlap_sum += pair.overlap;
    }
    m.ground_truth = m.true_positives + m.false_negatives;
    m.frames = input.frame_count;
    const auto ratio = [](double part, int whole) { return part / std::max(whole, 1); };
    m.precision = ratio(m.true_positives, m.true_positives + m.false_positives);
    m.recall = ratio(m.true_positives, m.ground_truth);
    m.f_score = ratio(2.0 * m.true_positives, 2 * m.true_positives + m.false_positives + m.false_negatives);
    m.n_moda = 1 - ratio(m.false_negatives + m.false_positives, m.ground_truth);
    m.n_modp = ratio(m.overlap_sum, m.true_positives);
    m.false_positives_per_frame = ratio(m.false_positives, m.frames);
    return m;
}

}  // namespace eyrie

#include "evaluation/measures/score_curve.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "evaluation/evaluation_input.h"

namespace eyrie {
namespace {

/// The scores at which the curve is asked, ascending.
std::vector<double> thresholdsOf(const BoxesByFrame& result, std::size_t most) {
    std::vector<double> scores;
    for (const auto& [frame, boxes] : result) {
        for (const BoxRecord& box : boxes) {
            if (std::isnan(box.score)) throw Error(ErrorKind::input, "score curve: a score is not a number");
            scores.push_back(box.score);
        }
    }
    std::sort(scores.begin(), scores.end());
    std::vector<double> distinct = scores;
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    most = std::max<std::size_t>(most, 2);
    if (distinct.size() <= most) return distinct;
    // By boxes, so that the curve is as fine where many tracks lie.
    std::set<double> chosen;
    for (std::size_t i = 0; i < most; ++i) chosen.insert(scores[i * (scores.size() - 1) / (most - 1)]);
    return {chosen.begin(), chosen.end()};
}

}  // namespace

std::vector<ScorePoint> scoreCurve(const BoxesByFrame& truth, const BoxesByFrame& result,
                                   const EvaluationOptions& options, std::size_t most, const std::stop_token& stop) {
    check(options);
    std::vector<ScorePoint> curve;
    BoxesByFrame kept = result;
    for (const double threshold : thresholdsOf(result, most)) {
        if (stop.stop_requested()) break;
        std::set<int> ids;
        for (auto& [frame, boxes] : kept) {
            std::erase_if(boxes, [&](const BoxRecord& box) { return box.score < threshold; });
            for (const BoxRecord& box : boxes) {
                if (box.id) ids.insert(*box.id);
            }
        }
        const EvaluationInput input = prepareEvaluation(truth, kept, options);
        curve.push_back(
            {threshold, static_cast<int>(ids.size()), detectionMeasures(input, matchFrames(input, options))});
    }
    return curve;
}

}  // namespace eyrie

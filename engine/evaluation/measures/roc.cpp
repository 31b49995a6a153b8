#include "evaluation/measures/roc.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace eyrie {

RocCurve rocCurve(std::vector<ScoredSample> samples) {
    double positives = 0;
    for (const ScoredSample& sample : samples) {
        if (std::isnan(sample.score)) throw Error(ErrorKind::input, "ROC curve: a score is not a number");
        if (sample.positive) positives += 1;
    }
    const double negatives = static_cast<double>(samples.size()) - positives;
    if (positives == 0 || negatives == 0) {
        throw Error(ErrorKind::input, "ROC curve: the test set needs both positive and negative samples");
    }
    std::sort(samples.begin(), samples.end(),
              [](const ScoredSample& a, const ScoredSample& b) { return a.score > b.score; });
    RocCurve curve;
    curve.points.push_back({std::numeric_limits<double>::infinity(), 0, 0});
    double true_positives = 0;
    double false_positives = 0;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        (samples[k].positive ? true_positives : false_positives) += 1;
        const bool more_of_this_score = k + 1 < samples.size() && samples[k + 1].score == samples[k].score;
        if (more_of_this_score) continue;
        const RocPoint point{samples[k].score, false_positives / negatives, true_positives / positives};
        const RocPoint& before = curve.points.back();
        curve.area += (point.false_positive_rate - before.false_positive_rate) *
                      (point.true_positive_rate + before.true_positive_rate) / 2;
        curve.points.push_back(point);
    }
    return curve;
}

}  // namespace eyrie

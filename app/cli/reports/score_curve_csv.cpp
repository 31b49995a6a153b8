#include "cli/reports/score_curve_csv.h"

#include <cstdio>

namespace eyrie::cli {

std::string scoreCurveCsv(const std::vector<ScorePoint>& curve) {
    std::string text = "threshold,tracks,tp,fp,fn,precision,recall,f_score\n";
    for (const ScorePoint& point : curve) {
        const DetectionMeasures& m = point.detection;
        char line[200];
        std::snprintf(line, sizeof line, "%.17g,%d,%d,%d,%d,%.6f,%.6f,%.6f\n", point.threshold, point.tracks,
                      m.true_positives, m.false_positives, m.false_negatives, m.precision, m.recall, m.f_score);
        text += line;
    }
    return text;
}

}  // namespace eyrie::cli

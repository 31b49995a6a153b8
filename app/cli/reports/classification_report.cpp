#include "cli/reports/classification_report.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include "io/atomic_file.h"

namespace eyrie::cli {

double ClassificationResult::detectionRateAt(double false_alarm_rate) const {
    double rate = 0;
    for (const RocPoint& point : curve.points) {
        if (point.false_positive_rate <= false_alarm_rate) rate = std::max(rate, point.true_positive_rate);
    }
    return rate;
}

ClassificationResult classify(const VehicleModel& model, const SampleSet& samples) {
    std::vector<cv::Mat> windows;
    for (const Sample& sample : samples) windows.push_back(sample.window);
    const std::vector<double> values = model.decideAll(windows);
    std::vector<ScoredSample> scored;
    for (std::size_t i = 0; i < values.size(); ++i) scored.push_back({values[i], samples[i].vehicle});
    ClassificationResult result;
    result.vehicles = countOf(samples, true);
    result.others = countOf(samples, false);
    result.curve = rocCurve(std::move(scored));
    return result;
}

void writeRocCsv(const std::filesystem::path& path, const RocCurve& curve) {
    std::string text = "threshold,false_alarm_rate,detection_rate\n";
    for (const RocPoint& point : curve.points) {
        char line[96];
        std::snprintf(line, sizeof line, "%.9g,%.9g,%.9g\n", point.threshold, point.false_positive_rate,
                      point.true_positive_rate);
        text += line;
    }
    writeFileAtomically(path, text);
}

std::string fractionText(double value, int decimals) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

}  // namespace eyrie::cli

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "evaluation/measures/roc.h"
#include "learning/models/vehicle_model.h"
#include "learning/training/sample_set.h"

namespace eyrie::cli {

/// How well a model tells vehicles from others in a set.
struct ClassificationResult {
    int vehicles = 0;
    int others = 0;
    RocCurve curve;

    double area() const { return curve.area; }
    /// Highest share of vehicles found while at most this share of the others is taken for one.
    double detectionRateAt(double false_alarm_rate) const;
};

/// Throws Error(input) when the set lacks vehicles or others.
ClassificationResult classify(const VehicleModel& model, const SampleSet& samples);

/// `threshold,false_alarm_rate,detection_rate`, a line per point of the curve. Throws Error(output).
void writeRocCsv(const std::filesystem::path& path, const RocCurve& curve);

/// Fraction with `decimals` digits.
std::string fractionText(double value, int decimals);

}  // namespace eyrie::cli

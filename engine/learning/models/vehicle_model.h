#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "learning/classifiers/classifier.h"
#include "learning/descriptors/descriptor.h"
#include "learning/models/window.h"

namespace eyrie {

/// How a model came about; stored inside its file.
struct TrainingRecord {
    std::string data;  ///< for people: the sources with their counts and terms
    int vehicles = 0;  ///< samples that the classifier saw, mirrored ones included
    int others = 0;
    int hard_negative_rounds = 0;
    std::uint64_t seed = 0;
    std::string utc_time;  ///< "2026-11-21T08:30:00Z"; empty where unknown
    std::string settings;  ///< the parameters, a "name = value" a line
};

/// A descriptor, a classifier trained on it, and where they come from. Immutable; copies share everything.
struct VehicleModel {
    std::shared_ptr<const Descriptor> descriptor;
    std::shared_ptr<const Classifier> classifier;
    TrainingRecord record;
    WindowFit fit;  ///< of the vehicles it was trained on; boxes are made by it

    /// Decision value of a window (CV_8UC1, 16×32, heading up); higher is surer to be a vehicle.
    double decide(const cv::Mat& window) const;
    std::vector<double> decideAll(const std::vector<cv::Mat>& windows) const;
};

/// Replaces the file in one step. Throws Error(output).
void saveModel(const VehicleModel& model, const std::filesystem::path& path);

/// Throws Error(input) when the file is missing, no model of ours, damaged, cut short or from a newer version.
VehicleModel loadModel(const std::filesystem::path& path);

/// The same from and to memory; `name` is the file for messages.
std::string modelBytes(const VehicleModel& model);
VehicleModel modelFromBytes(std::string_view bytes, const std::string& name);

}  // namespace eyrie

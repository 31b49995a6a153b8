#pragma once

#include <cstdint>
#include <vector>

#include "learning/models/vehicle_model.h"
#include "learning/training/sample_set.h"
#include "learning/training/training_set.h"

namespace eyrie {

/// Scans labelled images with a model, upright to a few headings each (those of its vehicles, and random ones), and
/// cuts the windows that it takes for vehicles but that overlap no labelled one by 0.45 or more and no unclear area: at
/// most `wanted`, the worst first, cut as the model was trained. Images without vehicles are scanned for vehicles of
/// the size of `typical`. The same seed finds the same. Ends early, with what it has, when stopped.
SampleSet mineBackground(const VehicleModel& model, const std::vector<LabelledImage>& images,
                         const OrientedBox& typical, int wanted, std::uint64_t seed, const TrainingWatch& watch = {});

}  // namespace eyrie

#pragma once

#include <optional>
#include <utility>

#include "chain/chain_options.h"
#include "detection/detector.h"
#include "detection/sliding_window/box_classifier.h"

namespace eyrie {

/// `classified_at` for the finishing of tracks; nothing where no classifier takes part, since then a box that nobody
/// took for a vehicle says nothing either.
inline ClassifiedAt classifiedVehicles(const ChainOptions& options, ClassifiedAt classified_at) {
    return looksThroughWindows(options.detection.method) ? std::move(classified_at) : ClassifiedAt();
}

/// What gives detections their decision: the classifier of the detector that the options name; nothing where none takes
/// part.
inline std::optional<BoxClassifier> classifierOfBoxes(const Detector& detector, const ChainOptions& options,
                                                      const SceneScale& scale) {
    const VehicleModel* model = detector.model();
    if (model == nullptr) return std::nullopt;
    return BoxClassifier(*model, options.detection.sliding_window, scale);
}

}  // namespace eyrie

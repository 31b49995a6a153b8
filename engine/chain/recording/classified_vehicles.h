#pragma once

#include <optional>
#include <utility>

#include "chain/chain_options.h"
#include "detection/sliding_window/box_classifier.h"

namespace eyrie {

/// `classified_at` for the finishing of tracks; nothing where no classifier takes part, since then a box that nobody
/// took for a vehicle says nothing either.
inline ClassifiedAt classifiedVehicles(const ChainOptions& options, ClassifiedAt classified_at) {
    return looksThroughWindows(options.detection.method) ? std::move(classified_at) : ClassifiedAt();
}

/// What gives detections their decision; nothing where no classifier takes part. Throws Error(input) when its model is
/// missing or damaged.
inline std::optional<BoxClassifier> classifierOfBoxes(const ChainOptions& options, const SceneScale& scale) {
    if (!looksThroughWindows(options.detection.method)) return std::nullopt;
    return makeBoxClassifier(options.detection.sliding_window, scale);
}

}  // namespace eyrie

#pragma once

#include <functional>
#include <memory>
#include <stop_token>

#include "tune/compare/comparison_loader.h"
#include "tune/compare/computed_frames.h"

namespace eyrie::ui {

/// The frames of the sides that are computed; null for stored runs.
struct ComputedPair {
    std::shared_ptr<ComputedFrames> first;
    std::shared_ptr<ComputedFrames> second;
};

/// Computes what is not stored, telling how far it is some times a second, and compares. Stops early, with whatever is
/// there, when `stop` was requested. Throws Error.
SideComparison compareSides(const ComparisonPair& pair, const ComputedPair& computed, const std::stop_token& stop,
                            const std::function<void(int frames_done, int frames_total)>& tell);

}  // namespace eyrie::ui

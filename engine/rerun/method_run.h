#pragma once

#include <functional>
#include <stop_token>
#include <vector>

#include "chain/chain_run.h"
#include "core/labels/box_record.h"
#include "rerun/method_variants.h"

namespace eyrie {

/// What one method found.
struct MethodResult {
    std::string name;
    BoxesByFrame detections;  ///< kept ones
    BoxesByFrame tracks;      ///< finished; empty for the global sliding window
    StageTimes median_ms{};   ///< of the stages after motion vectors
};

/// Sees every frame of every method in ascending order, the peer's some frames late; used to store them. Runs on the
/// caller's thread.
using MethodFrameObserver =
    std::function<void(std::size_t method, const std::shared_ptr<const FrameResult>& result, const Frame& frame)>;

/// Runs several methods over one video. Reading, registration and motion vectors are done once for all, by the
/// parameters of the first; each method gives what it would give alone. Frames are read once and not kept.
/// Throws Error(input | parameter), also where a method lacks its model file.
std::vector<MethodResult> runMethods(FrameSource& source, FrameRange range, const std::vector<MethodVariant>& methods,
                                     const SceneScale& scale, const std::stop_token& stop,
                                     const std::function<void(const RunProgress&)>& progress = {},
                                     const MethodFrameObserver& observer = {});

}  // namespace eyrie

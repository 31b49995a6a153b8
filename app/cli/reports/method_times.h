#pragma once

#include <string>
#include <vector>

#include "chain/chain_options.h"
#include "core/values/frame.h"

namespace eyrie::cli {

/// What a method costs after the motion vectors; medians over frames, ms.
struct MethodTimes {
    std::string name;
    double areas_ms = 0;  ///< clustering, or difference images
    double stacking_ms = 0;
    double detection_ms = 0;
    double removal_ms = 0;  ///< of duplicates and outliers
    double tracking_ms = 0;
};

/// Runs every detector and the difference images without stacking, those of §7.3.4 with it, too, whatever `options` say
/// of stacking, all over the same motion vectors, one frame after the other. The first `warm_up` frames are not
/// counted. Throws Error(input) where a model is missing.
std::vector<MethodTimes> measureMethods(const std::vector<Frame>& frames, const ChainOptions& options,
                                        const SceneScale& scale, int warm_up);

}  // namespace eyrie::cli

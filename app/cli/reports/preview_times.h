#pragma once

#include <filesystem>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "chain/chain_options.h"
#include "core/values/frame.h"

namespace eyrie::cli {

/// How long somebody who drags a slider waits for the first picture.
struct PreviewTimes {
    cv::Size size;        ///< of the frames
    double first_ms = 0;  ///< the first answer of all
    struct Moved {
        std::string parameter;
        double median_ms = 0;
        double longest_ms = 0;
        double final_ms = 0;  ///< until its tracks are followed through the 30 frames before; median
    };
    std::vector<Moved> moved;
};

/// The live preview over frames enlarged to 1024×540, on a run stored in `project`, which is made. Pixels are in
/// memory; results are read from the project.
PreviewTimes measurePreview(const std::vector<Frame>& frames, const ChainOptions& options, SceneScale scale,
                            const std::filesystem::path& project);

}  // namespace eyrie::cli

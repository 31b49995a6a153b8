#pragma once

#include <string>

#include "chain/chain_options.h"
#include "chain/chain_run.h"

namespace eyrie::ui {

/// What the next run will be made with. Edited by the run bar and the parameter form.
struct RunSettings {
    ChainOptions options = builtInPreset("default");
    std::string preset = "default";
    double gsd_m_per_px = 0;  ///< 0: not known
    FrameRange range;
};

}  // namespace eyrie::ui

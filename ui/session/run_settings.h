#pragma once

#include <string>

#include "chain/chain_options.h"
#include "chain/chain_run.h"
#include "core/values/scale_basis.h"
#include "store/details/recording_options.h"

namespace eyrie::ui {

/// What the next run will be made with. Edited by the run bar and the parameter form.
struct RunSettings {
    ChainOptions options = builtInPreset("default");
    std::string preset = "default";
    double gsd_m_per_px = 0;                      ///< 0: not known
    ScaleOrigin gsd_origin = ScaleOrigin::given;  ///< of a GSD that is known: `given` or `metadata`
    FrameRange range;
    RecordingOptions recording;  ///< what the run keeps; changes nothing of what it finds

    /// Another GSD, with where it comes from.
    void useGsd(double value, ScaleOrigin origin = ScaleOrigin::given) {
        gsd_m_per_px = value;
        gsd_origin = origin;
    }
};

}  // namespace eyrie::ui

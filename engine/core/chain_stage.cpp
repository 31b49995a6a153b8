#include "core/chain_stage.h"

namespace eyrie {

const char* nameOf(ChainStage stage) {
    switch (stage) {
        case ChainStage::registration:
            return "registration";
        case ChainStage::motion:
            return "independent motion";
        case ChainStage::clustering:
            return "clustering";
        case ChainStage::stacking:
            return "stacking";
        case ChainStage::detection:
            return "detection";
        case ChainStage::removal:
            return "duplicates and outliers";
        case ChainStage::tracking:
            return "tracking";
        case ChainStage::finishing:
            return "finishing";
        case ChainStage::none:
            break;
    }
    return "nothing";
}

}  // namespace eyrie

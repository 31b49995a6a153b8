#include "core/values/frame_result.h"

namespace eyrie {

const char* nameOf(Stage stage) {
    switch (stage) {
        case Stage::read:
            return "read";
        case Stage::corners:
            return "corners";
        case Stage::tracking_corners:
            return "corner tracking";
        case Stage::homography:
            return "homography";
        case Stage::motion:
            return "independent motion";
        case Stage::clustering:
            return "clustering";
        case Stage::stacking:
            return "stacking";
        case Stage::detection:
            return "detection";
        case Stage::removal:
            return "duplicates and outliers";
        case Stage::tracking:
            return "tracking";
        case Stage::store:
            return "store";
    }
    return "";
}

}  // namespace eyrie

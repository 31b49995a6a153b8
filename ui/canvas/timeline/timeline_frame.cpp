#include "canvas/timeline/timeline_frame.h"

#include <algorithm>

#include "widgets/theme_colours.h"

namespace eyrie::ui {

QColor qualityColour(const TimelineFrame& frame) {
    switch (frame.state) {
        case RegistrationState::failed:
            return {224, 58, 48};
        case RegistrationState::frozen:
            return {122, 142, 170};
        case RegistrationState::first:
        case RegistrationState::registered:
            break;
    }
    return blend(QColor(70, 170, 90), QColor(235, 165, 40), std::clamp(frame.rms_px / kPoorRms, 0.0, 1.0));
}

double badness(const TimelineFrame& frame) {
    switch (frame.state) {
        case RegistrationState::failed:
            return 1000;
        case RegistrationState::frozen:
            return 500;
        case RegistrationState::registered:
            return frame.rms_px;
        case RegistrationState::first:
            break;
    }
    return 0;
}

}  // namespace eyrie::ui

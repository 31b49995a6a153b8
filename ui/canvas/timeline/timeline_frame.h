#pragma once

#include <QColor>

#include "core/values/corner.h"

namespace eyrie::ui {

/// What the timeline knows of a frame that a run has done.
struct TimelineFrame {
    bool done = false;
    RegistrationState state = RegistrationState::first;
    double rms_px = 0;
    int inliers = 0;
    int corners = 0;
    int motion_vectors = 0;
    int tracks = 0;
};

/// Colour of a frame's registration: green at rms 0 towards amber at `kPoorRms`, red when it failed, blue-grey when the
/// picture was frozen.
QColor qualityColour(const TimelineFrame& frame);
inline constexpr double kPoorRms = 0.5;  ///< px

/// How much attention a frame deserves when several share a screen column.
double badness(const TimelineFrame& frame);

}  // namespace eyrie::ui

#pragma once

#include <QString>
#include <functional>

#include "core/values/ids.h"

namespace eyrie::ui {

/// What time it was when the frames of a video were taken, for whoever shows it beside them. By default nobody knows.
struct ClockOfFrames {
    /// The time of the day in UTC, "22:08:22"; empty where nobody knows.
    std::function<QString(FrameIndex)> time = [](FrameIndex) { return QString(); };
    /// The whole moment, "2009-01-12 22:08:22.040 UTC"; empty where nobody knows.
    std::function<QString(FrameIndex)> text = [](FrameIndex) { return QString(); };
    /// What that rests on, for people; empty where nobody knows.
    std::function<QString()> origin = [] { return QString(); };

    bool known() const { return !origin().isEmpty(); }
};

}  // namespace eyrie::ui

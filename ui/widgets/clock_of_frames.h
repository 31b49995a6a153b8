#pragma once

#include <QAbstractItemModel>
#include <QString>
#include <functional>
#include <optional>

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
    /// The first frame taken at a time of the day in UTC (s since midnight) or later; behind the last frame where the
    /// video ends before it. Of the days that on which `near`, told likewise, is nearest to the video. Nothing where
    /// nobody knows.
    std::function<std::optional<FrameIndex>(double seconds, double near)> frame_of_day = [](double, double) {
        return std::optional<FrameIndex>();
    };

    bool known() const { return !origin().isEmpty(); }
    /// The time of the day, or what stands in its place where nobody knows.
    QString timeOr(FrameIndex frame, const QString& otherwise) const {
        const QString told = time(frame);
        return told.isEmpty() ? otherwise : told;
    }
};

/// Tells the views of a list that these columns and their titles follow another clock.
inline void tellClockChanged(QAbstractItemModel& list, int first_column, int last_column) {
    emit list.headerDataChanged(Qt::Horizontal, first_column, last_column);
    const int rows = list.rowCount();
    if (rows > 0) emit list.dataChanged(list.index(0, first_column), list.index(rows - 1, last_column));
}

}  // namespace eyrie::ui

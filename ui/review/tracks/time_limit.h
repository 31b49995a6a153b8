#pragma once

#include <QString>
#include <functional>
#include <optional>

#include "core/review/seen_frames.h"

class QJsonObject;

namespace eyrie::ui {

/// The first frame that was taken at a time of the day in UTC (s since midnight) or later; behind the last one where
/// the video ends before it. The day is that on which `near`, told likewise, is nearest to the video; both may be of
/// the day after. Nothing where nobody knows the time.
using FrameOfDay = std::function<std::optional<FrameIndex>(double seconds, double near)>;
/// The same, asking once for each time.
FrameOfDay remembering(FrameOfDay ask);

/// A moment of a video as a person names it.
struct TimeLimit {
    int value = 0;        ///< a frame, or seconds since midnight
    bool of_day = false;  ///< UTC
    bool operator==(const TimeLimit&) const = default;
};

/// "120" is a frame; "22:08" and "22:08:22" are times of the day. Nothing for other texts.
std::optional<TimeLimit> timeLimitOf(const QString& text);
/// The same as a person would type it.
QString timeLimitText(const TimeLimit& limit);

/// From … to, both included; nothing: no limit there.
struct TimeRange {
    std::optional<TimeLimit> from;
    std::optional<TimeLimit> to;

    bool any() const { return from || to; }
    bool ofDay() const { return (from && from->of_day) || (to && to->of_day); }
    bool operator==(const TimeRange&) const = default;
};

/// The frames that a range leaves. Times of the day limit nothing while nobody knows them (`frame_of_day` may be none).
/// Two of them are of the day on which what lies between them is nearest to the video, over midnight where the second
/// is the earlier one.
FrameSpan framesOf(const TimeRange& range, const FrameOfDay& frame_of_day);
/// Whether some frame lies in both.
inline bool overlap(const FrameSpan& a, const FrameSpan& b) {
    return a.first <= b.last && b.first <= a.last;
}

/// For settings: numbers are frames, texts are times of the day.
QJsonObject jsonOf(const TimeRange& range);
/// What is not understood is no limit.
TimeRange timeRangeOf(const QJsonObject& json);

}  // namespace eyrie::ui

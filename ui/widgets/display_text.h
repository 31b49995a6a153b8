#pragma once

#include <QString>
#include <cstdint>
#include <string>

#include "core/labels/track_class.h"
#include "core/review/track_correction.h"
#include "core/values/scene_scale.h"

/// Numbers as people read them: with units, in metres and km/h when the GSD is known, in pixels otherwise.
namespace eyrie::ui {

/// "m" or "px".
QString lengthUnit(const SceneScale& scale);
/// px in the unit of lengthUnit().
double shownLength(double px, const SceneScale& scale);
/// "km/h" or "px/frame".
QString speedUnit(const SceneScale& scale);
/// px/frame in the unit of speedUnit().
double shownSpeed(double px_per_frame, const SceneScale& scale);

/// A number in the user's locale; a dash for what is none.
QString numberText(double value, int decimals);
/// "41.2 km/h" or "1.73 px/frame".
QString speedText(double px_per_frame, const SceneScale& scale);
/// Without decimals that nobody can rely on, for places with little room: "41 km/h" or "1.7 px/frame".
QString shortSpeedText(double px_per_frame, const SceneScale& scale);
/// "4.4 m" or "12.7 px".
QString lengthText(double px, const SceneScale& scale);
/// "4.9 s", "2:04.9", "1:02:04".
QString durationText(double seconds);
/// "vehicle", "two-wheeler", "person"; a dash for unknown.
QString shownName(TrackClass track_class);
/// "2026-11-21T08:00:00Z" as a short local date and time, today as the time alone; the text itself if it is no
/// time.
QString localTimeText(const std::string& utc);

/// A moment, µs since 1970-01-01, to the millisecond: "2009-01-12 22:08:22.040 UTC".
QString utcMomentText(std::int64_t utc_us);

/// The path of a file as a person named it, with the ending (".ts") that it should have; an empty one stays empty.
QString withEnding(const QString& path, const char* ending);

/// How dialogs ask for projects: "Eyrie projects (*.eyrie)".
QString projectFilter();
/// The same where any other file may be chosen, too.
QString projectOrAnyFilter();

/// How much longer something takes, rounded up to seconds: "0:05 left".
QString leftText(double seconds);

/// With a capital letter at its beginning.
QString capitalised(QString text);

/// What a person did to a track: "by hand", "joined", "split", "rejected".
QString shownName(CorrectionKind kind);

}  // namespace eyrie::ui

#pragma once

#include <QColor>
#include <QIcon>
#include <QString>
#include <optional>
#include <string>
#include <vector>

#include "review/events/found_events.h"

/// Events and verdicts in words and colours.
namespace eyrie::ui {

/// "Stops"; of a kind as it is listed, the last being what could not be searched.
QString listedKindText(int listed_kind);
/// "Enters yard", "Crosses gate to the left".
QString eventKindText(const FoundEvents& found, std::size_t position);
/// "Stops, stands 12.4 s, starts again": an event with those of the same stop that stand in its row; without such as
/// above.
QString eventRowText(const FoundEvents& found, std::size_t position, const std::vector<std::size_t>& others);
/// The same of what a verdict is on.
QString eventKindText(const ReviewSubject& subject);
/// "12", the number that eyrie-cli has it under; empty for a stretch that could not be searched.
QString eventNumberText(const FoundEvents& found, std::size_t position);
/// When the event begins: "1:02.4".
QString eventClockText(const FoundEvents& found, std::size_t position);
/// "12, 15"; empty for a stretch that could not be searched.
QString eventTracksText(const FoundEvents& found, std::size_t position);
/// "43 km/h"; of what has no figure, how long it lasts.
QString eventFigureText(const FoundEvents& found, std::size_t position);
/// "Speed before 43 km/h", what the figure counts as well; empty without one.
QString countedFigureText(const FoundEvents& found, std::size_t position);
/// How long it lasts, s; nothing for what happens in a moment.
std::optional<double> eventSeconds(const FoundEvents& found, std::size_t position);
/// The lowest or the highest speed while it lasts, in the unit of speedUnit() of the run's scale; nothing where that is
/// not known.
std::optional<double> eventSpeed(const FoundEvents& found, std::size_t position, double SpeedRange::*which);
/// Kind, zone and sense, number, frames and place in the queue, for tooltips. Without what was said about it.
QString eventTipText(const FoundEvents& found, std::size_t position);

/// "Relevant"; empty while it is not judged.
QString judgementText(Judgement judgement);
/// "Relevant: Anna, 4 Mar 2026 14:03", who said it and when (`utc`: ISO 8601); without a judgement "Anna, 14:03". As
/// much of it as is known; empty where nothing was said.
QString judgedText(Judgement judgement, const QString& person, const std::string& utc);
/// Told apart from each other on light and dark grounds, and by shape, too, where drawn as icons.
QColor judgementColour(Judgement judgement, bool dark);
QIcon judgementIcon(Judgement judgement, bool dark);

}  // namespace eyrie::ui

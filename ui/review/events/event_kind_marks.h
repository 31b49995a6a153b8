#pragma once

#include <QColor>
#include <QPixmap>
#include <QString>

#include "canvas/timeline/timeline_kinds.h"
#include "core/review/verdict.h"

/// How kinds of events look, the same in the list, its menu of kinds and the timeline.
namespace eyrie::ui {

/// Kinds that share a colour.
enum class EventGroup { passage, standing, way, speed, company, zone, unsearched };

/// What a kind is known by: colours tell groups apart, also where one kind of cone is missing; letters and shapes tell
/// what colours do not.
struct EventKindMark {
    EventGroup group = EventGroup::unsearched;
    const char* letters = "";                ///< two, no other kind's
    BarShape shape = BarShape::full_height;  ///< on the timeline; no other kind's of the group
};

/// Of a kind as it is listed, the last being what could not be searched.
const EventKindMark& markOf(int listed_kind);
/// Seen well on the grounds of the dark or the light theme.
QColor groupColour(EventGroup group, bool dark);
/// A plate in the colour of the kind's group with its letters.
QPixmap kindPlate(int listed_kind, bool dark);
/// How an event of a kind was judged, and the plate.
QPixmap judgedKindPlate(Judgement judgement, int listed_kind, bool dark);

}  // namespace eyrie::ui

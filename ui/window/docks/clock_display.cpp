#include "window/docks/clock_display.h"

#include "canvas/timeline/timeline_view.h"
#include "review/earth/earth_dock.h"
#include "review/earth/video_earth.h"
#include "review/events/events_dock.h"
#include "review/inspector/inspector_panel.h"
#include "review/inspector/track_inspector.h"
#include "review/mosaic/mosaic_panel.h"
#include "session/project_session.h"
#include "widgets/wiring.h"
#include "window/bars/status_fields.h"
#include "window/docks/review_docks.h"
#include "window/docks/watching_docks.h"
#include "workspace/timeline_binding.h"

namespace eyrie::ui {

ClockDisplay::ClockDisplay(const ClockParts& parts, QObject* parent) : QObject(parent), parts_(parts) {
    VideoEarth& earth = parts_.watching.earth().earth();
    parts_.binding.setClock([&earth](FrameIndex frame) { return earth.clockText(frame); });
    parts_.status.setPlaces({[this, &earth](QPointF px) { return earth.placeOf(parts_.session.shownFrame(), px); },
                             [&earth] { return earth.origin(); }});
    whenAny(&earth, &parts_.status, &StatusFields::showPlace, &VideoEarth::changed);
    whenAny(&earth, this, &ClockDisplay::showClock, &VideoEarth::clockChanged);
    TrackInspector& inspector = parts_.review.inspector().track();
    inspector.setCourse([&earth](FrameIndex frame, const OrientedBox& box) {
        return earth.courseOf(frame, {box.centre.x, box.centre.y}, box.heading);
    });
    whenAny(&earth, &inspector, &TrackInspector::showCourse, &VideoEarth::changed);
    showClock();
}

void ClockDisplay::showClock() {
    const VideoEarth& earth = parts_.watching.earth().earth();
    const ClockOfFrames clock = earth.clock();
    parts_.status.setClock(clock);
    parts_.events.setClock(clock);
    parts_.review.setClock(clock);
    parts_.watching.mosaic().setClock(clock);
    if (clock.known())
        parts_.timeline.setClock([&earth](std::int64_t video_us) { return earth.utcAt(video_us); });
    else
        parts_.timeline.setClock({});
}

}  // namespace eyrie::ui

#include "moc_clock_display.cpp"

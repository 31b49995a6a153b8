#include "window/handover/run_handover.h"

#include <QWidget>

#include "review/events/event_text.h"
#include "review/events/events_dock.h"
#include "review/events/events_model.h"
#include "session/project_session.h"
#include "widgets/message_bar.h"
#include "widgets/wiring.h"
#include "window/handover/clip_dialog.h"
#include "window/handover/track_export.h"
#include "workspace/session_reactions.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

RunHandover::RunHandover(const HandoverParts& parts) : QObject(&parts.window), parts_(parts) {
    const WindowActions& actions = parts_.actions;
    bindCommands(this, {{actions.export_tracks, [this] { exportTracks(); }},
                        {actions.clip_event, [this] { clipOfEvent(); }},
                        {actions.clip_track, [this] { clipOfTrack(); }}});
    followSession(
        parts_.session, this,
        {{{SessionChange::video, SessionChange::current_run, SessionChange::run_data, SessionChange::run_ended},
          [this] { enableActions(); }}});
    enableActions();
}

void RunHandover::enableActions() {
    const bool has_run = parts_.session.runData() != nullptr;
    const bool has_pictures = has_run && parts_.session.media() && !parts_.session.timesUs().empty();
    parts_.actions.export_tracks->setEnabled(has_run);
    parts_.actions.clip_event->setEnabled(has_pictures);
    parts_.actions.clip_track->setEnabled(has_pictures);
}

void RunHandover::exportTracks() {
    ExportDialog dialog(trackExport(parts_.session), &parts_.window);
    dialog.setFormat(QStringLiteral("tracks-csv"));  // what an operator hands over: times, metres, km/h and places
    dialog.exec();
}

void RunHandover::clipOfEvent() {
    const auto place = parts_.events.currentPlace();
    const Event* event = place ? parts_.events.model().found()->eventAt(*place) : nullptr;
    if (event == nullptr) return remind(tr("Select an event first; the clip covers it and what is around it."));
    const QString number = eventNumberText(*parts_.events.model().found(), *place);
    ClipDialog dialog(parts_.session, {tr("Clip of event %1").arg(number), {event->first_frame, event->last_frame}},
                      &parts_.window);
    dialog.exec();
}

void RunHandover::clipOfTrack() {
    const auto track = parts_.session.selectedTrack();
    const TrackSummary* life = track ? parts_.session.trackSummary(*track) : nullptr;
    if (life == nullptr) return remind(tr("Select a track first; the clip covers the whole track."));
    ClipDialog dialog(parts_.session, {tr("Clip of track %1").arg(*track), {life->first_frame, life->last_frame}},
                      &parts_.window);
    dialog.exec();
}

void RunHandover::remind(const QString& text) {
    parts_.messages.showMessage(MessageKind::info, text);
}

}  // namespace eyrie::ui

#include "moc_run_handover.cpp"

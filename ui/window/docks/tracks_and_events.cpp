#include "window/docks/tracks_and_events.h"

#include "review/correct/track_correcting.h"
#include "review/events/event_review.h"
#include "review/events/events_dock.h"
#include "review/events/events_panel.h"
#include "review/pictures/picture_column.h"
#include "review/tracks/filter_chips.h"
#include "review/tracks/tracks_panel.h"
#include "widgets/wiring.h"
#include "window/docks/review_docks.h"
#include "workspace/dock_registry.h"

namespace eyrie::ui {

void joinTracksAndEvents(ReviewDocks& review, EventsDock& events, DockRegistry& docks, ProjectSession& session) {
    TracksPanel& tracks = review.tracks();
    review.setDoingsWanted([&events] { events.review().setWanted(); });
    review.setQueryChanged(
        [&tracks, &events] { events.panel().setQuery(tracks.query(), [&tracks] { tracks.chips().clear(); }); });
    TrackCorrecting& correcting = events.correcting();
    correcting.setList(tracks);
    docks.watch(DockId::tracks, &correcting, [&correcting](bool) { correcting.enableActions(); });
    auto* pictures = new PictureColumn(tracks, TracksModel::picture_column, session, [&events](int track) {
        const auto& run = events.review().tracks();
        return run ? placeOfTrack(*run, track) : std::nullopt;
    });
    whenAny(&events, pictures, &PictureColumn::refresh, &EventsDock::tracksRead);
    const auto tell_doings = [&tracks, &events] {
        const auto& found = events.review().found();
        tracks.setDoings(found ? found->doings : nullptr);
    };
    whenAny(&events, &tracks, tell_doings, &EventsDock::eventsShown);
}

}  // namespace eyrie::ui

#include "window/docks/watching_docks.h"

#include <optional>

#include "canvas/timeline/timeline_view.h"
#include "canvas/video_view.h"
#include "review/card/card_dock.h"
#include "review/earth/earth_dock.h"
#include "review/earth/ground_control.h"
#include "review/earth/video_earth.h"
#include "review/events/event_review.h"
#include "review/events/events_dock.h"
#include "review/events/events_panel.h"
#include "review/mosaic/mosaic_panel.h"
#include "review/mosaic/mosaic_view.h"
#include "review/tracks/like_tracks.h"
#include "review/tracks/tracks_panel.h"
#include "review/watch/seen_watch.h"
#include "review/watch/steady_watch.h"
#include "review/watch/watch_commands.h"
#include "review/watch/watched_ground.h"
#include "session/project_session.h"
#include "widgets/message_bar.h"
#include "widgets/wiring.h"
#include "window/docks/review_docks.h"
#include "workspace/dock_registry.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

WatchingDocks::WatchingDocks(const WatchingParts& parts)
    : QObject(&parts.window),
      parts_(parts),
      ground_(new WatchedGround(this)),
      like_(new LikeTracks({parts.session, parts.review.tracks(), parts.docks, parts.actions, parts.messages}, this)),
      earth_(new EarthDock({parts.session, parts.canvas, parts.docks, parts.actions, parts.messages})),
      steady_(new SteadyWatch({parts.session, parts.canvas, parts.actions, parts.messages, *ground_}, this)),
      commands_(new WatchCommands(
          {parts.session, parts.canvas, parts.actions, parts.messages, parts.overlays, *ground_}, this)) {
    parts_.review.setLikenessWanted([this](std::optional<TrackId> track) { like_->want(track); });
    whenAny(&parts_.events, this, &WatchingDocks::showGround, &EventsDock::tracksRead);
    whenAny(
        ground_, like_, [this] { like_->setGround(ground_->ground()); }, &WatchedGround::changed);
    const auto show_watched = [this](const std::optional<WatchedFrames>& watched) {
        parts_.events.panel().showSeen(watched ? std::optional(watched->share) : std::nullopt);
        parts_.timeline.setWatched(watched ? std::optional(watched->spans) : std::nullopt);
    };
    seen_ = new SeenWatch(parts_.session, parts_.canvas, parts_.window, show_watched, this);
    card_ = new CardDock({parts_.session, parts_.docks, parts_.events, *ground_});
    wireMosaic();
}

void WatchingDocks::showGround() {
    ground_->setRun(parts_.events.review().tracks());
    earth_->earth().setRun(parts_.events.review().tracks());
}

void WatchingDocks::wireMosaic() {
    mosaic_ = new MosaicPanel({parts_.session, parts_.overlays, *ground_});
    parts_.docks.add(DockId::mosaic, tr("Mosaic"), mosaic_);
    parts_.docks.watch(DockId::mosaic, mosaic_, [this](bool visible) { mosaic_->setLookedAt(visible); });
    bindCommands(this, {{parts_.actions.show_mosaic, [this] {
                             parts_.docks.raise(DockId::mosaic);
                             mosaic_->view().setFocus();
                         }}});
}

void WatchingDocks::setActive(bool active) {
    commands_->setActive(active);
    earth_->control().setActive(active);
    steady_->setActive(active);
}

void WatchingDocks::enableActions() {
    steady_->enableActions();
    commands_->enableActions();
}

}  // namespace eyrie::ui

#include "moc_watching_docks.cpp"

#include "review/tracks/like_tracks.h"

#include "ground/track_likeness.h"
#include "review/tracks/filter_chips.h"
#include "review/tracks/tracks_panel.h"
#include "review/watch/watched_ground.h"
#include "session/project_session.h"
#include "widgets/message_bar.h"
#include "widgets/wiring.h"
#include "workspace/dock_registry.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {
namespace {

const QString kLikeTopic = QStringLiteral("tracks like one");

}  // namespace

LikeTracks::LikeTracks(const LikeParts& parts, QObject* parent) : QObject(parent), parts_(parts) {
    bindCommands(this, {{parts_.actions.like_track, [this] {
                             parts_.docks.raise(DockId::tracks);
                             parts_.panel.listLike(parts_.session.selectedTrack());
                         }}});
    whenChanged(parts_.session, this,
                {
                    {SessionChange::selection, [this] { enableAction(); }},
                    {SessionChange::current_run,
                     [this] {
                         // The number means another vehicle there.
                         if (shown_run_ != parts_.session.currentRun()) parts_.panel.listLike(std::nullopt);
                         shown_run_ = parts_.session.currentRun();
                     }},
                });
    enableAction();
}

void LikeTracks::enableAction() {
    parts_.actions.like_track->setEnabled(parts_.session.selectedTrack().has_value());
}

void LikeTracks::setGround(const std::shared_ptr<const RunGround>& ground) {
    if (ground_ == ground) return;
    ground_ = ground;
    search();
}

void LikeTracks::want(std::optional<TrackId> track) {
    wanted_ = track;
    parts_.messages.dismissTopic(kLikeTopic);
    search();
}

void LikeTracks::search() {
    query_.cancel();
    sayWaiting(wanted_.has_value());
    if (!wanted_ || !ground_) return;
    const auto work = [this, ground = ground_, track = *wanted_](const BackgroundTask& task) {
        auto likeness = std::make_shared<LikenessByTrack>();
        likeness->chosen = track;
        for (const TrackLikeness& each : tracksLike(*ground->run, ground->stretches, track))
            likeness->likeness[each.track] = each.likeness;
        task.tell([this, likeness] {
            sayWaiting(false);
            parts_.panel.setLikeness(likeness);
        });
    };
    query_.ask(work, [this](const QString& message) { fail(message); });
}

void LikeTracks::sayWaiting(bool waits) {
    const RunRecord* run = parts_.session.shownRun();
    const bool at_work = parts_.session.running() || (run != nullptr && run->live);
    QString why;
    if (waits) why = at_work && !ground_ ? tr("when the run ends") : tr("being looked for…");
    parts_.panel.chips().setLikeWaiting(why);
}

void LikeTracks::fail(const QString& text) {
    sayWaiting(false);
    parts_.panel.listLike(std::nullopt);
    parts_.messages.showTopic(
        kLikeTopic, MessageKind::warning,
        tr("Tracks like this one cannot be listed: %1. Choose one that is not tentative or left out.").arg(text));
}

}  // namespace eyrie::ui

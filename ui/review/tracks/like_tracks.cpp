#include "review/tracks/like_tracks.h"

#include "ground/track_likeness.h"
#include "review/tracks_panel.h"
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

void LikeTracks::setRun(const std::shared_ptr<const StoredTracks>& run) {
    if (run_ == run) return;
    run_ = run;
    search();
}

void LikeTracks::want(std::optional<TrackId> track) {
    wanted_ = track;
    parts_.messages.dismissTopic(kLikeTopic);
    search();
}

void LikeTracks::search() {
    query_.cancel();
    if (!wanted_ || !run_) return;
    const auto work = [this, run = run_, track = *wanted_](const BackgroundTask& task) {
        const GroundStretches ground(run->footage);
        auto likeness = std::make_shared<LikenessByTrack>();
        likeness->chosen = track;
        for (const TrackLikeness& each : tracksLike(*run, ground, track))
            likeness->likeness[each.track] = each.likeness;
        task.tell([this, likeness] { parts_.panel.setLikeness(likeness); });
    };
    query_.ask(work, [this](const QString& message) { fail(message); });
}

void LikeTracks::fail(const QString& text) {
    parts_.panel.listLike(std::nullopt);
    parts_.messages.showTopic(
        kLikeTopic, MessageKind::warning,
        tr("No tracks like this one can be told: %1. Choose one that is not tentative or left out.").arg(text));
}

}  // namespace eyrie::ui

#include "review/tracks/like_tracks.h"

#include <utility>

#include "ground/look_reading.h"
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

/// Looks at all tracks that were not looked at; `tell` gets the per cent done when they are others.
template <class Tell>
LooksRead lookAt(LookReading& reading, const RunGround& ground, const Media& media, const std::stop_token& stop,
                 const Tell& tell) {
    const auto open = [&]() -> ReadPicture {
        const std::shared_ptr<FrameSource> source = media.open({}, stop);
        return [source](FrameIndex frame) { return source->read(frame, true); };
    };
    tell(0);  // a video that is opened for the first time is indexed
    int percent = 0;
    const auto tell_percent = [&](double share) {
        const int done = static_cast<int>(100 * share);
        if (std::exchange(percent, done) < done) tell(done);
    };
    return reading.goOn(ground.run->tracks, open, tell_percent, stop);
}

}  // namespace

LikeTracks::LikeTracks(const LikeParts& parts, QObject* parent)
    : QObject(parent), parts_(parts), reading_(std::make_shared<LookReading>()) {
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
    looks_.reset();
    reading_ = std::make_shared<LookReading>();
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
    const auto& limit = parts_.panel.chips().filter().like;
    const LikenessChoice counts = limit ? limit->counts : LikenessChoice();
    const auto work = [this, ground = ground_, track = *wanted_, counts, media = parts_.session.media(), known = looks_,
                       reading = reading_](const BackgroundTask& task) {
        std::vector<TrackLikeness> found = tracksLike(*ground->run, ground->stretches, track);
        if (known) compareLooks(found, *known, track);
        task.tell([this, track, found, counts] { take(track, found, counts); });
        if (!counts.looks || known || !media) return;
        const LooksRead seen = lookAt(*reading, *ground, *media, task.stop(), [&](int percent) {
            task.tell(
                [this, percent] { parts_.panel.chips().setLikeWaiting(tr("looking at pictures, %1 %").arg(percent)); });
        });
        if (task.stop().stop_requested()) return;
        compareLooks(found, seen.looks, track);
        task.tell([this, track, found, counts, looks = std::make_shared<const LooksByTrack>(seen.looks),
                   missing = QString::fromStdString(seen.missing())] {
            takeLooks(looks, missing);
            take(track, found, counts);
        });
    };
    query_.ask(work, [this](const QString& message) { fail(message); });
}

void LikeTracks::take(TrackId chosen, const std::vector<TrackLikeness>& found, const LikenessChoice& counts) {
    auto likeness = std::make_shared<LikenessByTrack>();
    likeness->chosen = chosen;
    for (const TrackLikeness& each : found) likeness->likeness[each.track] = likenessBy(each, counts);
    sayWaiting(false);
    parts_.panel.setLikeness(likeness);
}

void LikeTracks::takeLooks(std::shared_ptr<const LooksByTrack> looks, const QString& missing) {
    if (missing.isEmpty()) {
        looks_ = std::move(looks);
        return;
    }
    reading_ = std::make_shared<LookReading>();  // what could not be read may be there the next time
    parts_.messages.showTopic(kLikeTopic, MessageKind::warning,
                              tr("What vehicles look like does not count, or only in part: %1.").arg(missing));
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

#include "moc_like_tracks.cpp"

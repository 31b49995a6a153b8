#include "review/correct/track_correcting.h"

#include <QTableView>
#include <exception>
#include <map>
#include <set>
#include <utility>

#include "canvas/video_view.h"
#include "core/error.h"
#include "correction/made_corrections.h"
#include "review/correct/vehicle_box_tool.h"
#include "review/events/event_review.h"
#include "review/tracks/tracks_panel.h"
#include "session/background/pace.h"
#include "session/project/media.h"
#include "session/project_session.h"
#include "widgets/display_text.h"
#include "widgets/message_bar.h"
#include "widgets/wiring.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {

const QString kCorrectingTopic = QStringLiteral("correcting tracks");
constexpr double kThereAlready = 0.3;  ///< overlap of a box that is drawn with one that is shown

bool isRejectable(const TrackSummary& track) {
    return !track.doubtful && !isRejected(track);
}

}  // namespace

TrackCorrecting::TrackCorrecting(const CorrectingParts& parts, QObject* parent)
    : QObject(parent), parts_(parts), tool_(new VehicleBoxTool(parts.canvas, this)) {
    tool_->setFinished([this](const OrientedBox& box) { follow(box); });
    tool_->setDrawingChanged([this] { parts_.actions.add_track->setChecked(tool_->drawing()); });
    const WindowActions& actions = parts_.actions;
    bindCommands(this, {
                           {actions.add_track, [this](bool on) { startDrawing(on); }},
                           {actions.join_tracks, [this](bool on) { startJoin(on); }},
                           {actions.split_track, [this] { split(); }},
                           {actions.reject_tracks, [this] { reject(); }},
                           {actions.remove_correction, [this] { removeLast(); }},
                           {actions.undo_verdict, [this] { forgetWhatWasTold(); }},
                           {actions.redo_verdict, [this] { forgetWhatWasTold(); }},
                           {actions.deselect,
                            [this] {
                                tool_->cancel();
                                endJoin();
                            }},
                       });
    whenChanged(parts_.session, this,
                {
                    {SessionChange::selection,
                     [this] {
                         joinWithSelected();
                         enableActions();
                     }},
                    {{SessionChange::run_data, SessionChange::frame}, [this] { enableActions(); }},
                    {SessionChange::work_ends, [this] { following_.request_stop(); }},
                    {{SessionChange::video, SessionChange::current_run},
                     [this] {
                         tool_->cancel();
                         endJoin();
                         following_.request_stop();
                         enableActions();
                     }},
                });
    enableActions();
}

TrackCorrecting::~TrackCorrecting() = default;

void TrackCorrecting::setList(const TracksPanel& list) {
    list_ = &list;
    whenAny(list.table()->selectionModel(), this, &TrackCorrecting::enableActions,
            &QItemSelectionModel::selectionChanged);
}

void TrackCorrecting::setActive(bool active) {
    active_ = active;
    if (!active) {
        tool_->cancel();
        endJoin();
    }
    enableActions();
}

void TrackCorrecting::enableActions() {
    const WindowActions& actions = parts_.actions;
    const auto selected = parts_.session.selectedTrack();
    const auto& tracks = parts_.review.tracks();
    const bool possible = active_ && !working_ && parts_.review.canMark() && tracks;
    actions.add_track->setEnabled(possible);
    const bool of_one = possible && selected;
    const bool rejected = of_one && tracks->corrections.rejected.contains(*selected);
    actions.join_tracks->setEnabled(of_one && !rejected);
    actions.split_track->setEnabled(of_one && !rejected);
    // Each of many is looked at when it is asked for: this is done in every frame.
    const bool of_many = of_one && areSeveralChosen();
    const TrackSummary* summary = selected ? parts_.session.trackSummary(*selected) : nullptr;
    actions.reject_tracks->setEnabled(of_many || (of_one && summary != nullptr && isRejectable(*summary)));
    actions.remove_correction->setEnabled(of_many || (of_one && tracks->corrections.touched(*selected) != nullptr));
}

// ---- which tracks ---------------------------------------------------------------------------------------------------

std::vector<TrackId> TrackCorrecting::chosen() const {
    const auto selected = parts_.session.selectedTrack();
    if (!selected) return {};
    const QList<int> listed = isListSeen() ? list_->selectedIds() : QList<int>();
    // A track whose row is filtered away is meant alone.
    if (!listed.contains(*selected)) return {*selected};
    return {listed.begin(), listed.end()};
}

bool TrackCorrecting::isListSeen() const {
    // A table behind another tab is not hidden: it lies outside the window.
    return list_ && !list_->table()->viewport()->visibleRegion().isEmpty();
}

bool TrackCorrecting::areSeveralChosen() const {
    if (!isListSeen()) return false;
    int rows = 0;
    for (const QItemSelectionRange& range : list_->table()->selectionModel()->selection()) rows += range.height();
    return rows > 1;
}

// ---- trying ---------------------------------------------------------------------------------------------------------

void TrackCorrecting::attempt(const QString& step, const MakeCorrections& make, const Kept& kept, std::size_t most) {
    const auto& data = parts_.session.runData();
    if (working_ || !data) return;
    working_.emplace();
    enableActions();
    std::vector<int> numbers(most);
    for (int& number : numbers) number = parts_.review.newCorrectionId();
    const TriedOn tried_on{parts_.session.project(), data->record, parts_.review.corrections(),
                           parts_.session.correctedTracks()};
    const auto work = [this, step, make, kept, numbers, tried_on](const BackgroundTask& task) {
        const auto tried = std::make_shared<const TriedCorrections>(tryCorrections(tried_on, make, numbers, task));
        task.tell([this, step, tried, kept, project = tried_on.project, run_id = tried_on.run.id] {
            const auto due = std::exchange(working_, std::nullopt);  // until it is stored
            enableActions();
            // While it was tried, another run or project may have been chosen.
            if (parts_.session.project() == project && parts_.session.currentRun() == run_id)
                finish(step, *tried, kept);
            else if (parts_.session.project() == project)
                warn(tr("“%1” was given up: another run is shown now.").arg(step));
        });
    };
    following_ = query_.post(work, [this](const QString& failure) {
        working_.reset();
        enableActions();
        warn(capitalised(failure));
    });
}

void TrackCorrecting::finish(const QString& step, const TriedCorrections& tried, const Kept& kept) {
    parts_.messages.dismissTopic(kCorrectingTopic);
    if (tried.made.empty()) return tellRefused(tried);
    if (parts_.review.correct(tried.made, step)) kept(tried);
}

void TrackCorrecting::tellRefused(const TriedCorrections& tried) {
    switch (tried.state) {
        case CorrectionState::covered:
            warn(tried.refused.kind == CorrectionKind::add
                     ? tr("Track %1 already follows this vehicle most of the time; nothing was added.")
                           .arg(tried.covering)
                     : tr("That is already the case; nothing was changed."));
            return;
        case CorrectionState::apart:
            warn(tr("The two tracks are in different places at the same time, so they cannot be the same vehicle."));
            return;
        default:
            warn(tr("Nothing was changed: %1.").arg(QString::fromUtf8(nameOf(tried.state))));
    }
}

void TrackCorrecting::tell(const QString& text) {
    parts_.messages.showTopic(kCorrectingTopic, MessageKind::info, text);
}

void TrackCorrecting::warn(const QString& text) {
    parts_.messages.showTopic(kCorrectingTopic, MessageKind::warning, text);
}

void TrackCorrecting::forgetWhatWasTold() {
    if (!join_with_ && !working_) parts_.messages.dismissTopic(kCorrectingTopic);
}

// ---- joining, splitting, rejecting ----------------------------------------------------------------------------------

void TrackCorrecting::startJoin(bool wanted) {
    const auto selected = parts_.session.selectedTrack();
    if (!wanted || !selected) return endJoin();
    join_with_ = selected;
    parts_.session.playback().pause();
    parts_.messages.showTopic(
        kCorrectingTopic, MessageKind::info,
        tr("Click the track that follows the same vehicle as track %1, in the video or in the list.").arg(*selected),
        tr("Cancel"), [this] { endJoin(); });
}

void TrackCorrecting::endJoin() {
    parts_.actions.join_tracks->setChecked(false);
    if (std::exchange(join_with_, std::nullopt)) parts_.messages.dismissTopic(kCorrectingTopic);
}

void TrackCorrecting::joinWithSelected() {
    const auto other = parts_.session.selectedTrack();
    if (!join_with_ || !other || *other == *join_with_) return;
    const TrackId one = *join_with_;
    endJoin();
    attempt(
        tr("Join tracks %1 and %2").arg(one).arg(*other),
        [one, other = *other](const CorrectionTrial& trial) {
            return std::vector{joinOf(trial.statesOf(one), trial.statesOf(other))};
        },
        [this, one, other = *other](const TriedCorrections&) {
            // It has the number of the one that begins first.
            const auto first = parts_.session.trackSummary(one), second = parts_.session.trackSummary(other);
            const bool keeps = first != nullptr && second != nullptr && first->first_frame <= second->first_frame;
            parts_.session.selectTrack(keeps ? one : other);
            tell(tr("Tracks %1 and %2 are one now, track %3. Undo takes it back.")
                     .arg(one)
                     .arg(other)
                     .arg(keeps ? one : other));
        });
}

void TrackCorrecting::split() {
    const auto selected = parts_.session.selectedTrack();
    if (!selected) return;
    parts_.session.playback().pause();
    const FrameIndex frame = parts_.session.shownFrame();
    attempt(
        tr("Split track %1").arg(*selected),
        [track = *selected, frame](const CorrectionTrial& trial) {
            return std::vector{splitOf(trial.statesOf(track), frame)};
        },
        [this, track = *selected, frame](const TriedCorrections& tried) {
            parts_.session.selectTrack(tried.newTrack());
            tell(tr("Track %1 ends before frame %2; from there on it is track %3. Undo takes it back.")
                     .arg(track)
                     .arg(frame)
                     .arg(tried.newTrack()));
        });
}

void TrackCorrecting::reject() {
    const auto& data = parts_.session.runData();
    if (!data) return;
    const std::vector<TrackId> all = chosen();
    const std::set<TrackId> wanted(all.begin(), all.end());
    std::vector<TrackId> tracks;
    for (const TrackSummary& track : data->tracks)
        if (wanted.contains(track.id) && isRejectable(track)) tracks.push_back(track.id);
    if (tracks.empty())
        return warn(tr("None of the selected tracks is part of the result, so there is nothing to reject."));
    const auto make = [tracks](const CorrectionTrial& trial) {
        std::vector<TrackCorrection> rejections;
        const std::set<TrackId> none_kept(tracks.begin(), tracks.end());
        for (const TrackId track : tracks) rejections.push_back(trial.rejectionOf(track, none_kept));
        return rejections;
    };
    const auto kept = [this, tracks](const TriedCorrections& tried) {
        const std::size_t made = tried.made.size();
        QString text =
            made == 1
                ? tr("Track %1 is rejected: it remains only in the list of tracks. Undo takes it back.")
                      .arg(tracks[tried.made_at.front()])
                : tr("%1 tracks are rejected: they remain only in the list of tracks. Undo takes them back.").arg(made);
        if (const std::size_t refused = tracks.size() - made; refused > 0)
            text += QLatin1Char(' ') + (refused == 1 ? tr("1 other could not be rejected: %1.")
                                                     : tr("%1 others could not be rejected: %2.").arg(refused))
                                           .arg(QString::fromUtf8(nameOf(tried.state)));
        tell(text);
    };
    attempt(tracks.size() == 1 ? tr("Reject track %1").arg(tracks.front()) : tr("Reject %1 tracks").arg(tracks.size()),
            make, kept, tracks.size());
}

void TrackCorrecting::removeLast() {
    const auto& tracks = parts_.review.tracks();
    if (!tracks) return;
    const auto& corrections = parts_.review.corrections();
    std::map<int, TrackId> last;  // both parts of a split have one
    for (const TrackId id : chosen()) {
        const CorrectedTrack* track = tracks->corrections.touched(id);
        if (track != nullptr && !track->corrections.empty() && corrections.contains(track->corrections.back()))
            last.emplace(track->corrections.back(), id);
    }
    if (last.empty()) return warn(tr("Nobody corrected any of the selected tracks."));
    std::vector<int> ids;
    for (const auto& [id, track] : last) ids.push_back(id);
    if (ids.size() > 1) {
        if (parts_.review.removeCorrections(ids, tr("Take back %1 corrections").arg(ids.size())))
            tell(tr("%1 corrections were taken back. Undo brings them back.").arg(ids.size()));
        return;
    }
    const auto& [id, track] = *last.begin();
    const CorrectionKind kind = corrections.at(id).kind;
    const QString done = QString::fromUtf8(nameOf(kind));
    if (parts_.review.removeCorrections(ids, tr("Remove \"%1\" of track %2").arg(done).arg(track)))
        tell((kind == CorrectionKind::reject ? tr("Track %1 is no longer %2. Undo rejects it again.")
                                             : tr("Track %1 is no longer %2. Undo brings it back."))
                 .arg(track)
                 .arg(done));
}

// ---- adding ---------------------------------------------------------------------------------------------------------

void TrackCorrecting::startDrawing(bool wanted) {
    if (!wanted) return tool_->cancel();
    parts_.session.playback().pause();
    tool_->start();
}

QString TrackCorrecting::followingText(const DrawnVehicleAdvance& advance, double seconds_left) {
    return (advance.backwards ? tr("Following the vehicle backwards: frame %1, at most %2.")
                              : tr("Following the vehicle forwards: frame %1, at most %2."))
        .arg(advance.frame)
        .arg(leftText(seconds_left));
}

void TrackCorrecting::showFollowing(const QString& text) {
    parts_.messages.showTopic(kCorrectingTopic, MessageKind::info, text, tr("Stop and keep"),
                              [this] { following_.request_stop(); });
}

void TrackCorrecting::follow(const OrientedBox& box) {
    const ViewFrame& shown = parts_.canvas.frame();
    const auto& tracks = parts_.review.tracks();
    if (!parts_.session.media() || !tracks) return;
    if (shown.result)
        for (const TrackState& state : shown.result->tracks)
            if (overlap(state.box, box) > kThereAlready && state.status != TrackStatus::tentative) {
                parts_.session.selectTrack(state.id);
                return warn(tr("Track %1 already follows this vehicle.").arg(state.id));
            }
    const FrameIndex frame = shown.index;
    const auto make = [this, box, frame, tracks, media = *parts_.session.media()](const CorrectionTrial& trial) {
        const std::stop_token& stop = trial.task.stop();
        const auto source = media.open({}, stop);
        const GrayFrames gray = grayReader(*source);
        Pace pace;
        const auto progress = [this, &trial, &pace](const DrawnVehicleAdvance& advance) {
            if (!pace.isDue()) return;
            const double left = pace.secondsLeft(advance.done, advance.most_left);
            trial.task.tell([this, advance, left] { showFollowing(followingText(advance, left)); });
        };
        const Footage& footage = tracks->footage;
        DrawnVehicle& vehicle = trial.tried.vehicle;
        vehicle =
            followBothWays(box, frame, footage.first_frame, footage.last_frame, gray, footage.camera, progress, stop);
        if (vehicle.sightings.size() < 2)
            throw Error(
                ErrorKind::parameter,
                "the vehicle could not be followed to any other frame (" + vehicle.ended_after +
                    "); draw a tighter box, draw it in a frame that shows the vehicle better, or set a bookmark");
        return std::vector{additionOf(vehicle.sightings, frame)};
    };
    attempt(tr("Add a track"), make, [this](const TriedCorrections& tried) {
        const std::vector<Sighting>& seen = tried.vehicle.sightings;
        parts_.session.selectTrack(tried.newTrack());
        tell(tr("Added track %1, frames %2 to %3. Backwards: %4. Forwards: %5. Undo takes it back.")
                 .arg(tried.newTrack())
                 .arg(seen.front().frame)
                 .arg(seen.back().frame)
                 .arg(QString::fromStdString(tried.vehicle.ended_before),
                      QString::fromStdString(tried.vehicle.ended_after)));
    });
    if (working_) showFollowing(tr("Following the vehicle, forwards and then backwards."));
}

}  // namespace eyrie::ui

#include "moc_track_correcting.cpp"

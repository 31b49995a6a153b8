#include "review/correct/track_correcting.h"

#include <exception>
#include <utility>

#include "canvas/video_view.h"
#include "core/error.h"
#include "correction/corrected_run.h"
#include "review/correct/vehicle_box_tool.h"
#include "review/events/event_review.h"
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

}  // namespace

/// What would come of a correction.
struct TrackCorrecting::Tried {
    TrackCorrection correction;
    CorrectionState state = CorrectionState::no_track;
    TrackId last_id = 0;   ///< the highest of the run
    TrackId covering = 0;  ///< a track that has it so already
    DrawnVehicle vehicle;  ///< what was followed

    /// The track that an addition or a split makes.
    TrackId newTrack() const { return last_id + correction.id; }
};

/// What it is made from.
struct TrackCorrecting::Trial {
    const RunStore& store;
    const RunRecord& run;
    const CorrectedTracks& corrected;
    const BackgroundTask& task;
    Tried& tried;

    std::vector<TrackFrame> statesOf(TrackId track) const {
        std::vector<TrackFrame> states = trackStates(store, run.id, track, corrected);
        if (states.empty())
            throw Error(ErrorKind::parameter, "track " + std::to_string(track) +
                                                  " is not part of the run's result (its score kept it out); only "
                                                  "tracks of the result are joined and split");
        return states;
    }
};

TrackCorrecting::TrackCorrecting(const CorrectingParts& parts, QObject* parent)
    : QObject(parent), parts_(parts), tool_(new VehicleBoxTool(parts.canvas, this)) {
    tool_->setFinished([this](const OrientedBox& box) { follow(box); });
    tool_->setDrawingChanged([this] { parts_.actions.add_track->setChecked(tool_->drawing()); });
    const WindowActions& actions = parts_.actions;
    bindCommands(this, {
                           {actions.add_track, [this](bool on) { startDrawing(on); }},
                           {actions.join_tracks, [this](bool on) { startJoin(on); }},
                           {actions.split_track, [this] { split(); }},
                           {actions.remove_correction, [this] { removeLast(); }},
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
    actions.join_tracks->setEnabled(possible && selected);
    actions.split_track->setEnabled(possible && selected);
    actions.remove_correction->setEnabled(possible && selected && tracks->corrections.track(*selected) != nullptr);
}

// ---- trying ---------------------------------------------------------------------------------------------------------

void TrackCorrecting::attempt(const QString& step, const Make& make, const Kept& kept) {
    const auto& data = parts_.session.runData();
    if (working_ || !data) return;
    working_ = true;
    enableActions();
    const auto work = [this, step, make, kept, project = parts_.session.project(), run = data->record,
                       number = parts_.review.newCorrectionId(), corrections = parts_.review.corrections(),
                       memo = parts_.session.correctedTracks()](const BackgroundTask& task) mutable {
        ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
        const RunStore store(file);
        auto tried = std::make_shared<Tried>();
        const auto before = memo->of(store, project, run, corrections);
        tried->correction = make({store, run, *before, task, *tried});
        tried->correction.id = number;
        corrections[number] = tried->correction;
        const auto made = memo->of(store, project, run, corrections);
        tried->state = made->states.at(number);
        const auto covering = made->covering.find(number);
        if (covering != made->covering.end()) tried->covering = covering->second;
        tried->last_id = store.lastTrackId(run.id);
        task.tell([this, step, tried, kept, project, run_id = run.id] {
            working_ = false;
            enableActions();
            // While it was tried, another run or project may have been chosen.
            if (parts_.session.project() == project && parts_.session.currentRun() == run_id)
                finish(step, *tried, kept);
        });
    };
    following_ = query_.post(work, [this](const QString& failure) {
        working_ = false;
        enableActions();
        warn(capitalised(failure));
    });
}

void TrackCorrecting::finish(const QString& step, const Tried& tried, const Kept& kept) {
    parts_.messages.dismissTopic(kCorrectingTopic);
    if (tried.state != CorrectionState::applied) return tellRefused(tried);
    if (parts_.review.correct(tried.correction, step)) kept(tried);
}

void TrackCorrecting::tellRefused(const Tried& tried) {
    switch (tried.state) {
        case CorrectionState::covered:
            warn(tried.correction.kind == CorrectionKind::add
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

// ---- joining and splitting ------------------------------------------------------------------------------------------

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
        [one, other = *other](const Trial& trial) { return joinOf(trial.statesOf(one), trial.statesOf(other)); },
        [this, one, other = *other](const Tried&) {
            // It has the number of the one that begins first.
            const auto first = parts_.session.trackSummary(one), second = parts_.session.trackSummary(other);
            const bool keeps = first != nullptr && second != nullptr && first->first_frame <= second->first_frame;
            parts_.session.selectTrack(keeps ? one : other);
            tell(tr("Tracks %1 and %2 are one now, track %3. Z takes it back.")
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
        [track = *selected, frame](const Trial& trial) { return splitOf(trial.statesOf(track), frame); },
        [this, track = *selected, frame](const Tried& tried) {
            parts_.session.selectTrack(tried.newTrack());
            tell(tr("Track %1 ends before frame %2; from there on it is track %3. Z takes it back.")
                     .arg(track)
                     .arg(frame)
                     .arg(tried.newTrack()));
        });
}

void TrackCorrecting::removeLast() {
    const auto selected = parts_.session.selectedTrack();
    const auto& tracks = parts_.review.tracks();
    if (!selected || !tracks) return;
    const CorrectedTrack* track = tracks->corrections.track(*selected);
    if (track == nullptr || track->corrections.empty()) return;
    const int last = track->corrections.back();
    const auto correction = parts_.review.corrections().find(last);
    if (correction == parts_.review.corrections().end()) return;
    const QString done = QString::fromUtf8(nameOf(correction->second.kind));
    if (parts_.review.removeCorrections({last}, tr("Remove \"%1\" of track %2").arg(done).arg(*selected)))
        tell(tr("Track %1 is no longer %2. Z brings it back.").arg(*selected).arg(done));
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
    const auto make = [this, box, frame, tracks, media = *parts_.session.media()](const Trial& trial) {
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
        return additionOf(vehicle.sightings, frame);
    };
    attempt(tr("Add a track"), make, [this](const Tried& tried) {
        const std::vector<Sighting>& seen = tried.vehicle.sightings;
        parts_.session.selectTrack(tried.newTrack());
        tell(tr("Added track %1, frames %2 to %3. Backwards: %4. Forwards: %5. Z takes it back.")
                 .arg(tried.newTrack())
                 .arg(seen.front().frame)
                 .arg(seen.back().frame)
                 .arg(QString::fromStdString(tried.vehicle.ended_before),
                      QString::fromStdString(tried.vehicle.ended_after)));
    });
    if (working_) showFollowing(tr("Following the vehicle, forwards and then backwards."));
}

}  // namespace eyrie::ui

#include "window/docks/review_docks.h"

#include "review/inspector/inspector_panel.h"
#include "review/runs/run_text.h"
#include "review/runs/runs_panel.h"
#include "review/tracks/tracks_panel.h"
#include "tune/inspect/motion_statistics_panel.h"
#include "tune/inspect/stacks_panel.h"
#include "tune/inspect/stages_panel.h"
#include "tune/parameters/parameter_binding.h"
#include "tune/sweep/sweep_panel.h"
#include "widgets/charts/stage_times_chart.h"
#include "widgets/empty_state.h"
#include "widgets/layout/scrolled.h"
#include "widgets/parameters/parameter_form.h"
#include "widgets/wiring.h"
#include "window/run_guard.h"
#include "workspace/dock_registry.h"
#include "workspace/first_step.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

ReviewDocks::ReviewDocks(const ReviewParts& parts) : QObject(&parts.docks), parts_(parts), session_(parts.session) {
    runs_model_ = new RunsModel(this);
    tracks_model_ = new TracksModel(this);
    runs_ = new RunsPanel(runs_model_);
    tracks_ = new TracksPanel(tracks_model_);
    inspector_ = new InspectorPanel(session_);
    form_ = new ParameterForm;
    chart_ = new StageTimesChart;
    parameters_ = new ParameterBinding(session_, *form_, parts_.messages, this);
    stages_ = new StagesPanel(session_, parts_.inspection);
    stacks_ = new StacksPanel(session_, parts_.inspection);
    statistics_ = new MotionStatisticsPanel(session_);
    sweeps_ = new SweepPanel(session_, parts_.evaluation, *parameters_, parts_.messages);
    DockRegistry& docks = parts_.docks;
    docks.add(DockId::runs, tr("Runs"), runs_);
    docks.add(DockId::tracks, tr("Tracks"), tracks_);
    docks.add(DockId::inspector, tr("Inspector"), scrolled(inspector_));
    docks.add(DockId::parameters, tr("Parameters"), form_);
    docks.add(DockId::stage_times, tr("Times"), chart_);
    docks.add(DockId::stages, tr("Stages"), stages_);
    docks.add(DockId::stacks, tr("Stacks"), stacks_);
    docks.add(DockId::statistics, tr("Statistics"), scrolled(statistics_));
    docks.add(DockId::sweeps, tr("Sweeps"), scrolled(sweeps_));
    docks.watch(DockId::stages, stages_, [this](bool visible) { stages_->setLookedAt(visible); });
    docks.watch(DockId::stacks, stacks_, [this](bool visible) { stacks_->setLookedAt(visible); });
    docks.watch(DockId::statistics, statistics_, [this](bool visible) { statistics_->setLookedAt(visible); });
    whenChanged(
        session_, this,
        {
            {{SessionChange::video, SessionChange::runs, SessionChange::current_run, SessionChange::run_started,
              SessionChange::run_ended},
             [this] { showRuns(); }},
            {SessionChange::run_data, [this] { adoptAwaitedParameters(); }},
            {{SessionChange::current_run, SessionChange::run_data}, [this] { showTracks(); }},
            {{SessionChange::video, SessionChange::run_preparing, SessionChange::run_started, SessionChange::run_ended},
             [this] { explainNoTracks(); }},
            {SessionChange::picture, [this] { tracks_->setShownFrame(session_.shownFrame()); }},
            {SessionChange::selection, [this] { tracks_->selectId(session_.selectedTrack().value_or(0)); }},
        });
    wireRuns();
    wireTracks();
    showRuns();
}

void ReviewDocks::wireRuns() {
    connect(&session_, &ProjectSession::liveFrames, this, [this] {
        if (const RunRecord* run = session_.ownRun()) runs_model_->updateRun(*run);
    });
    connect(runs_model_, &RunsModel::renameRequested, &session_, &ProjectSession::renameRun);
    runs_->setCommands({
        .show = [this](int run_id) { session_.showRun(run_id); },
        .run = [this] { parts_.actions.run->trigger(); },
        .remove = [this](int run_id) { parts_.guard.remove(run_id); },
        .go_on = [this](int run_id) { session_.continueRun(run_id); },
        .can_go_on = [this](int run_id) { return session_.canContinue(run_id); },
        .use_parameters = [this](int run_id) { adoptParametersOf(run_id); },
    });
}

void ReviewDocks::adoptParametersOf(int run_id) {
    if (session_.currentRun() == run_id && session_.runData()) {
        parameters_->adoptRunParameters();
        return;
    }
    parameters_wanted_of_ = run_id;
    session_.showRun(run_id);
}

void ReviewDocks::adoptAwaitedParameters() {
    if (!parameters_wanted_of_ || session_.currentRun() != parameters_wanted_of_) return;
    parameters_wanted_of_.reset();
    parameters_->adoptRunParameters();
}

void ReviewDocks::showRuns() {
    if (session_.video())
        runs_->emptyState()->setTexts(
            tr("No run yet. A run finds and follows the moving vehicles of the video; each is "
               "kept here with its parameters and can be shown again."),
            tr("Run with these defaults"));
    else
        runs_->emptyState()->setTexts(tr("The runs of a video are kept here. Open one to begin."));
    runs_model_->setLiveRun(session_.ownRun() != nullptr ? session_.ownRun()->id : 0);
    runs_model_->setRuns(session_.runs());
    runs_->selectId(session_.currentRun().value_or(0));
}

void ReviewDocks::wireTracks() {
    tracks_->setCommands({
        .select = [this](int track) { session_.goToTrack(track); },
        .go_to =
            [this](int track, int frame) {
                session_.selectTrack(track);
                session_.goToFrame(frame);
            },
        .use_min_score = [this](double score) { parts_.overlays.setMinScore(score); },
        .want_doings = [this] { want_doings_(); },
        .query_changed = [this] { tell_query_(); },
        .want_likeness = [this](std::optional<TrackId> track) { want_likeness_(track); },
    });
    const WindowActions& actions = parts_.actions;
    tracks_->setMenuActions({actions.follow_object, actions.like_track, actions.join_tracks, actions.split_track,
                             actions.reject_tracks, actions.remove_correction, actions.clip_track});
    explainNoTracks();
}

void ReviewDocks::explainNoTracks() {
    const auto& data = session_.runData();
    QString text = afterFirstStep(session_, TracksPanel::aboutText());
    if (data && !data->record.live && !(session_.ownRun() != nullptr && session_.ownRun()->id == data->record.id))
        text = whyNoTracks(data->facts);
    else if (data)
        text = tr("The tracks are listed here when the run ends. Until then the video shows them.");
    tracks_->emptyState()->setTexts(text);
}

void ReviewDocks::showTracks() {
    explainNoTracks();
    const auto& data = session_.runData();
    // What is gone goes first: without a threshold all that it held back would be listed for a moment.
    if (!data) tracks_model_->setTracks({}, session_.scale());
    tracks_->setThreshold(data ? data->score_threshold : 0);
    if (data) tracks_model_->setTracks(data->tracks, session_.scale());
    tracks_->selectId(session_.selectedTrack().value_or(0));
}

}  // namespace eyrie::ui

#include "moc_review_docks.cpp"

#include "window/docks/review_docks.h"

#include <QDockWidget>

#include "review/inspector_panel.h"
#include "review/run_text.h"
#include "review/runs_panel.h"
#include "review/tracks_panel.h"
#include "tune/inspect/motion_statistics_panel.h"
#include "tune/inspect/stacks_panel.h"
#include "tune/inspect/stages_panel.h"
#include "tune/parameters/parameter_binding.h"
#include "tune/sweep/sweep_panel.h"
#include "widgets/charts/stage_times_chart.h"
#include "widgets/empty_state.h"
#include "widgets/parameters/parameter_form.h"
#include "workspace/dock_registry.h"

namespace eyrie::ui {

ReviewDocks::ReviewDocks(ProjectSession& session, Inspection& inspection, DockRegistry& docks)
    : QObject(&docks), session_(session), docks_(docks) {
    runs_model_ = new RunsModel(this);
    tracks_model_ = new TracksModel(this);
    runs_ = new RunsPanel(runs_model_);
    tracks_ = new TracksPanel(tracks_model_);
    inspector_ = new InspectorPanel(session_);
    form_ = new ParameterForm;
    chart_ = new StageTimesChart;
    stages_ = new StagesPanel(session_, inspection);
    stacks_ = new StacksPanel(session_, inspection);
    statistics_ = new MotionStatisticsPanel(session_);
    sweeps_ = new SweepPanel(session_);
    docks_.add(DockId::runs, tr("Runs"), runs_);
    docks_.add(DockId::tracks, tr("Tracks"), tracks_);
    docks_.add(DockId::inspector, tr("Inspector"), inspector_);
    docks_.add(DockId::parameters, tr("Parameters"), form_);
    docks_.add(DockId::stage_times, tr("Times"), chart_);
    QDockWidget* stages = docks_.add(DockId::stages, tr("Stages"), stages_);
    QDockWidget* stacks = docks_.add(DockId::stacks, tr("Stacks"), stacks_);
    QDockWidget* statistics = docks_.add(DockId::statistics, tr("Statistics"), statistics_);
    docks_.add(DockId::sweeps, tr("Sweeps"), sweeps_);
    connect(stages, &QDockWidget::visibilityChanged, stages_, &StagesPanel::setLookedAt);
    connect(stacks, &QDockWidget::visibilityChanged, stacks_, &StacksPanel::setLookedAt);
    connect(statistics, &QDockWidget::visibilityChanged, statistics_, &MotionStatisticsPanel::setLookedAt);
    wireRuns();
    wireTracks();
    showRuns();
}

void ReviewDocks::wireSweeps(ParameterBinding& parameters) {
    connect(sweeps_, &SweepPanel::applyRequested, &parameters, &ParameterBinding::setValues);
    connect(sweeps_, &SweepPanel::savePresetRequested, &parameters, &ParameterBinding::saveAsPreset);
    connect(sweeps_, &SweepPanel::problem, &parameters, &ParameterBinding::problem);
    connect(sweeps_, &SweepPanel::notice, &parameters, &ParameterBinding::notice);
}

void ReviewDocks::showTrackList() {
    docks_.raise(DockId::tracks);
}

void ReviewDocks::wireRuns() {
    connect(&session_, &ProjectSession::videoChanged, this, &ReviewDocks::showRuns);
    connect(&session_, &ProjectSession::runsChanged, this, &ReviewDocks::showRuns);
    connect(&session_, &ProjectSession::currentRunChanged, this, &ReviewDocks::showRuns);
    connect(&session_, &ProjectSession::currentRunChanged, this, &ReviewDocks::showTracks);
    connect(&session_, &ProjectSession::runStarted, this, &ReviewDocks::showRuns);
    connect(&session_, &ProjectSession::runFinished, this, &ReviewDocks::showRuns);
    connect(&session_, &ProjectSession::liveFrames, this, [this] {
        if (const RunRecord* run = session_.ownRun()) runs_model_->updateRun(*run);
    });
    connect(runs_model_, &RunsModel::renameRequested, &session_, &ProjectSession::renameRun);
    connect(runs_, &RunsPanel::runActivated, &session_, &ProjectSession::showRun);
    runs_->setContinuable([this](int run_id) { return session_.canContinue(run_id); });
    connect(runs_, &RunsPanel::continueRequested, this, &ReviewDocks::continueRequested);
    connect(runs_, &RunsPanel::removeRequested, this, &ReviewDocks::removeRequested);
    connect(runs_, &RunsPanel::runRequested, this, &ReviewDocks::runRequested);
    connect(runs_, &RunsPanel::parametersRequested, this, [this](int run_id) {
        if (session_.currentRun() == run_id && session_.runData()) {
            emit parametersRequested();
            return;
        }
        parameters_wanted_of_ = run_id;
        session_.showRun(run_id);
    });
    connect(&session_, &ProjectSession::runDataChanged, this, [this] {
        if (!parameters_wanted_of_ || session_.currentRun() != parameters_wanted_of_) return;
        parameters_wanted_of_.reset();
        emit parametersRequested();
    });
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
    connect(&session_, &ProjectSession::runDataChanged, this, &ReviewDocks::showTracks);
    connect(&session_, &ProjectSession::selectionChanged, this,
            [this](std::optional<TrackId> track) { tracks_->selectId(track.value_or(0)); });
    connect(tracks_, &TracksPanel::minScoreChanged, this, &ReviewDocks::minScoreChanged);
    connect(tracks_, &TracksPanel::trackSelected, &session_, &ProjectSession::goToTrack);
    connect(tracks_, &TracksPanel::trackActivated, this, [this](int track, int frame) {
        session_.selectTrack(track);
        session_.goToFrame(frame);
    });
}

void ReviewDocks::explainNoTracks() {
    const auto& data = session_.runData();
    QString text =
        tr("The tracks of a run are listed here: one row for each moving vehicle, with its life, speed and "
           "size.");
    if (data && !data->record.live && !(session_.ownRun() != nullptr && session_.ownRun()->id == data->record.id))
        text = whyNoTracks(data->facts);
    else if (data)
        text = tr("No tracks yet. They appear while the run works.");
    tracks_->emptyState()->setTexts(text);
}

void ReviewDocks::showTracks() {
    explainNoTracks();
    tracks_model_->setTracks(session_.runData() ? session_.runData()->tracks : std::vector<TrackSummary>(),
                             session_.scale());
    tracks_->selectId(session_.selectedTrack().value_or(0));
}

}  // namespace eyrie::ui

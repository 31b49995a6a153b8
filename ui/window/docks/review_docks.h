#pragma once

#include <QList>
#include <QObject>
#include <functional>

#include "review/runs/runs_model.h"
#include "review/tracks/tracks_model.h"
#include "session/project_session.h"

namespace eyrie::ui {

class DockRegistry;
class EvaluationSession;
class Inspection;
class InspectorPanel;
class MessageBar;
class MotionStatisticsPanel;
class OverlaySettings;
class ParameterBinding;
class ParameterForm;
class RunGuard;
class RunsPanel;
class StacksPanel;
class StageTimesChart;
class StagesPanel;
class SweepPanel;
class TracksPanel;
class WindowActions;

/// What the docks work on. All must outlive them.
struct ReviewParts {
    ProjectSession& session;
    Inspection& inspection;
    EvaluationSession& evaluation;
    DockRegistry& docks;
    WindowActions& actions;
    OverlaySettings& overlays;
    RunGuard& guard;
    MessageBar& messages;
};

/// The docks about runs and tracks, and those that show what the stages did; how their lists follow the session.
class ReviewDocks : public QObject {
    Q_OBJECT

 public:
    explicit ReviewDocks(const ReviewParts& parts);

    ParameterForm& parameterForm() { return *form_; }
    ParameterBinding& parameters() { return *parameters_; }
    StageTimesChart& stageTimes() { return *chart_; }
    StagesPanel& stages() { return *stages_; }
    StacksPanel& stacks() { return *stacks_; }
    MotionStatisticsPanel& statistics() { return *statistics_; }
    SweepPanel& sweeps() { return *sweeps_; }
    TracksPanel& tracks() { return *tracks_; }
    /// What time it was when the frames were taken; to be given again when that is known otherwise.
    void setClock(const ClockOfFrames& clock) { tracks_model_->setClock(clock); }
    InspectorPanel& inspector() { return *inspector_; }
    /// What is done when somebody asks for what the tracks did: TracksPanel::setDoings().
    void setDoingsWanted(std::function<void()> want) { want_doings_ = std::move(want); }
    /// What is done when TracksPanel::query() is another.
    void setQueryChanged(std::function<void()> tell) { tell_query_ = std::move(tell); }
    /// What is done when the list asks how like tracks are to one: TracksPanel::setLikeness().
    void setLikenessWanted(std::function<void(std::optional<TrackId>)> want) { want_likeness_ = std::move(want); }

 private:
    void wireRuns();
    void wireTracks();
    void showRuns();
    void showTracks();
    void explainNoTracks();
    /// Takes the parameters of a run over into the form, once they are read.
    void adoptParametersOf(int run_id);
    void adoptAwaitedParameters();

    ReviewParts parts_;
    ProjectSession& session_;
    RunsModel* runs_model_;
    TracksModel* tracks_model_;
    RunsPanel* runs_;
    TracksPanel* tracks_;
    InspectorPanel* inspector_;
    ParameterForm* form_;
    ParameterBinding* parameters_;
    StageTimesChart* chart_;
    StagesPanel* stages_;
    StacksPanel* stacks_;
    MotionStatisticsPanel* statistics_;
    SweepPanel* sweeps_;
    std::function<void()> want_doings_ = [] {};
    std::function<void()> tell_query_ = [] {};
    std::function<void(std::optional<TrackId>)> want_likeness_ = [](std::optional<TrackId>) {};
    std::optional<int> parameters_wanted_of_;  ///< run whose parameters are taken over once they are read
};

}  // namespace eyrie::ui

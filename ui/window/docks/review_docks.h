#pragma once

#include <QList>
#include <QObject>

#include "review/runs_model.h"
#include "review/tracks_model.h"
#include "session/project_session.h"

namespace eyrie::ui {

class DockRegistry;
class Inspection;
class InspectorPanel;
class MotionStatisticsPanel;
class ParameterBinding;
class ParameterForm;
class RunsPanel;
class StacksPanel;
class StageTimesChart;
class StagesPanel;
class SweepPanel;
class TracksPanel;

/// The docks about runs and tracks, and those that show what the stages did; how their lists follow the session.
class ReviewDocks : public QObject {
    Q_OBJECT

 public:
    /// Session, inspection and docks must outlive it.
    ReviewDocks(ProjectSession& session, Inspection& inspection, DockRegistry& docks);

    ParameterForm& parameterForm() { return *form_; }
    StageTimesChart& stageTimes() { return *chart_; }
    StagesPanel& stages() { return *stages_; }
    StacksPanel& stacks() { return *stacks_; }
    MotionStatisticsPanel& statistics() { return *statistics_; }
    SweepPanel& sweeps() { return *sweeps_; }

    /// Brings the list of tracks to the front.
    void showTrackList();
    /// What a sweep found goes into the parameters of the next run.
    void wireSweeps(ParameterBinding& parameters);

 signals:
    void runRequested();
    void removeRequested(int run_id);
    void continueRequested(int run_id);
    void parametersRequested();
    /// Tracks with a lower score are not to be shown.
    void minScoreChanged(double score);

 private:
    void wireRuns();
    void wireTracks();
    void showRuns();
    void showTracks();
    void explainNoTracks();

    ProjectSession& session_;
    DockRegistry& docks_;
    RunsModel* runs_model_;
    TracksModel* tracks_model_;
    RunsPanel* runs_;
    TracksPanel* tracks_;
    InspectorPanel* inspector_;
    ParameterForm* form_;
    StageTimesChart* chart_;
    StagesPanel* stages_;
    StacksPanel* stacks_;
    MotionStatisticsPanel* statistics_;
    SweepPanel* sweeps_;
    std::optional<int> parameters_wanted_of_;  ///< run whose parameters are taken over once they are read
};

}  // namespace eyrie::ui

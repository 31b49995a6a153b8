#pragma once

#include <QList>
#include <QObject>

#include "review/runs_model.h"
#include "review/tracks_model.h"
#include "session/project_session.h"

class QDockWidget;
class QMainWindow;

namespace eyrie::ui {

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

/// The docks of the review workspace and how their lists follow the session.
class ReviewDocks : public QObject {
    Q_OBJECT

 public:
    /// Docks into `window`, which owns the widgets. Session and inspection must outlive them.
    ReviewDocks(ProjectSession& session, Inspection& inspection, QMainWindow& window);

    const QList<QDockWidget*>& docks() const { return docks_; }
    /// Adds a dock beside the others on the right, behind them. Before the window's layout is restored.
    QDockWidget* addDock(const QString& name, const QString& title, QWidget* content);
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
    QDockWidget* dock(const QString& name, const QString& title, QWidget* content, Qt::DockWidgetArea area);
    void wireRuns();
    void wireTracks();
    void showRuns();
    void showTracks();
    void explainNoTracks();

    ProjectSession& session_;
    QMainWindow& window_;
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
    QList<QDockWidget*> docks_;
    std::optional<int> parameters_wanted_of_;  ///< run whose parameters are taken over once they are read
};

}  // namespace eyrie::ui

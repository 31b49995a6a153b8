#pragma once

#include <QWidget>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "tune/evaluate/evaluation_session.h"

class QLabel;
class QProgressBar;
class QStackedWidget;
class QTableWidget;
class QToolButton;

namespace eyrie::ui {

class EmptyState;
class EvaluationChoices;
class LineChart;
class TrackedBar;

/// What the evaluation leads to.
struct EvaluationCommands {
    /// The user wants to draw or import labels.
    std::function<void()> label = [] {};
    std::function<void(int object)> go_to_object = [](int) {};
    std::function<void()> write_report = [] {};
};

/// How good the run shown is: against what, the measures in numbers, their certainty, the objects, and curves over
/// time.
class EvaluationPanel : public QWidget {
    Q_OBJECT

 public:
    /// Both must outlive the panel.
    EvaluationPanel(ProjectSession& session, EvaluationSession& evaluation, QWidget* parent = nullptr);

    /// What stands there while there is nothing to see; empty while there is.
    QString explanation() const;
    /// Certainty and difference, as shown above the table.
    QString headline() const;
    const QTableWidget& table() const { return *table_; }
    LineChart& counts() { return *counts_; }
    LineChart& ratios() { return *ratios_; }
    /// Precision over recall, as the score that a track must have grows.
    LineChart& scoreCurve() { return *score_curve_; }
    TrackedBar& tracked() { return *tracked_; }
    void showReportProgress(double share);
    /// Takes this file as the ground truth.
    void useTruthFile(const QString& path);
    void setCommands(EvaluationCommands commands) { commands_ = std::move(commands); }

 private:
    QWidget* buildResult();
    void refresh();
    void showTable();
    void showCurves();
    void forgetScoreCurve();
    void askForScoreCurve();
    /// `threshold`: the run's own; nothing where none applies.
    void showScoreCurve(const std::vector<ScorePoint>& curve, std::optional<double> threshold);
    void copyTable() const;

    ProjectSession& session_;
    EvaluationSession& evaluation_;
    EvaluationCommands commands_;
    EvaluationChoices* choices_;
    QLabel* headline_;
    QLabel* remarks_;
    QStackedWidget* pages_;
    EmptyState* empty_;
    QTableWidget* table_;
    TrackedBar* tracked_;
    LineChart* counts_;
    LineChart* ratios_;
    LineChart* score_curve_;
    QLabel* curve_failure_;
    std::shared_ptr<const RunEvaluation> curve_of_;
    QToolButton* report_;
    QProgressBar* report_progress_;
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui

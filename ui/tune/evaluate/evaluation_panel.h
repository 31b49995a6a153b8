#pragma once

#include <QWidget>

#include "tune/evaluate/evaluation_session.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QProgressBar;
class QStackedWidget;
class QTableWidget;
class QToolButton;

namespace eyrie::ui {

class EmptyState;
class LineChart;
class TrackedBar;

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
    TrackedBar& tracked() { return *tracked_; }
    /// Takes this file as the ground truth.
    void showReportProgress(double share);
    void useTruthFile(const QString& path);

 signals:
    /// The user wants to draw or import labels.
    void labellingRequested();
    void objectActivated(int object);
    void reportRequested();

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    QWidget* buildChoices();
    QWidget* buildResult();
    void showSettings();
    void showRuns();
    void applySettings();
    void chooseTruthFile();
    void refresh();
    void showTable();
    void showCurves();
    void copyTable() const;

    ProjectSession& session_;
    EvaluationSession& evaluation_;
    QComboBox* truth_;
    QComboBox* measured_;
    QComboBox* other_;
    QDoubleSpinBox* overlap_;
    QDoubleSpinBox* border_;
    QCheckBox* vehicles_;
    QCheckBox* upright_;
    QToolButton* more_;
    QWidget* details_;
    QLabel* headline_;
    QLabel* remarks_;
    QStackedWidget* pages_;
    EmptyState* empty_;
    QTableWidget* table_;
    TrackedBar* tracked_;
    LineChart* counts_;
    LineChart* ratios_;
    QToolButton* report_;
    QProgressBar* report_progress_;
};

/// Precision and recall over a sliding window; NaN where nothing is defined.
struct WindowedRatios {
    std::vector<double> precision;
    std::vector<double> recall;
};
/// `window`: frames of the list, centred.
WindowedRatios windowedRatios(const std::vector<FrameCounts>& frames, int window);

/// "f-score 0.940 (0.921 – 0.956)" … and, where another run is compared, whether the difference is real.
QString certaintyText(const RunEvaluation& evaluation);

}  // namespace eyrie::ui

#pragma once

#include <QWidget>
#include <optional>

#include "tune/sweep/sweep_session.h"
#include "tune/sweep/sweep_views.h"

class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QStackedLayout;
class QToolButton;

namespace eyrie::ui {

class EmptyState;
class MessageBar;
class EvaluationSession;
class ParameterBinding;
class SweepChart;
class SweepForm;

/// Sweeps over the run that is shown: what to try, how far it has come, and what came of it as curve or heat map.
class SweepPanel : public QWidget {
    Q_OBJECT

 public:
    /// All must outlive the panel. The parameters of a point go to `parameters`, what there is to say to `messages`.
    SweepPanel(ProjectSession& session, EvaluationSession& evaluation, ParameterBinding& parameters,
               MessageBar& messages, QWidget* parent = nullptr);

    SweepSession& sweeps() { return sweeps_; }
    SweepForm& form() { return *form_; }
    SweepChart& chart() { return *chart_; }
    void setView(SweepView view);

 private:
    QWidget* buildResult();
    void wireSweeps();
    void bindButtons(QToolButton* copy, QToolButton* copy_picture);
    void applyPoint();
    void savePoint();
    void removeSweep();
    void showRunning();
    void tell(const QString& text);
    void tellProblem(const QString& text);
    void showRun();
    void showList();
    void showTable();
    void showProgress(const SweepProgress& progress);
    void ask(const SweepRequest& request, double points);
    SweepCriterion criterion() const;
    /// The point that was clicked, else the best one.
    std::optional<int> chosenPoint() const;
    void fillMeasures();
    void fillOverlaps();

    ProjectSession& session_;
    ParameterBinding& parameters_;
    MessageBar& messages_;
    SweepSession sweeps_;
    SweepForm* form_;
    QProgressBar* progress_;
    QLabel* progress_text_;
    QPushButton* cancel_;
    QWidget* progress_line_;
    QComboBox* list_;
    QPushButton* resume_;
    QToolButton* remove_;
    QComboBox* view_;
    QComboBox* measure_;
    QComboBox* of_;
    QComboBox* overlap_;
    SweepChart* chart_;
    QLabel* best_;
    QPushButton* apply_;
    QPushButton* save_;
    EmptyState* empty_;
    QStackedLayout* pages_;
    int shown_sweep_ = 0;         ///< whose usual criterion was chosen
    std::optional<int> clicked_;  ///< position
};

}  // namespace eyrie::ui

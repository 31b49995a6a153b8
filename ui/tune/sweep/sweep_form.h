#pragma once

#include <QWidget>
#include <map>
#include <optional>
#include <vector>

#include "core/parameter.h"
#include "tune/sweep/sweep_session.h"

class QComboBox;
class QGridLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QToolButton;
class QAction;

namespace eyrie::ui {

class EvaluationSession;

/// What a sweep is to try: one or two parameters with values, ground truth and overlaps.
class SweepForm : public QWidget {
    Q_OBJECT

 public:
    /// What points are measured against is what the evaluation is; it must outlive the form.
    explicit SweepForm(EvaluationSession& evaluation, QWidget* parent = nullptr);

    /// The parameters of the run that would be swept over.
    void setParameters(const std::vector<Parameter>& parameters);
    /// `run`: "run 3", for the text of the button; empty: there is none to start from.
    void setRun(const QString& run);
    /// All runs that can be swept over beside that one, by number.
    void setRuns(const std::vector<std::pair<int, QString>>& runs, std::optional<int> shown);
    void setRunning(bool running);
    /// The unit of a parameter, empty for none.
    QString unitOf(const std::string& name) const;

    /// For tests and for links from elsewhere.
    void setAxis(int axis, const QString& name, const QString& values);
    SweepRequest request() const;

 signals:
    void startRequested(const SweepRequest& request);

 private:
    struct Axis {
        QComboBox* name;
        QLineEdit* values;
        QLabel* hint;
    };
    Axis addAxis(QGridLayout& grid, const QString& title);
    const Parameter* parameterOf(const Axis& axis) const;
    void refresh();
    void suggestValues(const Axis& axis);
    void showRuns();
    void start();

    EvaluationSession& evaluation_;
    std::vector<Parameter> parameters_;
    std::vector<Axis> axes_;
    QToolButton* over_;
    std::map<int, QAction*> runs_;  ///< those that may be swept over, too
    QLineEdit* overlaps_;
    QLabel* count_;
    QPushButton* start_;
    QString run_;
    bool running_ = false;
};

}  // namespace eyrie::ui

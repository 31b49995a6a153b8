#pragma once

#include <QWidget>

#include "tune/evaluate/evaluation_session.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QToolButton;

namespace eyrie::ui {

class TruthChoice;

/// What the run shown is compared with, and how: the fields of the settings of its evaluation.
class EvaluationChoices : public QWidget {
    Q_OBJECT

 public:
    /// Both must outlive the fields.
    EvaluationChoices(ProjectSession& session, EvaluationSession& evaluation, QWidget* parent = nullptr);

    /// Takes this file as the ground truth.
    void useTruthFile(const QString& path);

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    void buildFields();
    void showSettings();
    void showRuns();
    void applySettings();

    ProjectSession& session_;
    EvaluationSession& evaluation_;
    TruthChoice* truth_;
    QComboBox* measured_;
    QComboBox* other_;
    QDoubleSpinBox* overlap_;
    QDoubleSpinBox* border_;
    QComboBox* class_;
    QCheckBox* vehicles_;
    QCheckBox* upright_;
    QToolButton* more_;
    QWidget* details_;
};

}  // namespace eyrie::ui

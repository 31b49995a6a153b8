#pragma once

#include <QDialog>

#include "tune/train/label_training.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QListWidget;
class QProgressBar;
class QPushButton;
class QSpinBox;
class QStackedWidget;

namespace eyrie::ui {

class SweepChart;

/// Trains a classifier from labelled projects and shows it next to the one that comes with the program.
class TrainingDialog : public QDialog {
    Q_OBJECT

 public:
    /// `project`: the one that is open; may be empty.
    TrainingDialog(const std::filesystem::path& project, QWidget* parent);
    ~TrainingDialog() override;

    void addProject(const QString& file);
    void setFile(const QString& file);
    void setKinds(DescriptorKind descriptor, ClassifierKind classifier);
    void setEvery(int frames);
    /// What the dialog has no fields for; descriptor and classifier are those of the fields.
    TrainingOptions& options() { return options_; }
    void start();
    LabelTraining& training() { return training_; }
    SweepChart& chart() { return *chart_; }
    QString message() const;

 signals:
    /// The model is to be used for the sliding window.
    void useRequested(const QString& file);

 private:
    QWidget* buildSettings();
    void showReport(const std::shared_ptr<const TrainingReport>& report);
    void enable();

    TrainingOptions options_;
    LabelTraining training_;
    std::shared_ptr<const TrainingReport> report_;
    std::filesystem::path replaced_;  ///< that this file is replaced is meant
    QListWidget* projects_;
    QComboBox* descriptor_;
    QComboBox* classifier_;
    QSpinBox* every_;
    QLineEdit* file_;
    QProgressBar* progress_;
    QLabel* message_;
    QStackedWidget* pages_;  ///< what will be drawn, then the chart
    SweepChart* chart_;
    QPushButton* start_;
    QPushButton* cancel_;
    QPushButton* use_;
};

}  // namespace eyrie::ui

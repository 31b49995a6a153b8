#pragma once

#include <QWidget>
#include <optional>

#include "session/project/preset_library.h"
#include "session/project_session.h"
#include "tune/compare/comparison_loader.h"

class QComboBox;
class QLabel;
class QProgressBar;
class QSpinBox;
class QToolButton;

namespace eyrie::ui {

/// What A and B are: runs of the project, presets, or the parameters of the form; and over which frames those that are
/// no runs are computed.
class ComparisonHeader : public QWidget {
    Q_OBJECT

 public:
    /// Both must outlive it.
    ComparisonHeader(ProjectSession& session, PresetLibrary& presets, QWidget* parent = nullptr);

    /// Names of sides: "run:3", "form", "preset:thesis".
    static QString runSide(int run_id) { return QStringLiteral("run:%1").arg(run_id); }
    static QString formSide() { return QStringLiteral("form"); }
    static QString presetSide(const QString& preset) { return QStringLiteral("preset:%1").arg(preset); }
    /// False when there is no such side.
    bool choose(const QString& first, const QString& second);
    void setRange(FrameIndex first, FrameIndex last);

    /// What is chosen; nothing while no run is there to compare with.
    std::optional<ComparisonPair> pair() const;
    QString firstName() const;
    QString secondName() const;
    bool comparesForm() const;

    void setSummary(const QString& text);
    QString summary() const;
    /// Of frames that are computed; the bar goes when all are done.
    void showProgress(int done, int total);
    QToolButton& wipe() { return *wipe_; }

 signals:
    /// Other sides, or another range.
    void pairChosen();

 private:
    void fill();
    void chooseDefault();
    void adjustRange();
    QString runName(const RunRecord& run) const;
    const RunRecord* baseRun() const;
    ComparisonSide sideOf(const QComboBox& box, int base_run) const;
    bool computes() const;

    ProjectSession& session_;
    PresetLibrary& presets_;
    int run_count_ = 0;
    QComboBox* first_;
    QComboBox* second_;
    QToolButton* wipe_;
    QLabel* summary_;
    QWidget* range_line_;
    QSpinBox* from_;
    QSpinBox* to_;
    QLabel* base_;
    QProgressBar* progress_;
};

}  // namespace eyrie::ui

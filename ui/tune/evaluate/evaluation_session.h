#pragma once

#include <QObject>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "canvas/marks/verdict_mark.h"
#include "diagnosis/run_evaluation.h"
#include "session/background/background_query.h"
#include "session/project_session.h"
#include "widgets/delayed_call.h"

namespace eyrie::ui {

/// What is measured and how; kept over restarts.
struct EvaluationSettings {
    std::filesystem::path truth_file;  ///< empty: the labels of the project
    bool detections = false;
    EvaluationOptions wishes;  ///< the overlap is that of errors, curves and overlay
    std::optional<int> other_run;

    bool operator==(const EvaluationSettings&) const = default;
};

/// What counts, as was chosen last; every dock that measures goes by it.
EvaluationOptions storedWishes();

/// The evaluation of the run shown, computed in the background as long as somebody looks: anew when the run, the
/// settings or the labels change. Holds which error is looked at. Signals arrive on the thread of this object.
class EvaluationSession : public QObject {
    Q_OBJECT

 public:
    /// The session must outlive it.
    explicit EvaluationSession(ProjectSession& session, QObject* parent = nullptr);
    ~EvaluationSession() override;

    /// Whether anybody wants to know. Until then nothing is computed; what is known stays.
    void setWanted(bool wanted);
    bool wanted() const { return wanted_; }
    const EvaluationSettings& settings() const { return settings_; }
    void setSettings(const EvaluationSettings& settings);
    /// The labels of the project changed.
    void labelsChanged();

    /// Null until it is known, and where there is nothing to compare with.
    const std::shared_ptr<const RunEvaluation>& evaluation() const { return evaluation_; }
    /// Why there is none, and what to do; empty when there is one, or one is being computed.
    const QString& obstacle() const { return obstacle_; }
    /// What is said while it works.
    static QString workingText() { return tr("The run is being compared with the ground truth…"); }
    bool working() const { return working_; }
    /// What would be computed now; for reports.
    EvaluationRequest request() const;

    /// Position in evaluation()->errors of the error that is looked at.
    std::optional<std::size_t> selected() const { return selected_; }
    void select(std::optional<std::size_t> error);
    const DiagnosedError* selectedError() const;

    bool evaluated(FrameIndex frame) const { return matches_.contains(frame); }
    /// The verdicts of a frame, for the canvas.
    std::vector<VerdictMark> marksAt(FrameIndex frame) const;
    std::vector<BoxRecord> truthAt(FrameIndex frame) const;

 signals:
    void changed();
    void workingChanged(bool working);
    void settingsChanged();
    void selectionChanged();

 private:
    void refreshLater();
    void refresh();
    void forget();
    void forgetRun();
    void readTruthOfProject();
    void adopt(const std::shared_ptr<const RunEvaluation>& evaluation, const QString& obstacle);
    void keepSelection(const std::shared_ptr<const RunEvaluation>& before);
    void setWorking(bool working);

    ProjectSession& session_;
    EvaluationSettings settings_;
    bool wanted_ = false;
    bool stale_ = true;  ///< something changed since the last answer was asked for
    bool working_ = false;
    std::shared_ptr<const RunEvaluation> evaluation_;
    std::map<FrameIndex, std::size_t> matches_;              ///< of each frame, into evaluation_->matches
    std::map<FrameIndex, std::vector<std::size_t>> errors_;  ///< places of switches and fragments
    QString obstacle_;
    std::optional<std::size_t> selected_;
    DelayedCall soon_;
    std::unique_ptr<RunEvaluator> evaluator_;  ///< in the background only
    BackgroundQuery query_;                    ///< last: stops before the rest goes
};

}  // namespace eyrie::ui

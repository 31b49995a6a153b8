#pragma once

#include <QList>
#include <QObject>
#include <memory>
#include <optional>

#include "canvas/overlay_settings.h"
#include "tune/evaluate/evaluation_session.h"
#include "workspace/workspace_kind.h"

class QMainWindow;

namespace eyrie::ui {

class DockRegistry;
class ErrorChips;
class ErrorsModel;
class ErrorsPanel;
class EvaluationPanel;
class LabelWorkspace;
class MessageBar;
class ReportWriter;
class VideoView;
class WindowActions;

/// The docks that tell how good a run is, joined with the canvas and the labels: evaluation, and the list of errors.
class EvaluationDocks : public QObject {
    Q_OBJECT

 public:
    /// Everything named must outlive it; `window` is the parent of dialogs.
    EvaluationDocks(ProjectSession& session, EvaluationSession& evaluation, VideoView& canvas, WindowActions& actions,
                    OverlaySettings& overlays, DockRegistry& docks, MessageBar& messages, QMainWindow& window);
    ~EvaluationDocks() override;

    /// Makes "the truth is wrong" work.
    void join(LabelWorkspace& labelling);
    /// To be called before another workspace is shown, and after that.
    void leaveWorkspace() { giveOverlaysBack(); }
    void enterWorkspace(WorkspaceKind kind);

    EvaluationSession& evaluation() { return *evaluation_; }
    EvaluationPanel& panel() { return *panel_; }
    ErrorsPanel& errors() { return *errors_; }

    /// Goes to the next or previous error in the order of the list.
    void step(int direction);
    /// Draws the verdicts of the frame that the canvas shows. To be called after the canvas got another frame.
    void showMarks();
    /// A preview takes the verdicts away, which are those of the stored run: what it found is shown in their place, and
    /// they come back with the run.
    void setPreviewed(bool previewed);
    /// Goes to the place of the selected error and asks there; answers come from who listens to whyRequested().
    void askWhy();
    /// Opens the object of the selected error in the label workspace.
    void correctTruth();
    /// Writes the report; PDF where the name ends so, else HTML.
    void writeReport(const QString& path);

 signals:
    void whyRequested(const OrientedBox& box, const QString& about);

 private:
    static QString nothingEvaluatedText();
    void wireList();
    void wireReport();
    void askForReport();
    void showErrors();
    void goTo(int id);
    /// The first error of an object, else where it is first seen.
    void goToObject(int object);
    void wantChips();
    void updateWanted();
    void showErrorsAlone();
    void giveOverlaysBack();
    void tellChange(const std::shared_ptr<const RunEvaluation>& before);

    ProjectSession& session_;
    VideoView& canvas_;
    WindowActions& actions_;
    OverlaySettings& overlays_;
    DockRegistry& docks_;
    MessageBar& messages_;
    QMainWindow& window_;
    LabelWorkspace* labelling_ = nullptr;
    EvaluationSession* evaluation_;
    EvaluationPanel* panel_;
    ErrorsModel* model_;
    ErrorsPanel* errors_;
    ErrorChips* chips_;
    bool evaluation_looked_at_ = false;
    bool errors_looked_at_ = false;
    bool previewed_ = false;
    std::optional<OverlayProfile> other_overlays_;  ///< what was shown before the errors were shown alone
    bool correcting_ = false;                       ///< the labels are open because the truth was wrong
    std::shared_ptr<const RunEvaluation> told_;
    std::unique_ptr<ReportWriter> report_;
};

}  // namespace eyrie::ui

#pragma once

#include <QObject>
#include <memory>
#include <string>
#include <vector>

#include "session/project_session.h"
#include "tune/compare/preview_loader.h"

namespace eyrie::ui {

/// One parameter that differs between two sets.
struct ParameterDifference {
    std::string name;
    std::string first;
    std::string second;
};
std::vector<ParameterDifference> differencesBetween(const ChainOptions& first, const ChainOptions& second);

/// Shows the present frame of a stored run with the parameters of the form, as soon as one of them is moved. Costs
/// nothing before, and nothing when switched off.
class LivePreview : public QObject {
    Q_OBJECT

 public:
    /// The session must outlive it.
    explicit LivePreview(ProjectSession& session, QObject* parent = nullptr);

    bool enabled() const { return enabled_; }
    void setEnabled(bool enabled);
    /// Frames before the present one over which tracks are followed.
    int range() const { return range_; }
    void setRange(int frames);

    /// A person changed a parameter of the next run.
    void parametersEdited();
    /// Somebody points at a parameter of motion, which is slow to begin with.
    void warmUp();
    /// Back to what the run stored.
    void discard();

    /// Whether the frame shown is, or is about to be, a preview.
    bool active() const { return active_; }
    /// What the parameters of the form differ in from those of the run shown.
    const std::vector<ParameterDifference>& differences() const { return differences_; }
    /// The preview of the frame shown; null while it is on its way.
    std::shared_ptr<const PreviewView> view() const;
    int framesLeft() const { return frames_left_; }
    const QString& problem() const { return problem_; }

 signals:
    /// Switched on or off, begun or ended, another preview, progress.
    void changed();

 private:
    void showView(const std::shared_ptr<const PreviewView>& view);
    void showProgress(FrameIndex frame, int left);
    void showProblem(const QString& message);
    void request();
    void end();

    ProjectSession& session_;
    PreviewLoader loader_;
    bool enabled_ = true;
    bool active_ = false;
    int range_ = 30;
    int frames_left_ = 0;
    std::vector<ParameterDifference> differences_;
    std::shared_ptr<const PreviewView> view_;
    QString problem_;
};

}  // namespace eyrie::ui

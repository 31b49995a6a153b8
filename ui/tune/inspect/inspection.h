#pragma once

#include <QObject>
#include <QPointF>
#include <memory>
#include <optional>
#include <vector>

#include "session/project_session.h"
#include "tune/inspect/replay_loader.h"

namespace eyrie::ui {

/// What of an inspection is another than it was.
enum class InspectionChange {
    choice,    ///< another cluster, or another frame, or what can be known of it
    progress,  ///< framesLeft()
    view       ///< a frame was replayed: view()
};

/// Looks closer at the frame shown: follows the cluster that was chosen (by a selected track, by pointing, by stepping)
/// through the frames, and replays them while somebody wants to see what a run does not store. Costs nothing else.
class Inspection : public QObject {
    Q_OBJECT

 public:
    /// The session must outlive it.
    explicit Inspection(ProjectSession& session, QObject* parent = nullptr);

    /// Whether the steps of the chosen cluster, or the stacks of the frame, in a list or over the video, are being
    /// looked at.
    void wantStages(bool wanted);
    void wantStacks(StackPictures pictures);
    void wantStackOverlay(bool wanted);
    /// Also the views of fig. 5.1.
    void wantGeneralSegmentation(bool wanted);

    /// Chooses what lies under a point of the frame shown; nothing there: chooses nothing.
    void choose(QPointF image_point, double margin = 0);
    /// The next or former cluster of the frame; the first one when none was chosen.
    void step(int clusters);
    void clear();

    /// Whether anything was chosen, in this frame or in another.
    bool hasChoice() const { return chosen_ || session_.selectedTrack().has_value(); }
    /// The chosen cluster in the frame shown; nothing when it is not in it.
    std::optional<int> cluster() const { return cluster_; }
    /// Its search area.
    std::optional<OrientedBox> area() const;
    /// The newest replayed frame; null when none was wanted or the run changed.
    const std::shared_ptr<const ReplayView>& view() const { return view_; }
    /// How many frames before the one shown are still to be replayed.
    int framesLeft() const { return frames_left_; }
    /// The same for people, and what is said until then.
    QString progressText() const;
    QString waitingText() const;
    /// Why there is none, for people; empty while it is on its way.
    const QString& problem() const { return problem_; }

 signals:
    void changed(InspectionChange change);

 private:
    void runChanged();
    void frameShown();
    void showProgress(FrameIndex frame, int left);
    void showView(const std::shared_ptr<const ReplayView>& view);
    void showProblem(const QString& message);
    void resolve();
    void setCluster(std::optional<int> cluster);
    void remember(const FrameResult& result, int cluster);
    void request();

    ProjectSession& session_;
    ReplayLoader loader_;
    bool stages_wanted_ = false;
    StackPictures stacks_wanted_ = StackPictures::none;
    bool overlay_wanted_ = false;
    bool general_wanted_ = false;
    bool chosen_ = false;            ///< a cluster was chosen by itself, not by a track
    std::vector<CornerId> corners_;  ///< of the chosen cluster, as it was when last seen
    OrientedBox place_;              ///< its box then; for clusters without corners
    std::optional<int> cluster_;
    std::shared_ptr<const ReplayView> view_;
    int frames_left_ = 0;
    QString problem_;
};

}  // namespace eyrie::ui

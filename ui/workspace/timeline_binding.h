#pragma once

#include <QObject>
#include <functional>
#include <utility>
#include <vector>

#include "session/project_session.h"

namespace eyrie::ui {

class StageTimesChart;
class TimelineView;

/// Feeds the timeline and the chart of stage times from the session: the stored run, or frame by frame the running one.
class TimelineBinding : public QObject {
    Q_OBJECT

 public:
    /// All must outlive the binding.
    TimelineBinding(ProjectSession& session, TimelineView& timeline, StageTimesChart& chart, QObject* parent);

    /// What time it was when a frame was taken, for people; empty where nobody knows.
    void setClock(std::function<QString(FrameIndex)> clock) { clock_ = std::move(clock); }

 private:
    void showVideo();
    void showLength();
    void forgetRun();
    void showRun();
    void beginLive();
    void endLive();
    void addLive(const std::vector<FrameSummary>& frames);
    void showTrackLife();
    QString describe(FrameIndex frame) const;

    ProjectSession& session_;
    TimelineView& timeline_;
    StageTimesChart& chart_;
    std::function<QString(FrameIndex)> clock_;
    bool live_ = false;          ///< what is shown came from the running run
    bool known_before_ = false;  ///< what that run had done before it was gone on with is shown, too
};

}  // namespace eyrie::ui

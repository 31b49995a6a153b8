#pragma once

#include <QObject>
#include <functional>
#include <optional>
#include <stop_token>

#include "annotation/pictures/box_tracker.h"
#include "label/label_session.h"
#include "session/background/due_write.h"

namespace eyrie::ui {

/// How far tracking has come.
struct TrackingAdvance {
    QString object;            ///< "car 3"
    FrameIndex frame = 0;      ///< the last sure box
    int done = 0;              ///< frames
    int most = 0;              ///< it ends earlier where it gets unsure
    double seconds_left = -1;  ///< for all of them; < 0: not known yet
};

/// Whom tracking tells what. All are called on its thread.
struct LabelTrackingAnswers {
    std::function<void()> working_changed;
    /// It began, or more boxes are sure.
    std::function<void(const TrackingAdvance& advance)> show_advance;
    /// It ended there; a sentence that says why, or nothing where that was told as a problem.
    std::function<void(FrameIndex frame, const QString& told)> show_end;
};

/// Follows the selected box through the pictures, forward or backward, until it gets unsure; then takes what was sure
/// over as few keyframes, in one step to undo. Keyframes that are there already end it and are never changed. When the
/// window closes, or another video is opened, it ends with what is sure by then, which is waited for.
class LabelTracking : public QObject {
    Q_OBJECT

 public:
    /// Both must outlive it.
    LabelTracking(ProjectSession& session, LabelSession& labels, LabelTrackingAnswers answers,
                  QObject* parent = nullptr);

    /// From the frame shown; `direction` 1 or −1.
    void start(int direction);
    /// What is sure by then is taken.
    void stop() { tracking_.request_stop(); }
    bool working() const { return working_.has_value(); }

 private:
    void take(ObjectId id, FrameIndex start, const OrientedBox& box, const FollowResult& result);

    ProjectSession& session_;
    LabelSession& labels_;
    LabelTrackingAnswers answers_;
    std::optional<DueWrite> working_;
    std::stop_source tracking_;
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui

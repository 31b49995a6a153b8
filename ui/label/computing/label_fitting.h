#pragma once

#include <QObject>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "annotation/pictures/trajectory_refinement.h"
#include "label/label_session.h"
#include "session/background/due_write.h"

namespace eyrie::ui {

/// Lays the computed boxes of the selected objects on the pictures, by the boxes that a hand set; one step to undo.
class LabelFitting : public QObject {
    Q_OBJECT

 public:
    /// Both must outlive it. `working_changed`: it began or ended.
    LabelFitting(ProjectSession& session, LabelSession& labels, std::function<void()> working_changed,
                 QObject* parent = nullptr);

    void start();
    /// What is done by then is taken.
    void stop() { fitting_.request_stop(); }
    bool working() const { return working_.has_value(); }

 private:
    struct Fitted {
        LabelledObject before;
        PictureFit fit;
    };
    void take(const std::vector<Fitted>& fitted, const QString& failure);

    ProjectSession& session_;
    LabelSession& labels_;
    std::function<void()> working_changed_;
    std::optional<DueWrite> working_;
    std::stop_source fitting_;
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui

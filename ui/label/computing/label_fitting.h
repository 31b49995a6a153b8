#pragma once

#include <QObject>
#include <stop_token>
#include <vector>

#include "annotation/pictures/trajectory_refinement.h"
#include "label/label_session.h"

namespace eyrie::ui {

/// Lays the computed boxes of the selected objects on the pictures, by the boxes that a hand set; one step to undo.
class LabelFitting : public QObject {
    Q_OBJECT

 public:
    /// Both must outlive it.
    LabelFitting(ProjectSession& session, LabelSession& labels, QObject* parent = nullptr);
    ~LabelFitting() override;

    void start();
    void stop();
    bool working() const { return working_; }

 signals:
    void workingChanged(bool working);

 private:
    struct Fitted {
        LabelledObject before;
        PictureFit fit;
    };
    void take(const std::vector<Fitted>& fitted);

    ProjectSession& session_;
    LabelSession& labels_;
    bool working_ = false;
    int ticket_ = 0;
    std::stop_source request_;
    TaskThread thread_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui

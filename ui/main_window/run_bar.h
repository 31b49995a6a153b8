#pragma once

#include <QWidget>

#include "session/project_session.h"

class QDoubleSpinBox;
class QLabel;
class QLineEdit;
class QSpinBox;
class QToolButton;

namespace eyrie::ui {

class WindowActions;

/// Run and stop, with what the next run is made with besides its parameters: ground sampling distance, frame rate,
/// range of frames.
class RunBar : public QWidget {
    Q_OBJECT

 public:
    /// `session` must outlive the bar.
    RunBar(ProjectSession& session, const WindowActions& actions, QWidget* parent = nullptr);

    /// Takes the values of the session's settings and video.
    void refresh();

 signals:
    /// Editing is over: the keys belong to the canvas again.
    void editingDone();

 private:
    void gsdEdited();
    void frameRateEdited();
    void rangeEdited();
    void enable();

    ProjectSession& session_;
    QToolButton* run_button_;
    QToolButton* stop_button_;
    QLineEdit* gsd_;
    QDoubleSpinBox* frame_rate_;
    QSpinBox* first_frame_;
    QSpinBox* last_frame_;
    bool refreshing_ = false;
};

}  // namespace eyrie::ui

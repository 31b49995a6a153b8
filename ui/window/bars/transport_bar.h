#pragma once

#include <QWidget>

#include "session/project_session.h"

class QComboBox;
class QSpinBox;

namespace eyrie::ui {

class WindowActions;

/// The buttons under the canvas: frame; first, back, play, on, last; speed; loop; following a run.
class TransportBar : public QWidget {
    Q_OBJECT

 public:
    TransportBar(ProjectSession& session, const WindowActions& actions, QWidget* parent = nullptr);
    /// The next number typed is the frame to go to.
    void focusFrameField();

 signals:
    /// Editing is over: the keys belong to the canvas again.
    void editingDone();

 private:
    void showSpeed(double speed);
    void frameEdited();

    ProjectSession& session_;
    QComboBox* speed_;
    QSpinBox* frame_;
};

}  // namespace eyrie::ui

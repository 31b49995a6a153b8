#pragma once

#include <QWidget>

#include "session/project_session.h"

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QLineEdit;
class QSpinBox;
class QToolButton;

namespace eyrie::ui {

class MessageBar;
class WindowActions;

/// Run and stop, with what the next run is made with besides its parameters: ground sampling distance, frame rate,
/// range of frames, and what it keeps of them.
class RunBar : public QWidget {
    Q_OBJECT

 public:
    /// `session` and `messages` must outlive the bar.
    RunBar(ProjectSession& session, const WindowActions& actions, MessageBar& messages, QWidget* parent = nullptr);

    /// Takes the values of the session's settings and video.
    void refresh();
    /// What stands in the fields becomes what the next run is made with, whether its editing was finished or not.
    /// False, after saying why, when it cannot.
    bool takeEdits();

 signals:
    /// Editing is over: the keys belong to the canvas again.
    void editingDone();

 private:
    /// The GSD is being mended, or is good: what was said about it no longer holds.
    void forgetRefusal();
    /// Says where nothing can be found with the GSD of the settings.
    void tellDoubt();
    bool takeGsd();
    /// As the field shows that of the settings; empty where it is not known.
    QString gsdOfSettings() const;
    /// Where the scale of the run shown comes from.
    void showOrigin();
    void frameRateEdited();
    /// `confirmed`: what stands there is meant even if it is what was assumed.
    void takeFrameRate(bool confirmed);
    void askForFrameRate();
    /// Asks for the frame rate where the video does not tell it.
    void tellAssumedRate();
    void rangeEdited();
    void takeRange();
    void makeDetails();
    void enable();

    ProjectSession& session_;
    MessageBar& messages_;
    QToolButton* run_button_;
    QToolButton* stop_button_;
    QLineEdit* gsd_;
    QDoubleSpinBox* frame_rate_;
    QSpinBox* first_frame_;
    QSpinBox* last_frame_;
    QComboBox* details_;
    bool refreshing_ = false;
};

}  // namespace eyrie::ui

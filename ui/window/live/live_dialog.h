#pragma once

#include <QDialog>
#include <functional>

#include "chain/live/live_run.h"

class QLabel;
class QLineEdit;
class QProgressBar;
class QPushButton;
class QSpinBox;

namespace eyrie::ui {

/// What the dialog about a live source has others do.
struct LiveDialogCommands {
    std::function<void(const LiveRequest& request)> watch;
    std::function<void()> cancel;  ///< while it waits for the source
};

/// Asks for a live source: its address, where project and recording go, the scale. Stays open until the source answers,
/// so that what was wrong can be mended where it was typed.
class LiveDialog : public QDialog {
    Q_OBJECT

 public:
    LiveDialog(LiveDialogCommands commands, QWidget* parent);

    /// What the fields hold at first; the recording's place follows from the project's.
    void propose(const QString& address, const QString& project, double gsd_m_per_px = 0);
    /// The source is waited for, or no longer.
    void setWaiting(bool waiting);
    /// It has answered, and its first pictures are looked at for a scale: how far that is.
    void showLook(int done, int total);
    void showFault(const QString& why);

 protected:
    void reject() override;

 private:
    void buildFields();
    void buildEnd();
    QWidget* pathRow(QLineEdit* field, const std::function<void()>& choose);
    void addressEdited();
    void projectEdited();
    void chooseProject();
    void chooseRecording();
    void watch();

    LiveDialogCommands commands_;
    QWidget* fields_;
    QLineEdit* address_;
    QLabel* address_fault_;
    QLineEdit* project_;
    QLineEdit* recording_;
    QLineEdit* gsd_;
    QSpinBox* give_up_;
    QLabel* fault_;
    QProgressBar* busy_;
    QPushButton* watch_;
    bool waiting_ = false;
    bool recording_chosen_ = false;  ///< by a person: it no longer follows the project's
};

}  // namespace eyrie::ui

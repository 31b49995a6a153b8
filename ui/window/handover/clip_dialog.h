#pragma once

#include <QString>

#include "chain/chain_run.h"
#include "workspace/export_dialog.h"

class QCheckBox;
class QDoubleSpinBox;

namespace eyrie::ui {

class ProjectSession;

/// What a clip is cut around.
struct ClipSubject {
    QString title;      ///< "Clip of track 12"
    FrameRange frames;  ///< of the event or the track, both included
};

/// Cuts some frames of the run shown out of its video, with what is before and after them, with or without the tracks.
class ClipDialog : public ExportDialog {
    Q_OBJECT

 public:
    /// The session must show a run that was read, and its video be there.
    ClipDialog(const ProjectSession& session, const ClipSubject& subject, QWidget* parent = nullptr);

    void setAround(double seconds);
    void setOverlay(bool overlay);

 private:
    /// `self` is asked for its choices when somebody exports; it need not have been made yet.
    static ExportSource sourceFor(const ClipDialog* self, const ProjectSession& session, const ClipSubject& subject);

    QDoubleSpinBox* around_;
    QCheckBox* overlay_;
};

}  // namespace eyrie::ui

#pragma once

#include "models/tracks_model.h"
#include "panels/table_panel.h"

class QToolButton;

namespace eyrie::ui {

/// The tracks of the shown run: clicking one goes to it.
class TracksPanel : public TablePanel {
    Q_OBJECT
 public:
    /// `model` must outlive the panel.
    explicit TracksPanel(TracksModel* model, QWidget* parent = nullptr);
    /// Whether tracks that were never confirmed are listed; at first they are not.
    void setTentativeShown(bool shown);

 signals:
    void trackSelected(int track);
    /// The user wants to see a track: its first frame, or the last where that was clicked.
    void trackActivated(int track, int frame);

 protected:
    void fillMenu(QMenu& menu, int track) override;

 private:
    void activate(int track, int column);
    TracksModel* tracks_;
    QToolButton* tentative_;
};

}  // namespace eyrie::ui

#pragma once

#include <QWidget>

#include "tune/inspect/inspection.h"

class QCheckBox;
class QLabel;
class QStackedLayout;

namespace eyrie::ui {

class ChipGrid;
class EmptyState;

/// All image stacks of the frame shown (fig. 5.5–5.9): raw chip beside stacked image, height, and the colour that the
/// stack has in the video. Replays nothing
/// while nobody looks at it.
class StacksPanel : public QWidget {
    Q_OBJECT

 public:
    /// Both must outlive the panel.
    StacksPanel(ProjectSession& session, Inspection& inspection, QWidget* parent = nullptr);

    /// Whether the user sees the panel. A dock behind other tabs counts as visible for Qt.
    void setLookedAt(bool looked_at);
    ChipGrid& grid() { return *grid_; }
    /// What stands there while there is nothing to see; empty while there is.
    QString explanation() const;

 signals:
    /// The user pointed at a stack; where its master vector lies in the frame shown.
    void placeChosen(QPointF image_point);
    /// Run again with the same parameters, but with stacking.
    void stackingRunRequested();

 private:
    void refresh();
    void showView(const std::shared_ptr<const ReplayView>& view);
    void want();
    bool stackingOff() const;

    ProjectSession& session_;
    Inspection& inspection_;
    bool looked_at_ = false;
    std::shared_ptr<const ReplayView> view_;
    QLabel* summary_;
    QCheckBox* whole_area_;
    QStackedLayout* pages_;
    EmptyState* empty_;
    ChipGrid* grid_;
};

}  // namespace eyrie::ui

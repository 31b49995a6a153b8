#pragma once

#include <QWidget>
#include <functional>
#include <utility>

#include "tune/inspect/inspection.h"

class QCheckBox;
class QLabel;
class QStackedLayout;

namespace eyrie::ui {

class ChipGrid;
class EmptyState;

/// What the list of stacks leads to.
struct StackCommands {
    /// The user pointed at a stack; where its master vector lies in the frame shown.
    std::function<void(QPointF image_point)> show_place = [](QPointF) {};
    /// Run again with the same parameters, but with stacking.
    std::function<void()> run_with_stacking = [] {};
};

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
    void setCommands(StackCommands commands) { commands_ = std::move(commands); }

 private:
    void refresh();
    void showProgress();
    void showView(const std::shared_ptr<const ReplayView>& view);
    void want();
    bool stackingOff() const;

    ProjectSession& session_;
    Inspection& inspection_;
    StackCommands commands_;
    bool looked_at_ = false;
    std::shared_ptr<const ReplayView> view_;
    QLabel* summary_;
    QCheckBox* whole_area_;
    QStackedLayout* pages_;
    EmptyState* empty_;
    ChipGrid* grid_;
};

}  // namespace eyrie::ui

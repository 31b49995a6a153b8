#pragma once

#include <QWidget>

#include "tune/inspect/inspection.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QStackedLayout;
class QToolButton;

namespace eyrie::ui {

class ChipGrid;
class EmptyState;

/// The stage inspector: every step from the motion ROI of the chosen cluster to its detections. Replays nothing
/// while nobody looks at it.
class StagesPanel : public QWidget {
    Q_OBJECT

 public:
    /// Both must outlive the panel.
    StagesPanel(ProjectSession& session, Inspection& inspection, QWidget* parent = nullptr);

    /// Whether the user sees the panel. A dock behind other tabs counts as visible for Qt.
    void setLookedAt(bool looked_at);
    ChipGrid& grid() { return *grid_; }
    /// What stands there while there is nothing to see; empty while there is.
    QString explanation() const;

 private:
    QWidget* buildHeader();
    void refresh();
    void showProgress();
    void showView(const std::shared_ptr<const ReplayView>& view);
    void showSearch();
    /// Why there is nothing to be seen, and what to do; nothing when there is.
    std::pair<QString, QString> whyEmpty() const;
    QString summaryOf(const ReplayView& view) const;

    ProjectSession& session_;
    Inspection& inspection_;
    bool looked_at_ = false;
    std::shared_ptr<const ReplayView> view_;
    QLabel* title_;
    QLabel* summary_;
    QToolButton* back_;
    QToolButton* on_;
    QComboBox* searches_;  ///< where several stacks were searched for one cluster
    QCheckBox* general_;
    QStackedLayout* pages_;
    EmptyState* empty_;
    ChipGrid* grid_;
};

}  // namespace eyrie::ui

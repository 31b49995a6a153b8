#pragma once

#include <QWidget>

#include "session/inspection.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QStackedLayout;
class QToolButton;

namespace eyrie::ui {

class ChipGrid;
class EmptyState;

/// The stage inspector: every step from the motion ROI of the chosen cluster to its detections. Replays nothing while
/// it is not visible.
class StagesPanel : public QWidget {
    Q_OBJECT

 public:
    /// Both must outlive the panel.
    StagesPanel(ProjectSession& session, Inspection& inspection, QWidget* parent = nullptr);

    ChipGrid& grid() { return *grid_; }
    /// What stands there while there is nothing to see; empty while there is.
    QString explanation() const;

 protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;

 private:
    QWidget* buildHeader();
    void refresh();
    void showView(const std::shared_ptr<const ReplayView>& view);
    void showSearch();
    /// Why there is nothing to be seen, and what to do; nothing when there is.
    std::pair<QString, QString> whyEmpty() const;
    QString summaryOf(const ReplayView& view) const;

    ProjectSession& session_;
    Inspection& inspection_;
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

#pragma once

#include <QList>
#include <QWidget>

#include "window/window_settings.h"

class QVBoxLayout;

namespace eyrie::ui {

class WindowActions;

/// What the window shows while no video is open: how to begin.
class WelcomePanel : public QWidget {
    Q_OBJECT

 public:
    WelcomePanel(const WindowActions& actions, QWidget* parent = nullptr);
    /// Projects opened lately, newest first.
    void setRecent(const QList<RecentProject>& projects);

 protected:
    void paintEvent(QPaintEvent* event) override;

 signals:
    void recentChosen(const RecentProject& project);

 private:
    QWidget* column_;
    QWidget* recent_box_;
    QVBoxLayout* recent_layout_;
};

}  // namespace eyrie::ui

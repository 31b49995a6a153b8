#pragma once

#include <QStringList>
#include <QWidget>

class QVBoxLayout;

namespace eyrie::ui {

class WindowActions;

/// What the window shows while no video is open: how to begin.
class WelcomePanel : public QWidget {
    Q_OBJECT

 public:
    WelcomePanel(const WindowActions& actions, QWidget* parent = nullptr);
    /// Files opened lately, newest first.
    void setRecent(const QStringList& paths);

 protected:
    void paintEvent(QPaintEvent* event) override;

 signals:
    void recentChosen(const QString& path);

 private:
    QWidget* column_;
    QWidget* recent_box_;
    QVBoxLayout* recent_layout_;
};

}  // namespace eyrie::ui

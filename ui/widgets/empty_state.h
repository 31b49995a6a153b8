#pragma once

#include <QWidget>

class QLabel;
class QPushButton;

namespace eyrie::ui {

/// What a panel shows while it has nothing to show: what would be here, and the way to get it.
class EmptyState : public QWidget {
    Q_OBJECT
 public:
    explicit EmptyState(QWidget* parent = nullptr);
    /// `action`: text of a button, empty for none.
    void setTexts(const QString& explanation, const QString& action = {});
    QString explanation() const;

 signals:
    void actionTriggered();

 private:
    QLabel* label_;
    QPushButton* button_;
};

}  // namespace eyrie::ui

#pragma once

#include <QWidget>

class QLabel;
class QAbstractButton;
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
    QAbstractButton* button() const;

 private:
    QLabel* label_;
    QPushButton* button_;
};

}  // namespace eyrie::ui

#pragma once

#include <QDialog>

#include "workspace/key_bindings.h"

class QKeySequenceEdit;
class QLabel;
class QLineEdit;
class QPushButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace eyrie::ui {

/// The sheet of every command with its keys, and of the mouse: can be searched, and keys can be changed.
class KeySheet : public QDialog {
    Q_OBJECT

 public:
    /// `keys` must outlive the sheet. What belongs to `first` comes first: the title of a group.
    KeySheet(KeyBindings& keys, const QString& first, QWidget* parent);

    QLineEdit& search() { return *search_; }
    QTreeWidget& list() { return *list_; }
    /// Selects a command, whose keys are then to be changed.
    void choose(const QAction* action);
    /// Gives the chosen command this key; where another has it, says so and changes nothing.
    void setKey(const QKeySequence& key);
    QString answer() const;

 private:
    void fill(const QString& first);
    void showKeys(QTreeWidgetItem* item);
    void showAllKeys();
    void filter();
    void showChosen();
    QAction* chosen() const;

    KeyBindings& keys_;
    QLineEdit* search_;
    QTreeWidget* list_;
    QKeySequenceEdit* key_;
    QPushButton* set_;
    QPushButton* none_;
    QPushButton* default_;
    QLabel* answer_;
};

}  // namespace eyrie::ui

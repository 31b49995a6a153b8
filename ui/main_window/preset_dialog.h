#pragma once

#include <QDialog>

#include "session/preset_store.h"

class QComboBox;
class QLabel;
class QPushButton;
class QTableWidget;

namespace eyrie::ui {

/// All presets: what each differs in from another, and renaming, deleting, export and import.
class PresetDialog : public QDialog {
    Q_OBJECT

 public:
    /// `present`: the parameters of the form, which presets can be compared with, too. `presets` must outlive it.
    PresetDialog(PresetStore& presets, ChainOptions present, QWidget* parent);

    void select(const QString& name);
    QString selected() const;
    QTableWidget& list() { return *list_; }
    QTableWidget& differences() { return *differences_; }
    /// Without asking anybody.
    void renameSelected(const QString& name);
    void removeSelected();
    void importFile(const QString& file);
    void exportSelected(const QString& file);
    QString message() const;

 signals:
    void useRequested(const QString& name);

 private:
    QWidget* buildButtons();
    void refresh();
    void compare();
    void attempt(const std::function<void()>& work);

    PresetStore& presets_;
    ChainOptions present_;
    QTableWidget* list_;
    QComboBox* other_;
    QTableWidget* differences_;
    QLabel* message_;
    QPushButton* use_;
    QPushButton* rename_;
    QPushButton* remove_;
    QPushButton* export_;
};

}  // namespace eyrie::ui

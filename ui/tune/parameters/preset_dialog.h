#pragma once

#include <QDialog>

#include "session/project/preset_library.h"

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
    PresetDialog(PresetLibrary& presets, ChainOptions present, QWidget* parent);

    void select(const QString& name);
    QString selected() const;
    QTableWidget& list() { return *list_; }
    QTableWidget& differences() { return *differences_; }
    /// Without asking anybody. Done in the background; message() tells when.
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
    /// What an answer of the library is followed by.
    PresetLibrary::Answer then(const QString& said);
    const ChainOptions* optionsOf(const QString& name);

    PresetLibrary& presets_;
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

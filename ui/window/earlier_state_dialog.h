#pragma once

#include <QDialog>
#include <vector>

#include "session/project/earlier_states.h"

class QLabel;
class QListWidget;
class QPushButton;

namespace eyrie::ui {

/// The kept states of a project: when they were made, and what would be different with each.
class EarlierStateDialog : public QDialog {
    Q_OBJECT

 public:
    /// `states` must outlive the dialog; it is asked for the states of `project`.
    EarlierStateDialog(EarlierStates& states, const std::filesystem::path& project, QWidget* parent);

    QListWidget* list() const { return list_; }

 signals:
    void restoreChosen(const ProjectBackup& backup);
    /// As a project of its own, beside the present one.
    void openChosen(const ProjectBackup& backup);

 private:
    void show(const std::vector<EarlierState>& states);
    void choose(int row);

    std::vector<EarlierState> shown_;
    QListWidget* list_;
    QLabel* differences_;
    QPushButton* restore_;
    QPushButton* open_;
};

}  // namespace eyrie::ui

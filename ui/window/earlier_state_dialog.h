#pragma once

#include <QDialog>
#include <vector>

#include "session/project/earlier_states.h"

class QLabel;
class QListWidget;
class QPushButton;

namespace eyrie::ui {

/// What can be done with a kept state.
struct EarlierStateCommands {
    std::function<void(const ProjectBackup& backup)> restore;
    /// As a project of its own, beside the present one.
    std::function<void(const ProjectBackup& backup)> open_as_new;
};

/// The kept states of a project: when they were made, and what would be different with each.
class EarlierStateDialog : public QDialog {
    Q_OBJECT

 public:
    /// Of a project; waits for show().
    EarlierStateDialog(const std::filesystem::path& project, EarlierStateCommands commands, QWidget* parent);

    void show(const std::vector<EarlierState>& states);
    /// Why there is nothing to choose.
    void showProblem(const QString& text);
    QListWidget* list() const { return list_; }

 private:
    void choose(int row);
    void answer(const std::function<void(const ProjectBackup& backup)>& command);

    EarlierStateCommands commands_;
    std::vector<EarlierState> shown_;
    QListWidget* list_;
    QLabel* differences_;
    QPushButton* restore_;
    QPushButton* open_;
};

}  // namespace eyrie::ui

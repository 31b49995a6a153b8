#pragma once

#include <QObject>
#include <QStringList>
#include <filesystem>
#include <functional>
#include <vector>

#include "session/background/background_query.h"
#include "store/backup/project_backup.h"

namespace eyrie::ui {

/// A kept state of a project, and what would be different with it in place of the present one.
struct EarlierState {
    ProjectBackup backup;
    QStringList differences;  ///< a line each, for people
};

/// Whom earlier states tell what. All are called on their thread.
struct EarlierStatesAnswers {
    std::function<void(const std::vector<EarlierState>& states)> show;
    /// The project may be opened; it holds what was restored.
    std::function<void(const std::filesystem::path& project)> open;
    /// Listing or restoring failed; the text names what went wrong, the place and the remedy.
    std::function<void(const QString& text)> fail;
    /// Why the present state could not be kept.
    std::function<void(const QString& text)> tell;
};

/// Keeps, lists and restores earlier states of projects in the background.
class EarlierStates : public QObject {
    Q_OBJECT

 public:
    explicit EarlierStates(EarlierStatesAnswers answers, QObject* parent = nullptr);

    /// Keeps the present state of a project that is worked on, once a day.
    void keepIfDue(const std::filesystem::path& project);
    void list(const std::filesystem::path& project);
    /// Makes the project what it was. Nobody may have it open; connections of this program that are about to close are
    /// waited for.
    void restore(const std::filesystem::path& project, const ProjectBackup& backup);
    /// Makes a new project of the state.
    void restoreAsNew(const ProjectBackup& backup, const std::filesystem::path& fresh);

 private:
    EarlierStatesAnswers answers_;
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui

#pragma once

#include <QObject>
#include <QStringList>
#include <filesystem>
#include <vector>

#include "session/background/background_query.h"
#include "store/backup/project_backup.h"

namespace eyrie::ui {

/// A kept state of a project, and what would be different with it in place of the present one.
struct EarlierState {
    ProjectBackup backup;
    QStringList differences;  ///< a line each, for people
};

/// Keeps, lists and restores earlier states of projects in the background. Signals arrive on the thread of this object.
class EarlierStates : public QObject {
    Q_OBJECT

 public:
    explicit EarlierStates(QObject* parent = nullptr);

    /// Keeps the present state of a project that is worked on, once a day. Answers with notice() when it cannot.
    void keepIfDue(const std::filesystem::path& project);
    /// Answers with listed().
    void list(const std::filesystem::path& project);
    /// Makes the project what it was. Nobody may have it open; connections of this program that are about to close are
    /// waited for. Answers with restored() or failed().
    void restore(const std::filesystem::path& project, const ProjectBackup& backup);
    /// Makes a new project of the state. Answers with restored() or failed().
    void restoreAsNew(const ProjectBackup& backup, const std::filesystem::path& fresh);

 signals:
    void listed(const std::vector<EarlierState>& states);
    /// `project` may be opened; it holds what was restored.
    void restored(const std::filesystem::path& project);
    void failed(const QString& message);
    void notice(const QString& message);

 private:
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui

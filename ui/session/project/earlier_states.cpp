#include "session/project/earlier_states.h"

#include <chrono>
#include <exception>
#include <thread>
#include <utility>

#include "core/error.h"
#include "store/backup/project_restore.h"
#include "store/health/project_contents.h"

namespace eyrie::ui {

namespace {

using Clock = std::chrono::steady_clock;
/// The loaders of this window close their connections as soon as what they do at the moment is done.
constexpr auto kPatience = std::chrono::seconds(10);
constexpr auto kPause = std::chrono::milliseconds(50);

/// Restores as soon as nobody has the project open any more.
BackupResult restoreWhenFree(const std::filesystem::path& project, const ProjectBackup& backup,
                             const std::stop_token& stop) {
    const auto latest = Clock::now() + kPatience;
    while (true) {
        try {
            return restoreBackup(project, backup, {.stop = stop});
        } catch (const Error& error) {
            if (error.kind() != ErrorKind::project || Clock::now() > latest || stop.stop_requested()) throw;
        }
        std::this_thread::sleep_for(kPause);
    }
}

}  // namespace

EarlierStates::EarlierStates(EarlierStatesAnswers answers, QObject* parent)
    : QObject(parent), answers_(std::move(answers)) {}

void EarlierStates::keepIfDue(const std::filesystem::path& project) {
    query_.post([this, project](const BackgroundTask& task) {
        const BackupResult result = backUpIfDue(project, {.stop = task.stop()});
        if (result.notice.empty()) return;
        task.tell([this, text = QString::fromStdString(result.notice)] { answers_.tell(text); });
    });
}

void EarlierStates::list(const std::filesystem::path& project) {
    const auto work = [this, project](const BackgroundTask& task) {
        std::vector<EarlierState> states;
        const ProjectContents present = contentsOf(project);
        for (const ProjectBackup& backup : listBackups(project)) {
            if (task.stop().stop_requested()) return;
            EarlierState state{backup, {}};
            try {
                for (const std::string& line : differencesInWords(present, contentsOf(backup.path)))
                    state.differences << QString::fromStdString(line);
            } catch (const std::exception& error) {
                state.differences << QString::fromUtf8(error.what());
            }
            states.push_back(std::move(state));
        }
        task.tell([this, states] { answers_.show(states); });
    };
    query_.post(work, answers_.fail);
}

void EarlierStates::restore(const std::filesystem::path& project, const ProjectBackup& backup) {
    const auto work = [this, project, backup](const BackgroundTask& task) {
        const BackupResult result = restoreWhenFree(project, backup, task.stop());
        if (result.outcome == BackupOutcome::stopped) return;
        if (result.outcome == BackupOutcome::by_others)
            throw Error(ErrorKind::project, "another program keeps the present state of " + project.string() +
                                                " at this moment; restore again when it is done");
        task.tell([this, project] { answers_.open(project); });
    };
    query_.post(work, answers_.fail);
}

void EarlierStates::restoreAsNew(const ProjectBackup& backup, const std::filesystem::path& fresh) {
    const auto work = [this, backup, fresh](const BackgroundTask& task) {
        if (eyrie::restoreAsNew(backup, fresh, {.stop = task.stop()}))
            task.tell([this, fresh] { answers_.open(fresh); });
    };
    query_.post(work, answers_.fail);
}

}  // namespace eyrie::ui

#include "moc_earlier_states.cpp"

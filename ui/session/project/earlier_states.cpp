#include "session/project/earlier_states.h"

#include <chrono>
#include <exception>
#include <thread>

#include "core/error.h"
#include "session/background/queued_call.h"
#include "store/backup/project_restore.h"
#include "store/health/project_contents.h"

namespace eyrie::ui {

namespace {

using Clock = std::chrono::steady_clock;
/// The loaders of this window close their connections as soon as what they do at the moment is done.
constexpr auto kPatience = std::chrono::seconds(10);
constexpr auto kPause = std::chrono::milliseconds(50);

QString textOf(const std::exception& error) {
    return QString::fromUtf8(error.what());
}

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

EarlierStates::EarlierStates(QObject* parent) : QObject(parent) {}

void EarlierStates::keepIfDue(const std::filesystem::path& project) {
    thread_.post([this, project](const std::stop_token& stop) {
        const BackupResult result = backUpIfDue(project, {.stop = stop});
        if (result.notice.empty()) return;
        queuedCall(this, [this, text = QString::fromStdString(result.notice)] { emit notice(text); });
    });
}

void EarlierStates::list(const std::filesystem::path& project) {
    thread_.post([this, project](const std::stop_token& stop) {
        try {
            std::vector<EarlierState> states;
            const ProjectContents present = contentsOf(project);
            for (const ProjectBackup& backup : listBackups(project)) {
                if (stop.stop_requested()) return;
                EarlierState state{backup, {}};
                try {
                    for (const std::string& line : differencesInWords(present, contentsOf(backup.path)))
                        state.differences << QString::fromStdString(line);
                } catch (const std::exception& error) {
                    state.differences << textOf(error);
                }
                states.push_back(std::move(state));
            }
            queuedCall(this, [this, states] { emit listed(states); });
        } catch (const std::exception& error) {
            queuedCall(this, [this, text = textOf(error)] { emit failed(text); });
        }
    });
}

void EarlierStates::restore(const std::filesystem::path& project, const ProjectBackup& backup) {
    thread_.post([this, project, backup](const std::stop_token& stop) {
        try {
            const BackupResult result = restoreWhenFree(project, backup, stop);
            if (result.outcome == BackupOutcome::stopped) return;
            if (result.outcome == BackupOutcome::by_others)
                throw Error(ErrorKind::project, "another program keeps the present state of " + project.string() +
                                                    " at this moment; restore again when it is done");
            queuedCall(this, [this, project] { emit restored(project); });
        } catch (const std::exception& error) {
            queuedCall(this, [this, text = textOf(error)] { emit failed(text); });
        }
    });
}

void EarlierStates::restoreAsNew(const ProjectBackup& backup, const std::filesystem::path& fresh) {
    thread_.post([this, backup, fresh](const std::stop_token& stop) {
        try {
            if (!eyrie::restoreAsNew(backup, fresh, {.stop = stop})) return;
            queuedCall(this, [this, fresh] { emit restored(fresh); });
        } catch (const std::exception& error) {
            queuedCall(this, [this, text = textOf(error)] { emit failed(text); });
        }
    });
}

}  // namespace eyrie::ui

#include "cli/arguments/earlier_state.h"

#include <cstdio>
#include <string>
#include <utility>

#include "cli/reports/console_progress.h"
#include "store/backup/project_backup.h"

namespace eyrie::cli {
namespace {

void tell(const std::string& notice) {
    if (!notice.empty()) std::fprintf(stderr, "note: %s\n", notice.c_str());
}

}  // namespace

ProjectFile openForReading(const std::filesystem::path& project) {
    ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
    tell(file.notice());
    return file;
}

bool keepEarlierState(const std::filesystem::path& project, std::stop_token stop) {
    std::error_code missing;
    if (!std::filesystem::exists(project, missing)) return true;
    tell(ProjectFile::open(project).notice());
    ConsoleProgress progress("% of today's state kept");
    const BackupResult result =
        backUpIfDue(project, {[&](double share) { progress.showShare(share); }, std::move(stop)});
    tell(result.notice);
    if (result.outcome != BackupOutcome::stopped) return true;
    std::fprintf(stderr, "stopped; nothing was changed\n");
    return false;
}

}  // namespace eyrie::cli

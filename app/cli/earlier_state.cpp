#include "cli/earlier_state.h"

#include <cstdio>
#include <string>

#include "store/project_backup.h"

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

void keepEarlierState(const std::filesystem::path& project) {
    std::error_code missing;
    if (!std::filesystem::exists(project, missing)) return;
    tell(ProjectFile::open(project).notice());
    tell(backUpIfDue(project).notice);
}

}  // namespace eyrie::cli

#include "session/project/project_copy.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <map>
#include <string>

#include "core/error.h"
#include "io/atomic_file.h"

namespace eyrie::ui {

namespace fs = std::filesystem;

namespace {

constexpr int kMostCopies = 4;

/// Counters of the project, some of which grow with every step of labelling and reviewing.
std::map<std::string, std::int64_t> countersOf(ProjectFile& project) {
    std::map<std::string, std::int64_t> counters;
    SQLite::Statement statement(project.database(), "SELECT kind, value FROM label_counter");
    while (statement.executeStep()) counters[statement.getColumn(0).getString()] = statement.getColumn(1).getInt64();
    return counters;
}

void writeCopy(ProjectFile& project, const fs::path& part) {
    SQLite::Statement copy(project.database(), "VACUUM INTO ?");
    copy.bind(1, part.string());
    copy.exec();
}

/// Like renaming, but a file that somebody made meanwhile stays.
void bringInPlace(const fs::path& part, const fs::path& target) {
    std::error_code failed;
    fs::create_hard_link(part, target, failed);
    if (!failed) {
        fs::remove(part, failed);
        return;
    }
    if (fs::exists(target)) throw Error(ErrorKind::output, "it was made by another program meanwhile");
    fs::rename(part, target);  // a file system without hard links
}

}  // namespace

void copyProject(ProjectFile& project, const fs::path& target, StepsMeanwhile meanwhile) {
    std::error_code failed;
    if (fs::exists(target, failed))
        throw Error(ErrorKind::output, target.string() + " is there already and is not replaced; choose another name");
    const fs::path part = temporaryBeside(target);
    bool whole = false;
    try {
        for (int copies = 0; copies < kMostCopies && !whole; ++copies) {
            fs::remove(part, failed);
            const auto before = countersOf(project);
            writeCopy(project, part);
            whole = meanwhile == StepsMeanwhile::left_out || countersOf(project) == before;
        }
        if (whole) bringInPlace(part, target);
    } catch (const std::exception& error) {
        fs::remove(part, failed);
        throw Error(ErrorKind::output, "cannot write " + target.string() + ": " + error.what() +
                                           ". Choose a folder you may write to, with room for a copy.");
    }
    if (whole) return;
    fs::remove(part, failed);
    throw Error(ErrorKind::output, "cannot write " + target.string() +
                                       ": labels or verdicts were changed each time it was copied. Save again while "
                                       "nobody changes them.");
}

}  // namespace eyrie::ui

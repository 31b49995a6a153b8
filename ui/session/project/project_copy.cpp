#include "session/project/project_copy.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "core/error.h"
#include "io/atomic_file.h"

namespace eyrie::ui {

namespace fs = std::filesystem;

namespace {

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

void copyProject(ProjectFile& project, const fs::path& target) {
    std::error_code failed;
    if (fs::exists(target, failed))
        throw Error(ErrorKind::output, target.string() + " is there already and is not replaced; choose another name");
    const fs::path part = temporaryBeside(target);
    try {
        SQLite::Statement copy(project.database(), "VACUUM INTO ?");
        copy.bind(1, part.string());
        copy.exec();
        bringInPlace(part, target);
    } catch (const std::exception& error) {
        fs::remove(part, failed);
        throw Error(ErrorKind::output, "cannot write " + target.string() + ": " + error.what() +
                                           ". Choose a folder you may write to, with room for a copy.");
    }
}

}  // namespace eyrie::ui

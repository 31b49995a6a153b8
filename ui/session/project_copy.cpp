#include "session/project_copy.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "core/error.h"

namespace eyrie::ui {

namespace fs = std::filesystem;

void copyProject(ProjectFile& project, const fs::path& target) {
    const fs::path part = fs::path(target).concat(".part");
    std::error_code ignored;
    fs::remove(part, ignored);
    try {
        SQLite::Statement copy(project.database(), "VACUUM INTO ?");
        copy.bind(1, part.string());
        copy.exec();
        if (fs::exists(target) && fs::equivalent(target, project.path()))
            throw Error(ErrorKind::output, "the project cannot be copied onto itself");
        fs::rename(part, target);
    } catch (const std::exception& error) {
        fs::remove(part, ignored);
        throw Error(ErrorKind::output, "cannot write " + target.string() + ": " + error.what() +
                                           ". Choose a folder you may write to, with room for a copy.");
    }
}

}  // namespace eyrie::ui

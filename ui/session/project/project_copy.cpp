#include "session/project/project_copy.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>
#include <utility>

#include "core/error.h"
#include "io/atomic_file.h"

namespace eyrie::ui {

namespace fs = std::filesystem;

namespace {

constexpr int kMostCopies = 4;

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

/// Does what may fail with the file, and says then which it is and what helps.
template <class Work>
void writing(const fs::path& target, Work&& work) {
    try {
        work();
    } catch (const std::exception& error) {
        throw Error(ErrorKind::output, "cannot write " + target.string() + ": " + error.what() +
                                           ". Choose a folder you may write to, with room for a copy.");
    }
}

fs::path partFor(const fs::path& target) {
    std::error_code failed;
    if (fs::exists(target, failed))
        throw Error(ErrorKind::output, target.string() + " is there already and is not replaced; choose another name");
    return temporaryBeside(target);
}

void writeCopy(ProjectFile& project, const fs::path& part) {
    std::error_code failed;
    fs::remove(part, failed);
    SQLite::Statement copy(project.database(), "VACUUM INTO ?");
    copy.bind(1, part.string());
    copy.exec();
}

}  // namespace

void copyProject(ProjectFile& project, const fs::path& target, StepsMeanwhile meanwhile) {
    if (meanwhile == StepsMeanwhile::copied_too) {
        ProjectMove(project, target).finish();
        return;
    }
    const fs::path part = partFor(target);
    try {
        writing(target, [&] {
            writeCopy(project, part);
            bringInPlace(part, target);
        });
    } catch (const Error&) {
        std::error_code failed;
        fs::remove(part, failed);
        throw;
    }
}

ProjectMove::ProjectMove(ProjectFile& project, fs::path target)
    : project_(project), target_(std::move(target)), part_(partFor(target_)), others_(project_) {
    try {
        copy();
    } catch (const Error&) {
        std::error_code failed;
        fs::remove(part_, failed);
        throw;
    }
}

ProjectMove::~ProjectMove() {
    std::error_code failed;
    fs::remove(part_, failed);
}

void ProjectMove::copy() {
    writing(target_, [&] {
        others_.changed();  // from here on
        own_changes_ = project_.database().getTotalChanges();
        writeCopy(project_, part_);
    });
}

bool ProjectMove::changedSince() {
    const bool by_others = others_.changed();
    return by_others || project_.database().getTotalChanges() != own_changes_;
}

void ProjectMove::finish() {
    for (int copies = 0; changedSince(); ++copies) {
        if (copies == kMostCopies)
            throw Error(ErrorKind::output, "cannot write " + target_.string() +
                                               ": the project was changed each time it was copied. Save again while "
                                               "nobody changes it.");
        copy();
    }
    writing(target_, [&] { bringInPlace(part_, target_); });
}

}  // namespace eyrie::ui

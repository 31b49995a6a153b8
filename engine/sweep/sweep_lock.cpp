#include "sweep/sweep_lock.h"

#include "core/error.h"

namespace eyrie {

std::unique_ptr<FileLock> lockSweep(const ProjectFile& project, int sweep) {
    const std::string number = std::to_string(sweep);
    FileLock::Attempt attempt = FileLock::tryTake(lockFileBeside(project.path(), ".sweep-" + number));
    if (attempt.outcome == FileLock::Outcome::held) {
        throw Error(ErrorKind::project, "sweep " + number + " of " + project.path().string() +
                                            " is being worked on by " + attempt.words +
                                            "; wait until it is done, or stop it there");
    }
    return std::move(attempt.lock);
}

}  // namespace eyrie

#include "store/labels/writer_lock.h"

#include <utility>

namespace eyrie {

std::unique_ptr<WriterLock> WriterLock::tryTake(const std::filesystem::path& project, std::string& reason) {
    FileLock::Attempt attempt = FileLock::tryTake(lockFileBeside(project, ".labelling"));
    switch (attempt.outcome) {
        case FileLock::Outcome::taken:
            return std::unique_ptr<WriterLock>(new WriterLock(std::move(attempt.lock)));
        case FileLock::Outcome::held:
            reason = "the labels are read-only here: " + attempt.words +
                     " is labelling this project; close that window to label here";
            break;
        case FileLock::Outcome::impossible:
            reason = "the labels are read-only: " + attempt.words +
                     "; check the permissions of the folder, or copy the project to a drive of this computer";
            break;
    }
    return nullptr;
}

}  // namespace eyrie

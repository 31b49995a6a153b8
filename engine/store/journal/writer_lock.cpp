#include "store/journal/writer_lock.h"

#include <utility>

namespace eyrie {
namespace {

struct WorkWords {
    const char* ending;
    const char* read_only;
    const char* holds;  ///< what the other one does
    const char* remedy;
};

constexpr WorkWords kLabelWords{".labelling", "the labels are read-only", "is labelling this project",
                                "close that window to label here"};
constexpr WorkWords kReviewWords{".reviewing", "verdicts and bookmarks are read-only", "is reviewing this project",
                                 "close that window to judge here"};

const WorkWords& wordsOf(WriterLock::Work work) {
    return work == WriterLock::Work::labels ? kLabelWords : kReviewWords;
}

}  // namespace

std::unique_ptr<WriterLock> WriterLock::tryTake(const std::filesystem::path& project, std::string& reason, Work work) {
    const WorkWords& words = wordsOf(work);
    FileLock::Attempt attempt = FileLock::tryTake(lockFileBeside(project, words.ending));
    switch (attempt.outcome) {
        case FileLock::Outcome::taken:
            return std::unique_ptr<WriterLock>(new WriterLock(std::move(attempt.lock)));
        case FileLock::Outcome::held:
            reason = std::string(words.read_only) + " here: " + attempt.words + " " + words.holds + "; " + words.remedy;
            break;
        case FileLock::Outcome::impossible:
            reason = std::string(words.read_only) + ": " + attempt.words +
                     "; check the permissions of the folder, or copy the project to a drive of this computer";
            break;
    }
    return nullptr;
}

const char* WriterLock::readOnlyWords(Work work) {
    return wordsOf(work).read_only;
}

std::optional<std::string> WriterLock::holderOf(const std::filesystem::path& project) {
    auto holder = FileLock::holderOf(lockFileBeside(project, kLabelWords.ending));
    return holder ? holder : FileLock::holderOf(lockFileBeside(project, kReviewWords.ending));
}

}  // namespace eyrie

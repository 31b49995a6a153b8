#include "cli/labels_of_project.h"

#include "core/error.h"
#include "store/labels/annotation_store.h"

namespace eyrie::cli {

SequenceRecord chosenSequence(ProjectFile& project, std::optional<int> id) {
    const std::vector<SequenceRecord> sequences = sequencesOf(project);
    const std::string name = project.path().string();
    if (sequences.empty()) {
        throw Error(ErrorKind::project,
                    name + ": holds no video; make a run first (eyrie-cli run) or name the video (--video)");
    }
    if (!id && sequences.size() == 1) return sequences.front();
    std::string known;
    for (const SequenceRecord& sequence : sequences) {
        if (id == sequence.id) return sequence;
        known += (known.empty() ? "" : ", ") + std::to_string(sequence.id) + " " + sequence.path;
    }
    throw Error(ErrorKind::parameter, name + ": holds several videos; choose one by its number (--sequence): " + known);
}

}  // namespace eyrie::cli

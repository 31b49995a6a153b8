#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/labels/annotation.h"
#include "core/labels/annotation_edit.h"
#include "store/journal/journalled_store.h"
#include "store/project/project_file.h"
#include "store/runs/run_store.h"

namespace eyrie {

/// The row of a video in a project, made if it is not there; what is known of the video now, its frame rate too,
/// replaces what was known. Throws Error(project | output).
int ensureSequence(ProjectFile& project, const SequenceRecord& sequence);
/// A video of the project lies elsewhere now: its runs and labels belong to `path`. Throws Error(project | output),
/// and Error(parameter), changing nothing, when the project has another video of that path and size.
void relocateSequence(ProjectFile& project, int sequence_id, const std::string& path);
/// All videos of a project, ascending ids.
std::vector<SequenceRecord> sequencesOf(ProjectFile& project);
/// The labels of a sequence, read once, by anybody (command line). Throws Error(project) for damaged labels.
AnnotationSet readAnnotations(ProjectFile& project, int sequence_id);

/// Labels as JournalledStore keeps them.
struct LabelContent {
    using Set = AnnotationSet;
    using Edit = AnnotationEdit;
    static constexpr WriterLock::Work kWork = WriterLock::Work::labels;
    static constexpr const char* kReading = "reading the labels";
    static constexpr StepTable kSteps{"edit_journal", "work on the labels"};
    static constexpr std::array<NumberedTable, 2> kNumbers{
        {{"object", "labelled_object"}, {"region", "ignore_region"}}};
    static constexpr const char* kChanges = "change";
    static AnnotationSet read(SQLite::Database& database, int sequence_id);
    static void write(SQLite::Database& database, int sequence_id, const AnnotationEdit& edit,
                      const AnnotationSet& after);
    static Bytes pack(const AnnotationEdit& edit);
    static std::optional<AnnotationEdit> unpack(ByteView bytes, const AnnotationSet& set, bool done);
    static void ground(AnnotationEdit& edit, const AnnotationSet& set);
    static std::array<std::vector<int>, 2> ids(const AnnotationEdit& edit);
};

/// The labels of one sequence, and the right to label it.
class AnnotationStore : public JournalledStore<LabelContent> {
 public:
    using JournalledStore::JournalledStore;

    const AnnotationSet& annotations() const { return content(); }
    ObjectId newObjectId() { return newId(0, annotations().objects); }
    /// The first that are free, not handed out.
    ObjectId nextObjectId() const { return nextId(0); }
    int nextRegionId() const { return nextId(1); }
    int newRegionId() { return newId(1, annotations().regions); }
};

extern template class JournalledStore<LabelContent>;

}  // namespace eyrie

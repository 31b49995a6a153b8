#include "store/labels/annotation_store.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "store/database/rows.h"
#include "store/journal/journalled_store_code.h"
#include "store/labels/label_rows.h"
#include "store/labels/packed_labels.h"
#include "store/project/sequence_rows.h"

namespace eyrie {
int ensureSequence(ProjectFile& project, const SequenceRecord& sequence) {
    return guarded(project.path(), "adding a video", [&] { return storeSequence(project.database(), sequence); });
}

namespace {

/// Runs and labels of two videos are never taken for those of one.
void refuseTwoVideosOfAPath(ProjectFile& project, int sequence_id, const std::string& path) {
    SQLite::Statement other(project.database(),
                            "SELECT moved.path FROM sequence AS moved JOIN sequence AS other ON other.width = "
                            "moved.width AND other.height = moved.height WHERE moved.id = ?1 AND other.id <> ?1 AND "
                            "other.path = ?2");
    other.bind(1, sequence_id);
    other.bind(2, path);
    if (!other.executeStep()) return;
    throw Error(ErrorKind::parameter,
                "the project " + project.path().string() + " has another video at " + path +
                    ", with runs and labels of its own: those of " + other.getColumn(0).getString() +
                    " stay as they are. Put that video back where it was, or in a place of its own, and locate it "
                    "there");
}

}  // namespace

void relocateSequence(ProjectFile& project, int sequence_id, const std::string& path) {
    guarded(project.path(), "storing where the video is now", [&] {
        SQLite::Transaction transaction(project.database(), SQLite::TransactionBehavior::IMMEDIATE);
        refuseTwoVideosOfAPath(project, sequence_id, path);
        SQLite::Statement statement(project.database(), "UPDATE sequence SET path = ? WHERE id = ?");
        RowWriter(statement).text(path).integer(sequence_id).run();
        transaction.commit();
    });
}

std::vector<SequenceRecord> sequencesOf(ProjectFile& project) {
    return guarded(project.path(), "listing the videos", [&] {
        SQLite::Statement statement(project.database(),
                                    "SELECT id, path, width, height, frame_count, frame_rate_hz, rate_assumed "
                                    "FROM sequence ORDER BY id");
        std::vector<SequenceRecord> sequences;
        while (statement.executeStep()) {
            RowReader row(statement);
            SequenceRecord sequence;
            sequence.id = row.integer();
            sequence.path = row.text();
            sequence.size.width = row.integer();
            sequence.size.height = row.integer();
            sequence.frame_count = row.integer();
            sequence.frame_rate_hz = row.real();
            sequence.rate_assumed = row.integer() != 0;
            checkSequence(sequence);
            sequences.push_back(std::move(sequence));
        }
        return sequences;
    });
}

AnnotationSet readAnnotations(ProjectFile& project, int sequence_id) {
    return guarded(project.path(), "reading the labels", [&] {
        SQLite::Transaction moment(project.database());
        return readLabels(project.database(), sequence_id);
    });
}

AnnotationSet LabelContent::read(SQLite::Database& database, int sequence_id) {
    return readLabels(database, sequence_id);
}

void LabelContent::write(SQLite::Database& database, int sequence_id, const AnnotationEdit& edit,
                         const AnnotationSet& after) {
    writeLabels(database, sequence_id, edit, after);
}

Bytes LabelContent::pack(const AnnotationEdit& edit) {
    return packEdit(edit);
}

std::optional<AnnotationEdit> LabelContent::unpack(ByteView bytes, const AnnotationSet& set, bool done) {
    return unpackEdit(bytes, set, done);
}

void LabelContent::ground(AnnotationEdit& edit, const AnnotationSet& set) {
    groundChanges(edit.objects, set.objects);
    groundChanges(edit.regions, set.regions);
    if (edit.reviews && edit.reviews->kept <= set.reviews.size()) {
        const auto tail = set.reviews.begin() + static_cast<std::ptrdiff_t>(edit.reviews->kept);
        edit.reviews->removed.assign(tail, set.reviews.end());
    }
    if (edit.classes) edit.classes->before = set.classes;
}

std::array<std::vector<int>, 2> LabelContent::ids(const AnnotationEdit& edit) {
    return {idsAfter(edit.objects), idsAfter(edit.regions)};
}

template class JournalledStore<LabelContent>;

}  // namespace eyrie

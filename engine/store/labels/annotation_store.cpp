#include "store/labels/annotation_store.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>

#include "core/utc_time.h"
#include "store/database/rows.h"
#include "store/labels/label_rows.h"
#include "store/project/sequence_rows.h"

namespace eyrie {
namespace {

/// The edit with what is really there as its `before`, whatever its maker believed.
AnnotationEdit grounded(AnnotationEdit edit, const AnnotationSet& set) {
    for (auto& change : edit.objects) {
        if (!change.before) continue;
        const auto present = set.objects.find(change.before->id);
        if (present != set.objects.end()) change.before = present->second;
    }
    for (auto& change : edit.regions) {
        if (!change.before) continue;
        const auto present = set.regions.find(change.before->id);
        if (present != set.regions.end()) change.before = present->second;
    }
    if (edit.reviews && edit.reviews->kept <= set.reviews.size()) {
        const auto tail = set.reviews.begin() + static_cast<std::ptrdiff_t>(edit.reviews->kept);
        edit.reviews->removed.assign(tail, set.reviews.end());
    }
    if (edit.classes) edit.classes->before = set.classes;
    return edit;
}

}  // namespace

int ensureSequence(ProjectFile& project, const SequenceRecord& sequence) {
    return guarded(project.path(), "adding a video", [&] { return storeSequence(project.database(), sequence); });
}

void relocateSequence(ProjectFile& project, int sequence_id, const std::string& path) {
    guarded(project.path(), "storing where the video is now", [&] {
        SQLite::Statement statement(project.database(), "UPDATE sequence SET path = ? WHERE id = ?");
        RowWriter(statement).text(path).integer(sequence_id).run();
    });
}

std::vector<SequenceRecord> sequencesOf(ProjectFile& project) {
    return guarded(project.path(), "listing the videos", [&] {
        SQLite::Statement statement(project.database(),
                                    "SELECT id, path, width, height, frame_count, frame_rate_hz FROM sequence ORDER BY "
                                    "id");
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

AnnotationStore::AnnotationStore(ProjectFile& project, int sequence_id)
    : project_(project), sequence_id_(sequence_id), journal_(project, sequence_id) {
    if (!tryToWrite()) load();
}

AnnotationStore::~AnnotationStore() = default;

bool AnnotationStore::tryToWrite() {
    if (lock_) return true;
    if (project_.mode() == ProjectFile::Mode::read_only) {
        read_only_reason_ = "the labels are read-only: the project is open for reading only";
        return false;
    }
    auto lock = WriterLock::tryTake(project_.path(), read_only_reason_);
    if (!lock) return false;
    load();
    lock_ = std::move(lock);
    read_only_reason_.clear();
    return true;
}

void AnnotationStore::load() {
    guarded(project_.path(), "reading the labels", [&] {
        SQLite::Database& database = project_.database();
        SQLite::Transaction moment(database);
        set_ = readLabels(database, sequence_id_);
        changes_ = readCounter(database, "change");
        next_object_ = readNextNumber(database, "object");
        next_region_ = readNextNumber(database, "region");
        undo_count_ = journal_.doneCount();
        redo_count_ = journal_.undoneCount();
    });
    ++version_;
}

bool AnnotationStore::refresh() {
    if (lock_) return false;
    const auto changes =
        guarded(project_.path(), "reading the labels", [&] { return readCounter(project_.database(), "change"); });
    if (changes == changes_) return false;
    load();
    return true;
}

ObjectId AnnotationStore::newObjectId() {
    while (set_.objects.contains(next_object_)) ++next_object_;  // never where the counter is sound
    return next_object_++;
}

int AnnotationStore::newRegionId() {
    while (set_.regions.contains(next_region_)) ++next_region_;
    return next_region_++;
}

void AnnotationStore::refuseReadOnly() const {
    if (!lock_) throw Error(ErrorKind::output, read_only_reason_);
}

void AnnotationStore::apply(const AnnotationEdit& edit) {
    refuseReadOnly();
    if (edit.empty()) return;
    const AnnotationEdit real = grounded(edit, set_);
    commit(real, Step::edit);
    ++undo_count_;
    undo_count_ = std::min(undo_count_, kJournalSteps);
    redo_count_ = 0;
}

std::optional<AnnotationEdit> AnnotationStore::undo() {
    refuseReadOnly();
    auto edit = journal_.lastDone(set_);
    if (!edit) return std::nullopt;
    commit(inverseOf(*edit), Step::undo);
    --undo_count_;
    ++redo_count_;
    return edit;
}

std::optional<AnnotationEdit> AnnotationStore::redo() {
    refuseReadOnly();
    auto edit = journal_.firstUndone(set_);
    if (!edit) return std::nullopt;
    commit(*edit, Step::redo);
    ++undo_count_;
    --redo_count_;
    return edit;
}

void AnnotationStore::commit(const AnnotationEdit& edit, Step step) {
    project_.checkInPlace();
    applyEdit(set_, edit);
    for (const auto& change : edit.objects) {
        if (change.after) next_object_ = std::max(next_object_, change.after->id + 1);
    }
    for (const auto& change : edit.regions) {
        if (change.after) next_region_ = std::max(next_region_, change.after->id + 1);
    }
    try {
        guarded(project_.path(), "storing \"" + edit.name + "\"", [&] {
            SQLite::Database& database = project_.database();
            SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
            writeLabels(database, sequence_id_, edit, set_);
            if (step == Step::edit) journal_.add(edit, nowUtc());
            if (step == Step::undo) journal_.markUndone();
            if (step == Step::redo) journal_.markDone();
            raiseCounter(database, "object", next_object_);
            raiseCounter(database, "region", next_region_);
            raiseCounter(database, "change", changes_ + 1);
            transaction.commit();
        });
    } catch (...) {
        applyEdit(set_, inverseOf(edit));
        throw;
    }
    ++changes_;
    ++version_;
}

std::string AnnotationStore::undoName() const {
    return journal_.lastDoneName();
}

std::string AnnotationStore::redoName() const {
    return journal_.firstUndoneName();
}

}  // namespace eyrie

#include "store/labels/label_rows.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <limits>

#include "store/database/rows.h"
#include "store/labels/packed_labels.h"
#include "store/project/sequence_rows.h"

namespace eyrie {
namespace {

void readObjects(SQLite::Database& database, int sequence_id, AnnotationSet& set) {
    SQLite::Statement statement(database,
                                "SELECT id, class, colour, notes, origin, last_frame, keyframes FROM labelled_object "
                                "WHERE sequence_id = ? ORDER BY id");
    statement.bind(1, sequence_id);
    while (statement.executeStep()) {
        RowReader row(statement);
        LabelledObject object;
        object.id = row.integer();
        try {
            object.object_class = row.text();
            object.colour = static_cast<std::uint32_t>(row.wide());
            object.notes = row.text();
            object.origin = row.word(stored::kObjectOrigins);
            object.last_frame = row.integer();
            object.keyframes = RowReader::unpacked(unpackKeyframes(row.bytes()), "keyframes");
            if (object.id < 1) throw MalformedRow{"a number below 1"};
            if (object.last_frame < object.keyframes.front().frame) throw MalformedRow{"it ends before it begins"};
            if (object.last_frame > kLastFrame || object.keyframes.back().frame > kLastFrame)
                throw MalformedRow{"frames beyond every video"};
        } catch (const MalformedRow& malformed) {
            throw MalformedRow{"object " + std::to_string(object.id) + ": " + malformed.what};
        }
        set.objects.emplace_hint(set.objects.end(), object.id, std::move(object));
    }
}

void readRegions(SQLite::Database& database, int sequence_id, AnnotationSet& set) {
    SQLite::Statement statement(database,
                                "SELECT id, polygon, anchor, reference_frame, first_frame, last_frame, notes FROM "
                                "ignore_region WHERE sequence_id = ? ORDER BY id");
    statement.bind(1, sequence_id);
    while (statement.executeStep()) {
        RowReader row(statement);
        IgnoreRegion region;
        region.id = row.integer();
        region.polygon = RowReader::unpacked(unpackPolygon(row.bytes()), "polygon of an ignore region");
        region.anchor = row.word(stored::kRegionAnchors);
        region.reference_frame = row.integer();
        region.first_frame = row.integer();
        region.last_frame = row.integer();
        region.notes = row.text();
        try {
            checkRegion(region);
        } catch (const Error&) {
            throw MalformedRow{"ignore region " + std::to_string(region.id)};
        }
        set.regions.emplace(region.id, std::move(region));
    }
}

void readReviews(SQLite::Database& database, int sequence_id, AnnotationSet& set) {
    SQLite::Statement statement(database,
                                "SELECT object_id, first_frame, last_frame, state, person, when_utc FROM review_mark "
                                "WHERE sequence_id = ? ORDER BY position");
    statement.bind(1, sequence_id);
    while (statement.executeStep()) {
        RowReader row(statement);
        ReviewMark mark;
        mark.object = row.integer();
        mark.first_frame = row.integer();
        mark.last_frame = row.integer();
        mark.state = row.word(stored::kReviewStates);
        mark.person = row.text();
        mark.when_utc = row.text();
        set.reviews.push_back(std::move(mark));
    }
}

void readClasses(SQLite::Database& database, int sequence_id, AnnotationSet& set) {
    SQLite::Statement statement(database,
                                "SELECT name, vehicle, colour, length_m, width_m FROM object_class WHERE sequence_id = "
                                "? ORDER BY position");
    statement.bind(1, sequence_id);
    while (statement.executeStep()) {
        RowReader row(statement);
        ObjectClass each;
        each.name = row.text();
        each.vehicle = row.integer() != 0;
        each.colour = static_cast<std::uint32_t>(row.wide());
        each.length_m = row.real();
        each.width_m = row.real();
        set.classes.push_back(std::move(each));
    }
}

void deleteRow(SQLite::Database& database, const char* command, int sequence_id, std::int64_t key) {
    SQLite::Statement statement(database, command);
    RowWriter(statement).integer(sequence_id).integer(key).run();
}

void writeObjects(SQLite::Database& database, int sequence_id, const AnnotationEdit& edit) {
    const std::string values =
        "INTO labelled_object (id, sequence_id, class, colour, notes, origin, "
        "last_frame, keyframes) VALUES (?, ?, ?, ?, ?, ?, ?, ?)";
    // A number that an object of another video has is refused, never taken away from it.
    SQLite::Statement add(database, "INSERT " + values);
    SQLite::Statement replace(database, "INSERT OR REPLACE " + values);
    for (const auto& change : edit.objects) {
        if (!change.after) {
            deleteRow(database, "DELETE FROM labelled_object WHERE sequence_id = ? AND id = ?", sequence_id,
                      change.before->id);
            continue;
        }
        const LabelledObject& object = *change.after;
        const Bytes keyframes = packKeyframes(object.keyframes);
        RowWriter(change.before ? replace : add)
            .integer(object.id)
            .integer(sequence_id)
            .text(object.object_class)
            .integer(object.colour)
            .text(object.notes)
            .word(stored::kObjectOrigins, object.origin)
            .integer(object.last_frame)
            .bytes(keyframes)
            .run();
    }
}

void writeRegions(SQLite::Database& database, int sequence_id, const AnnotationEdit& edit) {
    const std::string values =
        "INTO ignore_region (id, sequence_id, polygon, anchor, reference_frame, "
        "first_frame, last_frame, notes) VALUES (?, ?, ?, ?, ?, ?, ?, ?)";
    SQLite::Statement add(database, "INSERT " + values);
    SQLite::Statement replace(database, "INSERT OR REPLACE " + values);
    for (const auto& change : edit.regions) {
        if (!change.after) {
            deleteRow(database, "DELETE FROM ignore_region WHERE sequence_id = ? AND id = ?", sequence_id,
                      change.before->id);
            continue;
        }
        const IgnoreRegion& region = *change.after;
        const Bytes polygon = packPolygon(region.polygon);
        RowWriter(change.before ? replace : add)
            .integer(region.id)
            .integer(sequence_id)
            .bytes(polygon)
            .word(stored::kRegionAnchors, region.anchor)
            .integer(region.reference_frame)
            .integer(region.first_frame)
            .integer(region.last_frame)
            .text(region.notes)
            .run();
    }
}

void writeReviews(SQLite::Database& database, int sequence_id, std::size_t kept, const AnnotationSet& after) {
    deleteRow(database, "DELETE FROM review_mark WHERE sequence_id = ? AND position >= ?", sequence_id,
              static_cast<std::int64_t>(kept));
    SQLite::Statement add(database,
                          "INSERT INTO review_mark (sequence_id, position, object_id, first_frame, last_frame, state, "
                          "person, when_utc) VALUES (?, ?, ?, ?, ?, ?, ?, ?)");
    for (std::size_t i = kept; i < after.reviews.size(); ++i) {
        const ReviewMark& mark = after.reviews[i];
        RowWriter(add)
            .integer(sequence_id)
            .integer(static_cast<std::int64_t>(i))
            .integer(mark.object)
            .integer(mark.first_frame)
            .integer(mark.last_frame)
            .word(stored::kReviewStates, mark.state)
            .text(mark.person)
            .text(mark.when_utc)
            .run();
    }
}

void writeClasses(SQLite::Database& database, int sequence_id, const AnnotationSet& after) {
    deleteRow(database, "DELETE FROM object_class WHERE sequence_id = ? AND position >= ?", sequence_id, 0);
    SQLite::Statement add(database,
                          "INSERT INTO object_class (sequence_id, position, name, vehicle, colour, length_m, width_m) "
                          "VALUES (?, ?, ?, ?, ?, ?, ?)");
    int position = 0;
    for (const ObjectClass& each : after.classes) {
        RowWriter(add)
            .integer(sequence_id)
            .integer(position++)
            .text(each.name)
            .integer(each.vehicle)
            .integer(each.colour)
            .real(each.length_m)
            .real(each.width_m)
            .run();
    }
}

}  // namespace

AnnotationSet readLabels(SQLite::Database& database, int sequence_id) {
    AnnotationSet set;
    readObjects(database, sequence_id, set);
    readRegions(database, sequence_id, set);
    readReviews(database, sequence_id, set);
    readClasses(database, sequence_id, set);
    return set;
}

void writeLabels(SQLite::Database& database, int sequence_id, const AnnotationEdit& edit, const AnnotationSet& after) {
    writeObjects(database, sequence_id, edit);
    writeRegions(database, sequence_id, edit);
    if (edit.reviews) writeReviews(database, sequence_id, edit.reviews->kept, after);
    if (edit.classes) writeClasses(database, sequence_id, after);
}

}  // namespace eyrie

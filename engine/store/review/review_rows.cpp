#include "store/review/review_rows.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <cmath>
#include <limits>
#include <set>

#include "store/database/rows.h"
#include "store/labels/packed_labels.h"
#include "store/project/sequence_rows.h"
#include "store/review/correction_rows.h"
#include "store/review/review_words.h"

namespace eyrie {
namespace {

Verdict readVerdict(RowReader& row) {
    Verdict verdict;
    ReviewSubject& subject = verdict.subject;
    verdict.id = row.integer();
    try {
        subject.kind = row.word(stored::kSubjectKinds);
        subject.first_frame = readFrameNumber(row);
        subject.last_frame = readFrameNumber(row);
        subject.first_s = row.real();
        subject.last_s = row.real();
        subject.frame = readFrameNumber(row);
        subject.place = row.point();
        subject.ground_frame = readFrameNumber(row);
        subject.ground = row.point();
        subject.zone = row.text();
        subject.sense = row.word(stored::kCrossingSenses);
        verdict.judgement = row.word(stored::kJudgements);
        verdict.note = row.text();
        verdict.tags = tagsOf(row.text());
        verdict.starred = row.integer() != 0;
        verdict.person = row.text();
        verdict.when_utc = row.text();
        checkVerdict(verdict);
    } catch (const MalformedRow& malformed) {
        throw MalformedRow{"verdict " + std::to_string(verdict.id) + ": " + malformed.what};
    } catch (const Error& error) {
        throw MalformedRow{error.what()};
    }
    return verdict;
}

Bookmark readBookmark(RowReader& row) {
    Bookmark bookmark;
    bookmark.id = row.integer();
    try {
        bookmark.frame = readFrameNumber(row);
        bookmark.seconds = row.real();
        const cv::Point2d place = row.point();
        if (!std::isnan(place.x) || !std::isnan(place.y)) bookmark.place = place;
        bookmark.note = row.text();
        bookmark.person = row.text();
        bookmark.when_utc = row.text();
        checkBookmark(bookmark);
    } catch (const MalformedRow& malformed) {
        throw MalformedRow{"bookmark " + std::to_string(bookmark.id) + ": " + malformed.what};
    } catch (const Error& error) {
        throw MalformedRow{error.what()};
    }
    return bookmark;
}

StoredZone readZone(RowReader& row) {
    StoredZone zone;
    zone.id = row.integer();
    try {
        zone.zone.name = row.text();
        zone.zone.shape = row.word(stored::kZoneShapes);
        zone.zone.anchor = row.word(stored::kZoneAnchors);
        zone.zone.frame = readFrameNumber(row);
        zone.zone.points = RowReader::unpacked(unpackPolygon(row.bytes()), "points");
        zone.colour = row.integer();
        zone.shown = row.integer() != 0;
        zone.person = row.text();
        zone.when_utc = row.text();
        checkZone(zone);
    } catch (const MalformedRow& malformed) {
        throw MalformedRow{"zone " + std::to_string(zone.id) + ": " + malformed.what};
    } catch (const Error& error) {
        throw MalformedRow{error.what()};
    }
    return zone;
}

void readZones(SQLite::Database& database, int sequence_id, std::map<int, StoredZone>& zones) {
    if (!database.tableExists("zone")) return;
    SQLite::Statement rows(database,
                           "SELECT id, name, shape, anchor, frame, points, colour, shown, person, when_utc FROM zone "
                           "WHERE sequence_id = ? ORDER BY id");
    rows.bind(1, sequence_id);
    std::set<std::string> names;
    while (rows.executeStep()) {
        RowReader row(rows);
        StoredZone zone = readZone(row);
        if (!names.insert(zone.zone.name).second) {
            throw MalformedRow{"zone " + std::to_string(zone.id) + " has the name of another, \"" + zone.zone.name +
                               "\""};
        }
        zones.emplace_hint(zones.end(), zone.id, std::move(zone));
    }
}

void writeZones(SQLite::Database& database, int sequence_id, const std::vector<Change<StoredZone>>& changes) {
    if (changes.empty()) return;
    const std::string values =
        "INTO zone (id, sequence_id, name, shape, anchor, frame, points, colour, shown, person, when_utc) VALUES (?, "
        "?, ?, ?, ?, ?, ?, ?, ?, ?, ?)";
    SQLite::Statement add(database, "INSERT " + values);
    SQLite::Statement replace(database, "INSERT OR REPLACE " + values);
    SQLite::Statement remove(database, "DELETE FROM zone WHERE sequence_id = ? AND id = ?");
    for (const auto& change : changes) {
        if (!change.after) {
            RowWriter(remove).integer(sequence_id).integer(change.before->id).run();
            continue;
        }
        const StoredZone& zone = *change.after;
        const Bytes points = packPolygon(zone.zone.points);
        RowWriter(change.before ? replace : add)
            .integer(zone.id)
            .integer(sequence_id)
            .text(zone.zone.name)
            .word(stored::kZoneShapes, zone.zone.shape)
            .word(stored::kZoneAnchors, zone.zone.anchor)
            .integer(zone.zone.frame)
            .bytes(points)
            .integer(zone.colour)
            .integer(zone.shown)
            .text(zone.person)
            .text(zone.when_utc)
            .run();
    }
}

void bind(RowWriter& row, const Verdict& verdict, const std::string& tags) {
    const ReviewSubject& subject = verdict.subject;
    row.word(stored::kSubjectKinds, subject.kind)
        .integer(subject.first_frame)
        .integer(subject.last_frame)
        .real(subject.first_s)
        .real(subject.last_s)
        .integer(subject.frame)
        .point(subject.place)
        .integer(subject.ground_frame)
        .point(subject.ground)
        .text(subject.zone)
        .word(stored::kCrossingSenses, subject.sense)
        .word(stored::kJudgements, verdict.judgement)
        .text(verdict.note)
        .text(tags)
        .integer(verdict.starred)
        .text(verdict.person)
        .text(verdict.when_utc);
}

void bind(RowWriter& row, const Bookmark& bookmark) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();  // stored as NULL
    row.integer(bookmark.frame)
        .real(bookmark.seconds)
        .point(bookmark.place.value_or(cv::Point2d(kNone, kNone)))
        .text(bookmark.note)
        .text(bookmark.person)
        .text(bookmark.when_utc);
}

}  // namespace

ReviewSet readReviewRows(SQLite::Database& database, int sequence_id) {
    ReviewSet set;
    SQLite::Statement verdicts(database,
                               "SELECT id, kind, first_frame, last_frame, first_s, last_s, frame, x, y, ground_frame, "
                               "ground_x, ground_y, zone, sense, judgement, note, tags, starred, person, when_utc FROM "
                               "verdict WHERE sequence_id = ? ORDER BY id");
    verdicts.bind(1, sequence_id);
    while (verdicts.executeStep()) {
        RowReader row(verdicts);
        Verdict verdict = readVerdict(row);
        set.verdicts.emplace_hint(set.verdicts.end(), verdict.id, std::move(verdict));
    }
    SQLite::Statement bookmarks(database,
                                "SELECT id, frame, seconds, x, y, note, person, when_utc FROM bookmark WHERE "
                                "sequence_id = ? ORDER BY id");
    bookmarks.bind(1, sequence_id);
    while (bookmarks.executeStep()) {
        RowReader row(bookmarks);
        Bookmark bookmark = readBookmark(row);
        set.bookmarks.emplace_hint(set.bookmarks.end(), bookmark.id, std::move(bookmark));
    }
    readZones(database, sequence_id, set.zones);
    set.corrections = readCorrectionRows(database, sequence_id);
    return set;
}

void writeReviewRows(SQLite::Database& database, int sequence_id, const ReviewEdit& edit) {
    const std::string verdict_values =
        "INTO verdict (id, sequence_id, kind, first_frame, last_frame, first_s, last_s, frame, x, y, ground_frame, "
        "ground_x, ground_y, zone, sense, judgement, note, tags, starred, person, when_utc) VALUES (?, ?, ?, ?, ?, ?, "
        "?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)";
    // A number that belongs to another video is refused, never taken away from it.
    SQLite::Statement add_verdict(database, "INSERT " + verdict_values);
    SQLite::Statement replace_verdict(database, "INSERT OR REPLACE " + verdict_values);
    SQLite::Statement remove_verdict(database, "DELETE FROM verdict WHERE sequence_id = ? AND id = ?");
    for (const auto& change : edit.verdicts) {
        if (!change.after) {
            RowWriter(remove_verdict).integer(sequence_id).integer(change.before->id).run();
            continue;
        }
        const std::string tags = tagText(change.after->tags);
        RowWriter row(change.before ? replace_verdict : add_verdict);
        row.integer(change.after->id).integer(sequence_id);
        bind(row, *change.after, tags);
        row.run();
    }
    const std::string bookmark_values =
        "INTO bookmark (id, sequence_id, frame, seconds, x, y, note, person, when_utc) VALUES (?, ?, ?, ?, ?, ?, ?, "
        "?, ?)";
    SQLite::Statement add_bookmark(database, "INSERT " + bookmark_values);
    SQLite::Statement replace_bookmark(database, "INSERT OR REPLACE " + bookmark_values);
    SQLite::Statement remove_bookmark(database, "DELETE FROM bookmark WHERE sequence_id = ? AND id = ?");
    for (const auto& change : edit.bookmarks) {
        if (!change.after) {
            RowWriter(remove_bookmark).integer(sequence_id).integer(change.before->id).run();
            continue;
        }
        RowWriter row(change.before ? replace_bookmark : add_bookmark);
        row.integer(change.after->id).integer(sequence_id);
        bind(row, *change.after);
        row.run();
    }
    writeZones(database, sequence_id, edit.zones);
    writeCorrectionRows(database, sequence_id, edit.corrections);
}

}  // namespace eyrie

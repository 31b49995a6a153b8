#include "store/review/correction_rows.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "core/error.h"
#include "store/database/rows.h"
#include "store/project/sequence_rows.h"
#include "store/review/packed_review.h"
#include "store/review/review_words.h"

namespace eyrie {
namespace {

TrackCorrection readCorrection(RowReader& row) {
    TrackCorrection correction;
    correction.id = row.integer();
    try {
        correction.kind = row.word(stored::kCorrectionKinds);
        correction.frame = readFrameNumber(row);
        correction.track = RowReader::unpacked(unpackSightings(row.bytes()), "boxes");
        correction.other = RowReader::unpacked(unpackSightings(row.bytes()), "boxes");
        correction.person = row.text();
        correction.when_utc = row.text();
        checkCorrection(correction);
    } catch (const MalformedRow& malformed) {
        throw MalformedRow{"correction " + std::to_string(correction.id) + ": " + malformed.what};
    } catch (const Error& error) {
        throw MalformedRow{error.what()};
    }
    return correction;
}

}  // namespace

std::map<int, TrackCorrection> readCorrectionRows(SQLite::Database& database, int sequence_id) {
    std::map<int, TrackCorrection> corrections;
    if (!database.tableExists("correction")) return corrections;
    SQLite::Statement rows(database,
                           "SELECT id, kind, frame, track, other, person, when_utc FROM correction WHERE sequence_id = "
                           "? ORDER BY id");
    rows.bind(1, sequence_id);
    while (rows.executeStep()) {
        RowReader row(rows);
        TrackCorrection correction = readCorrection(row);
        corrections.emplace_hint(corrections.end(), correction.id, std::move(correction));
    }
    return corrections;
}

void writeCorrectionRows(SQLite::Database& database, int sequence_id,
                         const std::vector<Change<TrackCorrection>>& changes) {
    if (changes.empty()) return;
    const std::string values =
        "INTO correction (id, sequence_id, kind, frame, track, other, person, when_utc) VALUES (?, ?, ?, ?, ?, ?, ?, "
        "?)";
    SQLite::Statement add(database, "INSERT " + values);
    SQLite::Statement replace(database, "INSERT OR REPLACE " + values);
    SQLite::Statement remove(database, "DELETE FROM correction WHERE sequence_id = ? AND id = ?");
    for (const auto& change : changes) {
        if (!change.after) {
            RowWriter(remove).integer(sequence_id).integer(change.before->id).run();
            continue;
        }
        const TrackCorrection& correction = *change.after;
        const Bytes track = packSightings(correction.track);
        const Bytes other = packSightings(correction.other);
        RowWriter(change.before ? replace : add)
            .integer(correction.id)
            .integer(sequence_id)
            .word(stored::kCorrectionKinds, correction.kind)
            .integer(correction.frame)
            .bytes(track)
            .bytes(other)
            .text(correction.person)
            .text(correction.when_utc)
            .run();
    }
}

}  // namespace eyrie

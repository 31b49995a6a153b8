#include "store/runs/stored_light.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <cmath>
#include <limits>
#include <string>

#include "core/geometry/angle.h"
#include "core/values/last_frame.h"
#include "store/database/rows.h"
#include "store/runs/of_run.h"

namespace eyrie {
namespace {

double shareFrom(RowReader& row, const char* what) {
    const double value = row.real();
    if (!(value >= 0 && value <= 1)) throw MalformedRow{std::string("an impossible ") + what};
    return value;
}

double lengthFrom(RowReader& row, const char* what) {
    const double value = row.real();
    if (!(value >= 0 && std::isfinite(value))) throw MalformedRow{std::string("an impossible ") + what};
    return value;
}

double headingFrom(RowReader& row) {
    const double degrees = row.real();
    if (!(degrees >= 0 && degrees < 360)) throw MalformedRow{"an impossible direction of shadows"};
    return wrapPi(radiansFromDegrees(degrees));
}

int countFrom(RowReader& row, const char* what) {
    const int value = row.integer();
    if (value < 0) throw MalformedRow{std::string("an impossible number of ") + what};
    return value;
}

LightFinding readFinding(RowReader& row) {
    LightFinding finding;
    finding.first_frame = row.integer();
    finding.last_frame = row.integer();
    if (finding.first_frame < 0 || finding.last_frame < finding.first_frame || finding.last_frame > kLastFrame)
        throw MalformedRow{"shadows in frames outside every video"};
    finding.outcome = row.word(stored::kLightOutcomes);
    finding.heading = headingFrom(row);
    finding.reach_m = lengthFrom(row, "reach of shadows");
    finding.scatter_m = lengthFrom(row, "scatter of shadows");
    finding.vehicles = countFrom(row, "vehicles");
    finding.agreement = shareFrom(row, "agreement about shadows");
    const double darkening = row.real();
    if (darkening < 0 || darkening > 1) throw MalformedRow{"an impossible darkness of shadows"};
    if (!std::isnan(darkening)) finding.darkening = darkening;
    finding.trimmed = countFrom(row, "tracks");
    finding.dropped = countFrom(row, "tracks");
    return finding;
}

BoxTrim readTrim(RowReader& row) {
    BoxTrim trim;
    trim.what = row.word(stored::kLightOutcomes);
    if (trim.what != LightOutcome::shadows && trim.what != LightOutcome::beams)
        throw MalformedRow{"something else than shadows and beams in boxes"};
    trim.along = shareFrom(row, "share of a box");
    trim.across = shareFrom(row, "share of a box");
    trim.taken = shareFrom(row, "share of a box");
    return trim;
}

}  // namespace

std::vector<LightFinding> readFindings(SQLite::Database& database, int run_id) {
    SQLite::Statement statement(database,
                                "SELECT first_frame, last_frame, outcome, heading_deg, reach_m, scatter_m, vehicles, "
                                "agreement, darkening, trimmed, dropped FROM light_finding WHERE run_id = ? ORDER BY "
                                "first_frame");
    statement.bind(1, run_id);
    std::vector<LightFinding> findings;
    while (statement.executeStep()) {
        RowReader row(statement);
        findings.push_back(readFinding(row));
    }
    return findings;
}

std::map<TrackId, BoxTrim> readTrims(SQLite::Database& database, int run_id) {
    SQLite::Statement statement(database, "SELECT track_id, what, along, across, taken FROM box_trim WHERE run_id = ?");
    statement.bind(1, run_id);
    std::map<TrackId, BoxTrim> trims;
    while (statement.executeStep()) {
        RowReader row(statement);
        const TrackId track = row.integer();
        trims[track] = readTrim(row);
    }
    return trims;
}

std::optional<FrameShadow> StoredLight::shadowIn(int run_id, FrameIndex frame) const {
    return guarded(project_.path(), "reading the light" + ofRun(run_id), [&]() -> std::optional<FrameShadow> {
        SQLite::Statement statement(project_.database(),
                                    "SELECT heading_deg, reach_px FROM frame_shadow WHERE run_id = ? AND frame = ?");
        statement.bind(1, run_id);
        statement.bind(2, frame);
        if (!statement.executeStep()) return std::nullopt;
        RowReader row(statement);
        FrameShadow shadow;
        shadow.frame = frame;
        shadow.heading = headingFrom(row);
        shadow.reach_px = lengthFrom(row, "reach of shadows");
        return shadow;
    });
}

std::optional<BoxTrim> StoredLight::trimOf(int run_id, TrackId track) const {
    return guarded(project_.path(), "reading the light" + ofRun(run_id), [&]() -> std::optional<BoxTrim> {
        SQLite::Statement statement(
            project_.database(), "SELECT what, along, across, taken FROM box_trim WHERE run_id = ? AND track_id = ?");
        statement.bind(1, run_id);
        statement.bind(2, track);
        if (!statement.executeStep()) return std::nullopt;
        RowReader row(statement);
        return readTrim(row);
    });
}

void replaceLight(SQLite::Database& database, int run_id, const RunLight& light) {
    for (const char* table : {"light_finding", "frame_shadow", "box_trim"}) {
        SQLite::Statement statement(database, std::string("DELETE FROM ") + table + " WHERE run_id = ?");
        RowWriter(statement).integer(run_id).run();
    }
    SQLite::Statement finding_of(database,
                                 "INSERT INTO light_finding (run_id, first_frame, last_frame, outcome, heading_deg, "
                                 "reach_m, scatter_m, vehicles, agreement, darkening, trimmed, dropped) VALUES (?, ?, "
                                 "?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
    for (const LightFinding& finding : light.findings) {
        RowWriter(finding_of)
            .integer(run_id)
            .integer(finding.first_frame)
            .integer(finding.last_frame)
            .word(stored::kLightOutcomes, finding.outcome)
            .real(degreesFromRadians(finding.heading))
            .real(finding.reach_m)
            .real(finding.scatter_m)
            .integer(finding.vehicles)
            .real(finding.agreement)
            .real(finding.darkening.value_or(std::numeric_limits<double>::quiet_NaN()))
            .integer(finding.trimmed)
            .integer(finding.dropped)
            .run();
    }
    SQLite::Statement shadow_of(database,
                                "INSERT INTO frame_shadow (run_id, frame, heading_deg, reach_px) VALUES (?, ?, ?, ?)");
    for (const FrameShadow& shadow : light.frames) {
        RowWriter(shadow_of)
            .integer(run_id)
            .integer(shadow.frame)
            .real(degreesFromRadians(shadow.heading))
            .real(shadow.reach_px)
            .run();
    }
    SQLite::Statement trim_of(
        database, "INSERT INTO box_trim (run_id, track_id, what, along, across, taken) VALUES (?, ?, ?, ?, ?, ?)");
    for (const auto& [track, trim] : light.trims) {
        RowWriter(trim_of)
            .integer(run_id)
            .integer(track)
            .word(stored::kLightOutcomes, trim.what)
            .real(trim.along)
            .real(trim.across)
            .real(trim.taken)
            .run();
    }
}

}  // namespace eyrie

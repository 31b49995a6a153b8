#include "store/review/control_points.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <cmath>

#include "core/values/last_frame.h"
#include "store/database/rows.h"
#include "store/project/sequence_rows.h"

namespace eyrie {

bool isPossible(const ControlPoint& point) {
    constexpr double kFarthestPixel = 1e6;
    return point.frame >= 0 && point.frame <= kLastFrame && std::abs(point.px.x) < kFarthestPixel &&
           std::abs(point.px.y) < kFarthestPixel && std::abs(point.place.latitude_deg) <= 90 &&
           std::abs(point.place.longitude_deg) <= 180;
}

namespace {

std::vector<ControlPoint> readRows(SQLite::Database& database, int sequence_id) {
    SQLite::Statement statement(database,
                                "SELECT frame, x, y, latitude_deg, longitude_deg FROM control_point WHERE "
                                "sequence_id = ? ORDER BY id");
    statement.bind(1, sequence_id);
    std::vector<ControlPoint> points;
    while (statement.executeStep()) {
        RowReader row(statement);
        ControlPoint point;
        point.frame = readFrameNumber(row);
        point.px = row.point();
        point.place.latitude_deg = row.real();
        point.place.longitude_deg = row.real();
        if (!isPossible(point)) throw MalformedRow{"a control point that is not on the earth"};
        points.push_back(point);
    }
    return points;
}

void writeRows(SQLite::Database& database, int sequence_id, const std::vector<ControlPoint>& points) {
    SQLite::Statement forget(database, "DELETE FROM control_point WHERE sequence_id = ?");
    RowWriter(forget).integer(sequence_id).run();
    SQLite::Statement add(database,
                          "INSERT INTO control_point (sequence_id, frame, x, y, latitude_deg, longitude_deg) "
                          "VALUES (?, ?, ?, ?, ?, ?)");
    for (const ControlPoint& point : points) {
        RowWriter(add)
            .integer(sequence_id)
            .integer(point.frame)
            .point(point.px)
            .real(point.place.latitude_deg)
            .real(point.place.longitude_deg)
            .run();
    }
}

}  // namespace

std::vector<ControlPoint> readControlPoints(ProjectFile& project, int sequence_id) {
    return guarded(project.path(), "reading the control points",
                   [&] { return readRows(project.database(), sequence_id); });
}

void replaceControlPoints(ProjectFile& project, int sequence_id, const std::vector<ControlPoint>& points) {
    project.checkInPlace();
    guarded(project.path(), "storing the control points", [&] {
        SQLite::Transaction transaction(project.database(), SQLite::TransactionBehavior::IMMEDIATE);
        writeRows(project.database(), sequence_id, points);
        transaction.commit();
    });
}

bool exchangeControlPoints(ProjectFile& project, int sequence_id, const std::vector<ControlPoint>& before,
                           const std::vector<ControlPoint>& after) {
    project.checkInPlace();
    return guarded(project.path(), "storing the control points", [&] {
        SQLite::Transaction transaction(project.database(), SQLite::TransactionBehavior::IMMEDIATE);
        if (readRows(project.database(), sequence_id) != before) return false;
        writeRows(project.database(), sequence_id, after);
        transaction.commit();
        return true;
    });
}

}  // namespace eyrie

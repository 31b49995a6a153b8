#include "store/sweeps/sweep_store.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "core/time/utc_time.h"
#include "store/database/database_error.h"
#include "store/database/rows.h"

namespace eyrie {
namespace {

std::vector<SweepRecord> readSweeps(SQLite::Database& database) {
    SQLite::Statement statement(
        database,
        "SELECT id, made_utc, name, point_count, (SELECT count(*) FROM sweep_point WHERE sweep_id = sweep.id), plan "
        "FROM sweep ORDER BY id");
    std::vector<SweepRecord> sweeps;
    while (statement.executeStep()) {
        RowReader row(statement);
        SweepRecord sweep;
        sweep.id = row.integer();
        sweep.made_utc = row.text();
        sweep.name = row.text();
        sweep.point_count = row.integer();
        sweep.points_done = row.integer();
        sweep.plan = row.longText();
        sweeps.push_back(std::move(sweep));
    }
    return sweeps;
}

std::string ofSweep(int id) {
    return " of sweep " + std::to_string(id);
}

}  // namespace

std::vector<SweepRecord> SweepStore::sweeps() const {
    return guarded(project_.path(), "listing the sweeps", [&] { return readSweeps(project_.database()); });
}

int SweepStore::add(const std::string& name, int point_count, const std::string& plan) {
    return guarded(project_.path(), "storing the plan of a sweep", [&] {
        SQLite::Statement statement(project_.database(),
                                    "INSERT INTO sweep (made_utc, name, point_count, plan) VALUES (?, ?, ?, ?)");
        const std::string now = nowUtc();
        RowWriter(statement).text(now).text(name).integer(point_count).text(plan).run();
        return static_cast<int>(project_.database().getLastInsertRowid());
    });
}

bool SweepStore::addPoint(int sweep, const SweepPointRecord& point) {
    project_.checkInPlace();
    return guarded(project_.path(), "storing point " + std::to_string(point.position) + ofSweep(sweep), [&] {
        SQLite::Statement statement(project_.database(),
                                    "INSERT INTO sweep_point (sweep_id, position, seconds, figures) "
                                    "VALUES (?, ?, ?, ?) ON CONFLICT DO NOTHING");
        RowWriter(statement).integer(sweep).integer(point.position).real(point.seconds).text(point.figures).run();
        return project_.database().getChanges() > 0;
    });
}

std::vector<SweepPointRecord> SweepStore::points(int sweep) const {
    return guarded(project_.path(), "reading the points" + ofSweep(sweep), [&] {
        SQLite::Statement statement(
            project_.database(),
            "SELECT position, seconds, figures FROM sweep_point WHERE sweep_id = ? ORDER BY position");
        statement.bind(1, sweep);
        std::vector<SweepPointRecord> points;
        while (statement.executeStep()) {
            RowReader row(statement);
            SweepPointRecord point;
            point.position = row.integer();
            point.seconds = row.real();
            point.figures = row.longText();
            points.push_back(std::move(point));
        }
        return points;
    });
}

std::set<int> SweepStore::pointsDone(int sweep) const {
    return guarded(project_.path(), "reading the points" + ofSweep(sweep), [&] {
        SQLite::Statement statement(project_.database(), "SELECT position FROM sweep_point WHERE sweep_id = ?");
        statement.bind(1, sweep);
        std::set<int> done;
        while (statement.executeStep()) done.insert(RowReader(statement).integer());
        return done;
    });
}

void SweepStore::remove(int sweep) {
    guarded(project_.path(), "removing sweep " + std::to_string(sweep), [&] {
        SQLite::Statement statement(project_.database(), "DELETE FROM sweep WHERE id = ?");
        RowWriter(statement).integer(sweep).run();
    });
}

}  // namespace eyrie

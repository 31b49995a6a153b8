#include "store/sweeps/comparison_store.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "core/time/utc_time.h"
#include "store/database/database_error.h"

namespace eyrie {

int addComparison(ProjectFile& project, const std::string& sequence, const std::string& report) {
    return guarded(project.path(), "storing a comparison", [&] {
        SQLite::Statement statement(project.database(),
                                    "INSERT INTO comparison (made_utc, sequence, report) VALUES (?, ?, ?)");
        statement.bind(1, nowUtc());
        statement.bind(2, sequence);
        statement.bind(3, report);
        statement.exec();
        return static_cast<int>(project.database().getLastInsertRowid());
    });
}

std::vector<ComparisonRecord> comparisons(ProjectFile& project) {
    return guarded(project.path(), "reading the comparisons", [&] {
        std::vector<ComparisonRecord> all;
        SQLite::Statement statement(project.database(),
                                    "SELECT id, made_utc, sequence, report FROM comparison ORDER BY id");
        while (statement.executeStep()) {
            all.push_back({statement.getColumn(0).getInt(), statement.getColumn(1).getString(),
                           statement.getColumn(2).getString(), statement.getColumn(3).getString()});
        }
        return all;
    });
}

}  // namespace eyrie

#include "store/project/schema.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "core/values/scene_scale.h"
#include "store/database/database_error.h"
#include "store/project/schema_steps.h"

namespace eyrie::schema {
namespace {

constexpr std::array kMigrations{addRuns,
                                 addLabels,
                                 addComparisonsAndCompleteBoxes,
                                 addSweeps,
                                 addPresets,
                                 addDroppedStates,
                                 addRemovalOfRuns,
                                 addRunStates,
                                 addRegistrationFaults,
                                 addViews,
                                 addReview,
                                 addScaleOrigins,
                                 addZones,
                                 addScaleSlopes,
                                 addKeptDetails,
                                 addEvidence,
                                 addCorrections,
                                 addLocalScales,
                                 addAssumedRates,
                                 addCompactStates,
                                 addVideoStarts,
                                 addArrows,
                                 addDoubtfulIndex,
                                 addDecisions,
                                 addRejectedProposals,
                                 addStartFractions,
                                 addSourceDigests,
                                 addLight,
                                 addElapsedAndZoom};

}  // namespace

void wordRegistrationFaults(SQLite::Database& database) {
    database.exec(R"sql(
UPDATE frame SET
    picture = CASE WHEN reason LIKE 'blank picture: %' THEN 'blank' WHEN reason LIKE 'blurred picture: %' THEN 'blurred' ELSE 'clear' END,
    reason_count = CASE WHEN reason LIKE '%(% of %)' THEN CAST(substr(reason, instr(reason, '(') + 1) AS INTEGER) ELSE 0 END,
    reason_of = CASE WHEN reason LIKE '%(% of %)' THEN CAST(substr(reason, instr(reason, ' of ') + 4) AS INTEGER) ELSE 0 END,
    reason = CASE
        WHEN registration_state <> 'failed' THEN ''
        WHEN reason LIKE 'cut: %' THEN 'cut'
        WHEN reason LIKE '%too few corners found again%' THEN 'too few found again'
        WHEN reason LIKE '%too few corners agree%' THEN 'too few agree'
        WHEN reason LIKE '%too few corners%' THEN 'too few corners'
        WHEN reason LIKE '%is not one a camera makes%' THEN 'impossible motion'
        ELSE 'no match' END
WHERE reason <> '';
)sql");
}

void tellScaleOrigins(SQLite::Database& database, const std::string& condition) {
    static_assert(kAssumedGsd == 0.25);
    database.exec(R"sql(
UPDATE run SET
    scale_origin = CASE WHEN gsd_known THEN 'given' WHEN gsd_m_per_px = 0.25 THEN 'assumed' ELSE 'estimated' END,
    scale_uncertainty = NULL,
    scale_vehicles = 0
WHERE )sql" + condition);
}

std::span<const Migration> migrations() {
    return kMigrations;
}

int currentNumber() {
    return static_cast<int>(kMigrations.size());
}

int numberOf(SQLite::Database& database) {
    return database.execAndGet("PRAGMA user_version").getInt();
}

void migrate(SQLite::Database& database, std::span<const Migration> steps) {
    const int newest = static_cast<int>(steps.size());
    while (numberOf(database) < newest) {
        SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
        // Read again under the lock: another program may have been quicker.
        const int number = numberOf(database);
        if (number >= newest) break;
        steps[static_cast<std::size_t>(number)](database);
        database.exec("PRAGMA user_version = " + std::to_string(number + 1));
        transaction.commit();
    }
}

namespace {

using Columns = std::map<std::string, std::vector<std::string>>;  // by table

Columns columnsOf(SQLite::Database& database) {
    Columns columns;
    SQLite::Statement statement(database,
                                "SELECT master.name, info.name FROM sqlite_master AS master, "
                                "pragma_table_info(master.name) AS info WHERE master.type = 'table'");
    while (statement.executeStep())
        columns[statement.getColumn(0).getString()].push_back(statement.getColumn(1).getString());
    return columns;
}

Columns columnsOfNewest() {
    SQLite::Database database(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    migrate(database, migrations());
    return columnsOf(database);
}

}  // namespace

void checkTables(SQLite::Database& database) {
    static const Columns expected = columnsOfNewest();
    const Columns present = columnsOf(database);
    for (const auto& [table, columns] : expected) {
        const auto found = present.find(table);
        if (found == present.end()) throw MalformedRow{"it has no table " + table};
        for (const std::string& column : columns) {
            if (std::find(found->second.begin(), found->second.end(), column) == found->second.end())
                throw MalformedRow{"its table " + table + " has no column " + column};
        }
    }
}

}  // namespace eyrie::schema

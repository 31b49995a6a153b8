#include "store/health/project_repair.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>
#include <unistd.h>

#include <optional>
#include <set>

#include "store/database/database_error.h"
#include "store/database/new_place.h"
#include "store/database/stop_handler.h"
#include "store/health/damaged_copy.h"
#include "store/health/file_check.h"
#include "store/health/raw_file.h"
#include "store/health/report_text.h"
#include "store/health/rescued_rows.h"
#include "store/health/table_rescue.h"
#include "store/project/project_file.h"
#include "store/project/schema.h"

namespace eyrie {
namespace {

using Path = std::filesystem::path;

/// A folder beside the new project that vanishes with all that was needed on the way.
class Workshop {
 public:
    explicit Workshop(const Path& fresh) : path_(lockFileBeside(fresh, ".repair-" + std::to_string(getpid()))) {
        std::error_code failed;
        std::filesystem::remove_all(path_, failed);
        if (!std::filesystem::create_directory(path_, failed)) {
            throw Error(ErrorKind::output, "the project " + fresh.string() + " cannot be made (" + failed.message() +
                                               "); check that its folder exists and may be written");
        }
    }
    ~Workshop() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Workshop(const Workshop&) = delete;
    Workshop& operator=(const Workshop&) = delete;
    const Path& path() const { return path_; }

 private:
    Path path_;
};

void refuseWithoutRoom(const Path& damaged, const Path& fresh) {
    std::error_code failed;
    if (std::filesystem::exists(fresh, failed)) {
        throw Error(ErrorKind::output,
                    fresh.string() + " exists already; choose another name for the repaired project");
    }
    const auto file = RawFile::open(damaged);
    const auto space = std::filesystem::space(std::filesystem::absolute(fresh).parent_path(), failed);
    if (failed || !file || space.available / 2 > file->size()) return;
    throw Error(ErrorKind::output, "there is too little room beside " + fresh.string() + ": " +
                                       std::to_string(space.available / 1'000'000) + " MB are free, " +
                                       std::to_string(2 * file->size() / 1'000'000 + 1) + " MB are needed");
}

/// Those that others belong to first: their numbers tell which rows to look for.
constexpr char kTables[] =
    "SELECT name FROM main.sqlite_schema WHERE type = 'table' AND name NOT LIKE 'sqlite_%' ORDER BY name NOT IN "
    "('sequence', 'run', 'sweep', 'preset'), name";

/// Tables that a project had before the step that added the others: what it never had is not lost. All for a number
/// that cannot be.
std::set<std::string> tablesOfSchema(int number) {
    SQLite::Database empty(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    const auto steps = schema::migrations();
    const bool known = number >= 1 && number <= schema::currentNumber();
    schema::migrate(empty, known ? steps.first(static_cast<std::size_t>(number)) : steps);
    const auto names = textsOf(empty, kTables);
    return {names.begin(), names.end()};
}

void append(std::vector<std::string>& lines, const std::vector<std::string>& more) {
    lines.insert(lines.end(), more.begin(), more.end());
}

std::vector<std::string> summaryOf(SQLite::Database& database) {
    std::vector<std::string> saved;
    SQLite::Statement runs(database,
                           "SELECT id, name, (SELECT count(*) FROM frame WHERE run_id = run.id), (SELECT count(*) FROM "
                           "track WHERE run_id = run.id AND confirmed) FROM run ORDER BY id");
    while (runs.executeStep()) {
        const std::string name = runs.getColumn(1).getString();
        saved.push_back("run " + runs.getColumn(0).getString() + (name.empty() ? "" : " \"" + name + "\"") + ": " +
                        counted(runs.getColumn(2).getInt(), "frame") + ", " +
                        counted(runs.getColumn(3).getInt(), "track"));
    }
    struct Kind {
        const char* table;
        const char* one;
        const char* many;
    };
    for (const Kind& kind :
         {Kind{"labelled_object", "labelled object", "labelled objects"},
          Kind{"ignore_region", "ignore region", "ignore regions"}, Kind{"review_mark", "review mark", "review marks"},
          Kind{"rejected_proposal", "rejected proposal", "rejected proposals"},
          Kind{"edit_journal", "step of work on the labels", "steps of work on the labels"},
          Kind{"verdict", "verdict", "verdicts"}, Kind{"bookmark", "bookmark", "bookmarks"},
          Kind{"zone", "zone", "zones"}, Kind{"correction", "correction of tracks", "corrections of tracks"},
          Kind{"review_step", "step of the review", "steps of the review"}, Kind{"preset", "preset", "presets"},
          Kind{"sweep", "sweep", "sweeps"}, Kind{"sweep_point", "point of a sweep", "points of sweeps"},
          Kind{"comparison", "comparison", "comparisons"}}) {
        const auto count = database.execAndGet(std::string("SELECT count(*) FROM ") + kind.table).getInt64();
        if (count > 0) saved.push_back(counted(count, kind.one, kind.many));
    }
    return saved;
}

/// Fills a new project from the copy of a damaged one; false when stopped.
bool fill(SQLite::Database& database, const DamagedCopy& copy, const CopyWatch& watch, RepairReport& report) {
    database.exec("PRAGMA foreign_keys = OFF");
    // So that SQLite opens what contradicts itself; nothing but rows is taken from there.
    sqlite3_db_config(database.getHandle(), SQLITE_DBCONFIG_DEFENSIVE, 0, nullptr);
    database.exec("PRAGMA writable_schema = ON");
    {
        SQLite::Statement attach(database, "ATTACH ? AS damaged");
        attach.bind(1, copy.path.string());
        attach.exec();
    }
    const StopHandler handler(database, watch.stop);
    try {
        const auto tables = textsOf(database, kTables);
        const auto had = tablesOfSchema(database.execAndGet("PRAGMA damaged.user_version").getInt());
        bool frames_whole = true;
        for (std::size_t i = 0; i < tables.size(); ++i) {
            const TableRescue rescue = rescueTable(database, tables[i]);
            if (tables[i] == "frame") frames_whole = rescue.whole;
            if (!rescue.whole && had.contains(tables[i]))
                report.lost.push_back("part of the rows of " + tables[i] + " (" + rescue.fault + ")");
            if (watch.progress) watch.progress(static_cast<double>(i + 1) / static_cast<double>(tables.size()));
        }
        // Rows of a schema before these columns.
        const auto lacks = [&](const std::string& table, const std::string& column) {
            return textsOf(database, "SELECT name FROM pragma_table_info('" + table + "', 'damaged') WHERE name = '" +
                                         column + "'")
                .empty();
        };
        const bool has_sentences = lacks("frame", "picture");
        const bool lacks_origins = lacks("run", "scale_origin");
        database.exec("DETACH damaged");
        SQLite::Transaction transaction(database);
        if (has_sentences) schema::wordRegistrationFaults(database);
        if (lacks_origins) schema::tellScaleOrigins(database);
        append(report.lost, mendScaleOrigins(database));
        append(report.lost, mendScaleSlopes(database));
        append(report.lost, mendVideoStarts(database));
        append(report.lost, mendRunStarts(database));
        append(report.lost, dropImpossibleRows(database));
        append(report.lost, mendReferences(database));
        append(report.lost, mendRuns(database, frames_whole));
        append(report.lost, mendLabels(database));
        append(report.lost, mendReview(database));
        transaction.commit();
    } catch (const SQLite::Exception& exception) {
        if (exception.getErrorCode() == SQLITE_INTERRUPT) return false;
        throw;
    }
    report.saved = summaryOf(database);
    return true;
}

}  // namespace

RepairReport repairProject(const Path& damaged, const Path& fresh, const CopyWatch& watch) {
    std::error_code missing;
    if (!std::filesystem::is_regular_file(damaged, missing)) checkFile(damaged);  // throws
    refuseWithoutRoom(damaged, fresh);
    const Workshop workshop(fresh);
    RepairReport report;
    const DamagedCopy copy = copyDamaged(damaged, workshop.path(), watch);
    report.lost = copy.notes;
    const Path made = workshop.path() / "new.eyrie";
    report.stopped = copy.stopped || !guarded(fresh, "saving what can be read", [&] {
                         ProjectFile project = ProjectFile::create(made);
                         const bool whole = fill(project.database(), copy, watch, report);
                         project.database().exec("PRAGMA journal_mode = DELETE");
                         return whole;
                     });
    if (report.stopped) return report;
    const NewPlace place(fresh);
    if (const auto error = renameWithoutReplacing(made, fresh)) {
        throw Error(ErrorKind::output, "the project " + fresh.string() + " cannot be made (" + error.message() +
                                           "); choose another name or folder");
    }
    return report;
}

}  // namespace eyrie

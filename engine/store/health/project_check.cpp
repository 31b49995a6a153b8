#include "store/health/project_check.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <algorithm>
#include <functional>
#include <set>

#include "store/backup/project_backup.h"
#include "store/database/rows.h"
#include "store/database/stop_handler.h"
#include "store/health/file_check.h"
#include "store/health/raw_file.h"
#include "store/health/report_text.h"
#include "store/health/row_rules.h"
#include "store/health/schema_check.h"
#include "store/health/untouched_database.h"
#include "store/journal/journal_check.h"
#include "store/labels/annotation_store.h"
#include "store/project/schema.h"
#include "store/review/review_store.h"
#include "store/runs/run_lock.h"

namespace eyrie {
namespace {

using Path = std::filesystem::path;

constexpr std::size_t kLinesShown = 3;

/// The first lines of a list, and how many more there are.
std::string firstOf(const std::vector<std::string>& lines) {
    std::string words;
    for (std::size_t i = 0; i < std::min(lines.size(), kLinesShown); ++i) words += (i > 0 ? "; " : "") + lines[i];
    if (lines.size() > kLinesShown) words += "; and " + std::to_string(lines.size() - kLinesShown) + " more";
    return words;
}

/// One respect after the other; what throws is damaged, and the next is looked at all the same.
class Examination {
 public:
    Examination(const Path& path, HealthReport& report) : path_(path), report_(report) {}

    void add(const std::string& subject, const std::function<HealthItem()>& look) {
        if (report_.stopped) return;
        HealthItem item;
        try {
            item = look();
        } catch (const SQLite::Exception& exception) {
            if (exception.getErrorCode() == SQLITE_INTERRUPT) {
                report_.stopped = true;
                return;
            }
            // Busy, or the disk refuses: that tells nothing about the project.
            if (exception.getErrorCode() == SQLITE_BUSY || exception.getErrorCode() == SQLITE_CANTOPEN) {
                throw databaseError(path_, "checking", exception);
            }
            item = {"", Health::damaged, exception.what()};
        } catch (const MalformedRow& row) {
            item = {"", Health::damaged, row.what};
        }
        item.subject = subject;
        report_.items.push_back(std::move(item));
    }

 private:
    const Path& path_;
    HealthReport& report_;
};

HealthItem lookAtFile(const Path& path) {
    try {
        checkFile(path);
    } catch (const Error& error) {
        return {"", Health::damaged, error.what()};
    }
    const auto file = RawFile::open(path);
    return {"", Health::good, counted(static_cast<std::int64_t>(file ? file->size() : 0), "byte")};
}

HealthItem lookAtStructure(const Path& path, SQLite::Database& database) {
    std::vector<std::string> faults;
    try {
        faults = textsOf(database, "PRAGMA integrity_check(20)");
    } catch (const SQLite::Exception& exception) {
        if (exception.getErrorCode() != SQLITE_CORRUPT) throw;
        faults.push_back(exception.what());
    }
    if (faults.size() == 1 && faults[0] == "ok") return {"", Health::good, "every page is in its place"};
    std::string words = firstOf(faults);
    if (hasLog(path)) {
        const auto without = openWithoutLog(path);
        if (textsOf(*without, "PRAGMA integrity_check(1)") == std::vector<std::string>{"ok"}) {
            words += "; without the log beside it (" + path.filename().string() +
                     "-wal) the file is whole: that log is damaged or of another file";
        }
    }
    return {"", Health::damaged, words};
}

HealthItem lookAtReferences(SQLite::Database& database) {
    const auto broken = textsOf(database, "SELECT DISTINCT \"table\" FROM pragma_foreign_key_check ORDER BY 1");
    if (broken.empty()) return {"", Health::good, "every row belongs to one that is there"};
    return {"", Health::damaged, "rows belong to none that is there, in " + firstOf(broken)};
}

HealthItem lookAtValues(SQLite::Database& database, const std::set<std::string>& tables) {
    std::vector<std::string> faults;
    for (const RowRule& rule : rowRules()) {
        if (tables.count(rule.table) == 0 || rule.since > schema::numberOf(database)) continue;
        const auto count =
            database.execAndGet("SELECT count(*) FROM " + rule.table + " WHERE NOT (" + rule.condition + ")")
                .getInt64();
        if (count > 0) faults.push_back(rule.what + " (" + std::to_string(count) + " in " + rule.table + ")");
    }
    if (faults.empty()) return {"", Health::good, "all are possible, all packed arrays can be read"};
    return {"", Health::damaged, firstOf(faults)};
}

/// What people made of a kind, and its steps.
template <class Content>
HealthItem lookAtWork(SQLite::Database& database, const std::set<std::string>& tables) {
    // A project of an older schema may lack some of the tables.
    if (!tables.contains(Content::kSteps.name) || !tables.contains(Content::kNumbers.front().table))
        return {"", Health::good, "none"};
    int steps = 0;
    int misfits = 0;
    for (const std::string& id : textsOf(database, "SELECT id FROM sequence")) {
        const JournalCheck journal = checkJournal<Content>(database, std::stoi(id));
        steps += journal.done + journal.undone;
        misfits += journal.done - journal.done_fitting + journal.undone - journal.undone_fitting;
    }
    if (misfits > 0) {
        return {"", Health::damaged,
                std::to_string(misfits) + " of " + counted(steps, "step") + " can no longer be undone or redone"};
    }
    std::string words;
    for (const NumberedTable& table : Content::kNumbers) {
        if (!tables.contains(table.table)) continue;
        const auto rows = database.execAndGet(std::string("SELECT count(*) FROM ") + table.table).getInt64();
        words += counted(rows, table.counter) + ", ";
    }
    return {"", Health::good, words + counted(steps, "step") + " to undo or redo"};
}

HealthItem lookAtRuns(const Path& path, SQLite::Database& database) {
    std::string words = counted(database.execAndGet("SELECT count(*) FROM run").getInt64(), "run");
    Health health = Health::good;
    SQLite::Statement open(database, "SELECT id FROM run WHERE state = 'running'");
    while (open.executeStep()) {
        const int id = open.getColumn(0).getInt();
        const auto writer = FileLock::holderOf(runLockFile(path, id));
        health = Health::remark;
        words += "; run " + std::to_string(id) +
                 (writer ? " is being written by " + *writer : " was killed, the frames that it had written are there");
    }
    return {"", health, words};
}

/// Files beside the project that a program which was killed leaves, or one that works has.
HealthItem lookAround(const Path& path) {
    std::vector<std::string> found;
    const std::string name = path.filename().string();
    if (hasLog(path)) found.push_back(name + "-wal holds changes that move into the project when it is next opened");
    std::error_code failed;
    if (std::filesystem::exists(path.string() + "-journal", failed)) {
        found.push_back(name + "-journal is of a change that was interrupted; it is undone when the project is opened");
    }
    std::filesystem::directory_iterator entries(std::filesystem::absolute(path).parent_path(), failed);
    for (; !failed && entries != std::filesystem::directory_iterator(); entries.increment(failed)) {
        const std::string other = entries->path().filename().string();
        if (other.starts_with(name + ".new-") || other.starts_with(name + ".repair-")) {
            found.push_back(
                other +
                " was left by a program that was killed, or one is writing it now; if none is, it may be deleted");
        } else if (other.starts_with(name + "-wal.left-")) {
            found.push_back(other + " holds changes of a project that lay here before");
        }
    }
    if (found.empty()) return {"", Health::good, "nothing"};
    return {"", Health::remark, firstOf(found)};
}

HealthItem lookAtBackups(const Path& path) {
    const auto backups = listBackups(path);
    if (backups.empty()) return {"", Health::good, "none"};
    return {"", Health::good, std::to_string(backups.size()) + ", the newest of " + inWords(backups.front().made)};
}

/// What is no project of ours is nothing to be examined.
void refuseForeignToCheck(const Path& path, SQLite::Database& database) {
    int application = 0;
    int number = 0;
    try {
        application = database.execAndGet("PRAGMA application_id").getInt();
        number = schema::numberOf(database);
        if (application == 0 && database.tableExists("run")) return;  // lost with the header
    } catch (const SQLite::Exception& exception) {
        if (exception.getErrorCode() == SQLITE_BUSY) throw databaseError(path, "checking", exception);
        return;  // damaged, and told as such
    }
    if (application != schema::kApplicationId) {
        throw Error(ErrorKind::project, path.string() + " is a database of another program, not an Eyrie project");
    }
    if (number > schema::currentNumber()) {
        throw Error(ErrorKind::project,
                    path.string() + " was written by a newer version of Eyrie; check it with that version");
    }
}

}  // namespace

bool HealthReport::healthy() const {
    return std::none_of(items.begin(), items.end(),
                        [](const HealthItem& item) { return item.health == Health::damaged; });
}

HealthReport checkProject(const Path& path, const CopyWatch& watch) {
    std::error_code failed;
    if (!std::filesystem::is_regular_file(path, failed) || !RawFile::open(path)) checkFile(path);  // throws
    HealthReport report;
    Examination examination(path, report);
    examination.add("file", [&] { return lookAtFile(path); });
    const auto database = guarded(path, "opening", [&] { return openUntouched(path); });
    refuseForeignToCheck(path, *database);
    addRowFunctions(*database);
    const StopHandler handler(*database, watch.stop);
    SchemaCheck schema;
    int looked = 0;
    const auto add = [&](const char* subject, const std::function<HealthItem()>& look) {
        examination.add(subject, look);
        constexpr double kLooks = 7;
        if (watch.progress) watch.progress(std::min(1.0, ++looked / kLooks));
    };
    add("tables", [&]() -> HealthItem {
        schema = checkSchema(*database);
        if (!schema.faults.empty()) return {"", Health::damaged, firstOf(schema.faults)};
        const int number = schema::numberOf(*database);
        return {"", Health::good,
                "schema " + std::to_string(number) +
                    (number < schema::currentNumber() ? ", is brought up to date when it is next opened" : "")};
    });
    add("structure", [&] { return lookAtStructure(path, *database); });
    // Where a table of ours is something else, asking it may never end.
    const bool ours =
        schema.tables.contains("sequence") && schema.tables.contains("run") && schema.tables.contains("frame");
    const HealthItem not_looked{"", Health::damaged, "not looked at, since tables are not as Eyrie makes them"};
    add("references", [&] { return ours ? lookAtReferences(*database) : not_looked; });
    add("values", [&] { return lookAtValues(*database, schema.tables); });
    add("labels", [&] { return lookAtWork<LabelContent>(*database, schema.tables); });
    add("review", [&] { return lookAtWork<ReviewContent>(*database, schema.tables); });
    add("runs", [&] { return ours ? lookAtRuns(path, *database) : not_looked; });
    examination.add("beside it", [&] { return lookAround(path); });
    examination.add("earlier states", [&] { return lookAtBackups(path); });
    return report;
}

}  // namespace eyrie

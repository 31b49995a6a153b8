#include "store/health/project_contents.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <functional>

#include "store/database/rows.h"
#include "store/health/report_text.h"
#include "store/health/untouched_database.h"
#include "store/labels/packed_labels.h"

namespace eyrie {
namespace {

bool hasColumn(SQLite::Database& database, const std::string& table, const std::string& column) {
    SQLite::Statement statement(database, "SELECT count(*) FROM pragma_table_info(?) WHERE name = ?");
    statement.bind(1, table);
    statement.bind(2, column);
    statement.executeStep();
    return statement.getColumn(0).getInt() > 0;
}

/// Calls `row` for every row of a query on a table; an older project may not have it.
void each(SQLite::Database& database, const std::string& table, const std::string& query,
          const std::function<void(RowReader&)>& row) {
    if (!database.tableExists(table)) return;
    SQLite::Statement statement(database, query);
    while (statement.executeStep()) {
        RowReader reader(statement);
        row(reader);
    }
}

void readRuns(SQLite::Database& database, ProjectContents& contents) {
    const char* present = hasColumn(database, "run", "removed_utc") ? " WHERE removed_utc = ''" : "";
    each(database, "run",
         std::string("SELECT id, name, started_utc, (SELECT count(*) FROM frame WHERE run_id = run.id) FROM run") +
             present,
         [&](RowReader& row) {
             const int id = row.integer();
             ProjectContents::Run& run = contents.runs[id];
             run.name = row.text();
             run.started_utc = row.text();
             run.frames = row.integer();
         });
}

void readLabels(SQLite::Database& database, ProjectContents& contents) {
    each(
        database, "labelled_object",
        "SELECT id, keyframes, quote(sequence_id) || quote(class) || quote(colour) || quote(notes) || quote(origin) || "
        "quote(last_frame) FROM labelled_object",
        [&](RowReader& row) {
            std::string& object = contents.objects[row.integer()];
            const ByteView bytes = row.bytes();
            for (const std::byte byte : bytes) object += static_cast<char>(byte);
            contents.keyframes += static_cast<int>(RowReader::unpacked(unpackKeyframes(bytes), "keyframes").size());
            object += row.text();
        });
    for (const char* table : {"ignore_region", "review_mark", "object_class", "rejected_proposal"}) {
        each(database, table, std::string("SELECT count(*) FROM ") + table,
             [&](RowReader& row) { contents.label_rows[table] = row.wide(); });
    }
    each(database, "edit_journal", "SELECT count(*) FROM edit_journal WHERE undone = 0",
         [&](RowReader& row) { contents.edits = row.integer(); });
}

void readReviewContents(SQLite::Database& database, ProjectContents& contents) {
    each(database, "verdict",
         "SELECT id, quote(sequence_id) || quote(kind) || quote(first_frame) || quote(last_frame) || quote(frame) || "
         "quote(x) || quote(y) || quote(zone) || quote(judgement) || quote(note) || quote(tags) || quote(starred) || "
         "quote(person) FROM verdict",
         [&](RowReader& row) {
             const int id = row.integer();
             contents.verdicts[id] = row.longText();
         });
    each(database, "bookmark",
         "SELECT id, quote(sequence_id) || quote(frame) || quote(x) || quote(y) || quote(note) || quote(person) FROM "
         "bookmark",
         [&](RowReader& row) {
             const int id = row.integer();
             contents.bookmarks[id] = row.longText();
         });
    each(database, "zone",
         "SELECT id, quote(sequence_id) || quote(name) || quote(shape) || quote(anchor) || quote(frame) || "
         "quote(points) || quote(colour) || quote(shown) FROM zone",
         [&](RowReader& row) {
             const int id = row.integer();
             contents.zones[id] = row.longText();
         });
    each(database, "correction",
         "SELECT id, quote(sequence_id) || quote(kind) || quote(frame) || quote(track) || quote(other) FROM correction",
         [&](RowReader& row) {
             const int id = row.integer();
             contents.corrections[id] = row.longText();
         });
    each(database, "seen", "SELECT coalesce(sum(last_frame - first_frame + 1), 0) FROM seen",
         [&](RowReader& row) { contents.seen = row.wide(); });
    each(database, "review_step", "SELECT count(*) FROM review_step WHERE undone = 0",
         [&](RowReader& row) { contents.review_steps = row.integer(); });
}

void readPresetsAndSweeps(SQLite::Database& database, ProjectContents& contents) {
    each(database, "preset", "SELECT name, saved_utc FROM preset", [&](RowReader& row) {
        const std::string name = row.text();
        contents.presets[name] = row.text();
    });
    each(database, "preset_value",
         "SELECT preset, quote(name) || quote(value) FROM preset_value ORDER BY preset, position", [&](RowReader& row) {
             const std::string name = row.text();
             contents.presets[name] += row.text();
         });
    each(database, "sweep", "SELECT id, name, (SELECT count(*) FROM sweep_point WHERE sweep_id = sweep.id) FROM sweep",
         [&](RowReader& row) {
             const int id = row.integer();
             ProjectContents::Sweep& sweep = contents.sweeps[id];
             sweep.name = row.text();
             sweep.points = row.integer();
         });
    each(database, "comparison", "SELECT count(*) FROM comparison",
         [&](RowReader& row) { contents.comparisons = row.integer(); });
}

std::string quoted(const std::string& name) {
    return name.empty() ? "" : " \"" + name + "\"";
}

/// Lines of what only one of the states has, and `changed` for what both have.
template <class Key, class Value, class Changed>
void compare(const std::map<Key, Value>& present, const std::map<Key, Value>& earlier,
             const std::function<std::string(const Key&, const Value&)>& words, const Changed& changed,
             std::vector<std::string>& lines) {
    for (const auto& [key, value] : earlier) {
        const auto same = present.find(key);
        if (same == present.end()) {
            lines.push_back(words(key, value) + " would be back");
        } else {
            changed(key, same->second, value);
        }
    }
    for (const auto& [key, value] : present) {
        if (earlier.count(key) == 0) lines.push_back(words(key, value) + " would be gone");
    }
}

void compareCounts(std::int64_t present, std::int64_t earlier, const std::string& noun, std::vector<std::string>& lines,
                   const std::string& nouns = {}) {
    if (present != earlier) lines.push_back(counted(earlier, noun, nouns) + " in place of " + std::to_string(present));
}

void compareRuns(const ProjectContents& present, const ProjectContents& earlier, std::vector<std::string>& lines) {
    using Run = ProjectContents::Run;
    compare<int, Run>(
        present.runs, earlier.runs,
        [](int id, const Run& run) {
            return "run " + std::to_string(id) + quoted(run.name) + " of " + run.started_utc + " (" +
                   counted(run.frames, "frame") + ")";
        },
        [&](int id, const Run& now, const Run& then) {
            const std::string run = "run " + std::to_string(id);
            if (now.started_utc != then.started_utc) {
                lines.push_back(run + " would be another one, of " + then.started_utc + " in place of " +
                                now.started_utc);
                return;
            }
            if (now.frames != then.frames) {
                lines.push_back(run + " would have " + counted(then.frames, "frame") + " in place of " +
                                std::to_string(now.frames));
            }
            if (now.name != then.name) lines.push_back(run + " would be called \"" + then.name + "\"");
        },
        lines);
}

/// How many of many things would be back, gone, or another.
void compareMany(const std::map<int, std::string>& present, const std::map<int, std::string>& earlier,
                 const std::string& noun, std::vector<std::string>& lines) {
    int back = 0;
    int gone = 0;
    int other = 0;
    for (const auto& [id, thing] : earlier) {
        const auto now = present.find(id);
        if (now == present.end()) {
            ++back;
        } else if (now->second != thing) {
            ++other;
        }
    }
    for (const auto& [id, thing] : present) gone += earlier.count(id) == 0 ? 1 : 0;
    if (back > 0) lines.push_back(counted(back, noun) + " would be back");
    if (gone > 0) lines.push_back(counted(gone, noun) + " would be gone");
    if (other > 0) lines.push_back(counted(other, noun) + " would be as before later changes");
}

void compareReview(const ProjectContents& present, const ProjectContents& earlier, std::vector<std::string>& lines) {
    compareMany(present.verdicts, earlier.verdicts, "verdict", lines);
    compareMany(present.bookmarks, earlier.bookmarks, "bookmark", lines);
    compareMany(present.zones, earlier.zones, "zone", lines);
    compareMany(present.corrections, earlier.corrections, "correction of tracks", lines);
    compareCounts(present.seen, earlier.seen, "watched frame", lines);
    compareCounts(present.review_steps, earlier.review_steps, "step of the review to undo", lines,
                  "steps of the review to undo");
}

void compareLabels(const ProjectContents& present, const ProjectContents& earlier, std::vector<std::string>& lines) {
    compareMany(present.objects, earlier.objects, "labelled object", lines);
    compareCounts(present.keyframes, earlier.keyframes, "keyframe", lines);
    const auto rows = [](const ProjectContents& contents, const char* table) {
        const auto found = contents.label_rows.find(table);
        return found == contents.label_rows.end() ? 0 : found->second;
    };
    compareCounts(rows(present, "ignore_region"), rows(earlier, "ignore_region"), "ignore region", lines);
    compareCounts(rows(present, "review_mark"), rows(earlier, "review_mark"), "review mark", lines);
    compareCounts(rows(present, "rejected_proposal"), rows(earlier, "rejected_proposal"), "rejected proposal", lines);
    compareCounts(present.edits, earlier.edits, "step to undo", lines, "steps to undo");
}

}  // namespace

ProjectContents contentsOf(const std::filesystem::path& project) {
    return guarded(project, "reading what it holds", [&] {
        const auto database = openUntouched(project);
        const SQLite::Transaction moment(*database);
        ProjectContents contents;
        readRuns(*database, contents);
        readLabels(*database, contents);
        readReviewContents(*database, contents);
        readPresetsAndSweeps(*database, contents);
        return contents;
    });
}

std::vector<std::string> differencesInWords(const ProjectContents& present, const ProjectContents& earlier) {
    std::vector<std::string> lines;
    compareRuns(present, earlier, lines);
    compareLabels(present, earlier, lines);
    compareReview(present, earlier, lines);
    compare<std::string, std::string>(
        present.presets, earlier.presets,
        [](const std::string& name, const std::string&) { return "preset" + quoted(name); },
        [&](const std::string& name, const std::string& now, const std::string& then) {
            if (now != then) lines.push_back("preset" + quoted(name) + " would have its earlier values");
        },
        lines);
    using Sweep = ProjectContents::Sweep;
    compare<int, Sweep>(
        present.sweeps, earlier.sweeps,
        [](int id, const Sweep& sweep) { return "sweep " + std::to_string(id) + quoted(sweep.name); },
        [&](int id, const Sweep& now, const Sweep& then) {
            if (now.points != then.points) {
                lines.push_back("sweep " + std::to_string(id) + " would have " + counted(then.points, "point") +
                                " in place of " + std::to_string(now.points));
            }
        },
        lines);
    compareCounts(present.comparisons, earlier.comparisons, "comparison", lines);
    return lines;
}

}  // namespace eyrie

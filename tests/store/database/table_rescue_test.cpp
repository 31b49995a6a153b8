#include "store/health/table_rescue.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <set>

#include "store/full_project.h"
#include "support/temporary_folder.h"

/// Rows of tables of which some pages are lost: every row that lies elsewhere is there again, and no other.
namespace eyrie::table_rescue_test {
namespace {

constexpr std::size_t kPage = 4096;
constexpr char kFrames[] = "frame (run_id, frame, text, PRIMARY KEY (run_id, frame)) WITHOUT ROWID";

/// A table in a file of its own, whose rows tell what they are in a text that can be found in the file's bytes.
class TableRescueTest : public testing::Test {
 protected:
    void makeDamaged(const std::string& table, const std::vector<std::string>& rows) {
        table_ = table;
        SQLite::Database database(path_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        database.exec("PRAGMA page_size = " + std::to_string(kPage));
        database.exec("CREATE TABLE " + table);
        SQLite::Transaction all(database);
        for (const std::string& row : rows) {
            // 400 bytes more: nine rows a page.
            std::string insert = "INSERT INTO " + nameOfTable();
            insert.append(" VALUES (").append(row).append(", '<").append(row).append(">' || printf('%.400c', 'x'))");
            database.exec(insert);
            all_.push_back("<" + row + ">");
        }
        all.commit();
        SQLite::Statement leaf(database,
                               "SELECT pageno FROM dbstat WHERE name = ? AND pagetype = 'leaf' ORDER BY path");
        leaf.bind(1, nameOfTable());
        while (leaf.executeStep()) leaves_.push_back(leaf.getColumn(0).getUInt());
    }
    /// Overwrites a leaf of the table; answers the rows that lay there, and the next, which in tables without numbers
    /// of rows lies in the page above and is reached through this one.
    std::set<std::string> lose(std::size_t leaf) {
        std::string bytes = test::bytesOf(path_);
        const std::string page = bytes.substr((leaves_.at(leaf) - 1) * kPage, kPage);
        bytes.replace((leaves_.at(leaf) - 1) * kPage, kPage, std::string(kPage, 'Z'));
        test::writeBytes(path_, bytes);
        std::set<std::string> lost;
        bool before = false;
        for (const std::string& row : all_) {
            const bool here = page.find(row) != std::string::npos;
            if (here || (before && table_ == kFrames)) lost.insert(row);
            before = here;
        }
        EXPECT_FALSE(lost.empty());
        return lost;
    }
    /// The leaf on which a row lies.
    std::size_t leafOf(const std::string& row) const {
        const std::string bytes = test::bytesOf(path_);
        for (std::size_t i = 0; i < leaves_.size(); ++i)
            if (bytes.substr((leaves_[i] - 1) * kPage, kPage).find("<" + row + ">") != std::string::npos) return i;
        return leaves_.size();
    }
    std::string nameOfTable() const { return table_.substr(0, table_.find(' ')); }
    /// A new project with an empty table of that kind, and `runs` runs.
    void prepare(int runs) {
        main_.exec("CREATE TABLE " + table_);
        main_.exec("CREATE TABLE run (id INTEGER PRIMARY KEY)");
        for (int id = 1; id <= runs; ++id) main_.exec("INSERT INTO run VALUES (" + std::to_string(id) + ")");
        main_.exec("ATTACH '" + path_.string() + "' AS damaged");
    }
    std::set<std::string> rescued() {
        SQLite::Statement row(main_, "SELECT substr(text, 1, instr(text, '>')) FROM main." + nameOfTable());
        std::set<std::string> found;
        while (row.executeStep()) found.insert(row.getColumn(0).getString());
        return found;
    }
    std::set<std::string> allBut(const std::set<std::string>& lost) const {
        std::set<std::string> rest(all_.begin(), all_.end());
        for (const std::string& row : lost) rest.erase(row);
        return rest;
    }

    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "damaged.db";
    std::string table_;
    std::vector<std::string> all_;  ///< in the order of their keys
    std::vector<unsigned> leaves_;
    SQLite::Database main_{":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE};
};

/// Of three runs; the second one's frames reach far out.
std::vector<std::string> framesOfRuns() {
    std::vector<std::string> rows;
    const auto add = [&](int run, int first, int last) {
        for (int frame = first; frame <= last; ++frame)
            rows.push_back(std::to_string(run) + ", " + std::to_string(frame));
    };
    add(1, 0, 60);
    add(2, 0, 70);
    add(2, 1000, 1080);
    add(2, 131'000, 131'140);
    add(2, 2'000'000, 2'000'060);
    add(2, 2'147'483'600, 2'147'483'646);
    add(3, 0, 60);
    return rows;
}

}  // namespace

TEST_F(TableRescueTest, OfAWholeTableEveryRowIsThere) {
    makeDamaged(kFrames, framesOfRuns());
    prepare(3);
    const TableRescue rescue = rescueTable(main_, "frame");
    EXPECT_TRUE(rescue.whole);
    EXPECT_EQ(rescue.rows, static_cast<std::int64_t>(all_.size()));
    EXPECT_EQ(rescued(), allBut({}));
}

TEST_F(TableRescueTest, ALostPageCostsItsRowsWhereverItLies) {
    const char* places[] = {"1, 0",      "1, 30",      "2, 40",         "2, 1023", "2, 1024", "2, 131072",
                            "2, 131100", "2, 2000030", "2, 2147483640", "3, 30",   "3, 60"};
    makeDamaged(kFrames, framesOfRuns());
    const std::string whole = test::bytesOf(path_);
    for (const char* place : places) {
        SCOPED_TRACE(place);
        test::writeBytes(path_, whole);
        const std::size_t leaf = leafOf(place);
        if (leaf == leaves_.size()) continue;  // it lies between the leaves
        const auto lost = lose(leaf);
        main_ = SQLite::Database(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        prepare(3);
        const TableRescue rescue = rescueTable(main_, "frame");
        EXPECT_FALSE(rescue.whole);
        EXPECT_FALSE(rescue.fault.empty());
        EXPECT_EQ(rescued(), allBut(lost));
        EXPECT_EQ(rescue.rows, static_cast<std::int64_t>(all_.size() - lost.size()));
    }
}

TEST_F(TableRescueTest, RunsThatTheListLacksAreLookedForEightFurther) {
    std::vector<std::string> rows;
    for (const int run : {1, 2, 9, 10, 11})
        for (int frame = 0; frame < 40; ++frame) rows.push_back(std::to_string(run) + ", " + std::to_string(frame));
    makeDamaged(kFrames, rows);
    const auto lost = lose(leafOf("1, 20"));
    prepare(2);
    rescueTable(main_, "frame");
    const auto found = rescued();
    for (const std::string& row : all_) {
        const bool beyond = row.starts_with("<11, ");
        EXPECT_EQ(found.count(row), beyond || lost.count(row) > 0 ? 0U : 1U) << row;
    }
}

TEST_F(TableRescueTest, RowsWithNumbersOfTheirOwnAreFoundByThem) {
    std::vector<std::string> rows;
    rows.reserve(300);
    for (int id = 1; id <= 300; ++id) rows.push_back(std::to_string(id));
    makeDamaged("verdict (id INTEGER PRIMARY KEY, text)", rows);
    std::set<std::string> lost = lose(leafOf("5"));
    for (const char* id : {"150", "290"}) lost.merge(lose(leafOf(id)));
    prepare(0);
    const TableRescue rescue = rescueTable(main_, "verdict");
    EXPECT_FALSE(rescue.whole);
    EXPECT_EQ(rescued(), allBut(lost));
}

TEST_F(TableRescueTest, RowsWithNamesAreReadFromBothEndsUpToWhatIsLost) {
    std::vector<std::string> rows;
    rows.reserve(89);
    for (int i = 10; i < 99; ++i) rows.push_back("1" + std::to_string(i));
    makeDamaged("preset (name TEXT PRIMARY KEY, text) WITHOUT ROWID", rows);
    const auto lost = lose(leafOf("150"));
    prepare(0);
    rescueTable(main_, "preset");
    EXPECT_EQ(rescued(), allBut(lost));
}

TEST_F(TableRescueTest, WhatIsNoTableOrHasNoneIsTold) {
    makeDamaged(kFrames, framesOfRuns());
    {
        SQLite::Database database(path_.string(), SQLite::OPEN_READWRITE);
        database.exec("ALTER TABLE frame RENAME TO hidden; CREATE VIEW frame AS SELECT * FROM hidden");
    }
    prepare(3);
    const TableRescue rescue = rescueTable(main_, "frame");
    EXPECT_FALSE(rescue.whole);
    EXPECT_EQ(rescue.fault, "the table is missing");
    EXPECT_EQ(rescue.rows, 0);
    EXPECT_TRUE(rescued().empty());
}

TEST_F(TableRescueTest, WhatIsNoDamageEndsIt) {
    makeDamaged(kFrames, framesOfRuns());
    prepare(3);
    main_.exec("PRAGMA max_page_count = 5");
    EXPECT_THROW(rescueTable(main_, "frame"), SQLite::Exception) << "no room";
    main_.exec("PRAGMA max_page_count = 100000");
    main_.exec("PRAGMA query_only = ON");
    EXPECT_THROW(rescueTable(main_, "frame"), SQLite::Exception) << "nothing may be written";
    main_.exec("PRAGMA query_only = OFF");
    sqlite3_progress_handler(
        main_.getHandle(), 1000, [](void*) { return 1; }, nullptr);
    EXPECT_THROW(rescueTable(main_, "frame"), SQLite::Exception) << "somebody stopped it";
    sqlite3_progress_handler(main_.getHandle(), 0, nullptr, nullptr);
    EXPECT_TRUE(rescueTable(main_, "frame").whole);
    EXPECT_EQ(rescued(), allBut({}));
}

}  // namespace eyrie::table_rescue_test

#include "store/database/freed_space.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>

#include "store/project/project_file.h"
#include "support/temporary_folder.h"

namespace eyrie::freed_space_test {
namespace {

using namespace std::chrono_literals;

class FreedSpace : public testing::Test {
 protected:
    /// So many pages that nobody needs any more.
    void free(SQLite::Database& database, int pages) const {
        database.exec("CREATE TABLE filler (x)");
        SQLite::Transaction transaction(database);
        SQLite::Statement insert(database, "INSERT INTO filler VALUES (zeroblob(8000))");
        for (int i = 0; i < pages; ++i) {
            insert.exec();
            insert.reset();
        }
        transaction.commit();
        database.exec("DROP TABLE filler");
    }
    static int left(SQLite::Database& database) { return database.execAndGet("PRAGMA freelist_count").getInt(); }
    std::uintmax_t size(SQLite::Database& database) const {
        database.tryExec("PRAGMA wal_checkpoint(TRUNCATE)");
        return std::filesystem::file_size(path_);
    }

    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "clip.eyrie";
    ProjectFile project_ = ProjectFile::create(path_);
};

TEST_F(FreedSpace, GoesBackToTheDisk) {
    const std::uintmax_t before = size(project_.database());
    free(project_.database(), 500);
    EXPECT_GT(size(project_.database()), before + 500 * 8000);
    giveBackSpace(project_.database());
    EXPECT_EQ(left(project_.database()), 0);
    EXPECT_LT(size(project_.database()), before + 100 * 8000);
    giveBackSpace(project_.database());  // nothing is to do
}

// What waits for a project is to be kept waiting for a step, not for a gigabyte.
TEST_F(FreedSpace, GoesBackInStepsAndNoLongerThanThereIsTime) {
    free(project_.database(), 500);
    const int before = left(project_.database());
    giveBackSpace(project_.database(), 0ms);
    const int after = left(project_.database());
    EXPECT_LT(after, before) << "one step is done";
    EXPECT_GT(after, before / 2) << "and no more";
    giveBackSpace(project_.database());
    EXPECT_EQ(left(project_.database()), 0);
}

TEST_F(FreedSpace, StaysInAFileThatWasNotMadeToGiveItBack) {
    SQLite::Database old((folder_ / "old.eyrie").string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    free(old, 50);
    const int before = left(old);
    EXPECT_GT(before, 0);
    giveBackSpace(old);
    EXPECT_EQ(left(old), before);
}

TEST_F(FreedSpace, WaitsForTheNextTimeWhereAnotherWrites) {
    free(project_.database(), 50);
    const int before = left(project_.database());
    SQLite::Database other(path_.string(), SQLite::OPEN_READWRITE);
    project_.database().setBusyTimeout(1);
    {
        const SQLite::Transaction writes(other, SQLite::TransactionBehavior::IMMEDIATE);
        EXPECT_NO_THROW(giveBackSpace(project_.database()));
        EXPECT_EQ(left(project_.database()), before);
    }
    giveBackSpace(project_.database());
    EXPECT_EQ(left(project_.database()), 0);
}

TEST_F(FreedSpace, KeepsNobodyFromWriting) {
    free(project_.database(), 1000);
    std::atomic<bool> given = false;
    std::jthread giving([&] {
        giveBackSpace(project_.database());
        given = true;
    });
    SQLite::Database other(path_.string(), SQLite::OPEN_READWRITE);
    other.setBusyTimeout(5000);
    do {
        EXPECT_NO_THROW(other.exec("INSERT INTO preset (name, saved_utc) VALUES (hex(randomblob(8)), '')"));
    } while (!given);
}

}  // namespace
}  // namespace eyrie::freed_space_test

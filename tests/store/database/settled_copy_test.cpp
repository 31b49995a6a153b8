#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "store/backup/database_copy.h"
#include "store/full_project.h"
#include "store/samples.h"
#include "support/temporary_folder.h"

namespace eyrie::settled_copy_test {

TEST(SettledCopy, IsOneFileInWhichNothingIsBeingWritten) {
    const test::TemporaryFolder folder;
    test::writeSampleProject(folder / "p.eyrie", 2);
    SQLite::Database(folder / "p.eyrie", SQLite::OPEN_READWRITE).exec("UPDATE run SET state = 'running'");
    for (const bool tolerant : {false, true}) {
        settleCopy(folder / "p.eyrie", tolerant);
        SQLite::Database settled(folder / "p.eyrie", SQLite::OPEN_READONLY);
        EXPECT_EQ(settled.execAndGet("PRAGMA journal_mode").getString(), "delete") << "no log beside it";
        EXPECT_EQ(settled.execAndGet("SELECT state FROM run").getString(), "stopped");
    }
}

TEST(SettledCopy, WhatIsDamagedStaysAsItIsWhereThatMayBe) {
    const test::TemporaryFolder folder;
    const std::string damaged(8192, 'x');
    test::writeBytes(folder / "p.eyrie", damaged);
    EXPECT_NO_THROW(settleCopy(folder / "p.eyrie", true));
    EXPECT_THROW(settleCopy(folder / "p.eyrie", false), SQLite::Exception);
    EXPECT_EQ(test::bytesOf(folder / "p.eyrie"), damaged);
}

TEST(CopiedDatabase, IsWholeHoweverManyStepsItTakes) {
    const test::TemporaryFolder folder;
    SQLite::Database source(folder / "a.db", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    source.exec("PRAGMA page_size = 4096");
    source.exec(
        "CREATE TABLE t (x); WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n LIMIT 900) INSERT INTO t "
        "SELECT printf('%d %.3500c', i, 'x') FROM n");
    const int pages = source.execAndGet("PRAGMA page_count").getInt();
    ASSERT_GT(pages, 3 * 256) << "256 pages go at a time";
    SQLite::Database target(folder / "b.db", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    std::vector<double> shares;
    CopyWatch watch;
    watch.progress = [&](double share) { shares.push_back(share); };
    EXPECT_TRUE(copyDatabase(source, target, watch));
    EXPECT_EQ(target.execAndGet("SELECT count(*) FROM t").getInt(), 900);
    EXPECT_EQ(target.execAndGet("PRAGMA integrity_check").getString(), "ok");
    ASSERT_EQ(shares.size(), static_cast<std::size_t>((pages + 255) / 256));
    for (std::size_t i = 0; i < shares.size(); ++i)
        EXPECT_NEAR(shares[i], std::min(1.0, 256.0 * static_cast<double>(i + 1) / pages), 1e-9);
    // Stopped between two steps nothing of it is there.
    std::stop_source stop;
    SQLite::Database stopped(folder / "c.db", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    watch.progress = [&](double) { stop.request_stop(); };
    watch.stop = stop.get_token();
    EXPECT_FALSE(copyDatabase(source, stopped, watch));
    EXPECT_FALSE(stopped.tableExists("t"));
}

}  // namespace eyrie::settled_copy_test

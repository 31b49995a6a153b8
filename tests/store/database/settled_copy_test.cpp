#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

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

}  // namespace eyrie::settled_copy_test

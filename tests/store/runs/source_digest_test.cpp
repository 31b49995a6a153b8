#include "store/runs/source_digest.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include "store/older_schema.h"
#include "store/project/schema.h"
#include "store/samples.h"
#include "support/temporary_folder.h"

namespace eyrie::source_digest_test {

TEST(SourceDigest, IsKeptOfEachRunAndUnknownOfThoseOfBefore) {
    const test::TemporaryFolder folder;
    const int run = test::writeSampleProject(folder / "p.eyrie", 1);
    const std::string digest(64, 'a');
    {
        ProjectFile project = ProjectFile::open(folder / "p.eyrie");
        EXPECT_EQ(sourceDigestOf(project, run), "");
        storeSourceDigest(project, run, digest);
        EXPECT_EQ(sourceDigestOf(project, run), digest);
        EXPECT_EQ(sourceDigestOf(project, run + 1), "");
    }
    SQLite::Database(folder / "p.eyrie", SQLite::OPEN_READWRITE)
        .exec(test::kBackToSchema27 + "ALTER TABLE run DROP COLUMN source_digest; PRAGMA user_version = 26");
    ProjectFile project = ProjectFile::open(folder / "p.eyrie");
    EXPECT_EQ(schema::numberOf(project.database()), schema::currentNumber());
    EXPECT_EQ(sourceDigestOf(project, run), "");
}

TEST(SourceDigest, OneThatIsNoneIsUnknown) {
    const test::TemporaryFolder folder;
    const int run = test::writeSampleProject(folder / "p.eyrie", 1);
    SQLite::Database(folder / "p.eyrie", SQLite::OPEN_READWRITE)
        .exec("UPDATE run SET source_digest = hex(zeroblob(3000000))");
    ProjectFile project = ProjectFile::open(folder / "p.eyrie");
    EXPECT_EQ(sourceDigestOf(project, run), "");
}

}  // namespace eyrie::source_digest_test

#include "store/labels/rejected_proposals.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include "store/older_schema.h"
#include "store/project/schema.h"
#include "store/runs/run_store.h"
#include "store/samples.h"
#include "support/temporary_folder.h"

namespace eyrie::rejected_proposals_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class RejectedProposals : public testing::Test {
 protected:
    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "clip.eyrie";
};

TEST_F(RejectedProposals, AreThereWhenTheProjectIsOpenedAgain) {
    const int run = test::writeSampleProject(path_, 2);
    {
        ProjectFile project = ProjectFile::open(path_);
        rejectProposals(project, run, {3, 1}, "Ada");
        rejectProposals(project, run, {3, 2}, "Bo");
    }
    ProjectFile project = ProjectFile::open(path_);
    EXPECT_THAT(rejectedProposals(project, run), ElementsAre(1, 2, 3));
    EXPECT_EQ(project.database().execAndGet("SELECT person FROM rejected_proposal WHERE track_id = 3").getString(),
              "Ada")
        << "who rejected it first did";
    forgetRejectedProposals(project, run);
    EXPECT_THAT(rejectedProposals(project, run), IsEmpty());
}

TEST_F(RejectedProposals, GoWithTheirRunAlone) {
    const int run = test::writeSampleProject(path_, 2);
    ProjectFile project = ProjectFile::open(path_);
    rejectProposals(project, run, {1}, "Ada");
    EXPECT_THAT(rejectedProposals(project, run + 1), IsEmpty());
    RunStore store(project);
    store.remove(run);
    EXPECT_THAT(rejectedProposals(project, run), ElementsAre(1)) << "it may be brought back";
    store.purgeRemoved();
    EXPECT_THAT(rejectedProposals(project, run), IsEmpty());
}

TEST_F(RejectedProposals, ThereAreNoneInAProjectOfBefore) {
    const int run = test::writeSampleProject(path_, 2);
    {
        SQLite::Database database(path_.string(), SQLite::OPEN_READWRITE);
        database.exec(
            test::kBackToSchema27 +
            "DROP TABLE rejected_proposal; ALTER TABLE run DROP COLUMN started_fraction_us; ALTER TABLE run DROP "
            "COLUMN source_digest; PRAGMA user_version = 24");
    }
    ProjectFile project = ProjectFile::open(path_);
    EXPECT_EQ(schema::numberOf(project.database()), schema::currentNumber());
    EXPECT_THAT(rejectedProposals(project, run), IsEmpty());
    rejectProposals(project, run, {2}, "Ada");
    EXPECT_THAT(rejectedProposals(project, run), ElementsAre(2));
}

}  // namespace
}  // namespace eyrie::rejected_proposals_test

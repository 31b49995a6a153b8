#include "store/health/project_check.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include "core/error.h"
#include "store/full_project.h"
#include "store/labels/annotation_store.h"
#include "store/labels/label_samples.h"
#include "store/project/project_file.h"
#include "store/project/schema.h"
#include "store/runs/result_writer.h"
#include "store/samples.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace eyrie::project_check_test {
namespace {

using testing::HasSubstr;

class CheckTest : public testing::Test {
 protected:
    /// What was found in one respect.
    HealthItem itemOf(const std::string& subject) const {
        for (const HealthItem& item : checkProject(path_).items) {
            if (item.subject == subject) return item;
        }
        return {"none", Health::damaged, "there is no such item"};
    }
    void change(const std::string& command) const {
        SQLite::Database database(path_.string(), SQLite::OPEN_READWRITE);
        database.exec(command);
    }
    void expectDamage(const std::string& subject, const std::string& words) const {
        const HealthItem item = itemOf(subject);
        EXPECT_EQ(item.health, Health::damaged) << subject;
        EXPECT_THAT(item.words, HasSubstr(words));
        EXPECT_FALSE(checkProject(path_).healthy());
    }

    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "clip.eyrie";
};

TEST_F(CheckTest, AHealthyProjectIsGoodInEveryRespectAndUntouched) {
    test::writeFullProject(path_);
    const std::string before = test::bytesOf(path_);
    const HealthReport report = checkProject(path_);
    EXPECT_TRUE(report.healthy());
    EXPECT_EQ(report.items.size(), 10U);
    for (const HealthItem& item : report.items) EXPECT_EQ(item.health, Health::good) << item.subject << item.words;
    EXPECT_EQ(test::bytesOf(path_), before);
    int entries = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
        EXPECT_EQ(entry.path(), path_);
        ++entries;
    }
    EXPECT_EQ(entries, 1);
}

TEST_F(CheckTest, AWorkingRunAndAKilledOneAreNoDamage) {
    ProjectFile::create(path_);
    {
        ResultWriter writer(path_, test::sampleRun(), {});
        writer.write(test::sampleFrame(0));
        const HealthItem runs = itemOf("runs");
        EXPECT_EQ(runs.health, Health::remark);
        EXPECT_THAT(runs.words, HasSubstr("run 1 is being written by process"));
        EXPECT_TRUE(checkProject(path_).healthy());
    }
    EXPECT_THAT(itemOf("runs").words, HasSubstr("run 1 was killed"));
    EXPECT_TRUE(checkProject(path_).healthy());
}

TEST_F(CheckTest, ALogThatAKilledProgramLeftStays) {
    test::writeFullProject(path_);
    {
        // What lies there while a program works is what a killed one leaves.
        ProjectFile project = ProjectFile::open(path_);
        project.database().exec("UPDATE run SET name = 'later' WHERE id = 1");
        std::filesystem::copy_file(path_, folder_ / "killed.eyrie");
        std::filesystem::copy_file(path_.string() + "-wal", folder_ / "killed.eyrie-wal");
    }
    path_ = folder_ / "killed.eyrie";
    const std::string file = test::bytesOf(path_);
    const std::string log = test::bytesOf(path_.string() + "-wal");
    EXPECT_EQ(itemOf("beside it").health, Health::remark);
    EXPECT_THAT(itemOf("beside it").words, HasSubstr("-wal"));
    EXPECT_TRUE(checkProject(path_).healthy());
    EXPECT_EQ(test::bytesOf(path_), file);
    EXPECT_EQ(test::bytesOf(path_.string() + "-wal"), log);
}

TEST_F(CheckTest, FindsWhatDoesNotBelongInAProject) {
    test::writeFullProject(path_);
    change("CREATE TRIGGER spy AFTER INSERT ON run BEGIN DELETE FROM track; END");
    expectDamage("tables", "foreign trigger spy");
    change("DROP TRIGGER spy; CREATE TABLE notes (a)");
    expectDamage("tables", "foreign table notes");
    change("DROP TABLE notes; DROP INDEX run_of_sequence");
    expectDamage("tables", "index run_of_sequence is missing");
    change(
        "CREATE INDEX run_of_sequence ON run (sequence_id); ALTER TABLE roi RENAME TO hidden; CREATE VIEW roi AS "
        "SELECT * FROM hidden");
    expectDamage("tables", "table roi is not as Eyrie makes it");
}

TEST_F(CheckTest, FindsImpossibleValues) {
    for (const char* command :
         {"UPDATE run SET gsd_m_per_px = 0",
          "UPDATE sequence SET frame_count = 2147483647",
          "UPDATE run SET state = 'asleep'",
          "UPDATE run SET scale_origin = 'perhaps'",
          "UPDATE run SET scale_origin = 'estimated'",
          "UPDATE run SET scale_uncertainty = 0.5",
          "UPDATE run SET scale_vehicles = -1",
          "UPDATE run SET scale_growth_down = -1.5",
          "UPDATE run SET rate_assumed = 7",
          "UPDATE run SET started_fraction_us = 1000000",
          "UPDATE run SET started_fraction_us = 'soon'",
          "UPDATE sequence SET rate_assumed = -1",
          "UPDATE sequence SET start_utc = '2026-02-30T08:00:00Z'",
          "UPDATE frame SET width = -1 WHERE frame = 3",
          "UPDATE motion_vectors SET data = x'0102' WHERE frame = 3",
          "UPDATE stationary_corners SET data = x'ff02' WHERE frame = 3",
          "UPDATE labelled_object SET keyframes = x'0901' WHERE id = 2",
          "UPDATE detection SET rejection = 'so so' WHERE frame = 1",
          "UPDATE detection SET probability = 1.5 WHERE frame = 1",
          "INSERT INTO track_evidence VALUES (1, 3, 0.5, 0.5, 1, 1, 1, 0, 7, NULL)",
          "INSERT INTO track_evidence VALUES (1, 3, 0.5, 0.5, 1, 1, 1, 0, 0.7, 13)",
          "INSERT INTO doubtful_state SELECT run_id, frame, track_id, x, y, length, width, heading_rad, vx, vy, "
          "'sure', "
          "origin, age, hits, score FROM track_state LIMIT 1",
          "UPDATE sweep_point SET figures = 'f = 1'"}) {
        std::filesystem::remove(path_);
        test::writeFullProject(path_);
        change(command);
        EXPECT_EQ(itemOf("values").health, Health::damaged) << command;
    }
    std::filesystem::remove(path_);
    test::writeFullProject(path_);
    change("UPDATE run SET scale_origin = 'perhaps' WHERE id = 1");
    expectDamage("values", "where the scale of a run comes from, or how sure it is, is impossible (1 in run)");
}

TEST_F(CheckTest, FindsRowsThatBelongToNothing) {
    test::writeFullProject(path_);
    change("DELETE FROM run WHERE id = 2");
    expectDamage("references", "detection");
}

TEST_F(CheckTest, FindsStepsOfWorkThatDoNotFit) {
    test::writeFullProject(path_);
    change("DELETE FROM labelled_object WHERE id = 5");
    expectDamage("labels", "can no longer be undone");
}

TEST_F(CheckTest, FindsDamagedPages) {
    test::writeFullProject(path_);
    std::string bytes = test::bytesOf(path_);
    bytes.replace(bytes.size() / 2, 3 * 8192, 3 * 8192, '\x5a');
    test::writeBytes(path_, bytes);
    EXPECT_FALSE(checkProject(path_).healthy());
    EXPECT_EQ(itemOf("structure").health, Health::damaged);
}

TEST_F(CheckTest, FindsATruncatedFileAndADamagedHeader) {
    test::writeFullProject(path_);
    const std::string whole = test::bytesOf(path_);
    test::writeBytes(path_, whole.substr(0, whole.size() / 3));
    expectDamage("file", "cut off");
    for (std::size_t at = 0; at < 16; at += 5) {
        std::string bytes = whole;
        bytes[at] = '\x7f';
        test::writeBytes(path_, bytes);
        expectDamage("file", "beginning is damaged");
    }
}

TEST_F(CheckTest, ALogOfAnotherFileIsNamed) {
    test::writeFullProject(path_);
    const auto other = folder_ / "other.eyrie";
    test::writeSampleProject(other, 3);
    {
        ProjectFile project = ProjectFile::open(other);
        AnnotationStore labels(project, 1);
        labels.apply(test::sampleEdit(labels.newObjectId()));
        std::filesystem::copy_file(other.string() + "-wal", path_.string() + "-wal");
    }
    expectDamage("structure", "of another file");
}

TEST_F(CheckTest, AnOlderProjectIsHealthyAndStaysAsItIs) {
    SQLite::Database(path_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
        .exec(test::bytesOf(test::sourceFolder() / "tests/data/schema_1.sql"));
    EXPECT_TRUE(checkProject(path_).healthy());
    SQLite::Database database(path_.string(), SQLite::OPEN_READONLY);
    EXPECT_EQ(schema::numberOf(database), 1);
}

TEST_F(CheckTest, AProjectThatDoesNotKnowOriginsOfScalesIsHealthy) {
    test::writeRunsOfSchemaEleven(path_);
    EXPECT_EQ(itemOf("values").health, Health::good) << itemOf("values").words;
    EXPECT_EQ(itemOf("tables").health, Health::good) << itemOf("tables").words;
}

TEST_F(CheckTest, WhatIsNoProjectIsRefused) {
    EXPECT_THROW(checkProject(path_), Error);
    EXPECT_THROW(checkProject(folder_.path()), Error);
    SQLite::Database(path_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE).exec("CREATE TABLE a (b)");
    EXPECT_THROW(checkProject(path_), Error);
}

TEST_F(CheckTest, CanBeStopped) {
    test::writeFullProject(path_);
    std::stop_source stop;
    stop.request_stop();
    EXPECT_TRUE(checkProject(path_, {{}, stop.get_token()}).stopped);
}

}  // namespace
}  // namespace eyrie::project_check_test

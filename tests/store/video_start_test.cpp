#include "store/project/video_start.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include <limits>

#include "core/error.h"
#include "store/health/project_check.h"
#include "store/health/project_repair.h"
#include "store/labels/annotation_store.h"
#include "store/older_schema.h"
#include "store/project/schema.h"
#include "store/samples.h"
#include "support/temporary_folder.h"

namespace eyrie::video_start_test {
namespace {

constexpr std::int64_t kBegin_us = 1'231'798'102'034'567;

class VideoStart : public testing::Test {
 protected:
    VideoStart() { test::writeSampleProject(path_, 2); }
    void change(const std::string& commands) const {
        SQLite::Database database(path_.string(), SQLite::OPEN_READWRITE);
        database.exec(commands);
    }
    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "p.eyrie";
};

TEST_F(VideoStart, IsKeptToTheMicrosecondUntilItIsForgotten) {
    {
        ProjectFile project = ProjectFile::open(path_);
        EXPECT_EQ(videoStartOf(project, 1), std::nullopt);
        storeVideoStart(project, 1, kBegin_us);
        // The video is stored again whenever it is run or its frame rate changes.
        SequenceRecord sequence = sequencesOf(project).at(0);
        sequence.frame_rate_hz = 50;
        EXPECT_EQ(ensureSequence(project, sequence), 1);
    }
    ProjectFile project = ProjectFile::open(path_);
    EXPECT_EQ(videoStartOf(project, 1), kBegin_us);
    EXPECT_EQ(videoStartOf(project, 7), std::nullopt) << "a video that it does not hold";
    EXPECT_TRUE(checkProject(path_).healthy());
    storeVideoStart(project, 1, std::nullopt);
    EXPECT_EQ(videoStartOf(project, 1), std::nullopt);
}

TEST_F(VideoStart, WhatIsSaidNowCountsBeforeWhatIsKept) {
    ProjectFile project = ProjectFile::open(path_);
    storeVideoStart(project, 1, kBegin_us);
    EXPECT_EQ(videoStartOf(project, 1, 5), 5);
}

TEST_F(VideoStart, IsNotKnownOfAProjectOfBefore) {
    change(test::kBackToSchema27 +
           "ALTER TABLE sequence DROP COLUMN start_utc; DROP INDEX doubtful_state_of_track; DROP VIEW v_detections; "
           "DROP VIEW v_track_evidence; ALTER TABLE detection DROP COLUMN decision; "
           "ALTER TABLE track_evidence DROP COLUMN decision; DROP TABLE rejected_proposal; "
           "ALTER TABLE run DROP COLUMN started_fraction_us; ALTER TABLE run DROP COLUMN source_digest; PRAGMA "
           "user_version = 20");
    ProjectFile project = ProjectFile::open(path_);
    EXPECT_EQ(schema::numberOf(project.database()), schema::currentNumber());
    EXPECT_EQ(videoStartOf(project, 1), std::nullopt);
    storeVideoStart(project, 1, kBegin_us);
    EXPECT_EQ(videoStartOf(project, 1), kBegin_us);
}

TEST_F(VideoStart, WhatIsInNoCalendarIsRefused) {
    ProjectFile project = ProjectFile::open(path_);
    EXPECT_THROW(storeVideoStart(project, 1, std::numeric_limits<std::int64_t>::max()), Error);
    EXPECT_EQ(videoStartOf(project, 1), std::nullopt);
}

TEST_F(VideoStart, OneThatNoWriterWroteCostsTheStartAloneAndNotTheVideo) {
    change("UPDATE sequence SET start_utc = 'yesterday'");
    {
        ProjectFile project = ProjectFile::open(path_);
        EXPECT_THROW(videoStartOf(project, 1), Error);
    }
    EXPECT_FALSE(checkProject(path_).healthy());
    const RepairReport report = repairProject(path_, folder_ / "saved.eyrie");
    EXPECT_THAT(report.lost, testing::Contains("when video 1 began"));
    ProjectFile saved = ProjectFile::open(folder_ / "saved.eyrie");
    EXPECT_EQ(sequencesOf(saved).size(), 1U);
    EXPECT_EQ(videoStartOf(saved, 1), std::nullopt);
}

}  // namespace
}  // namespace eyrie::video_start_test

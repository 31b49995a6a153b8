#include "store/project/project_file.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include <fstream>
#include <functional>

#include "core/error.h"
#include "store/labels/annotation_store.h"
#include "store/labels/label_samples.h"
#include "store/older_schema.h"
#include "store/project/schema.h"
#include "store/runs/result_writer.h"
#include "store/samples.h"
#include "support/places.h"
#include "support/replaced_tracks.h"
#include "support/temporary_folder.h"

namespace eyrie::project_file_test {
namespace {

/// A sample as projects told it before they kept what the classifier says of a box.
FrameResult frameOfBeforeDecisions(int frame) {
    FrameResult sample = test::sampleFrame(frame);
    for (Detection& detection : sample.detections) detection.decision = Detection().decision;
    return sample;
}

using testing::HasSubstr;

class ProjectFileTest : public testing::Test {
 protected:
    void write(const std::string& bytes) { std::ofstream(path_, std::ios::binary) << bytes; }

    /// Makes a database that is not (quite) a project.
    void makeDatabase(const std::vector<std::string>& commands) {
        SQLite::Database database(path_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        for (const std::string& command : commands) database.exec(command);
    }

    static void expectError(ErrorKind kind, const std::string& words, const std::function<void()>& action) {
        try {
            action();
            FAIL() << "expected an error with: " << words;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), kind) << error.what();
            EXPECT_THAT(error.what(), HasSubstr(words));
        }
    }

    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "clip.eyrie";
};

TEST_F(ProjectFileTest, ANewProjectIsOneFileOfOurKind) {
    {
        ProjectFile project = ProjectFile::create(path_);
        EXPECT_EQ(project.database().execAndGet("PRAGMA application_id").getInt(), schema::kApplicationId);
        EXPECT_EQ(schema::numberOf(project.database()), schema::currentNumber());
        EXPECT_EQ(project.database().execAndGet("PRAGMA journal_mode").getString(), "wal");
        EXPECT_EQ(project.database().execAndGet("PRAGMA foreign_keys").getInt(), 1);
        EXPECT_EQ(project.database().execAndGet("PRAGMA synchronous").getInt(), 1);
    }
    int entries = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
        EXPECT_EQ(entry.path(), path_) << "nothing else may stay behind";
        ++entries;
    }
    EXPECT_EQ(entries, 1);
}

TEST_F(ProjectFileTest, ANewProjectSaysThatItKeepsALog) {
    ProjectFile::create(path_);
    std::ifstream file(path_, std::ios::binary);
    std::string header(100, '\0');
    ASSERT_TRUE(file.read(header.data(), 100));
    // "Database File Format", §1.3.3: 2 and 2 for those who write and those who read.
    EXPECT_EQ(header.substr(18, 2), std::string({2, 2}));
}

TEST_F(ProjectFileTest, AnExistingFileIsNeverOverwritten) {
    write("my notes");
    expectError(ErrorKind::output, path_.string(), [&] { ProjectFile::create(path_); });
    EXPECT_EQ(std::filesystem::file_size(path_), 8U);
}

TEST_F(ProjectFileTest, OpenOrCreateDoesBoth) {
    ProjectFile::openOrCreate(path_);
    const int run = test::writeSampleProject(path_, 1);
    ProjectFile again = ProjectFile::openOrCreate(path_);
    EXPECT_TRUE(RunStore(again).run(run).has_value());
}

TEST_F(ProjectFileTest, AMissingFileIsNamed) {
    expectError(ErrorKind::project, path_.string(), [&] { ProjectFile::open(path_); });
    expectError(ErrorKind::project, "is not a file", [&] { ProjectFile::open(folder_.path()); });
}

TEST_F(ProjectFileTest, AFolderThatCannotBeWrittenIsNamed) {
    expectError(ErrorKind::output, "does not exist", [&] { ProjectFile::create(folder_ / "nowhere" / "a.eyrie"); });
    // No one can make files here, not even the administrator.
    if (std::filesystem::is_directory("/proc")) {
        expectError(ErrorKind::output, "/proc/a.eyrie", [] { ProjectFile::create("/proc/a.eyrie"); });
    }
    expectError(ErrorKind::output, "does not exist", [&] {
        write("a file, not a folder");
        ProjectFile::create(path_ / "a.eyrie");
    });
}

TEST_F(ProjectFileTest, WhatIsNoDatabaseIsRefused) {
    for (const std::string& bytes : {std::string("hello"), std::string(5000, 'x'), std::string(5000, '\0')}) {
        write(bytes);
        expectError(ErrorKind::project, "is not an Eyrie project", [&] { ProjectFile::open(path_); });
    }
    write("");
    expectError(ErrorKind::project, "is empty", [&] { ProjectFile::open(path_); });
}

TEST_F(ProjectFileTest, TheDatabaseOfAnotherProgramIsRefusedAndLeftAlone) {
    makeDatabase({"CREATE TABLE contacts (name TEXT)"});
    const auto time = std::filesystem::last_write_time(path_);
    expectError(ErrorKind::project, "another program", [&] { ProjectFile::open(path_); });
    expectError(ErrorKind::project, "another program", [&] { ProjectFile::openOrCreate(path_); });
    EXPECT_EQ(std::filesystem::last_write_time(path_), time);
}

TEST_F(ProjectFileTest, ANewerProjectIsRefusedAndLeftAlone) {
    test::writeSampleProject(path_, 1);
    makeDatabase({"PRAGMA user_version = 99"});
    for (const auto mode : {ProjectFile::Mode::read_write, ProjectFile::Mode::read_only}) {
        expectError(ErrorKind::project, "newer version", [&] { ProjectFile::open(path_, mode); });
    }
    makeDatabase({"PRAGMA user_version = " + std::to_string(schema::currentNumber())});
    EXPECT_NO_THROW(test::readEverything(path_));
}

TEST_F(ProjectFileTest, AnOlderProjectIsBroughtUpToDateEvenForReading) {
    test::writeSampleProject(path_, 2);
    makeDatabase({test::kBackToSchema27,
                  "DROP VIEW v_corrections",
                  "DROP TABLE correction",
                  "DROP VIEW v_track_evidence",
                  "DROP TABLE track_evidence",
                  "DROP TABLE doubtful_state",
                  "DROP VIEW v_zones",
                  "DROP TABLE zone",
                  "DROP VIEW v_verdicts",
                  "DROP VIEW v_bookmarks",
                  "DROP VIEW v_seen",
                  "DROP TABLE verdict",
                  "DROP TABLE bookmark",
                  "DROP TABLE review_step",
                  "DROP TABLE seen",
                  "DROP VIEW v_detections",
                  "DROP VIEW v_track_states",
                  "DROP VIEW v_runs",
                  "ALTER TABLE run DROP COLUMN rate_assumed",
                  "ALTER TABLE run DROP COLUMN started_fraction_us",
                  "ALTER TABLE run DROP COLUMN source_digest",
                  "ALTER TABLE sequence DROP COLUMN rate_assumed",
                  "ALTER TABLE sequence DROP COLUMN start_utc",
                  "ALTER TABLE run DROP COLUMN scale_growth_right",
                  "ALTER TABLE run DROP COLUMN scale_growth_down",
                  "ALTER TABLE detection DROP COLUMN probability",
                  "ALTER TABLE detection DROP COLUMN decision",
                  "ALTER TABLE run DROP COLUMN scale_origin",
                  "ALTER TABLE run DROP COLUMN scale_uncertainty",
                  "ALTER TABLE run DROP COLUMN scale_vehicles",
                  "ALTER TABLE frame DROP COLUMN picture",
                  "ALTER TABLE frame DROP COLUMN reason_count",
                  "ALTER TABLE frame DROP COLUMN reason_of",
                  "ALTER TABLE run DROP COLUMN removed_utc",
                  "DROP TABLE run_state",
                  "DROP TABLE unfinished_track_state",
                  "ALTER TABLE frame DROP COLUMN details",
                  "DROP TABLE unfinished_frame",
                  "DROP TABLE control_point",
                  "DROP TABLE dropped_state",
                  "DROP TABLE rejected_proposal",
                  "ALTER TABLE track DROP COLUMN score",
                  "ALTER TABLE track DROP COLUMN x_sum",
                  "ALTER TABLE track DROP COLUMN y_sum",
                  "CREATE INDEX track_state_of_track ON track_state (run_id, track_id, frame)",
                  "PRAGMA user_version = 5"});
    ProjectFile project = ProjectFile::open(path_, ProjectFile::Mode::read_only);
    test::expectSame(*RunStore(project).frameResult(1, 1), frameOfBeforeDecisions(1));
    EXPECT_EQ(schema::numberOf(project.database()), schema::currentNumber());
    expectError(ErrorKind::output, "cannot be written", [&] { RunStore(project).rename(1, "other"); });
}

TEST_F(ProjectFileTest, AProjectWithoutItsTablesIsDamaged) {
    makeDatabase({"CREATE TABLE x (y)", "PRAGMA application_id = " + std::to_string(schema::kApplicationId),
                  "PRAGMA user_version = " + std::to_string(schema::currentNumber())});
    expectError(ErrorKind::project, "damaged", [&] { ProjectFile::open(path_); });
    std::filesystem::remove(path_);
    test::writeSampleProject(path_, 1);
    makeDatabase({"DROP TABLE motion_cluster"});
    expectError(ErrorKind::project, "motion_cluster", [&] { ProjectFile::open(path_); });
}

TEST_F(ProjectFileTest, ReadOnlyReadsAndRefusesToWrite) {
    test::writeSampleProject(path_, 2);
    ProjectFile project = ProjectFile::open(path_, ProjectFile::Mode::read_only);
    RunStore store(project);
    test::expectSame(*store.frameResult(1, 1), test::sampleFrame(1));
    expectError(ErrorKind::output, "cannot be written", [&] { store.rename(1, "other"); });
}

TEST_F(ProjectFileTest, ARowThatNoWriterWroteIsAnErrorThatSaysWhere) {
    test::writeSampleProject(path_, 1);
    for (const char* command :
         {"UPDATE frame SET registration_state = 'perhaps'", "UPDATE motion_vectors SET data = x'0102'",
          "UPDATE motion_cluster SET members = x'ffffff7f'", "DELETE FROM stationary_corners"}) {
        std::filesystem::remove(path_);
        test::writeSampleProject(path_, 1);
        makeDatabase({command});
        ProjectFile project = ProjectFile::open(path_);
        expectError(ErrorKind::project, "frame 0 of run 1", [&] { RunStore(project).frameResult(1, 0); });
    }
}

TEST_F(ProjectFileTest, ALockedProjectIsAnErrorAndNotAHang) {
    test::writeSampleProject(path_, 1);
    SQLite::Database other(path_.string(), SQLite::OPEN_READWRITE);
    const SQLite::Transaction lock(other, SQLite::TransactionBehavior::EXCLUSIVE);
    ProjectFile project = ProjectFile::open(path_);
    project.database().setBusyTimeout(10);
    expectError(ErrorKind::project, "in use by another program", [&] { RunStore(project).rename(1, "other"); });
    EXPECT_TRUE(RunStore(project).frameResult(1, 0).has_value()) << "reading goes on";
}

// --- migrations -------------------------------------------------------------------------------------------------

TEST_F(ProjectFileTest, StepsRunOnceInOrderAndTakeTheirNumbers) {
    const schema::Migration steps[] = {[](SQLite::Database& database) { database.exec("CREATE TABLE a (x)"); },
                                       [](SQLite::Database& database) { database.exec("INSERT INTO a VALUES (2)"); },
                                       [](SQLite::Database& database) { database.exec("INSERT INTO a VALUES (3)"); }};
    SQLite::Database database(path_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    schema::migrate(database, std::span(steps).first(1));
    EXPECT_EQ(schema::numberOf(database), 1);
    schema::migrate(database, steps);
    schema::migrate(database, steps);
    EXPECT_EQ(schema::numberOf(database), 3);
    EXPECT_EQ(database.execAndGet("SELECT group_concat(x) FROM a").getString(), "2,3");
}

TEST_F(ProjectFileTest, AStepThatFailsLeavesTheFileBeforeIt) {
    const schema::Migration steps[] = {[](SQLite::Database& database) { database.exec("CREATE TABLE a (x)"); },
                                       [](SQLite::Database& database) {
                                           database.exec("INSERT INTO a VALUES (1)");
                                           database.exec("this is no SQL");
                                       }};
    SQLite::Database database(path_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    EXPECT_THROW(schema::migrate(database, steps), SQLite::Exception);
    EXPECT_EQ(schema::numberOf(database), 1);
    EXPECT_EQ(database.execAndGet("SELECT count(*) FROM a").getInt(), 0);
}

TEST_F(ProjectFileTest, AProjectOfSchemaOneOpensToday) {
    std::ifstream file(test::sourceFolder() / "tests/data/schema_1.sql");
    ASSERT_TRUE(file.good());
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    makeDatabase({text});
    ProjectFile project = ProjectFile::open(path_);
    EXPECT_EQ(schema::numberOf(project.database()), schema::currentNumber());
    const RunStore store(project);
    ASSERT_EQ(store.runs().size(), 1U);
    EXPECT_EQ(store.runs()[0].started_us, std::nullopt) << "nobody knows when in its second";
    EXPECT_EQ(store.runs()[0].sequence.path, "/videos/old.mp4");
    EXPECT_EQ(store.parameters(1).size(), 2U);
    const auto frame = store.frameResult(1, 7);
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->motion.registration.current_from_previous.matrix(0, 2), 1.5);
    ASSERT_EQ(frame->motion.motion_vectors.size(), 1U);
    EXPECT_EQ(frame->motion.motion_vectors[0].position, cv::Point2f(100.5F, 50.25F));
    ASSERT_EQ(frame->motion.stationary_corners.size(), 2U);
    EXPECT_EQ(frame->motion.stationary_corners[1], cv::Point2f(3, 4.0625F));
    ASSERT_EQ(frame->detections.size(), 1U);
    EXPECT_EQ(frame->detections[0].rejection, Rejection::outlier);
    ASSERT_EQ(frame->tracks.size(), 1U);
    EXPECT_EQ(frame->tracks[0].origin, StateOrigin::reconstructed);
    ASSERT_EQ(store.tracks(1).size(), 1U);
    EXPECT_DOUBLE_EQ(store.tracks(1)[0].mean_speed_px, 5);
    // It can be labelled now.
    AnnotationStore labels(project, store.runs()[0].sequence.id);
    EXPECT_TRUE(labels.annotations().objects.empty());
    labels.apply(test::sampleEdit(labels.newObjectId()));
    EXPECT_EQ(readAnnotations(project, store.runs()[0].sequence.id).objects.size(), 1U);
}

TEST_F(ProjectFileTest, SentencesOfOlderProjectsBecomeWordsWithFigures) {
    constexpr int kBefore = 8;
    const std::vector<std::pair<std::string, RegistrationFailure>> sentences = {
        {"too few corners (12 of 40)", {.fault = RegistrationFault::too_few_corners, .count = 12, .of = 40}},
        {"blank picture: too few corners (3 of 40)",
         {RegistrationFault::too_few_corners, PictureQuality::blank, 3, 40}},
        {"blurred picture: too few corners found again (7 of 900)",
         {RegistrationFault::too_few_found_again, PictureQuality::blurred, 7, 900}},
        {"too few corners agree (0 of 55)", {.fault = RegistrationFault::too_few_agree, .count = 0, .of = 55}},
        {"cut: the picture does not fit to the one before", {.fault = RegistrationFault::cut}},
        {"blank picture: the picture does not fit to the one before",
         {RegistrationFault::no_match, PictureQuality::blank}},
        {"the motion found is not one a camera makes", {.fault = RegistrationFault::impossible_motion}},
        {"what an even older version said", {.fault = RegistrationFault::no_match}}};
    {
        SQLite::Database database(path_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        schema::migrate(database, schema::migrations().first(kBefore));
        database.exec("PRAGMA application_id = " + std::to_string(schema::kApplicationId));
        database.exec(
            "INSERT INTO sequence (id, path, width, height, frame_count, frame_rate_hz) "
            "VALUES (1, '/videos/old.mp4', 64, 48, 20, 25)");
        database.exec(
            "INSERT INTO run (id, sequence_id, name, started_utc, engine_version, preset, gsd_m_per_px, gsd_known, "
            "frame_rate_hz, first_frame, last_frame, state, message) "
            "VALUES (1, 1, 'old', '', '', '', 0.2, 1, 25, 0, 19, 'finished', '')");
        int frame = 0;
        const auto insert = [&](const std::string& state, const std::string& reason) {
            SQLite::Statement row(database,
                                  "INSERT INTO frame (run_id, frame, time_us, width, height, registration_state, "
                                  "reason, from_frame, to_frame, inliers, corner_count, motion_vector_count, "
                                  "detection_count, track_count) VALUES (1, ?, 0, 64, 48, ?, ?, 0, 0, 0, 0, 0, 0, 0)");
            row.bind(1, frame++);
            row.bind(2, state);
            row.bind(3, reason);
            row.exec();
        };
        for (const auto& sentence : sentences) insert("failed", sentence.first);
        insert("frozen", "the picture repeats the one before");
        insert("registered", "");
    }
    ProjectFile project = ProjectFile::open(path_);
    const std::vector<Registration> read = RunStore(project).registrations(1);
    ASSERT_EQ(read.size(), sentences.size() + 2);
    for (std::size_t i = 0; i < sentences.size(); ++i)
        EXPECT_EQ(read[i].failure, sentences[i].second) << sentences[i].first;
    EXPECT_EQ(describe(read[2].failure), "blurred picture: too few corners tracked (7 of 900)");
    EXPECT_EQ(read[sentences.size()].failure, RegistrationFailure{});
    EXPECT_EQ(read[sentences.size() + 1].failure, RegistrationFailure{});
}

TEST_F(ProjectFileTest, RunsOfOlderProjectsTellWhereTheirScaleComesFromAsFarAsCanBe) {
    test::writeRunsOfSchemaEleven(path_);
    ProjectFile project = ProjectFile::open(path_);
    test::expectOriginsOfSchemaEleven(project);
    SQLite::Database other(path_.string(), SQLite::OPEN_READONLY);
    EXPECT_EQ(
        other.execAndGet("SELECT group_concat(scale_origin, ' ') FROM (SELECT * FROM v_runs ORDER BY run)").getString(),
        "given assumed estimated given");
}

TEST_F(ProjectFileTest, ViewsTellTracksByTheScaleAtTheirPlace) {
    const int run = test::writeSampleProject(path_, 8);
    ProjectFile project = ProjectFile::open(path_);
    project.database().exec("UPDATE run SET scale_growth_right = 0.0005, scale_growth_down = -0.001");
    const SceneScale scale = RunStore(project).runs().at(0).scale;
    ASSERT_FALSE(scale.slope.isFlat());
    SQLite::Database other(path_.string(), SQLite::OPEN_READONLY);
    int told = 0;
    for (const TrackSummary& track : RunStore(project).tracks(run)) {
        if (!track.confirmed) continue;
        SQLite::Statement row(other, "SELECT length_m, width_m, speed_kmh, scale_factor FROM v_tracks WHERE track = ?");
        row.bind(1, static_cast<std::int64_t>(track.id));
        ASSERT_TRUE(row.executeStep());
        const SceneScale here = scale.at(track.place);
        EXPECT_NEAR(row.getColumn(0).getDouble(), here.metres(track.mean_length_px), 1e-6);
        EXPECT_NEAR(row.getColumn(1).getDouble(), here.metres(track.mean_width_px), 1e-6);
        EXPECT_NEAR(row.getColumn(2).getDouble(), here.metresPerSecond(track.mean_speed_px) * 3.6, 1e-6);
        EXPECT_NEAR(row.getColumn(3).getDouble(), scale.slope.factorAt(track.place), 1e-9);
        ++told;
    }
    EXPECT_GT(told, 0);
}

TEST_F(ProjectFileTest, ViewsTellStatesInWholeWordsAndWithTheirScore) {
    const int run = test::writeSampleProject(path_, 8);
    ProjectFile project = ProjectFile::open(path_);
    RunStore store(project);
    std::vector<TrackFrame> states;
    for (int i = 0; i < 4; ++i) {
        TrackState state;
        state.id = 1;
        state.status = i == 0 ? TrackStatus::confirmed : TrackStatus::coasting;
        state.origin = static_cast<StateOrigin>(i);
        state.age = i;
        state.score = 0.625;
        states.push_back({i, state});
    }
    test::replaceTrackStates(store, run, states);
    SQLite::Database other(path_.string(), SQLite::OPEN_READONLY);
    SQLite::Statement row(other, "SELECT status, origin, score FROM v_track_states ORDER BY frame");
    for (const TrackFrame& written : states) {
        ASSERT_TRUE(row.executeStep());
        EXPECT_EQ(row.getColumn(0).getString(), nameOf(written.state.status));
        EXPECT_EQ(row.getColumn(1).getString(), nameOf(written.state.origin));
        EXPECT_EQ(row.getColumn(2).getDouble(), 0.625);
    }
}

TEST_F(ProjectFileTest, StatesOfBeforeSchemaTwentyAreReadAsTheyWere) {
    const int run = test::writeSampleProject(path_, 6);
    const std::string whole_words =
        "UPDATE track_state SET status = CASE status WHEN '' THEN 'confirmed' WHEN 'c' THEN 'coasting' ELSE status "
        "END, "
        "origin = CASE origin WHEN '' THEN 'detected' WHEN 'r' THEN 'reconstructed' WHEN 'p' THEN 'predicted' ELSE "
        "origin END";
    makeDatabase({test::kBackToSchema27, whole_words, "DROP VIEW v_track_states", "ALTER TABLE track DROP COLUMN score",
                  "ALTER TABLE track DROP COLUMN x_sum", "ALTER TABLE track DROP COLUMN y_sum",
                  "ALTER TABLE sequence DROP COLUMN start_utc", "DROP INDEX doubtful_state_of_track",
                  "DROP VIEW v_detections", "DROP VIEW v_track_evidence", "ALTER TABLE detection DROP COLUMN decision",
                  "ALTER TABLE track_evidence DROP COLUMN decision", "DROP TABLE rejected_proposal",
                  "ALTER TABLE run DROP COLUMN started_fraction_us", "ALTER TABLE run DROP COLUMN source_digest",
                  "CREATE INDEX track_state_of_track ON track_state (run_id, track_id, frame)",
                  "PRAGMA user_version = 19"});
    ProjectFile project = ProjectFile::open(path_);
    EXPECT_EQ(schema::numberOf(project.database()), schema::currentNumber());
    const RunStore store(project);
    for (int frame = 0; frame < 6; ++frame) {
        test::expectSame(*store.frameResult(run, frame), frameOfBeforeDecisions(frame));
    }
    EXPECT_EQ(store.trackStates(run, 2).size(), 6U);
    EXPECT_EQ(project.database()
                  .execAndGet("SELECT count(*) FROM track WHERE abs(x_sum - (SELECT sum(x) FROM track_state WHERE "
                              "track_state.run_id = track.run_id AND track_id = id)) > 1e-6")
                  .getInt(),
              0);
    EXPECT_EQ(project.database().execAndGet("SELECT count(x_sum) FROM track").getInt(), 5);
}

TEST_F(ProjectFileTest, ViewsTellTracksInUnitsOfPeople) {
    const int run = test::writeSampleProject(path_, 8);
    ProjectFile project = ProjectFile::open(path_);
    const RunStore store(project);
    const RunRecord record = store.runs().at(0);
    // As other tools read it; we ourselves run no views of files.
    SQLite::Database other(path_.string(), SQLite::OPEN_READONLY);
    for (const TrackSummary& track : store.tracks(run)) {
        if (!track.confirmed) continue;
        SQLite::Statement row(other, "SELECT speed_px_per_frame, speed_kmh, seconds FROM v_tracks WHERE track = ?");
        row.bind(1, static_cast<std::int64_t>(track.id));
        ASSERT_TRUE(row.executeStep());
        EXPECT_NEAR(row.getColumn(2).getDouble(), (track.last_frame - track.first_frame) / record.scale.frame_rate_hz,
                    1e-9);
        EXPECT_NEAR(row.getColumn(0).getDouble(), track.mean_speed_px, 1e-9);
        EXPECT_NEAR(row.getColumn(1).getDouble(),
                    track.mean_speed_px * record.scale.gsd_m_per_px * record.scale.frame_rate_hz * 3.6, 1e-6);
    }
    EXPECT_EQ(other.execAndGet("SELECT count(*) FROM v_track_states WHERE heading_deg NOT BETWEEN 0 AND 360").getInt(),
              0);
    EXPECT_EQ(other.execAndGet("SELECT count(*) FROM v_frames").getInt(), 8);
}

}  // namespace
}  // namespace eyrie::project_file_test

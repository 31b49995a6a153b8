// What other programs are told by the views of a project, beside what was written.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/angle.h"
#include "store/review/review_samples.h"
#include "store/review/review_store.h"
#include "store/review/seen_store.h"
#include "store/runs/run_store.h"
#include "store/samples.h"
#include "support/temporary_folder.h"

namespace eyrie::project_views_test {
namespace {

constexpr int kFrames = 8;

class ProjectViews : public testing::Test {
 protected:
    void SetUp() override {
        run_ = test::writeSampleProject(path_, kFrames);
        other_.emplace(path_.string(), SQLite::OPEN_READONLY);
    }
    /// All columns of the rows of a query, as another program reads them.
    SQLite::Statement rows(const std::string& of) { return {*other_, "SELECT * FROM " + of}; }

    static double number(SQLite::Statement& row, const char* column) { return row.getColumn(column).getDouble(); }
    static std::string text(SQLite::Statement& row, const char* column) { return row.getColumn(column).getString(); }

    static void expectBox(SQLite::Statement& row, const OrientedBox& box) {
        EXPECT_EQ(number(row, "x"), box.centre.x);
        EXPECT_EQ(number(row, "y"), box.centre.y);
        EXPECT_EQ(number(row, "length_px"), box.length);
        EXPECT_EQ(number(row, "width_px"), box.width);
        const double degrees = degreesFromRadians(box.heading);
        EXPECT_NEAR(number(row, "heading_deg"), degrees < 0 ? degrees + 360 : degrees, 1e-9);
    }

    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "p.eyrie";
    std::optional<SQLite::Database> other_;
    int run_ = 0;
};

}  // namespace

TEST_F(ProjectViews, TellDetectionsWithTheirBoxesAndWhatBecameOfThem) {
    SQLite::Statement row = rows("v_detections ORDER BY frame, number");
    const char* fates[] = {"none", "duplicate", "outlier", "size"};
    for (int frame = 0; frame < kFrames; ++frame) {
        const FrameResult written = test::sampleFrame(frame);
        for (std::size_t i = 0; i < written.detections.size(); ++i) {
            const Detection& detection = written.detections[i];
            ASSERT_TRUE(row.executeStep());
            EXPECT_EQ(number(row, "run"), run_);
            EXPECT_EQ(number(row, "frame"), frame);
            EXPECT_EQ(number(row, "number"), static_cast<double>(i));
            expectBox(row, detection.box);
            EXPECT_EQ(number(row, "score"), detection.score);
            EXPECT_EQ(text(row, "rejection"), fates[static_cast<int>(detection.rejection)]);
            EXPECT_EQ(row.getColumn("decision").isNull(), std::isnan(detection.decision));
            if (!std::isnan(detection.decision)) {
                EXPECT_EQ(number(row, "decision"), detection.decision);
            }
        }
    }
    EXPECT_FALSE(row.executeStep());
}

TEST_F(ProjectViews, TellWhereConfirmedTracksAreAndWhen) {
    SQLite::Statement row = rows("v_track_states ORDER BY frame, track");
    for (int frame = 0; frame < kFrames; ++frame) {
        const FrameResult written = test::sampleFrame(frame);
        for (const TrackState& state : written.tracks) {
            if (state.status == TrackStatus::tentative) continue;
            ASSERT_TRUE(row.executeStep());
            EXPECT_EQ(number(row, "run"), run_);
            EXPECT_EQ(number(row, "frame"), frame);
            EXPECT_EQ(number(row, "track"), static_cast<double>(state.id));
            EXPECT_DOUBLE_EQ(number(row, "seconds"), static_cast<double>(written.motion.time_us) / 1e6);
            expectBox(row, state.box);
            EXPECT_EQ(number(row, "vx_px_per_frame"), state.velocity.x);
            EXPECT_EQ(number(row, "vy_px_per_frame"), state.velocity.y);
            EXPECT_EQ(text(row, "status"), nameOf(state.status));
            EXPECT_EQ(text(row, "origin"), nameOf(state.origin));
            EXPECT_EQ(number(row, "score"), state.score);
        }
    }
    EXPECT_FALSE(row.executeStep());
}

TEST_F(ProjectViews, TellHowEachFrameWasRegisteredAndWhatIsInIt) {
    SQLite::Statement row = rows("v_frames ORDER BY frame");
    const char* states[] = {"first", "registered", "frozen", "failed"};
    for (int frame = 0; frame < kFrames; ++frame) {
        const FrameResult written = test::sampleFrame(frame);
        ASSERT_TRUE(row.executeStep());
        EXPECT_EQ(number(row, "run"), run_);
        EXPECT_EQ(number(row, "frame"), frame);
        EXPECT_DOUBLE_EQ(number(row, "seconds"), static_cast<double>(written.motion.time_us) / 1e6);
        EXPECT_EQ(text(row, "registration"), states[frame % 4]);
        EXPECT_EQ(text(row, "reason"), frame % 4 == 3 ? "too few found again" : "");
        EXPECT_EQ(text(row, "picture"), frame % 4 == 3 ? "blurred" : "clear");
        EXPECT_EQ(number(row, "corners"), written.motion.corner_count);
        EXPECT_EQ(number(row, "motion_vectors"), static_cast<double>(written.motion.motion_vectors.size()));
        EXPECT_EQ(number(row, "detections"), 2) << "of seven those that none of three reasons rejects";
        EXPECT_EQ(number(row, "tracks"), 3) << "of five those that are not tentative";
        EXPECT_EQ(number(row, "details"), 1);
    }
    EXPECT_FALSE(row.executeStep());
}

TEST_F(ProjectViews, TellRunsWithTheirScaleWhereItIsKnown) {
    const RunRecord written = test::sampleRun();
    {
        SQLite::Statement row = rows("v_runs");
        ASSERT_TRUE(row.executeStep());
        EXPECT_EQ(number(row, "run"), run_);
        EXPECT_EQ(text(row, "video"), "/videos/street.mp4");
        EXPECT_EQ(text(row, "name"), "first try");
        EXPECT_EQ(text(row, "state"), "finished");
        EXPECT_EQ(number(row, "first_frame"), 0);
        EXPECT_EQ(number(row, "last_frame"), 99);
        EXPECT_EQ(number(row, "frame_rate_hz"), 29.97);
        EXPECT_EQ(number(row, "gsd_m_per_px"), written.scale.gsd_m_per_px);
        EXPECT_EQ(text(row, "scale_origin"), "given");
        EXPECT_EQ(number(row, "rate_assumed"), 1);
        EXPECT_FALSE(row.executeStep());
    }
    ProjectFile project = ProjectFile::open(path_);
    project.database().exec("UPDATE run SET gsd_known = 0");
    {
        SQLite::Statement row = rows("v_runs");
        ASSERT_TRUE(row.executeStep());
        EXPECT_TRUE(row.getColumn("gsd_m_per_px").isNull());
        SQLite::Statement track = rows("v_tracks");
        ASSERT_TRUE(track.executeStep());
        for (const char* in_metres : {"length_m", "width_m", "speed_kmh"})
            EXPECT_TRUE(track.getColumn(in_metres).isNull());
        EXPECT_FALSE(track.getColumn("length_px").isNull());
    }
    RunStore(project).remove(run_);
    for (const char* view : {"v_runs", "v_tracks", "v_track_states", "v_frames", "v_detections", "v_track_evidence"}) {
        SQLite::Statement row = rows(view);
        EXPECT_FALSE(row.executeStep()) << view << " tells of a run that was removed";
    }
}

TEST_F(ProjectViews, TellOfTracksTheirMeansAndWhatSpeaksForThem) {
    ProjectFile project = ProjectFile::open(path_);
    RunStore store(project);
    TracksOfRun tracks;
    tracks.states = [](const TracksOfRun::StateVisitor& visitor) {
        for (int i = 0; i < 4; ++i) {
            TrackState state;
            state.id = 7;
            state.box = {{10.0 + 3 * i, 20.0 + 4 * i}, 12.0 + 2 * i, 6.0 + i, 0.5};
            state.velocity = {3, 4};
            state.status = TrackStatus::confirmed;
            visitor(2 + i, state);
        }
    };
    TrackEvidence evidence{0.9, 0.8, 1.5, 2.5, 3.5, 0.25, -0.5, 0.7};
    tracks.evidence[7] = evidence;
    store.replaceTracks(run_, tracks);
    SQLite::Statement track = rows("v_tracks");
    ASSERT_TRUE(track.executeStep());
    EXPECT_EQ(number(track, "run"), run_);
    EXPECT_EQ(number(track, "track"), 7);
    EXPECT_EQ(number(track, "first_frame"), 2);
    EXPECT_EQ(number(track, "last_frame"), 5);
    EXPECT_EQ(number(track, "frames"), 4);
    EXPECT_DOUBLE_EQ(number(track, "seconds"), 3 / 29.97);
    EXPECT_DOUBLE_EQ(number(track, "length_px"), 15);
    EXPECT_DOUBLE_EQ(number(track, "width_px"), 7.5);
    EXPECT_DOUBLE_EQ(number(track, "speed_px_per_frame"), 5);
    EXPECT_DOUBLE_EQ(number(track, "length_m"), 15 * 0.345);
    EXPECT_DOUBLE_EQ(number(track, "width_m"), 7.5 * 0.345);
    EXPECT_DOUBLE_EQ(number(track, "speed_kmh"), 5 * 0.345 * 29.97 * 3.6);
    EXPECT_EQ(number(track, "scale_factor"), 1);
    EXPECT_FALSE(track.executeStep());
    SQLite::Statement row = rows("v_track_evidence");
    ASSERT_TRUE(row.executeStep());
    EXPECT_EQ(number(row, "run"), run_);
    EXPECT_EQ(number(row, "track"), 7);
    const std::pair<const char*, double> told[] = {
        {"detected", evidence.detected},     {"looked_alike", evidence.looked_alike},
        {"life_s", evidence.life_s},         {"flow_px", evidence.flow_px},
        {"flow_ratio", evidence.flow_ratio}, {"alignment", evidence.alignment},
        {"decision", evidence.decision},     {"score", evidence.score}};
    for (const auto& [column, value] : told) EXPECT_EQ(number(row, column), value) << column;
    EXPECT_FALSE(row.executeStep());
}

TEST_F(ProjectViews, TellWhatPeopleSaidOfAVideo) {
    {
        ProjectFile project = ProjectFile::open(path_);
        ReviewStore review(project, 1);
        for (const ReviewEdit& edit :
             {test::sampleJudging(1), test::sampleBookmarking(2), test::sampleZoning(3), test::sampleCorrecting(1)})
            review.apply(edit);
        addSeen(project, 1, "Ada", {{10, 14}, {20, 20}});
    }
    const auto expectRow = [&](SQLite::Statement& row, const std::vector<std::pair<const char*, std::string>>& told) {
        ASSERT_TRUE(row.executeStep());
        EXPECT_EQ(row.getColumnCount(), static_cast<int>(told.size()));
        for (const auto& [column, value] : told) EXPECT_EQ(text(row, column), value) << column;
    };
    const std::string video = "/videos/street.mp4";
    SQLite::Statement verdict = rows("v_verdicts");
    expectRow(verdict, {{"verdict", "1"},
                        {"video", video},
                        {"kind", "leaves"},
                        {"judgement", "not relevant"},
                        {"first_frame", "101"},
                        {"last_frame", "151"},
                        {"start_s", "4.04"},
                        {"end_s", "6.04"},
                        {"frame", "121"},
                        {"x", "321.25"},
                        {"y", "110.5"},
                        {"zone", "yard \"ost\""},
                        {"sense", "to the left"},
                        {"note", "wendet, fährt zurück"},
                        {"tags", "lorry, gate 3"},
                        {"starred", "1"},
                        {"person", "Ada"},
                        {"when_utc", "2026-11-21T08:00:00Z"}});
    SQLite::Statement bookmark = rows("v_bookmarks");
    expectRow(bookmark, {{"bookmark", "2"},
                         {"video", video},
                         {"frame", "52"},
                         {"seconds", "2.08"},
                         {"x", "20.5"},
                         {"y", "32.25"},
                         {"note", "look here"},
                         {"person", "Bo"},
                         {"when_utc", "2026-11-21T09:00:00Z"}});
    SQLite::Statement zone = rows("v_zones");
    expectRow(zone, {{"zone", "3"},
                     {"video", video},
                     {"name", "yard 3"},
                     {"shape", "line"},
                     {"anchor", "ground"},
                     {"frame", "6"},
                     {"shown", "0"},
                     {"person", "Ada"},
                     {"when_utc", "2026-11-21T10:00:00Z"}});
    SQLite::Statement correction = rows("v_corrections");
    expectRow(correction, {{"correction", "1"},
                           {"video", video},
                           {"kind", "join"},
                           {"frame", "13"},
                           {"person", "Bo"},
                           {"when_utc", "2026-11-21T11:00:00Z"}});
    SQLite::Statement seen = rows("v_seen ORDER BY first_frame");
    expectRow(seen,
              {{"video", video}, {"person", "Ada"}, {"first_frame", "10"}, {"last_frame", "14"}, {"frames", "5"}});
    expectRow(seen,
              {{"video", video}, {"person", "Ada"}, {"first_frame", "20"}, {"last_frame", "20"}, {"frames", "1"}});
}

}  // namespace eyrie::project_views_test

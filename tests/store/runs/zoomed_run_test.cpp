// A run whose camera zooms, as it is stored and told in metres.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "store/health/project_check.h"
#include "store/older_schema.h"
#include "store/project/schema.h"
#include "store/runs/result_writer.h"
#include "store/runs/run_store.h"
#include "store/runs/track_scale.h"
#include "store/samples.h"
#include "support/temporary_folder.h"

namespace eyrie::zoomed_run_test {
namespace {

constexpr int kFrames = 10;
constexpr double kZooms[kFrames] = {1, 1, 1, 1.25, 1.5, 1.5, 1, 0.5, 0.5, 0.5};

class ZoomedRun : public testing::Test {
 protected:
    void SetUp() override {
        ProjectFile::openOrCreate(path_);
        RunRecord planned = test::sampleRun();
        planned.scale.slope = ScaleSlope::ofPicture(planned.sequence.size, 0, 0.002);
        ResultWriter writer(path_, planned, {});
        for (int frame = 0; frame < kFrames; ++frame) {
            FrameResult result;
            result.motion.frame = frame;
            result.motion.image_size = planned.sequence.size;
            result.motion.registration.zoom = kZooms[frame];
            result.motion.registration.state =
                frame == 4 || frame == 5 ? RegistrationState::frozen : RegistrationState::registered;
            result.motion.registration.elapsed = frame == 6 ? 3 : 1;
            if (frame >= 2 && frame <= 7) {
                TrackState state;
                state.id = 3;
                state.box = {{300, 100}, 40, 18, 0};
                state.velocity = {6, 0};
                state.status = TrackStatus::confirmed;
                result.tracks.push_back(state);
            }
            writer.write(result);
        }
        writer.finish(RunState::finished, "");
        run_ = writer.runId();
    }

    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "p.eyrie";
    int run_ = 0;
};

}  // namespace

TEST_F(ZoomedRun, ComesBackAsItWas) {
    ProjectFile project = ProjectFile::open(path_, ProjectFile::Mode::read_only);
    const RunStore store(project);
    const ZoomCourse course = store.run(run_)->scale.zoom;
    const std::vector<Registration> registrations = store.registrations(run_);
    ASSERT_EQ(registrations.size(), kFrames);
    SQLite::Database other(path_, SQLite::OPEN_READONLY);
    SQLite::Statement told(other, "SELECT zoom, elapsed FROM v_frames ORDER BY frame");
    for (int frame = 0; frame < kFrames; ++frame) {
        SCOPED_TRACE(frame);
        EXPECT_EQ(store.frameResult(run_, frame)->motion.registration.zoom, kZooms[frame]);
        EXPECT_EQ(registrations[std::size_t(frame)].zoom, kZooms[frame]);
        EXPECT_EQ(course.at(frame), kZooms[frame]);
        ASSERT_TRUE(told.executeStep());
        EXPECT_EQ(told.getColumn(0).getDouble(), kZooms[frame]);
        const int passed = frame == 4 || frame == 5 ? 0 : frame == 6 ? 3 : 1;
        EXPECT_EQ(told.getColumn(1).getInt(), passed);
        EXPECT_EQ(registrations[std::size_t(frame)].framesPassed(), passed);
        EXPECT_EQ(store.frameResult(run_, frame)->motion.registration.framesPassed(), passed);
    }
    for (int first = 0; first < kFrames; ++first) {
        double sum = 0;
        for (int last = first; last < kFrames; ++last) {
            sum += kZooms[last];
            EXPECT_NEAR(course.meanOf(first, last), sum / (last - first + 1), 1e-12) << first << " to " << last;
        }
    }
    EXPECT_TRUE(checkProject(path_).healthy());
}

TEST_F(ZoomedRun, TellsItsTracksInMetresByTheZoomOfTheirFrames) {
    ProjectFile project = ProjectFile::open(path_, ProjectFile::Mode::read_only);
    const RunStore store(project);
    const RunRecord run = store.run(run_).value();
    const TrackSummary track = store.tracks(run_).at(0);
    const double zoom = (1 + 1.25 + 1.5 + 1.5 + 1 + 0.5) / 6;
    // Zoomed in, the horizon is as much farther off as everything else.
    const double larger = zoom * (1 + 0.002 * (100 - 287.5) / zoom);
    const SceneScale scale = scaleOf(track, run.scale);
    EXPECT_DOUBLE_EQ(scale.metres(40), 40 * 0.345 / larger);
    SQLite::Database other(path_, SQLite::OPEN_READONLY);
    SQLite::Statement row(other, "SELECT length_m, width_m, speed_kmh, zoom FROM v_tracks");
    ASSERT_TRUE(row.executeStep());
    EXPECT_NEAR(row.getColumn(0).getDouble(), scale.metres(40), 1e-9);
    EXPECT_NEAR(row.getColumn(1).getDouble(), scale.metres(18), 1e-9);
    EXPECT_NEAR(row.getColumn(2).getDouble(), scale.metresPerSecond(6) * 3.6, 1e-9);
    EXPECT_NEAR(row.getColumn(3).getDouble(), zoom, 1e-12);
    EXPECT_DOUBLE_EQ(run.scale.at(4, {300, 100}).metres(40), 40 * 0.345 / (1.5 * (1 + 0.002 * (100 - 287.5) / 1.5)));
}

TEST_F(ZoomedRun, OfBeforeHasNoZoomAndWhatNoCameraHasIsRefused) {
    const auto change = [&](const std::string& sql) { SQLite::Database(path_, SQLite::OPEN_READWRITE).exec(sql); };
    for (const char* zoom : {"0", "-1", "1e9", "'much'"}) {
        SCOPED_TRACE(zoom);
        change(std::string("UPDATE frame SET zoom = ") + zoom + " WHERE frame = 4");
        ProjectFile project = ProjectFile::open(path_, ProjectFile::Mode::read_only);
        EXPECT_THROW(RunStore(project).frameResult(run_, 4), Error);
        EXPECT_THROW(RunStore(project).run(run_), Error);
        EXPECT_FALSE(checkProject(path_).healthy());
    }
    change("UPDATE frame SET zoom = 1");
    for (const char* elapsed : {"0", "-2", "1e12"}) {
        SCOPED_TRACE(elapsed);
        change(std::string("UPDATE frame SET elapsed = ") + elapsed + " WHERE frame = 4");
        ProjectFile project = ProjectFile::open(path_, ProjectFile::Mode::read_only);
        EXPECT_THROW(RunStore(project).frameResult(run_, 4), Error);
        EXPECT_FALSE(checkProject(path_).healthy());
    }
    change(test::kBackToSchema27);
    ProjectFile project = ProjectFile::open(path_);
    EXPECT_EQ(schema::numberOf(project.database()), schema::currentNumber());
    EXPECT_TRUE(RunStore(project).run(run_)->scale.zoom.isSteady());
    EXPECT_EQ(RunStore(project).frameResult(run_, 4)->motion.registration.zoom, 1);
    EXPECT_TRUE(checkProject(path_).healthy());
}

}  // namespace eyrie::zoomed_run_test

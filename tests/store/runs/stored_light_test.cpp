#include "store/runs/stored_light.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/geometry/angle.h"
#include "store/health/project_check.h"
#include "store/older_schema.h"
#include "store/project/schema.h"
#include "store/runs/run_store.h"
#include "store/samples.h"
#include "support/temporary_folder.h"

namespace eyrie::stored_light_test {
namespace {

RunLight sampleLight() {
    LightFinding shadows;
    shadows.last_frame = 3;
    shadows.heading = radiansFromDegrees(-100);
    shadows.reach_m = 2.5;
    shadows.scatter_m = 0.3;
    shadows.vehicles = 8;
    shadows.agreement = 0.9;
    shadows.darkening = 0.4;
    shadows.trimmed = 2;
    shadows.dropped = 1;
    LightFinding none;
    none.first_frame = 4;
    none.last_frame = 7;
    none.outcome = LightOutcome::few_vehicles;
    none.vehicles = 2;
    return {{shadows, none},
            {{0, radiansFromDegrees(-100), 12.5}, {1, radiansFromDegrees(-99), 12.75}},
            {{1, {LightOutcome::shadows, 0.5, 0.25, 0.2}}, {2, {LightOutcome::beams, 0.3, 0, 0.3}}}};
}

class StoredLightTest : public testing::Test {
 protected:
    void SetUp() override { run_ = test::writeSampleProject(path_, 8); }
    /// The sample's tracks with light.
    void store(const RunLight& light) {
        ProjectFile project = ProjectFile::open(path_);
        RunStore runs(project);
        std::vector<TrackFrame> states;
        runs.visitTrackStates(run_, [&](FrameIndex frame, const TrackState& state) {
            states.push_back({frame, state});
        });
        TracksOfRun tracks;
        tracks.states = [&](const TracksOfRun::StateVisitor& visitor) {
            for (const TrackFrame& each : states) visitor(each.frame, each.state);
        };
        tracks.light = light;
        runs.replaceTracks(run_, tracks);
    }
    void change(const std::string& sql) { SQLite::Database(path_, SQLite::OPEN_READWRITE).exec(sql); }

    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "p.eyrie";
    int run_ = 0;
};

TEST_F(StoredLightTest, ComesBackAsItWas) {
    const RunLight light = sampleLight();
    store(light);
    ProjectFile project = ProjectFile::open(path_, ProjectFile::Mode::read_only);
    const RunRecord run = RunStore(project).run(run_).value();
    ASSERT_EQ(run.light.size(), 2U);
    LightFinding shadows = run.light[0];
    EXPECT_NEAR(shadows.heading, light.findings[0].heading, 1e-12);
    shadows.heading = light.findings[0].heading;
    EXPECT_EQ(shadows, light.findings[0]);
    EXPECT_EQ(run.light[1], light.findings[1]);
    const StoredLight stored(project);
    EXPECT_NEAR(stored.shadowIn(run_, 1)->heading, light.frames[1].heading, 1e-12);
    EXPECT_EQ(stored.shadowIn(run_, 1)->reach_px, 12.75);
    EXPECT_EQ(stored.shadowIn(run_, 1)->frame, 1);
    EXPECT_EQ(stored.shadowIn(run_, 5), std::nullopt);
    EXPECT_EQ(stored.trimOf(run_, 1), light.trims.at(1));
    EXPECT_EQ(stored.trimOf(run_, 2), light.trims.at(2));
    EXPECT_EQ(stored.trimOf(run_, 3), std::nullopt);
    for (const TrackSummary& track : RunStore(project).tracks(run_)) {
        const auto trim = light.trims.find(track.id);
        EXPECT_EQ(track.trim, trim == light.trims.end() ? std::nullopt : std::optional(trim->second)) << track.id;
    }
    EXPECT_TRUE(checkProject(path_).healthy());
}

TEST_F(StoredLightTest, GivesWayWhenTracksAreReplacedAndGoesWithTheRun) {
    store(sampleLight());
    store({});
    {
        ProjectFile project = ProjectFile::open(path_);
        EXPECT_TRUE(RunStore(project).run(run_)->light.empty());
        EXPECT_EQ(StoredLight(project).shadowIn(run_, 1), std::nullopt);
        EXPECT_EQ(StoredLight(project).trimOf(run_, 1), std::nullopt);
    }
    store(sampleLight());
    ProjectFile project = ProjectFile::open(path_);
    RunStore(project).remove(run_);
    const auto rows = [&](const char* table) {
        return project.database().execAndGet(std::string("SELECT count(*) FROM ") + table).getInt();
    };
    EXPECT_EQ(rows("light_finding"), 2);
    SQLite::Database other(path_, SQLite::OPEN_READONLY);
    EXPECT_EQ(other.execAndGet("SELECT count(*) FROM v_light").getInt(), 0) << "views leave removed runs out";
    EXPECT_EQ(other.execAndGet("SELECT count(*) FROM v_frame_shadows").getInt(), 0);
    EXPECT_EQ(other.execAndGet("SELECT count(*) FROM v_box_trims").getInt(), 0);
    RunStore(project).purgeRemoved();
    for (const char* table : {"light_finding", "frame_shadow", "box_trim"}) EXPECT_EQ(rows(table), 0) << table;
}

TEST_F(StoredLightTest, OtherToolsReadItInDegrees) {
    store(sampleLight());
    SQLite::Database other(path_, SQLite::OPEN_READONLY);
    EXPECT_NEAR(other.execAndGet("SELECT heading_deg FROM v_light WHERE outcome = 'shadows'").getDouble(), 260, 1e-9);
    EXPECT_NEAR(other.execAndGet("SELECT heading_deg FROM v_frame_shadows WHERE frame = 1").getDouble(), 261, 1e-9);
    EXPECT_EQ(other.execAndGet("SELECT what FROM v_box_trims WHERE track = 2").getString(), "beams");
}

TEST_F(StoredLightTest, IsNotKnownOfRunsOfBefore) {
    store(sampleLight());
    change(test::kBackToSchema27);
    ProjectFile project = ProjectFile::open(path_);
    EXPECT_EQ(schema::numberOf(project.database()), schema::currentNumber());
    EXPECT_TRUE(RunStore(project).run(run_)->light.empty());
    EXPECT_EQ(StoredLight(project).shadowIn(run_, 1), std::nullopt);
    EXPECT_EQ(RunStore(project).tracks(run_).at(0).trim, std::nullopt);
    EXPECT_TRUE(checkProject(path_).healthy());
}

TEST_F(StoredLightTest, WhatNoWriterWroteIsRefusedAndFound) {
    for (const char* sql : {"UPDATE light_finding SET heading_deg = 360", "UPDATE light_finding SET heading_deg = -1",
                            "UPDATE light_finding SET reach_m = -1", "UPDATE light_finding SET scatter_m = -1",
                            "UPDATE light_finding SET vehicles = -1", "UPDATE light_finding SET agreement = 1.5",
                            "UPDATE light_finding SET darkening = 2 WHERE darkening IS NOT NULL",
                            "UPDATE light_finding SET outcome = 'eclipse'", "UPDATE light_finding SET last_frame = -1",
                            "UPDATE light_finding SET trimmed = -1", "UPDATE light_finding SET dropped = -1",
                            "UPDATE frame_shadow SET heading_deg = 400", "UPDATE frame_shadow SET reach_px = -2",
                            "UPDATE box_trim SET what = 'few vehicles'", "UPDATE box_trim SET along = 2",
                            "UPDATE box_trim SET across = -1", "UPDATE box_trim SET taken = 1.1"}) {
        store(sampleLight());
        change(sql);
        EXPECT_FALSE(checkProject(path_).healthy()) << sql;
        ProjectFile project = ProjectFile::open(path_);
        const auto readAll = [&] {
            RunStore(project).runs();
            RunStore(project).tracks(run_);
            StoredLight(project).shadowIn(run_, 1);
            StoredLight(project).trimOf(run_, 1);
        };
        EXPECT_THROW(readAll(), Error) << sql;
    }
}

}  // namespace
}  // namespace eyrie::stored_light_test

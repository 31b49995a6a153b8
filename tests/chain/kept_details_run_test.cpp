#include <gtest/gtest.h>

#include "chain/recording/run_recorder.h"
#include "store/details/kept_details.h"
#include "store/project/project_file.h"
#include "support/moving_scene.h"
#include "support/run_rows.h"
#include "support/temporary_folder.h"

namespace eyrie::kept_details_run_test {
namespace {

/// What is kept does not depend on how vehicles are outlined.
ChainOptions chainOptions() {
    ChainOptions options;
    options.detection.method = DetectionMethod::clusters;
    return options;
}

int recordKeeping(const std::filesystem::path& project,
                  const std::vector<std::pair<std::string, std::string>>& values) {
    const ChainOptions options = chainOptions();
    RecordingOptions recording;
    setParameters(describeOf(recording), values);
    const test::MovingScene scene;
    test::MemorySource source(scene);
    const SceneScale scale = sceneScale(source.info(), 0.2);
    RunRecorder recorder(project, plannedRun(source.info(), scale, {}, "default"), options, nullptr, recording);
    return recorder.finish(ChainRun(options, scale).run(source, {}, recorder, {})).id;
}

int detailed(const std::filesystem::path& project, int run) {
    ProjectFile file = ProjectFile::open(project);
    return detailedFrames(file, run);
}

/// Rows of tracks alone.
std::vector<std::string> tracksOf(const std::filesystem::path& project, int run) {
    std::vector<std::string> rows = test::rowsOf(project, run);
    std::erase_if(rows, [](const std::string& row) { return !row.starts_with("track"); });
    return rows;
}

TEST(KeptDetailsOfRuns, AreThoseOfTheFramesThatWereChosen) {
    const test::TemporaryFolder folder;
    const auto project = folder / "p.eyrie";
    EXPECT_EQ(detailed(project, recordKeeping(project, {})), 40) << "all of a short run";
    EXPECT_EQ(detailed(project, recordKeeping(project, {{"recording.details_up_to", "39"}})), 0)
        << "none of a long one";
    EXPECT_EQ(detailed(project, recordKeeping(project, {{"recording.details_up_to", "40"}})), 40);
    EXPECT_EQ(detailed(project, recordKeeping(project, {{"recording.details", "none"}})), 0);
    EXPECT_EQ(
        detailed(project, recordKeeping(project, {{"recording.details", "all"}, {"recording.details_up_to", "1"}})),
        40);
    EXPECT_EQ(detailed(project,
                       recordKeeping(project, {{"recording.details", "sampled"}, {"recording.details_every", "10"}})),
              4);
}

TEST(KeptDetailsOfRuns, ChangeNothingOfTheTracks) {
    const test::TemporaryFolder folder;
    const auto project = folder / "p.eyrie";
    const int all = recordKeeping(project, {{"recording.details", "all"}});
    const int none = recordKeeping(project, {{"recording.details", "none"}});
    const auto expected = tracksOf(project, all);
    ASSERT_FALSE(expected.empty());
    EXPECT_EQ(tracksOf(project, none), expected);
}

TEST(KeptDetailsOfRuns, AreNoParametersOfTheChain) {
    const test::TemporaryFolder folder;
    const auto project = folder / "p.eyrie";
    const int run = recordKeeping(project, {{"recording.details", "none"}});
    ProjectFile file = ProjectFile::open(project);
    const auto stored = RunStore(file).parameters(run);
    EXPECT_EQ(stored.back(), std::pair(std::string("recording.details"), std::string("none")));
    std::vector<std::string> unknown;
    EXPECT_EQ(parameterValues(storedOptions(stored, &unknown)), parameterValues(chainOptions()));
    EXPECT_TRUE(unknown.empty());
    EXPECT_EQ(RecordingOptions::among(stored).details, KeptDetails::none);
}

}  // namespace
}  // namespace eyrie::kept_details_run_test

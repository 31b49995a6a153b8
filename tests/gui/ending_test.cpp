#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <thread>

#include "store/project/project_file.h"
#include "store/runs/run_store.h"
#include "support/moving_scene.h"
#include "support/places.h"
#include "support/process.h"
#include "support/temporary_folder.h"

namespace eyrie::ending_test {
namespace {

namespace fs = std::filesystem;

/// The window's program itself, without a screen.
class Ending : public testing::TestWithParam<int> {
 protected:
    Ending() {
        for (const char* place : {"HOME", "XDG_DATA_HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_RUNTIME_DIR"})
            setenv(place, folder_.path().c_str(), 1);
        setenv("QT_QPA_PLATFORM", "offscreen", 1);
        const test::MovingScene scene;
        fs::create_directories(folder_ / "clip");
        for (int i = 0; i < 200; ++i)
            cv::imwrite((folder_ / "clip" / (std::to_string(1000 + i) + ".png")).string(), scene.draw(i % 40));
    }
    /// The run of the project, which lies beside what is shown.
    std::optional<RunRecord> run() const {
        try {
            ProjectFile project = ProjectFile::open(folder_ / "clip.eyrie", ProjectFile::Mode::read_only);
            const auto runs = RunStore(project).runs();
            if (!runs.empty()) return runs.front();
        } catch (const std::exception&) {
            // not there yet, or being made
        }
        return std::nullopt;
    }
    test::TemporaryFolder folder_;
};

TEST_P(Ending, ASignalClosesTheWindowAndKeepsWholeFrames) {
    test::Process window({test::programPath("eyrie"), "--gsd", "0.2", "--run", (folder_ / "clip").string()});
    while (run().value_or(RunRecord{}).frames_done < 3) std::this_thread::yield();
    kill(window.pid(), GetParam());
    EXPECT_EQ(window.wait().exit_code, 0);
    ASSERT_TRUE(run().has_value());
    EXPECT_EQ(run()->state, RunState::stopped);
    EXPECT_GE(run()->frames_done, 3);
}

INSTANTIATE_TEST_SUITE_P(Signals, Ending, testing::Values(SIGTERM, SIGHUP, SIGINT));

}  // namespace
}  // namespace eyrie::ending_test

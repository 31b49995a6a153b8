#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <optional>

#include "store/project/project_file.h"
#include "store/runs/run_store.h"
#include "support/moving_scene.h"
#include "support/places.h"
#include "support/process.h"
#include "support/temporary_folder.h"
#include "support/wait_until.h"

namespace eyrie::ending_test {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 100;  ///< more than are done until the signal comes

/// A clip, drawn once for all tests.
fs::path drawnClip() {
    static const test::TemporaryFolder folder;
    static const fs::path path = [] {
        const test::MovingScene scene;
        fs::create_directories(folder / "clip");
        for (int i = 0; i < kFrames; ++i)
            cv::imwrite((folder / "clip" / (std::to_string(1000 + i) + ".png")).string(), scene.draw(i % 40));
        return folder / "clip";
    }();
    return path;
}

/// The window's program itself, without a screen.
class Ending : public testing::TestWithParam<int> {
 protected:
    Ending() {
        for (const char* place : {"HOME", "XDG_DATA_HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_RUNTIME_DIR"})
            setenv(place, folder_.path().c_str(), 1);
        setenv("QT_QPA_PLATFORM", "offscreen", 1);
        fs::copy(drawnClip(), folder_ / "clip");
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
    test::waitUntil("frames are done", [&] { return run().value_or(RunRecord{}).frames_done >= 3; });
    kill(window.pid(), GetParam());
    EXPECT_EQ(window.wait().exit_code, 0);
    ASSERT_TRUE(run().has_value());
    EXPECT_EQ(run()->state, RunState::stopped);
    EXPECT_GE(run()->frames_done, 3);
}

INSTANTIATE_TEST_SUITE_P(Signals, Ending, testing::Values(SIGTERM, SIGHUP, SIGINT));

}  // namespace
}  // namespace eyrie::ending_test

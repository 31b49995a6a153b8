#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <sstream>

#include "cli/loaded_program.h"
#include "io/video/frame_source.h"
#include "store/project/project_file.h"
#include "store/runs/run_store.h"
#include "support/moving_scene.h"
#include "support/places.h"
#include "support/process.h"
#include "support/run_rows.h"
#include "support/wait_until.h"

namespace eyrie::resume_command_test {
namespace {

using testing::HasSubstr;

constexpr int kFrames = 60;

/// A clip drawn once for all tests.
std::string clip() {
    static const test::TemporaryFolder folder;
    static const bool drawn = [] {
        test::MovingScene scene;
        scene.frames = kFrames;
        std::filesystem::create_directories(folder / "clip");
        for (int i = 0; i < kFrames; ++i) {
            cv::imwrite(folder / ("clip/" + std::to_string(1000 + i) + ".png"), scene.draw(i));
        }
        return true;
    }();
    EXPECT_TRUE(drawn);
    return (folder / "clip").string();
}

std::string contentsOf(const std::string& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

class RunAgain : public testing::Test {
 protected:
    std::string at(const std::string& name) const { return (folder / name).string(); }
    static std::vector<std::string> program(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), test::programPath("eyrie-cli"));
        return arguments;
    }
    static test::ProcessResult cli(const std::vector<std::string>& arguments) { return test::runLoaded(arguments); }
    std::vector<std::string> command(const std::string& project, const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments{"run",       clip(),     "--gsd", "0.2", "--set", "view.oblique=false",
                                           "--project", at(project)};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }
    int framesDone(const std::string& project) const {
        try {
            ProjectFile file = ProjectFile::open(at(project), ProjectFile::Mode::read_only);
            const auto runs = RunStore(file).runs();
            return runs.empty() ? 0 : runs.back().frames_done;
        } catch (const std::exception&) {
            return 0;
        }
    }
    /// Sends a signal when at least so many frames are stored.
    int interrupted(const std::vector<std::string>& arguments, const std::string& project, int signal, int frames) {
        test::Process process(program(arguments));
        test::waitUntil("frames are done", [&] { return framesDone(project) >= frames; });
        kill(process.pid(), signal);
        return process.wait().exit_code;
    }
    void stop(const std::string& project, const std::vector<std::string>& more = {}) {
        ASSERT_EQ(interrupted(command(project, more), project, SIGINT, 10), 130);
        ASSERT_LT(framesDone(project), kFrames);
    }
    std::size_t runsIn(const std::string& project) const {
        ProjectFile file = ProjectFile::open(at(project), ProjectFile::Mode::read_only);
        return RunStore(file).runs().size();
    }
    const test::TemporaryFolder folder;
};

}  // namespace

TEST_F(RunAgain, GivesTheSameWhereverItWasKilled) {
    ASSERT_EQ(cli(command("whole.eyrie", {"--tracks", at("whole.csv")})).exit_code, 0);
    std::mt19937 dice(std::random_device{}());
    for (int round = 0; round < 2; ++round) {
        const std::string project = "killed-" + std::to_string(round) + ".eyrie";
        std::vector<std::string> again = command(project, {"--resume", "--tracks", at("t.csv")});
        const int moment = 1 + static_cast<int>(dice() % 25);
        SCOPED_TRACE(moment);
        EXPECT_EQ(interrupted(again, project, SIGKILL, moment), 128 + SIGKILL);
        interrupted(again, project, SIGINT, moment + 5);  // and once more, in another way
        const auto rest = cli(again);
        ASSERT_EQ(rest.exit_code, 0) << rest.errors;
        EXPECT_THAT(rest.output, HasSubstr("60 of 60 frames"));
        EXPECT_EQ(runsIn(project), 1U);
        EXPECT_EQ(test::rowsOf(at(project), 1), test::rowsOf(at("whole.eyrie"), 1));
        EXPECT_EQ(contentsOf(at("t.csv")), contentsOf(at("whole.csv")));
    }
}

TEST_F(RunAgain, NeedsOnlyTheProject) {
    stop("p.eyrie", {"--set", "tracking.min_overlap=0.33", "--frames", "3:50"});
    const auto result =
        cli({"run", "--resume", "--project", at("p.eyrie"), "--tracks", at("t.csv"), "--annotated", at("a.mp4")});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr("resuming run 1"));
    EXPECT_THAT(result.output, HasSubstr("48 of 48 frames"));
    EXPECT_EQ(openSource(at("a.mp4"))->info().frame_count, 48) << "those of before are in the video, too";
    ASSERT_EQ(
        cli(command("w.eyrie", {"--set", "tracking.min_overlap=0.33", "--frames", "3:50", "--tracks", at("w.csv")}))
            .exit_code,
        0);
    EXPECT_EQ(contentsOf(at("t.csv")), contentsOf(at("w.csv")));
}

TEST_F(RunAgain, BeginsWhenThereIsNothingAndEndsWhenNothingIsLeft) {
    const auto first = cli(command("p.eyrie", {"--resume"}));
    EXPECT_EQ(first.exit_code, 0) << first.errors;
    const auto second = cli(command("p.eyrie", {"--resume", "--tracks", at("t.csv")}));
    EXPECT_EQ(second.exit_code, 0) << second.errors;
    EXPECT_THAT(second.errors, HasSubstr("run 1 is finished"));
    EXPECT_THAT(contentsOf(at("t.csv")), HasSubstr("detected"));
    EXPECT_EQ(cli({"run", "--resume", "--project", at("p.eyrie")}).exit_code, 0);
    EXPECT_EQ(runsIn("p.eyrie"), 1U);
    const auto other = cli(command("p.eyrie", {"--resume", "--set", "tracking.min_overlap=0.33"}));
    EXPECT_EQ(other.exit_code, 0) << "no run was begun with these parameters: " << other.errors;
    EXPECT_EQ(runsIn("p.eyrie"), 2U);
    EXPECT_EQ(cli({"run", "--resume", "--project", at("none.eyrie")}).exit_code, 5);
}

TEST_F(RunAgain, GivenTwiceAtOnceMakesOneRun) {
    // Without a GSD both look at the video for a while before they begin a run.
    const std::vector<std::string> twice{"run", clip(), "--resume", "--project", at("p.eyrie")};
    test::Process one(program(twice));
    test::Process other(program(twice));
    const test::ProcessResult results[] = {one.wait(), other.wait()};
    EXPECT_EQ(runsIn("p.eyrie"), 1U) << results[0].errors << results[1].errors;
    EXPECT_TRUE(results[0].exit_code == 0 || results[1].exit_code == 0) << results[0].errors << results[1].errors;
    for (const test::ProcessResult& result : results) {
        if (result.exit_code == 0) continue;  // it may have come when the run was finished
        EXPECT_EQ(result.exit_code, 5) << result.errors;
        EXPECT_THAT(result.errors, HasSubstr("run 1 of " + at("p.eyrie")));
    }
}

TEST_F(RunAgain, AStoppedRunIsTakenUpByOneOfTwo) {
    stop("p.eyrie");
    test::Process one(program(command("p.eyrie", {"--resume"})));
    test::Process other(program(command("p.eyrie", {"--resume"})));
    const test::ProcessResult results[] = {one.wait(), other.wait()};
    EXPECT_EQ(runsIn("p.eyrie"), 1U);
    EXPECT_EQ(framesDone("p.eyrie"), kFrames) << results[0].errors << results[1].errors;
    ASSERT_EQ(cli(command("whole.eyrie")).exit_code, 0);
    EXPECT_EQ(test::rowsOf(at("p.eyrie"), 1), test::rowsOf(at("whole.eyrie"), 1));
}

TEST_F(RunAgain, RefusesWhatContradictsTheRun) {
    stop("p.eyrie");
    const int done = framesDone("p.eyrie");
    const std::vector<std::string> again{"run", "--resume", "--project", at("p.eyrie")};
    const auto refusal = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = again;
        arguments.insert(arguments.end(), more.begin(), more.end());
        const auto result = cli(arguments);
        EXPECT_EQ(result.exit_code, 2) << result.errors;
        return result.errors;
    };
    EXPECT_THAT(refusal({"--gsd", "0.3"}), HasSubstr("run 1 of " + at("p.eyrie") + " was started with --gsd 0.2"));
    EXPECT_THAT(refusal({"--frames", "0:20"}), HasSubstr("--frames 0:59"));
    EXPECT_THAT(refusal({"--fps", "10"}), HasSubstr("--fps 25"));
    EXPECT_THAT(refusal({"--set", "view.oblique=false", "--set", "tracking.min_overlap=0.33"}),
                HasSubstr("tracking.min_overlap="));
    EXPECT_THAT(refusal({"--run", "7"}), HasSubstr("holds run 1 alone"));
    EXPECT_EQ(cli({"run", "--project", at("p.eyrie")}).exit_code, 2) << "neither INPUT nor --resume";
    EXPECT_EQ(cli(command("p.eyrie", {"--run", "1"})).exit_code, 2) << "--run without --resume";
    EXPECT_EQ(framesDone("p.eyrie"), done);
}

TEST_F(RunAgain, FindsAVideoThatMovedAndRefusesAnother) {
    std::filesystem::create_directories(folder / "here");
    std::filesystem::copy(clip(), folder / "here/clip");
    ASSERT_EQ(
        interrupted({"run", at("here/clip"), "--gsd", "0.2", "--set", "view.oblique=false", "--project", at("p.eyrie")},
                    "p.eyrie", SIGINT, 10),
        130);
    std::filesystem::rename(folder / "here", folder / "there");
    const auto missing = cli({"run", "--resume", "--project", at("p.eyrie")});
    EXPECT_EQ(missing.exit_code, 3);
    EXPECT_THAT(missing.errors, HasSubstr(at("here/clip")));
    std::filesystem::copy(folder / "there/clip", folder / "other");
    for (int i = 0; i < kFrames; ++i) {
        const std::string file = at("other/" + std::to_string(1000 + i) + ".png");
        cv::imwrite(file, cv::imread(file) + cv::Scalar(3, 3, 3));
    }
    const auto other = cli({"run", at("other"), "--resume", "--run", "1", "--project", at("p.eyrie")});
    EXPECT_EQ(other.exit_code, 3) << other.output;
    EXPECT_THAT(other.errors, HasSubstr("is not the same video"));
    EXPECT_THAT(other.errors, testing::ContainsRegex("frame [0-9]+ \\([0-9]+\\.png\\) shows something else"));
    const auto moved = cli({"run", at("there/clip"), "--resume", "--run", "1", "--project", at("p.eyrie")});
    EXPECT_EQ(moved.exit_code, 0) << moved.errors;
    EXPECT_THAT(moved.output, HasSubstr("60 of 60 frames"));
}

TEST_F(RunAgain, DetectionsAreWrittenOfLongRuns) {
    const auto all = cli(command("p.eyrie", {"--detections", at("all.csv")}));
    ASSERT_EQ(all.exit_code, 0) << all.errors;
    const auto lengthy =
        cli(command("p.eyrie", {"--detections", at("long.csv"), "--set", "recording.details_up_to=10"}));
    ASSERT_EQ(lengthy.exit_code, 0) << lengthy.errors;
    EXPECT_FALSE(contentsOf(at("all.csv")).empty());
    EXPECT_EQ(contentsOf(at("long.csv")), contentsOf(at("all.csv"))) << "a run that would keep none but for that";
}

TEST_F(RunAgain, DetectionsThatAreNotKeptAreRefusedBeforeTheRun) {
    for (const std::string kept : {"none", "sampled"}) {
        const auto result =
            cli(command("p.eyrie", {"--detections", at("d.csv"), "--set", "recording.details=" + kept}));
        EXPECT_EQ(result.exit_code, 2);
        EXPECT_THAT(result.errors, HasSubstr("recording.details=" + kept));
    }
    EXPECT_FALSE(std::filesystem::exists(at("p.eyrie")));
    const std::vector<std::string> none{"--set", "recording.details=none"};
    stop("p.eyrie", none);
    const int done = framesDone("p.eyrie");
    const std::vector<std::string> again{"run", "--resume", "--project", at("p.eyrie"), "--detections", at("d.csv")};
    const auto unfinished = cli(again);
    EXPECT_EQ(unfinished.exit_code, 3);
    EXPECT_THAT(unfinished.errors, HasSubstr("keeps tracks only"));
    EXPECT_EQ(framesDone("p.eyrie"), done);
    EXPECT_EQ(cli(command("p.eyrie", {"--resume", "--set", "recording.details=none"})).exit_code, 0);
    EXPECT_EQ(runsIn("p.eyrie"), 1U) << "it was begun with the same";
    EXPECT_EQ(cli(again).exit_code, 3) << "finished";
    EXPECT_FALSE(std::filesystem::exists(at("d.csv")));
}

TEST_F(RunAgain, ARunThatKeepsSomethingElseIsAnotherOne) {
    ASSERT_EQ(cli(command("p.eyrie", {"--set", "recording.details=none"})).exit_code, 0);
    EXPECT_EQ(cli(command("p.eyrie", {"--resume", "--set", "recording.details=all"})).exit_code, 0);
    EXPECT_EQ(runsIn("p.eyrie"), 2U);
    EXPECT_EQ(cli(command("p.eyrie", {"--resume"})).exit_code, 0);
    EXPECT_EQ(runsIn("p.eyrie"), 2U);
}

}  // namespace eyrie::resume_command_test

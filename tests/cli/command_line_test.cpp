#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "cli/loaded_program.h"
#include "store/project/project_file.h"
#include "store/runs/run_store.h"
#include "support/moving_scene.h"
#include "support/places.h"
#include "support/process.h"
#include "support/shared_data.h"
#include "support/wait_until.h"

namespace eyrie::command_line_test {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string program = test::programPath("eyrie-cli");

test::ProcessResult cli(const std::vector<std::string>& arguments) {
    return test::runLoaded(arguments);
}

class CommandLine : public testing::Test {
 protected:
    std::string at(const std::string& name) const { return (folder / name).string(); }
    /// A folder of frames with two vehicles.
    std::string clip(int frames = 30) const {
        const test::MovingScene scene;
        std::filesystem::create_directories(folder / "clip");
        for (int i = 0; i < frames; ++i) {
            cv::imwrite(at("clip/" + std::to_string(1000 + i) + ".png"), scene.draw(i));
        }
        return at("clip");
    }
    void write(const std::string& name, const std::string& text) const { std::ofstream(at(name)) << text; }
    /// Until so many are stored by the run of p.eyrie, which another process does.
    void waitForFrames(int frames) const {
        test::waitUntil("frames are done", [&] {
            try {
                ProjectFile project = ProjectFile::open(folder / "p.eyrie", ProjectFile::Mode::read_only);
                const auto runs = RunStore(project).runs();
                return !runs.empty() && runs[0].frames_done >= frames;
            } catch (const std::exception&) {
                return false;
            }
        });
    }
    const test::TemporaryFolder folder;
};

}  // namespace

TEST_F(CommandLine, runWritesProjectTracksDetectionsTimingAndVideo) {
    const auto result =
        test::runProcess({program, "run", clip(), "--gsd", "0.2", "--project", at("p.eyrie"), "--tracks", at("t.csv"),
                          "--detections", at("d.csv"), "--timing", at("t.json"), "--annotated", at("a.mp4")});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, HasSubstr("30 of 30 frames"));
    EXPECT_THAT(result.output, HasSubstr("km/h"));
    for (const char* name : {"p.eyrie", "t.csv", "d.csv", "t.json", "a.mp4"}) {
        EXPECT_GT(std::filesystem::file_size(folder / name), 100U) << name;
    }
    for (const char* companion : {"p.eyrie-wal", "p.eyrie-shm"})
        EXPECT_FALSE(std::filesystem::exists(folder / companion)) << "a project is one file: " << companion;
    std::ifstream tracks(at("t.csv"));
    std::string header;
    std::getline(tracks, header);
    EXPECT_EQ(header, "frame,id,x,y,length,width,heading,class,score,vx,vy,origin");
    const auto evaluated = cli({"evaluate", "--ground-truth", at("t.csv"), "--result", at("t.csv")});
    EXPECT_EQ(evaluated.exit_code, 0) << evaluated.errors;
}

TEST_F(CommandLine, aFrameRateGivenOnceCountsForLaterRuns) {
    const std::string input = clip(3);
    for (const auto& rate : std::vector<std::vector<std::string>>{{"--fps", "30"}, {}, {"--fps", "10"}, {}}) {
        std::vector<std::string> command{"run",       input,        "--gsd", "0.2", "--set", "view.oblique=false",
                                         "--project", at("p.eyrie")};
        command.insert(command.end(), rate.begin(), rate.end());
        ASSERT_EQ(cli(command).exit_code, 0);
    }
    ProjectFile project = ProjectFile::open(folder / "p.eyrie");
    std::vector<double> rates;
    for (const RunRecord& run : RunStore(project).runs()) rates.push_back(run.scale.frame_rate_hz);
    EXPECT_THAT(rates, testing::ElementsAre(30, 30, 10, 10));
}

// Else what changes while a video is looked through for its scale would seem to be older than its run.
TEST_F(CommandLine, aRunBeginsBeforeItsVideoIsRead) {
    const std::string picture = clip(30) + "/1000.png";
    const timespec long_ago_and_as_it_is[] = {{0, 0}, {0, UTIME_OMIT}};  // read, written
    ASSERT_EQ(utimensat(AT_FDCWD, picture.c_str(), long_ago_and_as_it_is, 0), 0);
    ASSERT_EQ(cli({"run", at("clip"), "--project", at("p.eyrie"), "--quiet"}).exit_code, 0);
    struct stat facts {};
    ASSERT_EQ(stat(picture.c_str(), &facts), 0);
    if (facts.st_atim.tv_sec == 0) GTEST_SKIP() << "this disk does not keep when a file was read";
    const std::int64_t read_us = facts.st_atim.tv_sec * 1'000'000 + facts.st_atim.tv_nsec / 1000;
    constexpr std::int64_t kTick_us = 10'000;  // of the clock for files
    ProjectFile project = ProjectFile::open(folder / "p.eyrie");
    EXPECT_LE(RunStore(project).run(1)->started_us.value(), read_us + kTick_us);
}

TEST_F(CommandLine, aRunThatFollowsNothingSaysWhy) {
    std::filesystem::create_directories(folder / "blank");
    for (int i = 0; i < 12; ++i)
        cv::imwrite(at("blank/" + std::to_string(10 + i) + ".png"), cv::Mat(120, 160, CV_8U, cv::Scalar(i)));
    const auto result = cli({"run", at("blank"), "--gsd", "0.2", "--project", at("p.eyrie"), "--quiet"});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, HasSubstr("Not registered: 11 frames (blank picture: too few corners 11)"));
    EXPECT_THAT(result.output, HasSubstr("Vehicles followed: 0: no frame could be registered"));
}

TEST_F(CommandLine, aScaleWithWhichNothingCanBeFoundIsTheCauseThatIsTold) {
    const auto result =
        cli({"run", clip(), "--gsd", "9", "--set", "view.oblique=false", "--project", at("p.eyrie"), "--quiet"});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr("--gsd 9: at 9 m/px a car is 0.5 px long")) << "before the run";
    EXPECT_THAT(result.output, HasSubstr("Vehicles followed: 0: at 9 m/px a car is 0.5 px long"));
    EXPECT_THAT(result.output, HasSubstr("if 9 is in cm, give 0.09"));
}

TEST_F(CommandLine, whoeverChoosesNoRunIsToldWhichOneIsTaken) {
    const std::string input = clip(6);
    const std::vector<std::string> report{"report", "--project",  at("p.eyrie"), "--events",
                                          "--out",  at("r.html"), "--force"};
    for (const char* name : {"morning", "evening"}) {
        ASSERT_EQ(cli({"run", input, "--gsd", "0.2", "--set", "view.oblique=false", "--project", at("p.eyrie"),
                       "--name", name})
                      .exit_code,
                  0);
        if (std::string(name) == "morning") {
            EXPECT_THAT(cli(report).errors, Not(HasSubstr("taking"))) << "the only one";
        }
    }
    EXPECT_THAT(cli(report).errors, HasSubstr("taking run 2 (evening), the last of 2 in"));
    EXPECT_THAT(cli(report).errors, HasSubstr("--run takes another"));
    EXPECT_THAT(cli(report).output, HasSubstr("r.html, run 2 (evening), "));
    std::vector<std::string> chosen = report;
    chosen.insert(chosen.end(), {"--run", "1"});
    EXPECT_THAT(cli(chosen).errors, Not(HasSubstr("taking")));
    EXPECT_THAT(cli(chosen).output, HasSubstr("r.html, run 1 (morning), "));
}

TEST_F(CommandLine, frameRangeIsInclusiveAndChecked) {
    const auto result = cli(
        {"run", clip(), "--frames", "5:14", "--gsd", "0.2", "--set", "view.oblique=false", "--project", at("p.eyrie")});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, HasSubstr("10 of 10 frames"));
    for (const char* bad : {"9:5", "a:b", "-3:4", "", "5:6:7"}) {
        EXPECT_EQ(cli({"run", at("clip"), "--frames=" + std::string(bad), "--project", at("p.eyrie")}).exit_code, 2)
            << bad;
    }
    const auto outside = cli({"run", at("clip"), "--frames", "5:400", "--project", at("p.eyrie")});
    EXPECT_NE(outside.exit_code, 0);
    EXPECT_THAT(outside.errors, HasSubstr("frames 0 to 29"));
    EXPECT_EQ(cli({"run", at("clip"), "--frames", "30:", "--project", at("new.eyrie")}).exit_code, 2);
    EXPECT_FALSE(std::filesystem::exists(folder / "new.eyrie")) << "nothing was begun";
    const auto nowhere = cli({"run", at("clip"), "--tracks", at("nowhere/t.csv"), "--project", at("new.eyrie")});
    EXPECT_EQ(nowhere.exit_code, 4);
    EXPECT_THAT(nowhere.errors, HasSubstr("nowhere"));
    EXPECT_FALSE(std::filesystem::exists(folder / "new.eyrie")) << "nothing was begun";
    EXPECT_EQ(cli({"info", at("p.eyrie")}).exit_code, 0);
    EXPECT_FALSE(std::filesystem::exists(folder / "p.eyrie-shm")) << "reading leaves one file";
}

TEST_F(CommandLine, numbersThatCannotBeAreRefusedWithTheRemedy) {
    const std::string input = clip(3);
    for (const char* gsd : {"0", "-0.3", "nan", "inf", "1e9"}) {
        const auto result = cli({"run", input, "--gsd=" + std::string(gsd), "--project", at("p.eyrie")});
        EXPECT_EQ(result.exit_code, 2) << gsd;
        EXPECT_THAT(result.errors, HasSubstr("--gsd")) << gsd;
    }
    EXPECT_EQ(cli({"run", input, "--gsd", "abc"}).exit_code, 2);
    EXPECT_THAT(cli({"run", input, "--gsd", "80", "--project", at("p.eyrie")}).errors,
                HasSubstr("if 80 is in cm, give 0.8"));
    EXPECT_EQ(cli({"run", input, "--fps", "0", "--project", at("p.eyrie")}).exit_code, 2);
    const auto unknown = cli({"run", input, "--set", "motion.min_sped=1", "--project", at("p.eyrie")});
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_THAT(unknown.errors, HasSubstr("motion.min_speed"));
    const auto outside = cli({"run", input, "--set", "motion.min_age=0", "--project", at("p.eyrie")});
    EXPECT_EQ(outside.exit_code, 2);
    EXPECT_THAT(outside.errors, HasSubstr("expected"));
    EXPECT_EQ(cli({"run", input, "--preset", "nothing"}).exit_code, 2);
    EXPECT_FALSE(std::filesystem::exists(folder / "p.eyrie")) << "a refused call leaves nothing behind";
}

TEST_F(CommandLine, unusableInputsAreNamed) {
    write("empty.mp4", "");
    write("text.mp4", "this is no video, only words");
    std::filesystem::create_directories(folder / "nothing");
    for (const char* name : {"missing.mp4", "empty.mp4", "text.mp4", "nothing"}) {
        const auto result = cli({"run", at(name), "--project", at("p.eyrie")});
        EXPECT_EQ(result.exit_code, 3) << name;
        EXPECT_THAT(result.errors, HasSubstr(name));
    }
    EXPECT_EQ(cli({"run", "scene:nowhere", "--project", at("p.eyrie")}).exit_code, 2);
}

TEST_F(CommandLine, aBrokenImageAmidASequenceKeepsTheFramesBefore) {
    const std::string input = clip(20);
    write("clip/1012.png", "broken");
    const auto result = cli({"run", input, "--gsd", "0.2", "--set", "view.oblique=false", "--project", at("p.eyrie")});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.errors, HasSubstr("1012.png"));
    ProjectFile project = ProjectFile::open(folder / "p.eyrie");
    EXPECT_EQ(RunStore(project).runs().at(0).frames_done, 12);
}

TEST_F(CommandLine, projectsThatCannotBeUsedAreNamed) {
    const std::string input = clip(3);
    write("words.eyrie", "not a database at all, but long enough to be mistaken for one");
    const auto foreign = cli({"run", input, "--project", at("words.eyrie")});
    EXPECT_EQ(foreign.exit_code, 5) << foreign.errors;
    EXPECT_THAT(foreign.errors, HasSubstr("words.eyrie"));
    write("file", "x");
    const auto unwritable = cli({"run", input, "--project", at("file/p.eyrie")});
    EXPECT_EQ(unwritable.exit_code, 4) << unwritable.errors;
    const auto unwritable_csv = cli({"run", input, "--project", at("p.eyrie"), "--tracks", at("file/t.csv")});
    EXPECT_EQ(unwritable_csv.exit_code, 4) << unwritable_csv.errors;
}

TEST_F(CommandLine, aTruncatedVideoGivesWhatItHoldsOrSaysWhy) {
    EYRIE_NEED_SHARED_DATA("uavdt_m1303/clip.mp4");
    std::ifstream whole(test::sharedData("uavdt_m1303/clip.mp4"), std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(whole)), {});
    write("half.mp4", bytes.substr(0, bytes.size() / 2));
    const auto result = cli({"run", at("half.mp4"), "--frames", "0:5", "--gsd", "0.2", "--project", at("p.eyrie")});
    if (result.exit_code != 0) {
        EXPECT_EQ(result.exit_code, 3);
        EXPECT_THAT(result.errors, HasSubstr("half.mp4"));
    }
}

TEST_F(CommandLine, ctrlCStopsCleanlyAndKeepsWhatIsDone) {
    test::Process process({program, "run", "scene:demo", "--project", at("p.eyrie"), "--quiet"});
    waitForFrames(3);
    kill(process.pid(), SIGINT);
    const auto result = process.wait();
    EXPECT_EQ(result.exit_code, 130) << result.errors;
    EXPECT_THAT(result.output, HasSubstr("stopped"));
    ProjectFile project = ProjectFile::open(folder / "p.eyrie");
    EXPECT_EQ(RunStore(project).runs().at(0).state, RunState::stopped);
}

TEST_F(CommandLine, aKilledRunOpensAgainWithItsWholeFrames) {
    test::Process process({program, "run", "scene:demo", "--project", at("p.eyrie"), "--quiet"});
    waitForFrames(3);
    kill(process.pid(), SIGKILL);
    process.wait();
    const auto info = cli({"info", at("p.eyrie")});
    EXPECT_EQ(info.exit_code, 0) << info.errors;
    ProjectFile project = ProjectFile::open(folder / "p.eyrie");
    const RunStore store(project);
    const RunRecord run = store.runs().at(0);
    EXPECT_GE(run.frames_done, 3);
    EXPECT_TRUE(store.frameResult(run.id, run.frames_done - 1));
}

TEST_F(CommandLine, helpAndParametersAreThere) {
    for (const char* command : {"run", "evaluate", "render", "params", "bench", "info"}) {
        const auto result = cli({command, "--help"});
        EXPECT_EQ(result.exit_code, 0) << command;
        EXPECT_THAT(result.output, HasSubstr(command == std::string("params") ? "--json" : "Usage"));
    }
    EXPECT_THAT(cli({"--help"}).output, HasSubstr("Exit codes"));
    EXPECT_EQ(cli({"dance"}).exit_code, 2);
    EXPECT_EQ(cli({}).exit_code, 2);
    EXPECT_THAT(cli({"params"}).output, HasSubstr("gradient.quantile"));
    EXPECT_THAT(cli({"params", "--json"}).output, HasSubstr("\"motion.min_speed\""));
    EXPECT_EQ(cli({"params", "--preset", "thesis"}).exit_code, 0);
}

}  // namespace eyrie::command_line_test

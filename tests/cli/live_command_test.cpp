#include <gmock/gmock.h>
#include <signal.h>

#include <fstream>
#include <iterator>
#include <opencv2/imgproc.hpp>

#include "cli/loaded_program.h"
#include "io/video/video_writer.h"
#include "support/live_sender.h"
#include "support/live_server.h"
#include "support/moving_scene.h"
#include "support/places.h"
#include "support/process.h"
#include "support/temporary_folder.h"
#include "support/wait_until.h"

namespace eyrie::live_command_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class HandOver : public testing::Test {
 protected:
    std::string at(const std::string& name) const { return (folder_ / name).string(); }
    void film(int frames) const {
        test::MovingScene scene;
        scene.frames = frames;
        VideoWriterOptions options;
        options.key_frame_distance = 10;
        VideoWriter writer(at("film.ts"), scene.size, options);
        for (int i = 0; i < frames; ++i) {
            cv::Mat colour;
            cv::cvtColor(scene.draw(i), colour, cv::COLOR_GRAY2BGR);
            writer.write(colour);
        }
        writer.finish();
    }
    static std::vector<std::string> command(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), test::programPath("eyrie-cli"));
        return arguments;
    }
    static test::ProcessResult call(const std::vector<std::string>& arguments) { return test::runLoaded(arguments); }
    std::string address() const { return "udp://127.0.0.1:" + std::to_string(port_); }
    test::TemporaryFolder folder_;
    int port_ = test::freePort();
};

TEST_F(HandOver, ALiveSourceIsRecordedFollowedAndTold) {
    film(60);
    test::Process run(command({"run", address(), "--gsd", "0.2", "--set", "view.oblique=false", "--project",
                               at("live.eyrie"), "--give-up", "2", "--tracks", at("tracks.csv"), "--quiet"}));
    const test::LiveSender sender(port_, {{folder_ / "film.ts", 4, 1}});
    const test::ProcessResult result = run.wait();
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, AllOf(HasSubstr("finished"), HasSubstr("Recording: " + at("live.ts")),
                                     HasSubstr("Note: "), HasSubstr("no picture came for 2 s")));
    EXPECT_TRUE(std::filesystem::exists(at("tracks.csv")));
    EXPECT_EQ(call({"check", at("live.eyrie")}).exit_code, 0);
    // The recording is a video like any other, and its run one like any other.
    EXPECT_EQ(call({"info", at("live.ts")}).exit_code, 0);
    EXPECT_EQ(call({"events", "--project", at("live.eyrie")}).exit_code, 0);
}

TEST_F(HandOver, CtrlCEndsALiveRunAndKeepsIt) {
    film(200);
    test::Process run(command(
        {"run", address(), "--gsd", "0.2", "--set", "view.oblique=false", "--project", at("live.eyrie"), "--quiet"}));
    const test::LiveSender sender(port_, {{folder_ / "film.ts", 20, 1}});
    test::waitUntil("something is recorded", [&] {
        std::error_code absent;
        const auto size = std::filesystem::file_size(at("live.ts"), absent);
        return !absent && size >= 20'000;
    });
    kill(run.pid(), SIGINT);
    const test::ProcessResult result = run.wait();
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, HasSubstr("finished"));
}

TEST_F(HandOver, AnAddressThatNeverAnswersIsToldAndLeavesNoRun) {
    const test::ProcessResult result =
        call({"run", address(), "--project", at("live.eyrie"), "--wait", "0.6", "--quiet"});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.errors, HasSubstr("nothing that could be read came within 1 s"));
    EXPECT_FALSE(std::filesystem::exists(at("live.eyrie")));
    EXPECT_FALSE(std::filesystem::exists(at("live.ts")));
    EXPECT_EQ(call({"run", address(), "--frames", "0:10", "--project", at("live.eyrie")}).exit_code, 2);
    EXPECT_EQ(call({"run", address(), "--resume", "--project", at("live.eyrie")}).exit_code, 2);
    EXPECT_EQ(call({"run", address(), "--project", at("absent/live.eyrie"), "--wait", "0.6"}).exit_code, 4);
}

TEST_F(HandOver, ACameraThatIsNoneIsToldAndLeavesNoRun) {
    const auto absent = call({"run", "camera:/dev/no-such-camera", "--project", at("live.eyrie"), "--quiet"});
    EXPECT_EQ(absent.exit_code, 3);
    EXPECT_THAT(absent.errors, HasSubstr("/dev/no-such-camera: there is no such camera"));
    const auto other = call({"run", "camera:/dev/null", "--project", at("live.eyrie"), "--quiet"});
    EXPECT_EQ(other.exit_code, 3);
    EXPECT_THAT(other.errors, HasSubstr("/dev/null: this device is no camera"));
    EXPECT_FALSE(std::filesystem::exists(at("live.eyrie")));
    EXPECT_FALSE(std::filesystem::exists(at("live.ts")));
}

TEST_F(HandOver, WhatCannotBeRecordedLeavesNothing) {
    VideoWriterOptions options;
    options.codec = "mjpeg";
    VideoWriter writer(at("film.mkv"), {160, 120}, options);
    for (int i = 0; i < 10; ++i) writer.write(cv::Mat(120, 160, CV_8UC3, cv::Scalar::all(20 * i)));
    writer.finish();
    std::ifstream file(at("film.mkv"), std::ios::binary);
    const test::LiveServer server({std::string{std::istreambuf_iterator<char>(file), {}}});
    const auto result = call({"run", "tcp://" + server.place(), "--project", at("live.eyrie"), "--quiet"});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.errors, HasSubstr("mjpeg"));
    EXPECT_FALSE(std::filesystem::exists(at("live.eyrie")));
    EXPECT_FALSE(std::filesystem::exists(at("live.ts")));
}

TEST_F(HandOver, TheRecordingReplacesNothingAndIsNoOtherOutput) {
    const auto run = [&](const std::string& project, const std::string& tracks) {
        return call({"run", address(), "--project", at(project), "--tracks", at(tracks), "--wait", "0.6", "--force"});
    };
    const auto both = run("live.eyrie", "live.ts");
    EXPECT_EQ(both.exit_code, 4);
    EXPECT_THAT(both.errors, HasSubstr("live.ts: is named for two outputs"));
    EXPECT_EQ(run("live.ts", "t.csv").exit_code, 4) << "the recording would be the project";
    // One that is there gets a further name.
    std::ofstream(at("live.ts")) << "earlier";
    EXPECT_EQ(run("live.eyrie", "live-2.ts").exit_code, 4);
    EXPECT_EQ(run("live.eyrie", "live-3.ts").exit_code, 3) << "nobody sends";
}

TEST_F(HandOver, WhatIsOfUseWithALiveSourceOnlyIsRefusedWithAFile) {
    film(10);
    for (const char* option : {"--seconds", "--wait", "--give-up"}) {
        const auto result = call({"run", at("film.ts"), "--project", at("p.eyrie"), option, "5"});
        EXPECT_EQ(result.exit_code, 2) << option;
        EXPECT_THAT(result.errors, HasSubstr("for live sources"));
    }
    EXPECT_FALSE(std::filesystem::exists(at("p.eyrie")));
}

TEST_F(HandOver, TracksGoIntoACopyOfTheTransportStream) {
    film(40);
    ASSERT_EQ(call({"run", at("film.ts"), "--gsd", "0.2", "--set", "view.oblique=false", "--project", at("p.eyrie"),
                    "--quiet"})
                  .exit_code,
              0);
    const auto unknown = call({"export", "--project", at("p.eyrie"), "--format", "vmti", "--out", at("copy.ts")});
    EXPECT_EQ(unknown.exit_code, 3) << "nobody said when the video was taken";
    EXPECT_THAT(unknown.errors, HasSubstr("--start"));
    const auto written = call({"export", "--project", at("p.eyrie"), "--format", "vmti", "--out", at("copy.ts"),
                               "--start", "2026-11-21T08:00:00Z"});
    EXPECT_EQ(written.exit_code, 0) << written.errors;
    EXPECT_THAT(written.output, HasSubstr("VMTI sets of"));
    const auto held = call({"metadata", at("copy.ts")});
    EXPECT_THAT(held.output, HasSubstr("of moving targets (VMTI, ST 0903)"));
    EXPECT_EQ(call({"export", "--project", at("p.eyrie"), "--format", "vmti", "--out", at("film.ts"), "--start",
                    "2026-11-21T08:00:00Z", "--force"})
                  .exit_code,
              4)
        << "the original is never replaced";
    EXPECT_EQ(call({"export", "--from", at("film.ts"), "--format", "vmti", "--out", at("copy.ts")}).exit_code, 2);
    const auto detections = call({"export", "--project", at("p.eyrie"), "--detections", "--format", "vmti", "--out",
                                  at("other.ts"), "--start", "2026-11-21T08:00:00Z"});
    EXPECT_EQ(detections.exit_code, 2);
    EXPECT_THAT(detections.errors, HasSubstr("leave --detections out"));
}

TEST_F(HandOver, ARunThatKeptTracksOnlySaysSoWhereMoreIsAskedFor) {
    film(40);
    ASSERT_EQ(call({"run", at("film.ts"), "--gsd", "0.2", "--set", "view.oblique=false", "--project", at("p.eyrie"),
                    "--quiet", "--set", "recording.details=none"})
                  .exit_code,
              0);
    EXPECT_EQ(call({"export", "--project", at("p.eyrie"), "--format", "tracks-csv", "--out", at("t.csv")}).exit_code,
              0);
    const auto detections =
        call({"export", "--project", at("p.eyrie"), "--detections", "--format", "native-result", "--out", at("d.csv")});
    EXPECT_EQ(detections.exit_code, 3);
    EXPECT_THAT(detections.errors, AllOf(HasSubstr("keeps tracks only"), HasSubstr("recording.details=all")));
}

}  // namespace
}  // namespace eyrie::live_command_test

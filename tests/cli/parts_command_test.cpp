#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "cli/loaded_program.h"
#include "io/video/video_writer.h"
#include "store/labels/annotation_store.h"
#include "store/project/project_file.h"
#include "store/runs/run_store.h"
#include "support/moving_scene.h"
#include "support/places.h"
#include "support/process.h"
#include "support/wait_until.h"

namespace eyrie::parts_command_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr int kFrames = 60;

/// Frames [first, last) of the scene without loss, so that parts hold the pixels of the whole.
void film(const std::filesystem::path& path, int first, int last, double rate_hz = 25, cv::Size size = {320, 240}) {
    test::MovingScene scene;
    scene.frames = kFrames;
    VideoWriterOptions options;
    options.quality = 0;
    options.frame_rate_hz = rate_hz;
    VideoWriter writer(path, size, options);
    for (int frame = first; frame < last; ++frame) {
        cv::Mat picture;
        cv::cvtColor(scene.draw(frame)(cv::Rect({0, 0}, size)), picture, cv::COLOR_GRAY2BGR);
        writer.write(picture);
    }
    writer.finish();
}

std::string textOf(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

class PartsCommand : public testing::Test {
 protected:
    PartsCommand() {
        film(folder_ / "rec_1.mp4", 0, 25);
        film(folder_ / "rec_2.mp4", 25, 32);
        film(folder_ / "rec_3.mp4", 32, kFrames);
    }
    std::string at(const std::string& name) const { return (folder_ / name).string(); }
    std::vector<std::string> onParts(const std::string& command, const std::vector<std::string>& more = {}) const {
        std::vector<std::string> words{command, at("rec_1.mp4"), at("rec_2.mp4"), at("rec_3.mp4")};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    std::vector<std::string> runOfParts(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> words =
            onParts("run", {"--project", at("p.eyrie"), "--gsd", "0.2", "--set", "view.oblique=false", "--quiet"});
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    static test::ProcessResult call(const std::vector<std::string>& arguments) { return test::runLoaded(arguments); }
    /// The tracks of the same pictures in one file. The rate is given: measured over other spans it differs in its last
    /// digit.
    std::string tracksOfTheWhole() const {
        film(folder_ / "whole.mp4", 0, kFrames);
        const auto result = call({"run", at("whole.mp4"), "--project", at("whole.eyrie"), "--gsd", "0.2", "--set",
                                  "view.oblique=false", "--quiet", "--fps", "25", "--tracks", at("whole.csv")});
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        return textOf(at("whole.csv"));
    }
    int framesDone() const {
        try {
            ProjectFile file = ProjectFile::open(at("p.eyrie"), ProjectFile::Mode::read_only);
            const auto runs = RunStore(file).runs();
            return runs.empty() ? 0 : runs.back().frames_done;
        } catch (const std::exception&) {
            return 0;
        }
    }

    test::TemporaryFolder folder_;
};

}  // namespace

TEST_F(PartsCommand, aRunOverPartsIsThatOverTheWhole) {
    const auto result = test::runLoaded(runOfParts({"--fps", "25", "--tracks", at("parts.csv")}));
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const std::string tracks = textOf(at("parts.csv"));
    EXPECT_GT(std::count(tracks.begin(), tracks.end(), '\n'), 60) << "something was found";
    EXPECT_EQ(tracks, tracksOfTheWhole()) << "registration and tracks go on over the seams";
}

TEST_F(PartsCommand, theListIsKeptBesideTheProjectAndIsTheVideoOfLaterRuns) {
    ASSERT_EQ(test::runLoaded(runOfParts({"--frames", ":9"})).exit_code, 0);
    const std::string list = textOf(at("p.parts"));
    EXPECT_THAT(list,
                AllOf(HasSubstr("file,start_utc,frames,bytes,digest\nrec_1.mp4,,25,"), HasSubstr("\nrec_3.mp4,,28,")));
    ASSERT_EQ(test::runLoaded(runOfParts({"--frames", "30:40"})).exit_code, 0);
    ASSERT_EQ(
        call({"run", at("p.parts"), "--project", at("p.eyrie"), "--gsd", "0.2", "--frames", ":5", "--quiet"}).exit_code,
        0);
    EXPECT_EQ(textOf(at("p.parts")), list);
    ProjectFile file = ProjectFile::open(at("p.eyrie"), ProjectFile::Mode::read_only);
    const auto videos = sequencesOf(file);
    ASSERT_EQ(videos.size(), 1U);
    EXPECT_EQ(videos.front().path, at("p.parts"));
    EXPECT_EQ(videos.front().frame_count, kFrames);
    EXPECT_EQ(RunStore(file).runs().size(), 3U);
}

TEST_F(PartsCommand, aRunThatWasKilledIsGoneOnWithOverTheSeams) {
    std::vector<std::string> words = runOfParts({"--fps", "25"});
    words.insert(words.begin(), test::programPath("eyrie-cli"));
    test::Process process(words);
    test::waitUntil("28 frames are done", [&] { return framesDone() >= 28; });
    kill(process.pid(), SIGKILL);
    process.wait();
    const auto resumed = call({"run", "--resume", "--project", at("p.eyrie"), "--tracks", at("parts.csv"), "--quiet"});
    ASSERT_EQ(resumed.exit_code, 0) << resumed.errors;
    EXPECT_EQ(textOf(at("parts.csv")), tracksOfTheWhole());
    const auto again = test::runLoaded(runOfParts({"--fps", "25", "--resume"}));
    EXPECT_EQ(again.exit_code, 0) << again.errors;
    ProjectFile file = ProjectFile::open(at("p.eyrie"), ProjectFile::Mode::read_only);
    EXPECT_EQ(RunStore(file).runs().size(), 1U) << "the same files with --resume are the same video";
}

TEST_F(PartsCommand, aPartThatIsGoneIsNamedUntilItLiesBesideTheList) {
    std::filesystem::create_directory(folder_ / "out");
    ASSERT_EQ(call({"run", at("rec_1.mp4"), at("rec_2.mp4"), at("rec_3.mp4"), "--project", at("out/p.eyrie"), "--gsd",
                    "0.2", "--frames", ":5", "--quiet"})
                  .exit_code,
              0);
    std::filesystem::rename(at("rec_2.mp4"), at("away.mp4"));
    const std::vector<std::string> clip{"clip",     "--project", at("out/p.eyrie"), "--run",       "1",
                                        "--frames", "1:4",       "--out",           at("clip.mp4")};
    const auto missing = call(clip);
    EXPECT_EQ(missing.exit_code, 3);
    EXPECT_THAT(missing.errors,
                AllOf(HasSubstr("part 2 of 3, " + at("rec_2.mp4") + ", is not there"), HasSubstr("beside the list")));
    std::filesystem::rename(at("away.mp4"), at("out/rec_2.mp4"));
    EXPECT_EQ(call(clip).exit_code, 0);
}

TEST_F(PartsCommand, partsThatAreNotAlikeAreRefusedBeforeAnythingIsWritten) {
    film(folder_ / "rec_2.mp4", 25, 32, 25, {300, 240});
    const auto size = test::runLoaded(runOfParts());
    EXPECT_EQ(size.exit_code, 3);
    EXPECT_THAT(size.errors, HasSubstr("rec_2.mp4, is 300×240 px, the parts before it 320×240 px"));
    film(folder_ / "rec_2.mp4", 25, 32, 50);
    const auto rate = test::runLoaded(runOfParts());
    EXPECT_EQ(rate.exit_code, 3);
    EXPECT_THAT(rate.errors, AllOf(HasSubstr("rec_2.mp4, has 50 frames/s"), HasSubstr("--fps")));
    EXPECT_FALSE(std::filesystem::exists(at("p.eyrie")));
    EXPECT_FALSE(std::filesystem::exists(at("p.parts")));
    EXPECT_EQ(test::runLoaded(runOfParts({"--fps", "25", "--frames", ":3"})).exit_code, 0);
    ASSERT_EQ(test::runLoaded(runOfParts({"--frames", ":3"})).exit_code, 3) << "the files themselves still differ";
    EXPECT_EQ(
        call({"run", at("p.parts"), "--project", at("p.eyrie"), "--frames", ":3", "--gsd", "0.2", "--quiet"}).exit_code,
        0)
        << "the project remembers the rate";
}

TEST_F(PartsCommand, whatCannotBeAPartIsRefused) {
    const auto twice = call({"run", at("rec_1.mp4"), at("rec_1.mp4"), "--project", at("p.eyrie")});
    EXPECT_EQ(twice.exit_code, 3);
    EXPECT_THAT(twice.errors, HasSubstr("is given twice"));
    EXPECT_EQ(call({"run", at("rec_1.mp4"), "scene:seq1", "--project", at("p.eyrie")}).exit_code, 2);
    EXPECT_EQ(call({"run", at("rec_1.mp4"), "udp://127.0.0.1:5000", "--project", at("p.eyrie")}).exit_code, 2);
    const auto own = test::runLoaded(runOfParts({"--annotated", at("rec_3.mp4"), "--force"}));
    EXPECT_EQ(own.exit_code, 4);
    EXPECT_THAT(own.errors, HasSubstr("rec_3.mp4: is read by this command"));
    ASSERT_EQ(test::runLoaded(runOfParts({"--frames", ":3"})).exit_code, 0);
    const auto listed =
        call({"run", at("p.parts"), "--project", at("p.eyrie"), "--annotated", at("rec_3.mp4"), "--force"});
    EXPECT_EQ(listed.exit_code, 4);
    EXPECT_THAT(listed.errors, HasSubstr("rec_3.mp4: is read by this command"));
}

TEST_F(PartsCommand, infoTellsThePartsAndWritesTheirList) {
    const auto told = test::runLoaded(onParts("info", {"--list", at("day.parts"), "--json"}));
    ASSERT_EQ(told.exit_code, 0) << told.errors;
    const auto facts = nlohmann::json::parse(told.output);
    EXPECT_EQ(facts["file"], at("day.parts"));
    EXPECT_EQ(facts["frames"], kFrames);
    ASSERT_EQ(facts["parts"].size(), 3U);
    EXPECT_EQ(facts["parts"][2]["file"], at("rec_3.mp4"));
    EXPECT_EQ(facts["parts"][2]["first_frame"], 32);
    EXPECT_EQ(facts["parts"][2]["frames"], 28);
    EXPECT_EQ(facts["parts"][2]["first_s"], 1.28);
    EXPECT_TRUE(facts["parts"][2]["start_utc"].is_null());
    const auto listed = call({"info", at("day.parts")});
    EXPECT_EQ(listed.exit_code, 0);
    EXPECT_THAT(listed.output, HasSubstr("frames 25 to 31: " + at("rec_2.mp4")));
    EXPECT_EQ(test::runLoaded(onParts("info", {"--list", at("day.parts")})).exit_code, 4) << "never without --force";
    EXPECT_EQ(test::runLoaded(onParts("info", {"--list", at("day.parts"), "--force"})).exit_code, 0);
    EXPECT_EQ(test::runLoaded(onParts("info", {"--list", at("day.csv")})).exit_code, 2);
    EXPECT_EQ(call({"info", at("rec_1.mp4"), "--list", at("one.parts")}).exit_code, 2);
}

TEST_F(PartsCommand, clockTimesShowWhatWasNotRecordedBetweenTwoParts) {
    ASSERT_EQ(test::runLoaded(runOfParts()).exit_code, 0);
    std::string list = textOf(at("p.parts"));
    list.replace(list.find("rec_1.mp4,,"), 11, "rec_1.mp4,2026-11-21T08:00:00Z,");
    list.replace(list.find("rec_3.mp4,,"), 11, "rec_3.mp4,2026-11-21T09:00:00Z,");
    std::ofstream(at("p.parts")) << list;
    const auto exported =
        call({"export", "--project", at("p.eyrie"), "--run", "1", "--format", "tracks-csv", "--out", at("tracks.csv")});
    ASSERT_EQ(exported.exit_code, 0) << exported.errors;
    const std::string tracks = textOf(at("tracks.csv"));
    EXPECT_THAT(tracks, HasSubstr(",31,1.24,2026-11-21T08:00:01.240000Z,"));
    EXPECT_THAT(tracks, HasSubstr(",32,1.28,2026-11-21T09:00:00.000000Z,"));
}

TEST_F(PartsCommand, metadataAreLookedForInAllParts) {
    const auto told = test::runLoaded(onParts("metadata"));
    EXPECT_EQ(told.exit_code, 0) << told.errors;
    EXPECT_THAT(told.output, AllOf(HasSubstr("rec_1-rec_3.parts"), HasSubstr("No metadata (KLV)")));
}

}  // namespace eyrie::parts_command_test

#include "io/video/video_writer.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "io/numbered_video.h"
#include "support/temporary_folder.h"

namespace eyrie::video_writer_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class VideoWriterTest : public testing::Test {
 protected:
    int entries() const {
        return static_cast<int>(std::distance(std::filesystem::directory_iterator(folder_.path()), {}));
    }
    test::TemporaryFolder folder_;
};

TEST_F(VideoWriterTest, OddSizesGrowByARowOrColumn) {
    test::writeNumberedVideo(folder_ / "a.mp4", 3, {}, {161, 63});
    const auto source = openSource(folder_ / "a.mp4");
    EXPECT_EQ(source->info().size, cv::Size(162, 64));
    EXPECT_EQ(test::numberIn(source->read(2, false).gray), 2);
}

TEST_F(VideoWriterTest, KeepsTheFrameRate) {
    VideoWriterOptions options;
    options.frame_rate_hz = 30000.0 / 1001;
    test::writeNumberedVideo(folder_ / "a.mp4", 31, options);
    EXPECT_NEAR(openSource(folder_ / "a.mp4")->info().frame_rate_hz, 29.97, 1e-3);
}

TEST_F(VideoWriterTest, TheFileAppearsWhenItIsComplete) {
    VideoWriter writer(folder_ / "a.mp4", {160, 64});
    writer.write(test::numberedImage(0));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.mp4"));
    writer.finish();
    EXPECT_TRUE(std::filesystem::exists(folder_ / "a.mp4"));
    EXPECT_EQ(entries(), 1);
}

TEST_F(VideoWriterTest, WhatAKilledProcessLeftOfTheSameVideoIsRemoved) {
    const pid_t gone = ::fork();
    if (gone == 0) ::_exit(0);
    ::waitpid(gone, nullptr, 0);
    const std::string live = std::to_string(::getppid());
    for (const std::string& name : {"a.mp4." + std::to_string(gone) + "-1.part", "a.mp4." + live + "-1.part",
                                    "b.mp4." + std::to_string(gone) + "-1.part"}) {
        std::ofstream(folder_ / name) << "half a video";
    }
    test::writeNumberedVideo(folder_ / "a.mp4", 3);
    EXPECT_FALSE(std::filesystem::exists(folder_ / ("a.mp4." + std::to_string(gone) + "-1.part")));
    EXPECT_TRUE(std::filesystem::exists(folder_ / ("a.mp4." + live + "-1.part"))) << "its process works";
    EXPECT_TRUE(std::filesystem::exists(folder_ / ("b.mp4." + std::to_string(gone) + "-1.part"))) << "another video";
}

TEST_F(VideoWriterTest, FoldersThatCannotBeWrittenAreRefused) {
    EXPECT_THAT(test::messageOf(ErrorKind::output,
                                [&] {
                                    VideoWriter(folder_ / "none" / "a.mp4", {160, 64});
                                }),
                AllOf(HasSubstr("a.mp4"), HasSubstr("cannot be written")));
}

TEST_F(VideoWriterTest, UnknownExtensionsAreRefused) {
    EXPECT_THAT(test::messageOf(ErrorKind::output,
                                [&] {
                                    VideoWriter(folder_ / "a.video", {160, 64});
                                }),
                HasSubstr(".mp4"));
    EXPECT_EQ(entries(), 0);
}

TEST_F(VideoWriterTest, AFolderInTheWayIsRefused) {
    std::filesystem::create_directory(folder_ / "a.mp4");
    EXPECT_THAT(test::messageOf(ErrorKind::output,
                                [&] {
                                    VideoWriter(folder_ / "a.mp4", {160, 64});
                                }),
                HasSubstr("is a folder"));
}

TEST_F(VideoWriterTest, FramesOfAnotherSizeAreADefect) {
    VideoWriter writer(folder_ / "a.mp4", {160, 64});
    test::messageOf(ErrorKind::internal, [&] { writer.write(cv::Mat(10, 10, CV_8UC3)); });
    test::messageOf(ErrorKind::internal, [&] { writer.write(cv::Mat(64, 160, CV_8UC1)); });
}

}  // namespace
}  // namespace eyrie::video_writer_test

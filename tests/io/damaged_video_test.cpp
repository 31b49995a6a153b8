#include <gmock/gmock.h>

#include <opencv2/imgproc.hpp>

#include "io/numbered_video.h"
#include "io/video/video_decoder.h"
#include "support/shared_data.h"
#include "support/temporary_folder.h"

namespace eyrie::damaged_video_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class DamagedVideo : public testing::Test {
 protected:
    std::unique_ptr<FrameSource> open(const std::filesystem::path& path) {
        SourceOptions options;
        options.index_folder = folder_ / "index";
        return openSource(path, options);
    }
    std::string refusal(const std::filesystem::path& path) {
        return test::messageOf(ErrorKind::input, [&] { open(path); });
    }
    /// A copy with only the first part of a file.
    std::filesystem::path cut(const std::filesystem::path& path, double share) {
        const std::string bytes = test::bytesOf(path);
        const auto copy = folder_ / ("cut-" + path.filename().string());
        test::writeBytes(copy, bytes.substr(0, static_cast<std::size_t>(static_cast<double>(bytes.size()) * share)));
        return copy;
    }
    test::TemporaryFolder folder_;
};

TEST_F(DamagedVideo, MissingFileIsNamed) {
    EXPECT_THAT(refusal(folder_ / "none.mp4"), AllOf(HasSubstr("none.mp4"), HasSubstr("no such file")));
}

TEST_F(DamagedVideo, EmptyFile) {
    test::writeBytes(folder_ / "empty.mp4", "");
    EXPECT_THAT(refusal(folder_ / "empty.mp4"), AllOf(HasSubstr("empty.mp4"), HasSubstr("is empty")));
}

TEST_F(DamagedVideo, TextIsNoVideo) {
    std::string text;
    for (int i = 0; i < 2000; ++i) text += "This is not a video.\n";
    for (const char* name : {"text.mp4", "text.txt", "text"}) {
        test::writeBytes(folder_ / name, text);
        EXPECT_THAT(refusal(folder_ / name),
                    AllOf(HasSubstr(name), testing::AnyOf(HasSubstr("not a video"), HasSubstr("no video track"))));
    }
}

TEST_F(DamagedVideo, WhatIsNoVideoNamesWhatTakesIt) {
    test::writeBytes(folder_ / "boxes.CSV", "frame,id,x,y\n");
    EXPECT_THAT(refusal(folder_ / "boxes.CSV"), AllOf(HasSubstr("boxes.CSV"), HasSubstr("import")));
    test::writeBytes(folder_ / "p.eyrie", "anything");
    EXPECT_THAT(refusal(folder_ / "p.eyrie"), AllOf(HasSubstr("p.eyrie"), HasSubstr("--project")));
    test::writeBytes(folder_ / "renamed.mp4", "SQLite format 3 and so on");
    EXPECT_THAT(refusal(folder_ / "renamed.mp4"), HasSubstr("is a project"));
    test::writeBytes(folder_ / "labels.mp4", "[{\"frame\": 1}]");
    EXPECT_THAT(refusal(folder_ / "labels.mp4"), HasSubstr("is a JSON file, not a video"));
    test::writeBytes(folder_ / "list.m3u8", "#EXTM3U\n");  // names videos, so it is theirs to judge
    EXPECT_THAT(refusal(folder_ / "list.m3u8"), testing::Not(HasSubstr("import")));
}

TEST_F(DamagedVideo, NoiseIsNoVideo) {
    std::string bytes(50000, ' ');
    unsigned state = 1;
    for (char& c : bytes) c = static_cast<char>((state = state * 1664525U + 1013904223U) >> 24U);
    test::writeBytes(folder_ / "noise.ts", bytes);
    EXPECT_THAT(refusal(folder_ / "noise.ts"), HasSubstr("noise.ts"));
}

TEST_F(DamagedVideo, AnIndexAtTheEndIsLostWhenTruncated) {
    test::writeNumberedVideo(folder_ / "a.mp4", 60);
    EXPECT_THAT(refusal(cut(folder_ / "a.mp4", 0.6)), AllOf(HasSubstr("cut-a.mp4"), HasSubstr("cut off")));
}

TEST_F(DamagedVideo, TruncatedFilesAreReadAsFarAsTheyGo) {
    for (const char* file : {"a.ts", "a.mkv", "a.mpg"}) {
        VideoWriterOptions options;
        options.codec = std::string(file) == "a.mpg" ? "mpeg2video" : "libx264";
        options.key_frame_distance = 15;
        options.b_frames = 2;
        test::writeNumberedVideo(folder_ / file, 200, options);
        const auto source = open(cut(folder_ / file, 0.6));
        const int frames = source->info().frame_count;
        EXPECT_GT(frames, 90) << file;
        EXPECT_LT(frames, 150) << file;
        EXPECT_NEAR(source->info().frame_rate_hz, 25, 0.1) << file;
        // The last pictures may miss a part or be missing; none before them.
        for (int i = 0; i < frames - 5; ++i) EXPECT_EQ(test::numberIn(source->read(i, false).gray), i) << file;
        for (int i = frames - 5; i < frames; ++i) EXPECT_NO_THROW(source->read(i, true)) << file;
    }
}

TEST_F(DamagedVideo, ARecordingThatStartsAmidAGroupBeginsWithItsFirstWholePicture) {
    VideoWriterOptions options;
    options.codec = "mpeg2video";
    options.key_frame_distance = 15;
    options.b_frames = 2;
    test::writeNumberedVideo(folder_ / "a.ts", 100, options);
    const std::string bytes = test::bytesOf(folder_ / "a.ts");
    const std::size_t packet = 188;
    test::writeBytes(folder_ / "late.ts", bytes.substr(bytes.size() / packet / 3 * packet));
    const auto source = open(folder_ / "late.ts");
    const int frames = source->info().frame_count;
    ASSERT_GT(frames, 30);
    const int first = test::numberIn(source->read(0, false).gray);
    EXPECT_EQ(first + frames, 100);
    for (int i = 0; i < frames; ++i) EXPECT_EQ(test::numberIn(source->read(i, false).gray), first + i);
    EXPECT_EQ(source->timeOf(0), 0);
}

TEST_F(DamagedVideo, APictureThatCannotBeDecodedIsNamedAndTheNextIsRead) {
    VideoWriterOptions options;
    options.codec = "mjpeg";
    test::writeNumberedVideo(folder_ / "a.avi", 20, options);
    std::string bytes = test::bytesOf(folder_ / "a.avi");
    std::size_t picture = 0;
    for (int i = 0; i <= 7; ++i) picture = bytes.find("\xFF\xD8", picture + 1);
    const std::size_t next_chunk = bytes.find("\xFF\xD8", picture + 1) - 8;
    std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(picture),
              bytes.begin() + static_cast<std::ptrdiff_t>(next_chunk), '\0');
    test::writeBytes(folder_ / "bad.avi", bytes);
    const auto source = open(folder_ / "bad.avi");
    ASSERT_EQ(source->info().frame_count, 20);
    for (int i = 0; i < 20; ++i) {
        if (i == 7) {
            EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { source->read(i, false); }),
                        AllOf(HasSubstr("bad.avi"), HasSubstr("frame 7")));
        } else {
            EXPECT_EQ(test::numberIn(source->read(i, false).gray), i);
        }
    }
}

TEST_F(DamagedVideo, SoundAloneIsNoVideo) {
    // A wave file of silence.
    std::string bytes(
        "RIFF\x24\x40\x00\x00WAVEfmt \x10\x00\x00\x00\x01\x00\x01\x00\x40\x1F\x00\x00\x80\x3E\x00\x00\x02\x00\x10\x00"
        "data\x00\x40\x00\x00",
        44);
    bytes.append(16384, '\0');
    test::writeBytes(folder_ / "sound.wav", bytes);
    EXPECT_THAT(refusal(folder_ / "sound.wav"), AllOf(HasSubstr("sound.wav"), HasSubstr("no video track")));
}

TEST_F(DamagedVideo, ChangingSizeIsNamedWithFrameAndBothSizes) {
    VideoWriterOptions options;
    options.b_frames = 0;
    test::writeNumberedVideo(folder_ / "one.ts", 10, options, {160, 64});
    test::writeNumberedVideo(folder_ / "two.ts", 10, options, {200, 80}, 10);
    test::writeBytes(folder_ / "both.ts", test::bytesOf(folder_ / "one.ts") + test::bytesOf(folder_ / "two.ts"));
    const auto source = open(folder_ / "both.ts");
    ASSERT_EQ(source->info().frame_count, 20);
    EXPECT_EQ(source->info().size, cv::Size(160, 64));
    EXPECT_EQ(test::numberIn(source->read(9, false).gray), 9);
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { source->read(12, false); }),
                AllOf(HasSubstr("both.ts"), HasSubstr("frame 12"), HasSubstr("200×80"), HasSubstr("160×64")));
    EXPECT_EQ(test::numberIn(source->read(2, false).gray), 2);
}

int failsToRead(void*, std::uint8_t*, int) {
    return AVERROR(EIO);
}

int countPackets(const std::filesystem::path& path, AVFormatContext& demuxer) {
    const libav::Packet packet(av_packet_alloc());
    int count = 0;
    for (; readNext(path, demuxer, *packet); ++count) av_packet_unref(packet.get());
    return count;
}

TEST_F(DamagedVideo, ADiskThatFailsAmidAVideoIsNotItsEnd) {
    for (const char* name : {"whole.mp4", "whole.ts"}) {
        const auto path = folder_ / name;
        test::writeNumberedVideo(path, 400, {}, {320, 240});
        EXPECT_EQ(countPackets(path, *openContainer(path)), 400) << "its end is its end";
        const libav::Demuxer failing = openContainer(path);
        failing->pb->read_packet = failsToRead;
        EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { countPackets(path, *failing); }),
                    AllOf(HasSubstr(name), HasSubstr("cannot be read to its end"), HasSubstr("check the disk")));
    }
    const auto end = openContainer(cut(folder_ / "whole.ts", 0.6));
    const int left = countPackets(folder_ / "cut-whole.ts", *end);
    EXPECT_GT(left, 100) << "what was cut off has an end";
    EXPECT_LT(left, 400);
}

TEST_F(DamagedVideo, TwoRecordingsInOneFileKeepTheirOrder) {
    test::writeNumberedVideo(folder_ / "one.ts", 30);
    test::writeNumberedVideo(folder_ / "two.ts", 30, {}, {160, 64}, 30);
    test::writeBytes(folder_ / "both.ts", test::bytesOf(folder_ / "one.ts") + test::bytesOf(folder_ / "two.ts"));
    const auto source = open(folder_ / "both.ts");
    ASSERT_EQ(source->info().frame_count, 60);
    for (const int i : {0, 59, 29, 30, 31, 45, 3}) EXPECT_EQ(test::numberIn(source->read(i, false).gray), i);
    for (int i = 1; i < 60; ++i) EXPECT_GT(source->timeOf(i), source->timeOf(i - 1));
}

TEST_F(DamagedVideo, RealClipCutAt60PerCentNeverCrashes) {
    EYRIE_NEED_SHARED_DATA("klv");
    for (const char* file : {"mpeg2_klv.ts", "h265_tricky_klv.ts", "h264_klv.ts"}) {
        const auto source = open(cut(test::sharedData("klv") / file, 0.6));
        EXPECT_GT(source->info().frame_count, 5) << file;
        for (int i = 0; i < source->info().frame_count; ++i) EXPECT_NO_THROW(source->read(i, false)) << file << i;
    }
}

}  // namespace
}  // namespace eyrie::damaged_video_test

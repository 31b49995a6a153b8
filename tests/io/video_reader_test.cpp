#include "io/video/video_reader.h"

#include <gmock/gmock.h>

#include <opencv2/imgcodecs.hpp>
#include <random>

#include "io/numbered_video.h"
#include "support/shared_data.h"
#include "support/temporary_folder.h"

namespace eyrie::video_reader_test {
namespace {

using testing::HasSubstr;

struct Format {
    const char* name;
    const char* file;
    VideoWriterOptions options;
    bool is_exact = true;  ///< pictures do not depend on where decoding began
};

void PrintTo(const Format& format, std::ostream* out) {
    *out << format.name;
}

bool readsTo(FrameSource& source, FrameIndex index) {
    try {
        source.read(index, false);
        return true;
    } catch (const ReadingGivenUp&) {
        return false;
    }
}

class EveryFormat : public testing::TestWithParam<Format> {
 protected:
    std::unique_ptr<FrameSource> open(int frames) {
        const auto path = folder_ / GetParam().file;
        test::writeNumberedVideo(path, frames, GetParam().options);
        SourceOptions options;
        options.index_folder = folder_ / "index";
        return openSource(path, options);
    }
    test::TemporaryFolder folder_;
};

TEST_P(EveryFormat, DeliversEachFrameInOrderAtItsTime) {
    const auto source = open(80);
    ASSERT_EQ(source->info().frame_count, 80);
    EXPECT_NEAR(source->info().frame_rate_hz, 25, 0.1);
    EXPECT_FALSE(source->info().variable_frame_rate);
    for (int i = 0; i < 80; ++i) {
        const Frame frame = source->read(i, false);
        EXPECT_EQ(test::numberIn(frame.gray), i);
        EXPECT_EQ(frame.index, i);
        EXPECT_NEAR(static_cast<double>(frame.time_us), i * 40000.0, 1000);  // Matroska rounds to milliseconds
        EXPECT_EQ(frame.time_us, source->timeOf(i));
    }
}

TEST_P(EveryFormat, ARememberedRateCountsOnlyWhereItIsNotTheVideosOwn) {
    const auto own = open(12);
    SourceOptions options;
    options.index_folder = folder_ / "index";
    options.remembered_rate_hz = own->info().frame_rate_hz * 1.0001;  // as a project keeps it
    const auto same = openSource(own->info().path, options);
    EXPECT_EQ(same->info().frame_rate_hz, own->info().frame_rate_hz);
    EXPECT_EQ(same->timeOf(7), own->timeOf(7));
    options.remembered_rate_hz = 50;
    const auto other = openSource(own->info().path, options);
    EXPECT_EQ(other->info().frame_rate_hz, 50);
    EXPECT_EQ(other->timeOf(7), 140'000);
}

TEST_P(EveryFormat, JumpsToExactlyTheFrameAskedFor) {
    const auto source = open(80);
    std::mt19937 random(7);
    std::uniform_int_distribution<int> any(0, 79);
    for (int k = 0; k < 30; ++k) {
        const int i = any(random);
        EXPECT_EQ(test::numberIn(source->read(i, false).gray), i);
    }
    for (int i = 79; i > 50; --i) EXPECT_EQ(test::numberIn(source->read(i, false).gray), i) << "stepping back";
}

TEST_P(EveryFormat, AfterAReadingThatWasGivenUpAnyFrameIsWhatItWas) {
    const auto source = open(80);
    std::vector<cv::Mat> sequential;
    sequential.reserve(80);
    for (int i = 0; i < 80; ++i) sequential.push_back(source->read(i, false).gray);
    std::mt19937 random(5);
    int left = 0;
    int given_up = 0;
    source->giveUpWhen([&] { return left-- <= 0; });
    for (int k = 0; k < 60; ++k) {
        left = static_cast<int>(random() % 20);
        given_up += readsTo(*source, static_cast<int>(random() % 80)) ? 0 : 1;
        left = 1000;
        const int index = static_cast<int>(random() % 80);
        const cv::Mat gray = source->read(index, false).gray;
        EXPECT_EQ(test::numberIn(gray), index);
        const double difference = cv::norm(gray, sequential[static_cast<std::size_t>(index)], cv::NORM_INF);
        EXPECT_TRUE(difference == 0 || !GetParam().is_exact) << "frame " << index;
    }
    EXPECT_TRUE(given_up > 0 || GetParam().options.key_frame_distance == 1);
}

TEST_P(EveryFormat, RandomAccessGivesThePixelsOfSequentialReading) {
    const auto source = open(80);
    std::vector<cv::Mat> sequential;
    for (int i = 0; i < 80; ++i) sequential.push_back(source->read(i, false).gray);
    for (const int i : {63, 12, 13, 79, 0, 24, 23, 26, 50, 49, 3}) {
        const Frame frame = source->read(i, true);
        const cv::Mat& expected = sequential[static_cast<std::size_t>(i)];
        if (GetParam().is_exact) {
            EXPECT_EQ(cv::norm(frame.gray, expected, cv::NORM_INF), 0) << "frame " << i;
        } else {
            EXPECT_LT(cv::norm(frame.gray, expected, cv::NORM_L1) / static_cast<double>(expected.total()), 0.5);
        }
    }
}

VideoWriterOptions coded(const std::string& codec, int key_frame_distance, int b_frames, const std::string& more = {}) {
    VideoWriterOptions options;
    options.codec = codec;
    options.key_frame_distance = key_frame_distance;
    options.b_frames = b_frames;
    options.encoder_options = more;
    return options;
}

// Open groups of pictures: frames are shown before the key frame that they follow in the file.
INSTANTIATE_TEST_SUITE_P(
    Codecs, EveryFormat,
    testing::Values(
        Format{"h264", "a.mp4", coded("libx264", 24, 3)},
        Format{"h264_only_one_key", "a.mp4", coded("libx264", 250, 2)},
        Format{"h264_without_b", "a.mkv", coded("libx264", 12, 0)},
        Format{"h264_open_mp4", "a.mp4", coded("libx264", 24, 3, "x264-params=open-gop=1")},
        Format{"h264_open_mkv", "a.mkv", coded("libx264", 24, 3, "x264-params=open-gop=1")},
        Format{"h264_open_ts", "a.ts", coded("libx264", 24, 3, "x264-params=open-gop=1")},
        Format{"h264_intra_refresh", "a.mp4", coded("libx264", 24, 0, "x264-params=intra-refresh=1"), false},
        Format{"h264_no_container", "a.h264", coded("libx264", 24, 3, "x264-params=open-gop=1")},
        Format{"h265_open_ts", "a.ts", coded("libx265", 24, 4, "x265-params=open-gop=1\\:log-level=none")},
        Format{"h265_open_mp4", "a.mp4", coded("libx265", 24, 4, "x265-params=open-gop=1\\:log-level=none")},
        Format{"mpeg2_ts", "a.ts", coded("mpeg2video", 15, 2)}, Format{"mpeg2_ps", "a.mpg", coded("mpeg2video", 15, 2)},
        Format{"mpeg4_avi_without_stamps", "a.avi", coded("mpeg4", 12, 2)},
        Format{"mjpeg", "a.avi", coded("mjpeg", 1, 0)}),
    [](const auto& test) { return std::string(test.param.name); });

class Video : public testing::Test {
 protected:
    std::unique_ptr<FrameSource> open(const std::filesystem::path& path, double frame_rate_hz = 0) {
        SourceOptions options;
        options.index_folder = folder_ / "index";
        options.frame_rate_hz = frame_rate_hz;
        return openSource(path, options);
    }
    test::TemporaryFolder folder_;
};

TEST_F(Video, TellsItsFacts) {
    test::writeNumberedVideo(folder_ / "a.mp4", 12);
    const auto source = open(folder_ / "a.mp4");
    const VideoInfo& info = source->info();
    EXPECT_TRUE(info.path.is_absolute());
    EXPECT_EQ(info.size, cv::Size(160, 64));
    EXPECT_EQ(info.frame_count, 12);
    EXPECT_EQ(info.codec, "h264");
    EXPECT_THAT(info.container, HasSubstr("mp4"));
    EXPECT_FALSE(info.is_image_sequence);
}

TEST_F(Video, GreyIsTheLumaStretchedToTheFullRange) {
    for (const char* codec : {"libx264", "mjpeg"}) {  // limited and full range in the file
        const auto path = folder_ / (std::string(codec) + ".mkv");
        VideoWriterOptions options;
        options.codec = codec;
        options.quality = 5;
        VideoWriter writer(path, {64, 48}, options);
        for (const int level : {0, 60, 128, 255}) writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(level)));
        writer.finish();
        const auto source = open(path);
        ASSERT_EQ(source->info().frame_count, 4);
        int i = 0;
        for (const int level : {0, 60, 128, 255}) {
            const Frame frame = source->read(i++, true);
            EXPECT_NEAR(cv::mean(frame.gray)[0], level, 2) << codec;
            EXPECT_NEAR(cv::mean(frame.colour)[0], level, 3) << codec;
        }
    }
}

TEST_F(Video, ColourKeepsItsChannels) {
    VideoWriter writer(folder_ / "a.mp4", {64, 48}, {});
    writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar(200, 60, 30)));
    writer.finish();
    const auto source = open(folder_ / "a.mp4");
    const cv::Scalar mean = cv::mean(source->read(0, true).colour);
    EXPECT_NEAR(mean[0], 200, 6);
    EXPECT_NEAR(mean[1], 60, 6);
    EXPECT_NEAR(mean[2], 30, 6);
    EXPECT_TRUE(source->read(0, false).colour.empty());
}

TEST_F(Video, GreyDoesNotDependOnColour) {
    test::writeNumberedVideo(folder_ / "a.mp4", 3);
    const auto source = open(folder_ / "a.mp4");
    const cv::Mat alone = source->read(1, false).gray;
    EXPECT_EQ(cv::norm(alone, source->read(1, true).gray, cv::NORM_INF), 0);
}

TEST_F(Video, FramesStayWhatTheyWereWhenOthersAreRead) {
    test::writeNumberedVideo(folder_ / "a.mp4", 9);
    const auto source = open(folder_ / "a.mp4");
    const Frame kept = source->read(3, true);
    const cv::Mat copy = kept.gray.clone();
    for (int i = 0; i < 9; ++i) source->read(i, true);
    EXPECT_EQ(cv::norm(kept.gray, copy, cv::NORM_INF), 0);
}

TEST_F(Video, VariableFrameRateKeepsItsTimes) {
    const std::vector<std::int64_t> times_us = {0, 40'000, 80'000, 200'000, 210'000, 500'000, 540'000, 1'000'000};
    for (const char* file : {"a.mp4", "a.mkv", "a.ts"}) {
        VideoWriterOptions options;
        options.b_frames = 2;
        VideoWriter writer(folder_ / file, {160, 64}, options);
        for (std::size_t i = 0; i < times_us.size(); ++i)
            writer.write(test::numberedImage(static_cast<int>(i)), times_us[i]);
        writer.finish();
        const auto source = open(folder_ / file);
        ASSERT_EQ(source->info().frame_count, 8) << file;
        EXPECT_TRUE(source->info().variable_frame_rate) << file;
        EXPECT_NEAR(source->info().frame_rate_hz, 7, 0.05) << file;
        for (std::size_t i = 0; i < times_us.size(); ++i)
            EXPECT_NEAR(static_cast<double>(source->timeOf(static_cast<int>(i))), static_cast<double>(times_us[i]),
                        1000)
                << file;
    }
}

TEST_F(Video, MissingPicturesDoNotChangeItsRate) {
    VideoWriter writer(folder_ / "a.mkv", {160, 64}, {});
    for (int shown = 0; shown < 40; ++shown)
        if (shown % 5 != 2) writer.write(test::numberedImage(shown), shown * 40'000);
    writer.finish();
    const auto source = open(folder_ / "a.mkv");
    EXPECT_EQ(source->info().frame_count, 32);
    EXPECT_NEAR(source->info().frame_rate_hz, 25, 0.05);
    EXPECT_EQ(source->timeOf(2), 120'000);
}

TEST_F(Video, AGivenFrameRateReplacesItsOwn) {
    test::writeNumberedVideo(folder_ / "a.mp4", 5);
    const auto source = open(folder_ / "a.mp4", 2.5);
    EXPECT_EQ(source->info().frame_rate_hz, 2.5);
    EXPECT_EQ(source->timeOf(4), 1'600'000);
}

TEST_F(Video, OneFrameIsEnough) {
    test::writeNumberedVideo(folder_ / "a.mp4", 1, {}, {160, 64}, 77);
    const auto source = open(folder_ / "a.mp4");
    ASSERT_EQ(source->info().frame_count, 1);
    EXPECT_GT(source->info().frame_rate_hz, 0);
    EXPECT_EQ(test::numberIn(source->read(0, false).gray), 77);
}

TEST_F(Video, TinyFramesAreRead) {
    VideoWriter writer(folder_ / "a.mp4", {16, 16}, {});
    for (int i = 0; i < 5; ++i) writer.write(cv::Mat(16, 16, CV_8UC3, cv::Scalar::all(40 * i)));
    writer.finish();
    const auto source = open(folder_ / "a.mp4");
    EXPECT_EQ(source->info().size, cv::Size(16, 16));
    EXPECT_NEAR(cv::mean(source->read(4, false).gray)[0], 160, 4);
}

TEST_F(Video, FramesOutsideAreRefused) {
    test::writeNumberedVideo(folder_ / "a.mp4", 5);
    const auto source = open(folder_ / "a.mp4");
    for (const int index : {-1, 5}) {
        EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { source->read(index, false); }), HasSubstr("0 to 4"));
        EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { source->timeOf(index); }), HasSubstr("a.mp4"));
    }
}

TEST(RealVideo, ShowsTheImagesItWasMadeFrom) {
    EYRIE_NEED_SHARED_DATA("uavdt_m1303");
    test::TemporaryFolder folder;
    SourceOptions options;
    options.index_folder = folder.path();
    const auto clip = openSource(test::sharedData("uavdt_m1303/clip.mp4"), options);
    const auto images = openSource(test::sharedData("uavdt_m1303/img1"));
    ASSERT_EQ(clip->info().frame_count, images->info().frame_count);
    EXPECT_NEAR(clip->info().frame_rate_hz, 30, 1e-3);
    for (const int i : {117, 3, 48, 47}) {
        // The image before and the one after must be less alike than the one of the same number.
        const auto difference = [&](int other) {
            cv::Mat apart;
            cv::absdiff(clip->read(i, false).gray, images->read(other, false).gray, apart);
            return cv::mean(apart)[0];
        };
        EXPECT_LT(difference(i), 5);
        EXPECT_LT(difference(i), difference(i - 1));
        EXPECT_LT(difference(i), difference(i + 1));
    }
}

TEST(RealVideo, TransportStreamsWithMetadataAreReadExactly) {
    EYRIE_NEED_SHARED_DATA("klv");
    const std::vector<std::tuple<const char*, const char*, int>> clips = {
        {"h264_klv.ts", "h264", 30},        {"h264_no_klv.ts", "h264", 30},          {"h265_tricky_klv.ts", "hevc", 30},
        {"mpeg2_klv.ts", "mpeg2video", 30}, {"aphill_klv_10s.ts", "mpeg2video", 10}, {"aphill_short.ts", "h264", 48}};
    test::TemporaryFolder folder;
    SourceOptions options;
    options.index_folder = folder.path();
    for (const auto& [file, codec, frames] : clips) {
        const auto source = openSource(test::sharedData("klv") / file, options);
        EXPECT_EQ(source->info().codec, codec) << file;
        ASSERT_EQ(source->info().frame_count, frames) << file;
        std::vector<cv::Mat> sequential;
        for (int i = 0; i < frames; ++i) {
            sequential.push_back(source->read(i, false).gray);
            if (i > 0) {
                EXPECT_GT(source->timeOf(i), source->timeOf(i - 1)) << file;
            }
        }
        for (int i = frames - 1; i >= 0; i -= 3)
            EXPECT_EQ(cv::norm(source->read(i, false).gray, sequential[static_cast<std::size_t>(i)], cv::NORM_INF), 0)
                << file << " frame " << i;
    }
}

}  // namespace
}  // namespace eyrie::video_reader_test

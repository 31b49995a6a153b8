#include "io/video/video_decoder.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "io/numbered_video.h"
#include "io/video/pixel_conversion.h"
#include "support/temporary_folder.h"

namespace eyrie::video_decoder_test {
namespace {

constexpr int kFrames = 60;
constexpr FrameIndex kWanted = 41;

struct Coding {
    const char* name;
    const char* file;
    const char* codec;
    bool leaves_out;  ///< its pictures say whether any other is decoded by them
};

class LeavingOut : public testing::TestWithParam<Coding> {
 protected:
    void SetUp() override {
        VideoWriterOptions options;
        options.codec = GetParam().codec;
        options.key_frame_distance = 250;
        options.b_frames = 3;
        if (options.codec == "libx265") options.encoder_options = "x265-params=log-level=none";
        test::writeNumberedVideo(path_, kFrames, options);
        decoder_ = buildVideoIndex(path_, index_, {}, {});
        frame_of_ = index_.framesOfPackets();
    }

    std::map<FrameIndex, cv::Mat> picturesFromTheStart() {
        std::map<FrameIndex, cv::Mat> pictures;
        PixelConversion conversion;
        decoder_->startAt(0);
        while (const AVFrame* picture = decoder_->next())
            pictures[frame_of_[static_cast<std::size_t>(decoder_->packetOf(*picture))]] = conversion.gray(*picture);
        return pictures;
    }

    test::TemporaryFolder folder_;
    const std::filesystem::path path_ = folder_ / GetParam().file;
    VideoIndex index_;
    std::unique_ptr<VideoDecoder> decoder_;
    std::vector<FrameIndex> frame_of_;
};

TEST_P(LeavingOut, WhatIsWantedComesWithTheSamePixelsAndOnlyWhatNothingDependsOnIsMissing) {
    const auto all = picturesFromTheStart();
    ASSERT_EQ(all.size(), static_cast<std::size_t>(kFrames));
    decoder_->leaveOut([this](int packet) { return frame_of_[static_cast<std::size_t>(packet)] < kWanted; });
    const auto some = picturesFromTheStart();
    std::set<FrameIndex> missing;
    for (const auto& [frame, picture] : all) {
        if (const auto found = some.find(frame); found == some.end())
            missing.insert(frame);
        else
            EXPECT_EQ(cv::norm(found->second, picture, cv::NORM_INF), 0) << frame;
    }
    if (GetParam().leaves_out) {
        EXPECT_GT(missing.size(), static_cast<std::size_t>(kWanted / 4));
        EXPECT_LT(*missing.rbegin(), kWanted);
    } else {
        EXPECT_TRUE(missing.empty());
    }
}

TEST_P(LeavingOut, EndsWhenNothingIsUnwantedAnyMore) {
    decoder_->leaveOut([](int) { return true; });
    picturesFromTheStart();
    decoder_->leaveOut({});
    EXPECT_EQ(picturesFromTheStart().size(), static_cast<std::size_t>(kFrames));
}

INSTANTIATE_TEST_SUITE_P(Codecs, LeavingOut,
                         testing::Values(Coding{"h264", "a.mp4", "libx264", true},
                                         Coding{"mpeg2", "a.ts", "mpeg2video", true},
                                         Coding{"h265", "a.mp4", "libx265", false}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace eyrie::video_decoder_test

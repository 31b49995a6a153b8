#include "io/video/index_cache.h"

#include <gmock/gmock.h>

#include "io/numbered_video.h"
#include "support/temporary_folder.h"

namespace eyrie::index_cache_test {
namespace {

using testing::HasSubstr;

class IndexCacheTest : public testing::Test {
 protected:
    IndexCacheTest() {
        video_ = folder_ / "a.mp4";
        options_.index_folder = folder_ / "index";
        test::writeNumberedVideo(video_, 40);
    }
    /// Whether opening had to read through the video.
    bool indexes(int expected_frames = 40) {
        bool indexed = false;
        const auto source = openSource(video_, options_, [&](double) { indexed = true; });
        EXPECT_EQ(source->info().frame_count, expected_frames);
        EXPECT_EQ(test::numberIn(source->read(expected_frames - 1, false).gray), expected_frames - 1);
        return indexed;
    }
    std::filesystem::path record() { return IndexCache(options_.index_folder).recordOf(video_); }

    test::TemporaryFolder folder_;
    std::filesystem::path video_;
    SourceOptions options_;
};

TEST_F(IndexCacheTest, SecondOpeningUsesTheRecord) {
    EXPECT_TRUE(indexes());
    EXPECT_TRUE(std::filesystem::exists(record()));
    EXPECT_FALSE(indexes());
}

TEST_F(IndexCacheTest, EveryDamageLeadsToANewRecord) {
    indexes();
    const std::string whole = test::bytesOf(record());
    std::string flipped = whole;
    flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 1);
    for (const std::string& damaged : {std::string(), std::string("x"), whole.substr(0, whole.size() / 2),
                                       whole.substr(1), whole + "x", flipped, std::string(5000, '\xFF')}) {
        test::writeBytes(record(), damaged);
        EXPECT_TRUE(indexes());
        EXPECT_EQ(test::bytesOf(record()), whole);
    }
}

TEST_F(IndexCacheTest, WhenTheFileWasBegunIsKnownAtOnceAndLater) {
    EXPECT_EQ(openSource(video_, options_)->info().created_utc_us, std::nullopt);
    const std::string whole = test::bytesOf(video_);
    const std::size_t header = whole.find("mvhd");
    ASSERT_NE(header, std::string::npos);
    constexpr std::uint32_t kEpoch_s = 2'082'844'800;  // from 1904 to 1970
    const auto begunAt = [&](std::uint32_t seconds_since_1904) {
        std::string dated = whole;
        for (int byte = 0; byte < 4; ++byte)
            dated[header + 8 + static_cast<std::size_t>(byte)] =
                static_cast<char>((seconds_since_1904 >> (24 - 8 * byte)) & 0xFF);
        std::filesystem::remove(record());
        test::writeBytes(video_, dated);
        const auto first = openSource(video_, options_)->info().created_utc_us;
        bool indexed = false;
        const auto again = openSource(video_, options_, [&](double) { indexed = true; });
        EXPECT_FALSE(indexed);
        EXPECT_EQ(again->info().created_utc_us, first);
        return first;
    };
    EXPECT_EQ(begunAt(kEpoch_s + 1'231'798'102), 1'231'798'102'000'000);
    EXPECT_EQ(begunAt(60), std::nullopt) << "a clock that began in 1904 with the camera";
    EXPECT_EQ(begunAt(kEpoch_s + 3'600), std::nullopt) << "1970";
    EXPECT_EQ(begunAt(kEpoch_s + 315'964'800), std::nullopt) << "1980, where GPS begins";
}

TEST_F(IndexCacheTest, AChangedVideoIsIndexedAgain) {
    indexes();
    test::writeNumberedVideo(video_, 25);
    EXPECT_TRUE(indexes(25));
}

TEST_F(IndexCacheTest, ATouchedVideoIsIndexedAgain) {
    indexes();
    std::filesystem::last_write_time(video_, std::filesystem::last_write_time(video_) + std::chrono::seconds(2));
    EXPECT_TRUE(indexes());
}

TEST_F(IndexCacheTest, ARecordOfAnotherVideoIsNotBelieved) {
    indexes();
    const auto other = folder_ / "b.mp4";
    test::writeNumberedVideo(other, 10);
    std::filesystem::copy_file(record(), IndexCache(options_.index_folder).recordOf(other));
    EXPECT_EQ(openSource(other, options_)->info().frame_count, 10);
}

TEST_F(IndexCacheTest, ARecordWhoseFramesAreNowhereIsNotBelieved) {
    const IndexCache cache(options_.index_folder);
    VideoIndex index;
    index.packets.resize(2);
    index.shown = {0, 1};
    index.shown_ticks = {0, 1};
    cache.save(stateOf(video_), index);
    EXPECT_TRUE(cache.load(video_).has_value());
    for (const std::int32_t packet : {-1, 2, INT32_MAX}) {
        index.shown[1] = packet;
        cache.save(stateOf(video_), index);
        EXPECT_FALSE(cache.load(video_).has_value()) << packet;
    }
    index.shown = {0};
    cache.save(stateOf(video_), index);
    EXPECT_FALSE(cache.load(video_).has_value()) << "fewer frames than times";
}

TEST_F(IndexCacheTest, AFolderThatCannotBeWrittenOnlyMeansNoCache) {
    test::writeBytes(folder_ / "file", "in the way");
    options_.index_folder = folder_ / "file" / "index";
    EXPECT_TRUE(indexes());
    EXPECT_TRUE(indexes());
}

TEST_F(IndexCacheTest, ProgressRisesToOne) {
    std::vector<double> shares;
    openSource(video_, options_, [&](double share) { shares.push_back(share); });
    ASSERT_FALSE(shares.empty());
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_EQ(shares.back(), 1);
}

TEST_F(IndexCacheTest, StoppingLeavesNothingBehind) {
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { openSource(video_, options_, {}, stop.get_token()); }),
                HasSubstr("stopped while indexing"));
    EXPECT_FALSE(std::filesystem::exists(record()));
}

TEST_F(IndexCacheTest, StoppingFromTheProgressCallback) {
    std::stop_source stop;
    EXPECT_THAT(test::messageOf(ErrorKind::input,
                                [&] {
                                    openSource(
                                        video_, options_, [&](double) { stop.request_stop(); }, stop.get_token());
                                }),
                HasSubstr("stopped while indexing"));
}

}  // namespace
}  // namespace eyrie::index_cache_test

#include "georeference/video_clock.h"

#include <gtest/gtest.h>

#include "metadata/collected.h"

namespace eyrie::video_clock_test {
namespace {

constexpr std::int64_t kBegin_us = 1'231'798'102'000'000;
constexpr int kSets = 40;

/// Ten sets a second, with a stamp each unless it is 0.
std::shared_ptr<const VideoMetadata> stamped(const std::function<std::uint64_t(int)>& stamp_of) {
    std::vector<test::Carried> sets;
    std::vector<PictureStamp> pictures;
    for (int i = 0; i < kSets; ++i) {
        test::LocalSetWriter set;
        if (stamp_of(i) > 0) set.time(stamp_of(i));
        sets.push_back({set.range(tag::kPlatformHeading, 10, 0, 360).bytes(), i * 100'000LL, i});
        pictures.push_back({i * 100'000LL, i * 100'000LL});
    }
    return std::make_shared<const VideoMetadata>(test::collected(sets), pictures);
}

}  // namespace

TEST(VideoClock, knowsNothingOrWhatAPersonSays) {
    EXPECT_EQ(VideoClock().at(0), std::nullopt);
    EXPECT_EQ(VideoClock().origin(), "");
    EXPECT_EQ(VideoClock::startingAt(kBegin_us).at(250'000), kBegin_us + 250'000);
    EXPECT_EQ(VideoClock::byMetadata(nullptr).source(), VideoClock::Source::none);
    EXPECT_EQ(VideoClock::byMetadata(stamped([](int) { return 0; })).source(), VideoClock::Source::none);
}

TEST(VideoClock, aSteadyClockCountsForTheWholeVideo) {
    const auto clock = VideoClock::byMetadata(
        stamped([](int i) { return static_cast<std::uint64_t>(kBegin_us + i * 100'000 + (i % 3) * 1'000); }));
    EXPECT_EQ(clock.source(), VideoClock::Source::metadata);
    EXPECT_NEAR(static_cast<double>(clock.at(0).value_or(0) - kBegin_us), 1'000, 1'000);
    EXPECT_EQ(*clock.at(60'000'000) - *clock.at(0), 60'000'000) << "also where no set is near";
    EXPECT_EQ(clock.origin(), "the video's metadata");
}

TEST(VideoClock, aFewStampsThatJumpDoNotCount) {
    const auto clock = VideoClock::byMetadata(stamped([](int i) {
        if (i == 7) return static_cast<std::uint64_t>(1);
        if (i == 9) return ~std::uint64_t{0};
        return static_cast<std::uint64_t>(kBegin_us + i * 100'000);
    }));
    EXPECT_EQ(clock.at(700'000), kBegin_us + 700'000);
    EXPECT_NE(clock.origin().find("disagree"), std::string::npos);
}

TEST(VideoClock, oneStampInTenMayDisagreeByMoreThanHalfASecond) {
    const auto clockWith = [](int odd, std::int64_t by_us) {
        return VideoClock::byMetadata(stamped(
            [=](int i) { return static_cast<std::uint64_t>(kBegin_us + i * 100'000 + (i < odd ? by_us : 0)); }));
    };
    EXPECT_EQ(clockWith(9, 499'000).origin(), "the video's metadata");
    EXPECT_EQ(clockWith(1, 501'000).origin(), "the video's metadata, without 1 stamp that disagrees");
    EXPECT_EQ(clockWith(4, -501'000).origin(), "the video's metadata, without 4 stamps that disagree");
    EXPECT_EQ(clockWith(4, 2'000'000).at(60'000'000), kBegin_us + 60'000'000);
    EXPECT_NE(clockWith(5, 2'000'000).origin().find("not steady"), std::string::npos);
}

TEST(VideoClock, aVideoOfSeveralFlightsHasTheTimeOfEach) {
    const auto clock = VideoClock::byMetadata(stamped([](int i) {
        return static_cast<std::uint64_t>(kBegin_us + i * 100'000 + (i < kSets / 2 ? 0 : 3'600'000'000LL));
    }));
    EXPECT_EQ(clock.at(500'000), kBegin_us + 500'000);
    EXPECT_EQ(clock.at(3'500'000), kBegin_us + 3'600'000'000 + 3'500'000);
    EXPECT_EQ(clock.at(60'000'000), std::nullopt);
    EXPECT_NE(clock.origin().find("not steady"), std::string::npos);
}

}  // namespace eyrie::video_clock_test

#include <gtest/gtest.h>

#include "metadata/collected.h"
#include "metadata/metadata_timeline.h"

namespace eyrie::metadata_timeline_test {
namespace {

using test::Carried;
using test::collected;
using test::LocalSetWriter;

constexpr std::int64_t kSecond = 1'000'000;

/// 25 pictures a second from 0, with stamps that begin at `first_stamp_us`.
std::vector<PictureStamp> pictures(int count, std::int64_t first_stamp_us) {
    std::vector<PictureStamp> all;
    for (int i = 0; i < count; ++i) all.push_back({first_stamp_us + i * 40'000, i * 40'000});
    return all;
}

Carried heading(double degrees, std::int64_t stamp_us, int pictures_before = 0, std::uint64_t utc_us = 0) {
    LocalSetWriter set;
    if (utc_us > 0) set.time(utc_us);
    return {set.range(tag::kPlatformHeading, degrees, 0, 360).bytes(), stamp_us, pictures_before};
}

}  // namespace

TEST(MetadataTimeline, stampsAreMeasuredFromThePictures) {
    const MetadataStream stream = collected({heading(10, 90 * kSecond + 20'000)});
    const MetadataTimeline timeline(stream, pictures(50, 90 * kSecond));
    EXPECT_EQ(timeline.timeOf(0), 20'000);
    EXPECT_EQ(timeline.placedByStamp(), 1);
}

TEST(MetadataTimeline, setsWithoutStampLieWhereTheyLieInTheFile) {
    const MetadataStream stream = collected({heading(10, kNoStamp, 0), heading(10, kNoStamp, 11)});
    const MetadataTimeline timeline(stream, pictures(50, 0));
    EXPECT_EQ(timeline.timeOf(0), 0);
    EXPECT_EQ(timeline.timeOf(1), 400'000);
    EXPECT_EQ(timeline.placedByFile(), 2);
}

TEST(MetadataTimeline, aJumpOfTheContainersClockDoesNoHarm) {
    std::vector<PictureStamp> all = pictures(300, 0);
    for (std::size_t i = 150; i < all.size(); ++i) all[i].stamp_us -= 5 * kSecond;  // goes back to 1 s
    const MetadataStream stream = collected(
        {heading(10, 6 * kSecond - 40'000, 149), heading(20, 6 * kSecond, 260), heading(30, 900 * kSecond, 280)});
    const MetadataTimeline timeline(stream, all);
    EXPECT_EQ(timeline.timeOf(0), 149 * 40'000);
    EXPECT_EQ(timeline.timeOf(1), 275 * 40'000);  // after the jump, not the picture of 6 s before it
    EXPECT_EQ(timeline.timeOf(2), 279 * 40'000);  // a stamp of nowhere: by the file
}

TEST(MetadataTimeline, valuesAreBlendedTheShorterWayRound) {
    const MetadataStream stream = collected({heading(350, 0), heading(10, kSecond)});
    const MetadataTimeline timeline(stream, pictures(50, 0));
    EXPECT_NEAR(timeline.at(250'000).number(tag::kPlatformHeading).value_or(-1), 355, 0.01);
    EXPECT_NEAR(timeline.at(750'000).number(tag::kPlatformHeading).value_or(-1), 5, 0.01);
    const MetadataStream dateline = collected({{LocalSetWriter().angle(14, 179.9, 180).bytes(), 0},
                                               {LocalSetWriter().angle(14, -179.9, 180).bytes(), kSecond}});
    const MetadataTimeline across(dateline, pictures(50, 0));
    EXPECT_NEAR(across.at(750'000).number(14).value_or(0), -179.95, 1e-6);
}

TEST(MetadataTimeline, gapsAreNotBridged) {
    const MetadataStream stream = collected({heading(10, 0), heading(30, 5 * kSecond, 125)});
    const MetadataTimeline timeline(stream, pictures(200, 0));
    EXPECT_NEAR(timeline.at(900'000).number(tag::kPlatformHeading).value_or(-1), 10, 0.01);  // held for a second
    EXPECT_FALSE(timeline.at(2'500'000).number(tag::kPlatformHeading));
    EXPECT_NEAR(timeline.at(4'200'000).number(tag::kPlatformHeading).value_or(-1), 30, 0.01);
    EXPECT_FALSE(timeline.at(7 * kSecond).number(tag::kPlatformHeading));
}

TEST(MetadataTimeline, eachValueHasItsOwnNeighbours) {
    const MetadataStream stream =
        collected({{LocalSetWriter().range(5, 10, 0, 360).range(22, 100, 0, 10000).bytes(), 0},
                   heading(20, 500'000),
                   heading(40, kSecond),
                   {LocalSetWriter().range(22, 200, 0, 10000).bytes(), kSecond}});
    const MetadataTimeline timeline(stream, pictures(50, 0));
    const MetadataState state = timeline.at(750'000);
    EXPECT_NEAR(state.number(5).value_or(-1), 30, 0.01);
    EXPECT_NEAR(state.number(22).value_or(-1), 175, 0.1);
}

TEST(MetadataTimeline, setsOutOfOrderAreSorted) {
    const MetadataStream stream = collected({heading(40, kSecond), heading(10, 0), heading(20, 500'000)});
    const MetadataTimeline timeline(stream, pictures(50, 0));
    EXPECT_NEAR(timeline.at(250'000).number(5).value_or(-1), 15, 0.01);
    EXPECT_NEAR(timeline.at(750'000).number(5).value_or(-1), 30, 0.01);
}

TEST(MetadataTimeline, timesOfDayGoOnButDoNotBridgeJumps) {
    constexpr std::uint64_t noon = 1'600'000'000'000'000;
    const MetadataStream stream = collected({heading(1, 0, 0, noon), heading(1, kSecond, 25, noon + 1'010'000),
                                             heading(1, 2 * kSecond, 50, noon + 99'000'000)});
    const MetadataTimeline timeline(stream, pictures(100, 0));
    EXPECT_EQ(timeline.at(500'000).utc_us, static_cast<std::int64_t>(noon) + 505'000);
    EXPECT_EQ(timeline.at(1'400'000).utc_us, static_cast<std::int64_t>(noon) + 1'410'000);
    EXPECT_EQ(timeline.at(1'700'000).utc_us, static_cast<std::int64_t>(noon) + 98'700'000);
    EXPECT_FALSE(timeline.at(4 * kSecond).utc_us);
}

TEST(MetadataTimeline, withoutPicturesThereIsNoTime) {
    const MetadataStream stream = collected({heading(1, 0)});
    const MetadataTimeline timeline(stream, {});
    EXPECT_FALSE(timeline.timeOf(0));
    EXPECT_TRUE(timeline.at(0).numbers.empty());
}

TEST(MetadataTimeline, textsHoldUntilTheyChange) {
    const auto mission = [](const std::string& name, std::int64_t stamp_us) {
        return test::Carried{LocalSetWriter().item(3, test::KlvBytes(name.begin(), name.end())).bytes(), stamp_us,
                             static_cast<int>(stamp_us / 40'000)};
    };
    const MetadataStream stream =
        collected({mission("ALPHA", kSecond), heading(1, 2 * kSecond, 50), mission("BRAVO", 8 * kSecond)});
    const MetadataTimeline timeline(stream, pictures(400, 0));
    const auto textAt = [&](std::int64_t time_us) {
        const auto texts = timeline.textsAt(time_us);
        return texts.size() == 1 && texts[0].tag == 3 ? texts[0].value : std::string("none");
    };
    EXPECT_EQ(textAt(0), "ALPHA");  // nothing was stated yet
    EXPECT_EQ(textAt(7'900'000), "ALPHA");
    EXPECT_EQ(textAt(8 * kSecond), "BRAVO");
    EXPECT_EQ(textAt(15 * kSecond), "BRAVO");
}

TEST(MetadataTimeline, theShareCoveredCountsWhatIsBridgedAndHeld) {
    // Bridged from 1 to 2 s, held for a second before and after, and about 8 s.
    const MetadataStream stream =
        collected({heading(1, kSecond, 25), heading(1, 2 * kSecond, 50), heading(1, 8 * kSecond, 200)});
    const MetadataTimeline timeline(stream, pictures(260, 0));
    EXPECT_NEAR(timeline.coveredShare(0, 10 * kSecond), 0.5, 1e-9);
    EXPECT_NEAR(timeline.coveredShare(3 * kSecond, 7 * kSecond), 0, 1e-9);
    EXPECT_NEAR(timeline.coveredShare(0, 3 * kSecond), 1, 1e-9);
    EXPECT_EQ(timeline.coveredShare(2 * kSecond, 2 * kSecond), 1);  // a video of one frame
    EXPECT_EQ(timeline.coveredShare(5 * kSecond, 5 * kSecond), 0);
}

}  // namespace eyrie::metadata_timeline_test

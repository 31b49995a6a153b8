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

TEST(MetadataTimeline, inEachPartOfAVideoItsOwnSetsCount) {
    MetadataCollector collector({1, 0x101, "klv"});
    const auto feed = [&](const Carried& packet) {
        collector.feed({1, packet.stamp_us, 0, packet.pictures_before, packet.bytes});
    };
    feed(heading(10, 0, 0, 1'000 * kSecond));
    feed(heading(20, 900'000, 22, 1'000 * kSecond + 900'000));
    collector.endOfPart();
    feed(heading(200, 800'000, 25, 2'000 * kSecond - 200'000));  // before the first picture that can be shown
    feed(heading(210, 1'100'000, 28, 2'000 * kSecond + 100'000));
    const MetadataStream stream = collector.finish();
    EXPECT_EQ(stream.leaps, 0) << "what was not recorded is no fault of the clock";
    VideoInfo video;
    video.frame_count = 50;
    video.parts.resize(2);
    video.parts[1].first_frame = 25;
    video.parts[1].first_time_us = kSecond;
    const MetadataTimeline timeline(stream, pictures(50, 0), timelineOptionsOf(video));
    EXPECT_NEAR(*timeline.at(850'000).number(tag::kPlatformHeading), 20 - 10.0 * 50 / 900, 0.1);
    EXPECT_EQ(timeline.at(850'000).utc_us, 1'000 * kSecond + 850'000);
    EXPECT_NEAR(*timeline.at(kSecond).number(tag::kPlatformHeading), 200 + 10.0 * 2 / 3, 0.1);
    EXPECT_EQ(timeline.at(kSecond).utc_us, 2'000 * kSecond);
}

namespace {

/// Headings of two moments, the later one so long after the first.
std::optional<double> headingBetween(double first, double second, std::int64_t apart_us, std::int64_t at_us,
                                     const TimelineOptions& options = {}) {
    const MetadataStream stream = collected({heading(first, 0), heading(second, apart_us)});
    return MetadataTimeline(stream, pictures(100, 0), options).at(at_us).number(tag::kPlatformHeading);
}

}  // namespace

TEST(TimelineByHand, AnglesGoRoundEitherWay) {
    EXPECT_NEAR(*headingBetween(10, 350, kSecond, 750'000), 355, 0.01);  // 10 − 15, a whole turn on
    EXPECT_NEAR(*headingBetween(10, 350, kSecond, 250'000), 5, 0.01);
    EXPECT_NEAR(*headingBetween(100, 200, kSecond, 250'000), 125, 0.01);
    const auto elevation = [](double first, double second, std::int64_t at_us) {
        const MetadataStream stream =
            collected({{LocalSetWriter().angle(tag::kSensorElevation, first, 180).bytes(), 0},
                       {LocalSetWriter().angle(tag::kSensorElevation, second, 180).bytes(), kSecond}});
        return *MetadataTimeline(stream, pictures(50, 0)).at(at_us).number(tag::kSensorElevation);
    };
    EXPECT_NEAR(elevation(170, -170, 750'000), -175, 1e-4);
    EXPECT_NEAR(elevation(-170, 170, 750'000), 175, 1e-4);
    EXPECT_NEAR(elevation(-30, -50, 250'000), -35, 1e-4);
    EXPECT_NEAR(elevation(20, -20, 500'000), 0, 1e-4);
}

TEST(TimelineByHand, FlagsHoldUntilTheNext) {
    const MetadataStream stream =
        collected({{LocalSetWriter().item(47, {1}).bytes(), 0}, {LocalSetWriter().item(47, {9}).bytes(), kSecond}});
    const MetadataTimeline timeline(stream, pictures(50, 0));
    EXPECT_EQ(timeline.at(900'000).number(47), 1);
    EXPECT_EQ(timeline.at(kSecond).number(47), 9);
    EXPECT_FALSE(timeline.at(0).number(46));
    EXPECT_FALSE(timeline.at(0).number(48));
}

TEST(TimelineByHand, TwoSecondsAreBridgedAndOneIsHeld) {
    EXPECT_NEAR(*headingBetween(10, 30, 2 * kSecond, kSecond), 20, 0.01);
    EXPECT_NEAR(*headingBetween(10, 30, 2'040'000, 900'000), 10, 0.01);
    EXPECT_FALSE(headingBetween(10, 30, 2'040'000, 1'020'000)) << "1.02 s from both";
    EXPECT_NEAR(*headingBetween(10, 30, 2'040'000, kSecond), 10, 0.01);
    EXPECT_NEAR(*headingBetween(10, 30, 2'040'000, 1'040'000), 30, 0.01);
    // Where less is bridged than held the nearer one counts, of both the first.
    TimelineOptions options;
    options.longest_gap_s = 0.5;
    EXPECT_NEAR(*headingBetween(10, 30, kSecond, 400'000, options), 10, 0.01);
    EXPECT_NEAR(*headingBetween(10, 30, kSecond, 500'000, options), 10, 0.01);
    EXPECT_NEAR(*headingBetween(10, 30, kSecond, 600'000, options), 30, 0.01);
    EXPECT_NEAR(*headingBetween(10, 30, 500'000, 250'000, options), 20, 0.01);
}

TEST(TimelineByHand, AStampIsWithinTwoSecondsOfAPicture) {
    // The last of 50 pictures is shown at 1.96 s.
    const auto placed = [](std::int64_t stamp_us, int pictures_before = 50) {
        const MetadataStream stream = collected({heading(10, stamp_us, pictures_before)});
        const MetadataTimeline timeline(stream, pictures(50, 0));
        EXPECT_EQ(timeline.placedByStamp() + timeline.placedByFile(), 1);
        return std::pair(timeline.timeOf(0).value_or(-1), timeline.placedByStamp());
    };
    EXPECT_EQ(placed(1'960'000 + 1'900'000), std::pair(std::int64_t{3'860'000}, 1));
    EXPECT_EQ(placed(1'960'000 + 2'000'000), std::pair(std::int64_t{3'960'000}, 1));
    EXPECT_EQ(placed(1'960'000 + 2'100'000), std::pair(std::int64_t{1'960'000}, 0)) << "the picture before it";
    EXPECT_EQ(placed(-1'900'000, 0), std::pair(std::int64_t{-1'900'000}, 1));
    EXPECT_EQ(placed(-2'100'000, 0), std::pair(std::int64_t{0}, 0)) << "the next where none is before it";
    EXPECT_EQ(placed(-2'100'000, 1), std::pair(std::int64_t{0}, 0));
    EXPECT_EQ(placed(-2'100'000, 2), std::pair(std::int64_t{40'000}, 0));
    EXPECT_EQ(placed(kNoStamp, 999), std::pair(std::int64_t{1'960'000}, 0));
    EXPECT_EQ(placed(kNoStamp, -5), std::pair(std::int64_t{0}, 0));
}

TEST(TimelineByHand, PicturesThatAreNotShownPlaceNothing) {
    std::vector<PictureStamp> all = pictures(10, 0);
    for (const std::size_t i : {0, 1, 2, 5}) all[i].time_us = kNoStamp;
    const auto placed = [&](int pictures_before) {
        const MetadataStream stream = collected({heading(10, kNoStamp, pictures_before)});
        return MetadataTimeline(stream, all).timeOf(0);
    };
    EXPECT_EQ(placed(0), 120'000);
    EXPECT_EQ(placed(2), 120'000);
    EXPECT_EQ(placed(4), 120'000);
    EXPECT_EQ(placed(6), 160'000) << "the sixth is not shown";
    EXPECT_EQ(placed(7), 240'000);
    // Nor is a stamp measured from one, though it be the nearest.
    const MetadataStream stream = collected({heading(10, 205'000, 5)});
    EXPECT_EQ(MetadataTimeline(stream, all).timeOf(0), 205'000);
}

TEST(TimelineByHand, ClocksMayDifferByHalfASecondBetweenTwoSets) {
    constexpr std::int64_t noon = 1'600'000'000'000'000;
    const auto utcAt = [&](std::int64_t later_us, std::int64_t at_us, std::int64_t apart_us = kSecond) {
        const MetadataStream stream =
            collected({heading(1, 0, 0, noon), heading(1, apart_us, 25, static_cast<std::uint64_t>(noon + later_us))});
        const auto utc = MetadataTimeline(stream, pictures(100, 0)).at(at_us).utc_us;
        return utc ? *utc - noon : std::int64_t{-1'000'000'000};
    };
    EXPECT_EQ(utcAt(1'400'000, 500'000), 700'000);  // 0.5 s and half of 0.4 s
    EXPECT_EQ(utcAt(1'400'000, 250'000), 350'000);
    EXPECT_EQ(utcAt(600'000, 250'000), 150'000);
    EXPECT_EQ(utcAt(1'600'000, 250'000), 250'000) << "a jump: by the nearer set";
    EXPECT_EQ(utcAt(1'600'000, 500'000), 500'000);
    EXPECT_EQ(utcAt(1'600'000, 750'000), 1'350'000);
    EXPECT_EQ(utcAt(1'000'000, 2'000'000), 2'000'000) << "held for a second";
    EXPECT_EQ(utcAt(1'000'000, 2'040'000), -1'000'000'000);
    EXPECT_EQ(utcAt(1'000'000, -1'000'000), -1'000'000);
    EXPECT_EQ(utcAt(1'000'000, -1'040'000), -1'000'000'000);
    EXPECT_EQ(utcAt(3'000'000, 1'500'000, 3 * kSecond), -1'000'000'000) << "three seconds are not bridged";
    EXPECT_EQ(utcAt(2'200'000, 1'000'000, 2 * kSecond), 1'100'000);
}

TEST(TimelineByHand, TheShareCoveredEndsWhereHoldingDoes) {
    const MetadataStream stream = collected({heading(1, 2 * kSecond, 50)});
    const MetadataTimeline timeline(stream, pictures(260, 0));
    EXPECT_NEAR(timeline.coveredShare(0, 4 * kSecond), 0.5, 1e-9);
    EXPECT_NEAR(timeline.coveredShare(2 * kSecond, 6 * kSecond), 0.25, 1e-9);
    EXPECT_NEAR(timeline.coveredShare(1'500'000, 2'500'000), 1, 1e-9);
    EXPECT_EQ(timeline.coveredShare(kSecond, kSecond), 1);
    EXPECT_EQ(timeline.coveredShare(960'000, 960'000), 0);
    EXPECT_EQ(timeline.coveredShare(3 * kSecond, 3 * kSecond), 1);
    EXPECT_EQ(timeline.coveredShare(3'040'000, 3'040'000), 0);
}

}  // namespace eyrie::metadata_timeline_test

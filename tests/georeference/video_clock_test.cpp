#include "georeference/video_clock.h"

#include <gtest/gtest.h>

#include "metadata/collected.h"

namespace eyrie::video_clock_test {
namespace {

constexpr std::int64_t kBegin_us = 1'231'798'102'000'000;
constexpr int kSets = 40;
constexpr std::uint64_t kUnstamped = 42;

/// Ten sets a second, with a stamp each unless it is kUnstamped; a new part every so many.
std::shared_ptr<const VideoMetadata> stamped(const std::function<std::uint64_t(int)>& stamp_of, int of_part = kSets) {
    MetadataCollector collector({1, 0x101, "klv"});
    std::vector<PictureStamp> pictures;
    for (int i = 0; i < kSets; ++i) {
        if (i > 0 && i % of_part == 0) collector.endOfPart();
        test::LocalSetWriter set;
        if (stamp_of(i) != kUnstamped) set.time(stamp_of(i));
        const auto bytes = set.range(tag::kPlatformHeading, 10, 0, 360).bytes();
        collector.feed({1, i * 100'000LL, 0, i, bytes});
        pictures.push_back({i * 100'000LL, i * 100'000LL});
    }
    return std::make_shared<const VideoMetadata>(collector.finish(), pictures);
}

}  // namespace

TEST(VideoClock, knowsNothingOrWhatAPersonSays) {
    EXPECT_EQ(VideoClock().at(0), std::nullopt);
    EXPECT_EQ(VideoClock().origin(), "");
    EXPECT_EQ(VideoClock::startingAt(kBegin_us).at(250'000), kBegin_us + 250'000);
    EXPECT_EQ(VideoClock::byMetadata(nullptr).source(), VideoClock::Source::none);
    EXPECT_EQ(VideoClock::byMetadata(stamped([](int) { return kUnstamped; })).source(), VideoClock::Source::none);
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
    EXPECT_EQ(clock.origin(), "the video's metadata, without 1 stamp that disagrees") << "the other is none";
    const auto unset = VideoClock::byMetadata(
        stamped([](int i) { return i < 20 ? std::uint64_t{0} : static_cast<std::uint64_t>(kBegin_us + i * 100'000); }));
    EXPECT_EQ(unset.at(700'000), kBegin_us + 700'000) << "a clock that is not set yet";
    EXPECT_EQ(unset.origin(), "the video's metadata");
}

TEST(VideoClock, beginsWhereTheMedianOfItsStampsSaysWhateverTheirOrder) {
    // Stamps jitter by up to 0.4 s, most of all in the middle of the video.
    for (const int rare : {3, 19, 20, 21, 38}) {
        const auto clock = VideoClock::byMetadata(stamped([rare](int i) {
            const int late_ms = i == rare ? 400 : (i * 7) % 5 * 10;
            return static_cast<std::uint64_t>(kBegin_us + i * 100'000 + late_ms * 1000);
        }));
        EXPECT_EQ(clock.at(0), kBegin_us + 20'000) << rare;
    }
}

TEST(VideoClock, oneStampInTenMayDisagreeByMoreThanHalfASecond) {
    const auto clockWith = [](int odd, std::int64_t by_us) {
        return VideoClock::byMetadata(stamped(
            [=](int i) { return static_cast<std::uint64_t>(kBegin_us + i * 100'000 + (i < odd ? by_us : 0)); }));
    };
    EXPECT_EQ(clockWith(9, 499'000).origin(), "the video's metadata");
    EXPECT_EQ(clockWith(4, 500'000).origin(), "the video's metadata");
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

/// Three parts of a second each.
std::vector<VideoPart> threeParts() {
    std::vector<VideoPart> parts(3);
    for (int i = 0; i < 3; ++i) {
        parts[static_cast<std::size_t>(i)].first_time_us = i * 1'000'000;
        parts[static_cast<std::size_t>(i)].first_frame = i * 10;
        parts[static_cast<std::size_t>(i)].frame_count = 10;
    }
    return parts;
}

TEST(VideoClock, everyPartBeginsWhenItsMetadataSay) {
    // A minute was not recorded after each second.
    const auto metadata =
        stamped([](int i) { return static_cast<std::uint64_t>(kBegin_us + i * 100'000 + (i / 10) * 60'000'000); }, 10);
    const auto clock = VideoClock::ofParts(threeParts(), metadata, std::nullopt);
    EXPECT_EQ(clock.source(), VideoClock::Source::metadata);
    EXPECT_EQ(clock.at(0), kBegin_us);
    EXPECT_EQ(clock.at(999'999), kBegin_us + 999'999);
    EXPECT_EQ(clock.at(1'000'000), kBegin_us + 61'000'000);
    EXPECT_EQ(clock.at(2'500'000), kBegin_us + 122'500'000);
    EXPECT_EQ(clock.origin(), "the video's metadata");
}

TEST(VideoClock, whatTheListSaysOfAPartCountsBeforeItsMetadata) {
    const auto metadata = stamped([](int i) { return static_cast<std::uint64_t>(kBegin_us + i * 100'000); }, 10);
    auto parts = threeParts();
    parts[1].start_utc_us = kBegin_us + 3'600'000'000;
    const auto clock = VideoClock::ofParts(parts, metadata, std::nullopt);
    EXPECT_EQ(clock.at(500'000), kBegin_us + 500'000);
    EXPECT_EQ(clock.at(1'500'000), kBegin_us + 3'600'500'000);
    EXPECT_EQ(clock.at(2'500'000), kBegin_us + 2'500'000);
    EXPECT_EQ(clock.origin(), "the start times in the list of parts and the video's metadata");
}

TEST(VideoClock, aPartOfWhichNothingTellsFollowsWithoutAGap) {
    auto parts = threeParts();
    parts[1].start_utc_us = kBegin_us;
    const auto clock = VideoClock::ofParts(parts, nullptr, std::nullopt);
    EXPECT_EQ(clock.at(0), kBegin_us - 1'000'000) << "leads up to the first that is known";
    EXPECT_EQ(clock.at(1'000'000), kBegin_us);
    EXPECT_EQ(clock.at(2'250'000), kBegin_us + 1'250'000);
    EXPECT_EQ(clock.origin(), "the start times in the list of parts; 2 parts with no known start follow without a gap");
    EXPECT_EQ(VideoClock::ofParts(threeParts(), nullptr, std::nullopt).source(), VideoClock::Source::none);
}

TEST(VideoClock, aStartThatIsGivenMovesAllPartsTogether) {
    auto parts = threeParts();
    parts[0].start_utc_us = kBegin_us;
    parts[1].start_utc_us = kBegin_us + 60'000'000;
    const auto clock = VideoClock::ofParts(parts, nullptr, kBegin_us + 7);
    EXPECT_EQ(clock.at(0), kBegin_us + 7);
    EXPECT_EQ(clock.at(1'000'000), kBegin_us + 60'000'007);
    EXPECT_EQ(clock.origin().find("the start time given"), 0U);
    EXPECT_EQ(VideoClock::ofParts(threeParts(), nullptr, kBegin_us).at(2'000'000), kBegin_us + 2'000'000);
    EXPECT_EQ(VideoClock::ofParts({}, nullptr, kBegin_us).at(5), kBegin_us + 5) << "a video of one file";
}

TEST(VideoClock, aPersonCountsBeforeTheMetadataAndTheseBeforeTheFile) {
    const std::int64_t made_us = kBegin_us + 3'600'000'000;
    FoundMetadata found;
    EXPECT_EQ(VideoClock::of(found, std::nullopt).source(), VideoClock::Source::none);
    found.created_utc_us = made_us;
    const auto by_file = VideoClock::of(found, std::nullopt);
    EXPECT_EQ(by_file.source(), VideoClock::Source::file);
    EXPECT_EQ(by_file.at(250'000), made_us + 250'000);
    EXPECT_EQ(by_file.origin(), "the file's creation time");
    found.metadata = stamped([](int i) { return static_cast<std::uint64_t>(kBegin_us + i * 100'000); });
    const auto by_metadata = VideoClock::of(found, std::nullopt);
    EXPECT_EQ(by_metadata.source(), VideoClock::Source::metadata);
    EXPECT_EQ(by_metadata.at(0), kBegin_us);
    const auto by_person = VideoClock::of(found, kBegin_us + 7);
    EXPECT_EQ(by_person.source(), VideoClock::Source::given);
    EXPECT_EQ(by_person.at(0), kBegin_us + 7);
    EXPECT_EQ(by_person.origin(), "the start time given");
}

TEST(VideoClock, everyPartBeginsWhenItsFileDidUnlessThatWasBefore) {
    FoundMetadata found;
    found.parts = threeParts();
    found.parts[0].created_utc_us = found.parts[1].created_utc_us = kBegin_us;
    found.parts[2].created_utc_us = kBegin_us + 60'000'000;
    const auto clock = VideoClock::of(found, std::nullopt);
    EXPECT_EQ(clock.source(), VideoClock::Source::file);
    EXPECT_EQ(clock.at(1'500'000), kBegin_us + 1'500'000) << "one time for both: the second goes on";
    EXPECT_EQ(clock.at(2'000'000), kBegin_us + 60'000'000);
    EXPECT_EQ(clock.origin(), "the files' creation times");
    // Files tell it to the second: only what is more than one later than it would go on is a gap.
    found.parts[1].created_utc_us = kBegin_us + 2'000'000;
    EXPECT_EQ(VideoClock::of(found, std::nullopt).at(1'500'000), kBegin_us + 1'500'000);
    found.parts[1].created_utc_us = kBegin_us + 2'000'001;
    EXPECT_EQ(VideoClock::of(found, std::nullopt).at(1'500'000), kBegin_us + 2'500'001);
    found.parts[1].created_utc_us.reset();
    EXPECT_EQ(VideoClock::of(found, std::nullopt).at(1'500'000), kBegin_us + 1'500'000);
    EXPECT_EQ(VideoClock::of(found, std::nullopt).origin(),
              "the files' creation times; 1 part with no known start follows without a gap");
    found.parts[0].start_utc_us = kBegin_us - 5'000'000;
    EXPECT_EQ(VideoClock::of(found, std::nullopt).source(), VideoClock::Source::given) << "a list says it";
    EXPECT_EQ(VideoClock::of(found, std::nullopt).at(2'000'000), kBegin_us - 3'000'000);
}

TEST(VideoClock, aStartThatIsGivenKeepsTheGapsThatTheFilesTell) {
    FoundMetadata found;
    found.parts = threeParts();
    for (std::size_t i = 0; i < 3; ++i) {
        found.parts[i].start_utc_us.reset();
        found.parts[i].created_utc_us = kBegin_us + static_cast<std::int64_t>(i) * 60'000'000;
    }
    const auto clock = VideoClock::of(found, kBegin_us + 3'600'000'000);
    EXPECT_EQ(clock.at(0), kBegin_us + 3'600'000'000);
    EXPECT_EQ(clock.at(found.parts[2].first_time_us), kBegin_us + 3'600'000'000 + 120'000'000);
    EXPECT_EQ(clock.origin(), "the start time given");
}

TEST(VideoClock, aPartWhoseClockJumpsHasTheTimesOfItsMoments) {
    const auto metadata = stamped(
        [](int i) {
            const bool jumps = i >= 10 && i < 20 && i % 2 == 0;
            return static_cast<std::uint64_t>(kBegin_us + i * 100'000 + (jumps ? 9'000'000 : 0));
        },
        10);
    const auto clock = VideoClock::ofParts(threeParts(), metadata, std::nullopt);
    EXPECT_EQ(clock.at(500'000), kBegin_us + 500'000);
    EXPECT_EQ(clock.at(1'100'000), kBegin_us + 1'100'000);
    EXPECT_EQ(clock.at(1'200'000), kBegin_us + 1'200'000 + 9'000'000);
    EXPECT_EQ(clock.at(2'500'000), kBegin_us + 2'500'000);
    EXPECT_NE(clock.origin().find("not steady"), std::string::npos);
    // Gaps cannot be kept of what jumps; a start that is given counts alone.
    const auto given = VideoClock::ofParts(threeParts(), metadata, kBegin_us + 7);
    EXPECT_EQ(given.at(1'200'000), kBegin_us + 1'200'007);
    EXPECT_EQ(given.at(2'500'000), kBegin_us + 2'500'007);
    EXPECT_EQ(given.origin(), "the start time given");
}

}  // namespace eyrie::video_clock_test

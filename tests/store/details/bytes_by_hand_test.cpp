#include <gtest/gtest.h>

#include <chrono>
#include <cstring>

#include "store/backup/backup_name.h"
#include "store/details/recording_options.h"
#include "store/details/squeezed_bytes.h"
#include "store/labels/packed_labels.h"
#include "store/runs/packed_arrays.h"

/// What lies in project files to the byte: files of years ago must stay readable.
namespace eyrie::bytes_by_hand_test {
namespace {

template <class Value>
Value at(const Bytes& bytes, std::size_t offset) {
    Value value{};
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

std::vector<int> numbersOf(const Bytes& bytes) {
    std::vector<int> numbers;
    for (const std::byte byte : bytes) numbers.push_back(std::to_integer<int>(byte));
    return numbers;
}

std::vector<int> pointBytes(float x, float y) {
    return numbersOf(packPoints(std::vector<cv::Point2f>{{x, y}}));
}

TEST(BytesByHand, AMotionVectorTakesTwentyEight) {
    const Bytes bytes = packMotionVectors(std::vector<MotionVector>{{1, {2, 3}, {4, 5}, 6}, {7, {8, 9}, {1, 2}, 3}});
    ASSERT_EQ(bytes.size(), 56U);
    EXPECT_EQ(at<std::int64_t>(bytes, 0), 1);
    EXPECT_EQ(at<float>(bytes, 8), 2);
    EXPECT_EQ(at<float>(bytes, 12), 3);
    EXPECT_EQ(at<float>(bytes, 16), 4);
    EXPECT_EQ(at<float>(bytes, 20), 5);
    EXPECT_EQ(at<std::int32_t>(bytes, 24), 6);
    EXPECT_EQ(at<std::int64_t>(bytes, 28), 7);
    EXPECT_EQ(numbersOf(packIndices(std::vector<int>{1, -1})), (std::vector<int>{1, 0, 0, 0, 255, 255, 255, 255}));
}

TEST(BytesByHand, PointsAreSixteenthsOfAPixel) {
    EXPECT_EQ(pointBytes(1.5F, 2), (std::vector<int>{2, 24, 0, 32, 0}));
    EXPECT_EQ(pointBytes(0.03125F, 0.03F), (std::vector<int>{2, 1, 0, 0, 0})) << "half a step up, less down";
    EXPECT_EQ(pointBytes(4095.875F, 0), (std::vector<int>{2, 254, 255, 0, 0}));
    EXPECT_EQ(pointBytes(4095.9F, 0), (std::vector<int>{4, 254, 255, 0, 0, 0, 0, 0, 0})) << "wider from here on";
    EXPECT_EQ(pointBytes(0, -1.5F), (std::vector<int>{4, 0, 0, 0, 0, 232, 255, 255, 255}));
    EXPECT_EQ(pointBytes(4096, 0), (std::vector<int>{4, 0, 0, 1, 0, 0, 0, 0, 0}));
}

TEST(BytesByHand, SqueezedOnesSayHowManyTheyWereAndInWhatRecords) {
    const Bytes bytes = squeezeMotionVectors(std::vector<MotionVector>{{1, {2, 3}, {4, 5}, 6}, {7, {8, 9}, {1, 2}, 3}});
    EXPECT_EQ(at<std::uint8_t>(bytes, 0), 1);
    EXPECT_EQ(at<std::uint32_t>(bytes, 1), 56U);
    EXPECT_EQ(at<std::uint8_t>(bytes, 5), 28);
    EXPECT_TRUE(unsqueezed(bytes, 56));
    EXPECT_FALSE(unsqueezed(bytes, 55)) << "more than may be";
    EXPECT_EQ(at<std::uint8_t>(squeezeBoxes(std::vector<ClassifiedBox>(1)), 5), 56);
}

Keyframe keyframe() {
    Keyframe made;
    made.frame = 5;
    made.box = {{1, 2}, 3, 4, 0.5};
    return made;
}

TEST(BytesByHand, AKeyframeEndsWithItsFlags) {
    Keyframe given = keyframe();
    const auto flagsOf = [](const Keyframe& one) { return at<std::uint8_t>(packKeyframes({one}), 45); };
    EXPECT_EQ(flagsOf(given), 0);
    given.heading_set = true;
    EXPECT_EQ(flagsOf(given), 1);
    given.outside = true;
    EXPECT_EQ(flagsOf(given), 3);
    given.ignore = true;
    EXPECT_EQ(flagsOf(given), 7);
    given.occlusion = Occlusion::partly;
    EXPECT_EQ(flagsOf(given), 15);
    given.occlusion = Occlusion::fully;
    given.computed = true;
    EXPECT_EQ(flagsOf(given), 7 + 16 + 32);
    const auto back = unpackKeyframes(packKeyframes({given}));
    ASSERT_TRUE(back);
    EXPECT_TRUE(back->front().heading_set && back->front().outside && back->front().ignore && back->front().computed);
    EXPECT_EQ(back->front().occlusion, Occlusion::fully);
    const Bytes bytes = packKeyframes({keyframe()});
    EXPECT_EQ(at<std::uint8_t>(bytes, 0), 1);
    EXPECT_EQ(at<std::int32_t>(bytes, 1), 5);
    EXPECT_EQ(at<double>(bytes, 5), 1);
    EXPECT_EQ(at<double>(bytes, 13), 2);
    EXPECT_EQ(at<double>(bytes, 21), 3);
    EXPECT_EQ(at<double>(bytes, 29), 4);
    EXPECT_EQ(at<double>(bytes, 37), 0.5);
}

TEST(BytesByHand, KeyframesThatCannotBeAreNone) {
    const auto taken = [](const std::vector<Keyframe>& keyframes) {
        return unpackKeyframes(packKeyframes(keyframes)).has_value();
    };
    EXPECT_TRUE(taken({keyframe()}));
    EXPECT_FALSE(taken({}));
    EXPECT_FALSE(taken({keyframe(), keyframe()})) << "twice the same frame";
    Keyframe other = keyframe();
    other.frame = 0;
    EXPECT_TRUE(taken({other, keyframe()}));
    other.frame = -1;
    EXPECT_FALSE(taken({other}));
    other = keyframe();
    other.box.length = other.box.width = 0;
    EXPECT_TRUE(taken({other}));
    other.box.length = -1;
    EXPECT_FALSE(taken({other}));
    other = keyframe();
    other.box.width = -1;
    EXPECT_FALSE(taken({other}));
    Bytes bytes = packKeyframes({keyframe()});
    bytes[45] = std::byte{24};
    EXPECT_FALSE(unpackKeyframes(bytes)) << "an occlusion of 3";
    bytes[45] = std::byte{16};
    EXPECT_TRUE(unpackKeyframes(bytes));
    bytes[0] = std::byte{2};
    EXPECT_FALSE(unpackKeyframes(bytes)) << "another format";
}

TEST(RecordingByHand, DetailsAreKeptOfShortRunsOrOfEverySoManyFrames) {
    RecordingOptions options;
    options.details = KeptDetails::automatic;
    options.details_up_to = 100;
    EXPECT_TRUE(options.keepsDetailsOf(50, 10, 109)) << "100 frames";
    EXPECT_FALSE(options.keepsDetailsOf(50, 10, 110));
    EXPECT_TRUE(options.keepsAllDetails(10, 109));
    EXPECT_FALSE(options.keepsAllDetails(10, 110));
    options.details = KeptDetails::sampled;
    options.details_every = 4;
    EXPECT_TRUE(options.keepsDetailsOf(10, 10, 999));
    EXPECT_TRUE(options.keepsDetailsOf(14, 10, 999));
    for (const FrameIndex frame : {11, 12, 13}) EXPECT_FALSE(options.keepsDetailsOf(frame, 10, 999)) << frame;
    EXPECT_FALSE(options.keepsAllDetails(10, 11));
    options.details_every = 1;
    EXPECT_TRUE(options.keepsAllDetails(10, 999));
    options.details = KeptDetails::none;
    EXPECT_FALSE(options.keepsDetailsOf(10, 10, 10));
    EXPECT_FALSE(options.keepsAllDetails(10, 10));
    options.details = KeptDetails::all;
    EXPECT_TRUE(options.keepsDetailsOf(10, 10, 9'999'999));
    EXPECT_TRUE(options.keepsAllDetails(10, 9'999'999));
}

TEST(BackupNameByHand, IsTheTimeAndTheReasonAndIsReadBack) {
    using namespace std::chrono;
    const UtcTime time = sys_days(year(2026) / 2 / 9) + hours(7) + minutes(5) + seconds(3);
    EXPECT_EQ(inWords(time), "2026-02-09 07:05:03 UTC");
    EXPECT_EQ(backupFileName(time, BackupReason::daily), "2026-02-09T07-05-03Z-daily.eyrie");
    for (const BackupReason reason :
         {BackupReason::daily, BackupReason::before_migration, BackupReason::before_restoring}) {
        const auto read = parseBackupName("folder/" + backupFileName(time, reason));
        ASSERT_TRUE(read);
        EXPECT_EQ(read->made, time);
        EXPECT_EQ(read->reason, reason);
    }
    for (const char* other :
         {"2026-02-30T07-05-03Z-daily.eyrie", "2026-13-09T07-05-03Z-daily.eyrie", "2026-02-09T07-05-03Z-yearly.eyrie",
          "2026-02-09T07-05-03Z-daily.eyrie.partial-1", "2026-02-09T07-05Z-daily.eyrie", "p.eyrie", ""})
        EXPECT_FALSE(parseBackupName(other)) << other;
}

}  // namespace
}  // namespace eyrie::bytes_by_hand_test

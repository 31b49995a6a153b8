#include <gtest/gtest.h>

#include "core/time/utc_time.h"
#include "metadata/collected.h"

namespace eyrie::klv_values_test {
namespace {

using test::bytesOfHex;
using test::collected;
using test::KlvBytes;
using test::LocalSetWriter;
using test::UniversalSetWriter;

struct Example {
    int tag;
    const char* code;
    double value;
    double tolerance;
};

}  // namespace

// Codes and values are the worked examples of MISB ST 0601, recomputed by hand from the stated ranges.
TEST(KlvValues, tagsAreScaledAsTheStandardSays) {
    const Example examples[] = {
        {5, "71c2", 159.974364843, 1e-6},  // 29122 · 360 / 65535
        {6, "fd3d", -0.431531724, 1e-8},   // −707 · 20 / 32767
        {7, "08b8", 3.405865, 1e-6},       // 2232 · 50 / 32767
        {8, "93", 147, 0},                 //
        {13, "5595b66d", 60.1768229669783, 1e-9},
        {14, "5b5360c4", 128.426759042045, 1e-9},
        {15, "c221", 14190.719463, 1e-5},  // −900 + 49697 · 19900 / 65535
        {16, "cd9c", 144.571298, 1e-5},    // 52636 · 180 / 65535
        {17, "d917", 152.643625, 1e-5},    // 55575 · 180 / 65535
        {18, "724a0a20", 160.719211436976, 1e-9},
        {19, "87f84b86", -168.792324833941, 1e-8},
        {20, "7dc55ece", 176.865437649392, 1e-9},
        {21, "03830926", 68590.9832987, 1e-5},
        {22, "1281", 722.819867, 1e-5},  // 4737 · 10000 / 65535
        {23, "f101a229", -10.5423886331461, 1e-9},
        {24, "14bc082b", 29.157890122923, 1e-9},
        {25, "34f3", 3216.037232, 1e-5},    // −900 + 13555 · 19900 / 65535
        {26, "1750", 0.0136600848, 1e-9},   // 5968 · 0.075 / 32767
        {28, "f9c1", -0.0036599322, 1e-9},  // −1599 · 0.075 / 32767
        {36, "b2", 69.803922, 1e-5},        // 178 · 100 / 255
        {39, "ec", -20, 0},
        {43, "03", 6, 0},
        {90, "ff62e2f2", -0.43152510208614414, 1e-9},
        {96, "00d92a", 13898.5, 1e-9},  // 55594 / 2² : IMAPB over [0, 1 500 000] in three bytes
        {104, "2f921e", 23456.234375, 1e-9},
        {112, "1f40", 125, 1e-9},
        {113, "05f500", 2150, 1e-9},
        {119, "3b60", -50, 1e-9},
        {120, "4800", 72, 1e-9},
    };
    for (const Example& example : examples) {
        const TagInfo* info = infoOf(example.tag);
        ASSERT_NE(info, nullptr) << example.tag;
        const auto value = numberOf(*info, bytesOfHex(example.code));
        ASSERT_TRUE(value) << info->name;
        EXPECT_NEAR(*value, example.value, example.tolerance) << info->name;
    }
}

TEST(KlvValues, endsOfRangesAreMetExactly) {
    EXPECT_EQ(numberOf(*infoOf(5), bytesOfHex("ffff")), 360.0);
    EXPECT_EQ(numberOf(*infoOf(13), bytesOfHex("7fffffff")), 90.0);
    EXPECT_EQ(numberOf(*infoOf(13), bytesOfHex("80000001")), -90.0);
    EXPECT_EQ(numberOf(*infoOf(15), bytesOfHex("0000")), -900.0);
    EXPECT_EQ(numberOf(*infoOf(96), bytesOfHex("000000")), 0.0);
}

TEST(KlvValues, NumbersOfAnyLengthHaveOneToEightBytes) {
    const TagInfo& version = *infoOf(65);
    EXPECT_FALSE(numberOf(version, {}));
    EXPECT_EQ(numberOf(version, bytesOfHex("13")), 19.0);
    EXPECT_EQ(numberOf(version, bytesOfHex("0000000000000013")), 19.0);
    EXPECT_FALSE(numberOf(version, bytesOfHex("010000000000000013")));
}

TEST(KlvValues, whatSaysNoValueOrHasAWrongLengthIsNone) {
    EXPECT_FALSE(numberOf(*infoOf(13), bytesOfHex("80000000")));  // "out of range"
    EXPECT_FALSE(numberOf(*infoOf(26), bytesOfHex("8000")));
    EXPECT_FALSE(numberOf(*infoOf(13), bytesOfHex("5595b6")));
    EXPECT_FALSE(numberOf(*infoOf(13), {}));
    EXPECT_FALSE(numberOf(*infoOf(96), bytesOfHex("d00000")));  // IMAPB: beyond the range
    EXPECT_FALSE(klv::floatOf(bytesOfHex("7fc00000")));         // not a number
    EXPECT_FALSE(klv::floatOf(bytesOfHex("7f80")));
}

TEST(KlvValues, lengthsAndTagsOfAnyFormAreRead) {
    const auto lengthOf = [](const char* hex) {
        const KlvBytes bytes = bytesOfHex(hex);
        return klv::ByteCursor(bytes).takeLength();
    };
    EXPECT_EQ(lengthOf("05"), 5U);
    EXPECT_EQ(lengthOf("81f1"), 241U);
    EXPECT_EQ(lengthOf("82097b"), 2427U);
    EXPECT_EQ(lengthOf("8400000003"), 3U);
    EXPECT_FALSE(lengthOf("80"));    // indefinite
    EXPECT_FALSE(lengthOf("89"));    // nine bytes
    EXPECT_FALSE(lengthOf("8212"));  // cut off
    const auto tagOf = [](const char* hex) {
        const KlvBytes bytes = bytesOfHex(hex);
        return klv::ByteCursor(bytes).takeTag();
    };
    EXPECT_EQ(tagOf("41"), 65U);
    EXPECT_EQ(tagOf("810e"), 142U);
    EXPECT_FALSE(tagOf("ffffffffff7f"));  // beyond 32 bits
    EXPECT_FALSE(tagOf("81"));
}

TEST(KlvValues, theChecksumAddsBytesInPairs) {
    EXPECT_EQ(klv::checksumOf(bytesOfHex("010203")), 0x0402);
    EXPECT_EQ(klv::checksumOf(bytesOfHex("ffffffff")), 0xFFFE);
}

TEST(KlvValues, aLocalSetGivesItsNumbersTextsAndTime) {
    const KlvBytes set = LocalSetWriter()
                             .time(1'231'798'102'000'000)
                             .item(3, {'M', 'I', 0x07, 'S'})
                             .item(5, bytesOfHex("71c2"))
                             .item(13, bytesOfHex("80000000"))
                             .item(142, bytesOfHex("06"))
                             .bytes();
    const MetadataStream stream = collected({{set}});
    ASSERT_EQ(stream.packets.size(), 1U);
    EXPECT_EQ(stream.damaged(), 0);
    const MetadataPacket& packet = stream.packets[0];
    EXPECT_TRUE(packet.has_checksum);
    ASSERT_TRUE(packet.utc_us);
    EXPECT_EQ(utcText(*packet.utc_us), "2009-01-12T22:08:22.000000Z");
    EXPECT_NEAR(packet.number(5).value_or(0), 159.974364843, 1e-6);
    EXPECT_FALSE(packet.number(13));
    ASSERT_EQ(packet.texts.size(), 1U);
    EXPECT_EQ(packet.texts[0].value, "MIS");
    EXPECT_EQ(stream.tags.at(13).unreadable, 1);
    EXPECT_EQ(stream.tags.at(142).packets, 1);
}

TEST(KlvValues, theUniversalSetMeansTheSameTags) {
    const KlvBytes set = UniversalSetWriter()
                             .item("0702010101050000", test::bigEndian(1'231'798'102'000'000, 8))
                             .real("0701020103020000", 38.25)
                             .real("0701020103040000", -77.5)
                             .single("0701100106000000", -102.5F)
                             .single("0420020101080000", 0.75F)
                             .item("0102030405060708", {1, 2, 3})
                             .bytes();
    const MetadataStream stream = collected({{set}});
    ASSERT_EQ(stream.universal_sets, 1);
    EXPECT_EQ(stream.damaged(), 0);
    const MetadataPacket& packet = stream.packets[0];
    EXPECT_EQ(packet.number(tag::kCentreLatitude), 38.25);
    EXPECT_EQ(packet.number(tag::kCentreLongitude), -77.5);
    EXPECT_EQ(packet.number(tag::kPlatformHeading), -102.5);
    EXPECT_EQ(packet.number(tag::kHorizontalView), 0.75);
    EXPECT_EQ(packet.utc_us, 1'231'798'102'000'000);
    EXPECT_EQ(stream.tags.at(0).packets, 1);  // of unknown key
}

TEST(KlvBytesByHand, NumbersOfAnyLength) {
    const auto whole = [](const char* hex) { return klv::signedOf(bytesOfHex(hex)); };
    EXPECT_EQ(whole("7f"), 127);
    EXPECT_EQ(whole("80"), -128);
    EXPECT_EQ(whole("ff"), -1);
    EXPECT_EQ(whole("00ff"), 255);
    EXPECT_EQ(whole("ff01"), -255);
    EXPECT_EQ(whole("800000"), -8'388'608);
    EXPECT_EQ(whole("ffffffffffffff"), -1);
    EXPECT_EQ(whole("fffffffffffffffe"), -2);
    EXPECT_EQ(klv::unsignedOf(bytesOfHex("0102")), 258U);
    EXPECT_EQ(klv::floatOf(bytesOfHex("3fc00000")), 1.5);
    EXPECT_EQ(klv::floatOf(bytesOfHex("c000000000000000")), -2.0);
    EXPECT_FALSE(klv::floatOf(bytesOfHex("3fc0000000")));
    EXPECT_FALSE(klv::floatOf(bytesOfHex("7f800000"))) << "infinite";
}

TEST(KlvBytesByHand, LengthsUpToEightBytesAndTagsUpTo32Bits) {
    const auto lengthOf = [](const char* hex) {
        const KlvBytes bytes = bytesOfHex(hex);
        return klv::ByteCursor(bytes).takeLength();
    };
    EXPECT_EQ(lengthOf("7f"), 127U);
    EXPECT_EQ(lengthOf("880000000000000102"), 258U);
    EXPECT_FALSE(lengthOf("89000000000000000102"));
    const auto tagOf = [](const char* hex) {
        const KlvBytes bytes = bytesOfHex(hex);
        return klv::ByteCursor(bytes).takeTag();
    };
    EXPECT_EQ(tagOf("7f"), 127U);
    EXPECT_EQ(tagOf("8100"), 128U);
    EXPECT_EQ(tagOf("8fffffff7f"), 0xFFFFFFFFU);
    EXPECT_FALSE(tagOf("9080808000")) << "2³²";
    EXPECT_FALSE(tagOf("808080808001")) << "six bytes";
    const KlvBytes bytes = bytesOfHex("010203");
    klv::ByteCursor cursor(bytes);
    EXPECT_FALSE(cursor.take(4));
    EXPECT_EQ(cursor.left(), 3U) << "nothing was taken";
    EXPECT_EQ((*cursor.take(1))[0], 1);
    EXPECT_EQ((*cursor.take(2))[1], 3);
    EXPECT_EQ(cursor.position(), 3U);
    EXPECT_EQ(cursor.left(), 0U);
}

TEST(KlvBytesByHand, ImapbMeetsZeroExactly) {
    // Over [−0.9, 0.7] one byte has 2^(7 − 1) steps a unit: 64 · −0.9 = −57.6, rounded down −58, so that code 58 is 0.
    const auto across = [](int code) {
        const KlvBytes bytes{static_cast<std::uint8_t>(code)};
        return klv::imapbOf(bytes, -0.9, 0.7);
    };
    EXPECT_NEAR(across(58).value_or(9), 0, 1e-12);
    EXPECT_NEAR(across(59).value_or(9), 1.0 / 64, 1e-12);
    EXPECT_NEAR(across(1).value_or(9), -57.0 / 64, 1e-12);
    EXPECT_FALSE(across(0)) << "−58 / 64 lies below the range";
    EXPECT_NEAR(across(102).value_or(9), 44.0 / 64, 1e-12);
    EXPECT_FALSE(across(103)) << "45 / 64 above";
    // A range of less than a unit, on one side of 0: 128 steps a unit from its lower end.
    EXPECT_NEAR(klv::imapbOf(bytesOfHex("40"), 0.3, 1.2).value_or(9), 0.8, 1e-12);
    EXPECT_NEAR(klv::imapbOf(bytesOfHex("40"), -1.2, -0.3).value_or(9), -0.7, 1e-12);
    // The top of a whole range is the highest bit alone.
    EXPECT_EQ(klv::imapbOf(bytesOfHex("80"), 0, 1), 1.0);
    EXPECT_FALSE(klv::imapbOf(bytesOfHex("81"), 0, 1));
    EXPECT_EQ(klv::imapbOf(bytesOfHex("8000000000000000"), 0, 1), 1.0);
    EXPECT_FALSE(klv::imapbOf({}, 0, 1));
    EXPECT_FALSE(klv::imapbOf(bytesOfHex("000000000000000000"), 0, 1));
}

TEST(KlvSetsByHand, OfATagThatComesTwiceTheLastCounts) {
    const MetadataStream stream = collected({{LocalSetWriter()
                                                  .item(5, bytesOfHex("ffff"))
                                                  .item(4, {})
                                                  .item(5, bytesOfHex("0000"))
                                                  .item(8, {7})
                                                  .item(1000, {1})
                                                  .item(1001, {1})
                                                  .item(1500, {1})
                                                  .bytes()}});
    ASSERT_EQ(stream.packets.size(), 1U);
    EXPECT_EQ(stream.packets[0].number(5), 0.0);
    EXPECT_EQ(stream.packets[0].number(8), 7.0);
    EXPECT_FALSE(stream.packets[0].number(6));
    EXPECT_TRUE(stream.packets[0].texts.empty()) << "an empty text says nothing";
    EXPECT_EQ(stream.tags.at(5).packets, 1) << "counted once a set";
    EXPECT_EQ(stream.tags.at(1000).packets, 1);
    EXPECT_EQ(stream.tags.count(1001), 0U) << "the standard has no tag beyond 1000";
    EXPECT_EQ(stream.tags.at(0).packets, 1);
    EXPECT_EQ(stream.without_time, 1);
    EXPECT_EQ(stream.without_stamp, 1);
}

TEST(KlvSetsByHand, TimesReachIntoTheYear2255) {
    const MetadataStream stream = collected({{LocalSetWriter().time(8'900'000'000'000'000).bytes(), 0},
                                             {LocalSetWriter().time(9'100'000'000'000'000).bytes(), 0}});
    EXPECT_EQ(stream.packets.at(0).utc_us, 8'900'000'000'000'000);
    EXPECT_EQ(stream.packets.at(1).utc_us, std::nullopt);
    EXPECT_EQ(stream.tags.at(tag::kTime).unreadable, 1);
    EXPECT_EQ(stream.tags.at(tag::kTime).packets, 2);
    EXPECT_EQ(stream.without_time, 1);
    EXPECT_EQ(stream.without_stamp, 0);
}

TEST(KlvSetsByHand, SummariesHoldTheLeastTheGreatestAndTheFirstText) {
    const auto set = [](double speed, const char* mission) {
        LocalSetWriter writer;
        writer.item(8, {static_cast<std::uint8_t>(speed)});
        if (mission != nullptr) writer.item(3, KlvBytes(mission, mission + 1)).item(10, {'P'});
        return test::Carried{writer.bytes()};
    };
    const MetadataStream stream = collected({set(30, "A"), set(10, nullptr), set(50, "A"), set(40, "B"), set(20, "A")});
    EXPECT_EQ(stream.tags.at(8).least, 10);
    EXPECT_EQ(stream.tags.at(8).greatest, 50);
    EXPECT_TRUE(stream.tags.at(8).has_numbers);
    EXPECT_EQ(stream.tags.at(3).text, "A");
    EXPECT_TRUE(stream.tags.at(3).text_changes);
    EXPECT_EQ(stream.tags.at(3).packets, 4);
    EXPECT_FALSE(stream.tags.at(3).has_numbers);
    EXPECT_EQ(stream.tags.at(10).text, "P");
    EXPECT_FALSE(stream.tags.at(10).text_changes);
}

TEST(KlvSetsByHand, ALeapIsMoreThanTenSeconds) {
    const auto leaps = [](std::uint64_t by_us) {
        return collected(
                   {{LocalSetWriter().time(1'000'000).bytes()}, {LocalSetWriter().time(1'000'000 + by_us).bytes()}})
            .leaps;
    };
    EXPECT_EQ(leaps(10'000'000), 0);
    EXPECT_EQ(leaps(10'000'001), 1);
    const MetadataStream same =
        collected({{LocalSetWriter().time(5'000'000).bytes()}, {LocalSetWriter().time(5'000'000).bytes()}});
    EXPECT_EQ(same.steps_back, 0);
    EXPECT_EQ(same.leaps, 0);
}

TEST(KlvSetsByHand, TheStreamWithMostPlacesIsTheMostUsefulThenTheLongest) {
    const auto place = [] { return test::Carried{LocalSetWriter().angle(tag::kCentreLatitude, 5, 90).bytes()}; };
    const auto nowhere = [] { return test::Carried{LocalSetWriter().angle(tag::kCentreLongitude, 5, 180).bytes()}; };
    const auto unreadable = [] {
        return test::Carried{LocalSetWriter().item(tag::kCentreLatitude, bytesOfHex("80000000")).bytes()};
    };
    MetadataRecording recording;
    EXPECT_EQ(recording.mostUseful(), -1);
    recording.streams.push_back(collected({nowhere(), unreadable(), unreadable()}));
    EXPECT_EQ(recording.streams[0].places(), 0);
    EXPECT_EQ(recording.mostUseful(), 0);
    recording.streams.push_back(collected({place(), nowhere()}));
    EXPECT_EQ(recording.streams[1].places(), 1);
    EXPECT_EQ(recording.mostUseful(), 1);
    recording.streams.push_back(collected({place(), nowhere(), nowhere()}));
    EXPECT_EQ(recording.mostUseful(), 2);
    recording.streams.push_back(collected({place(), place()}));
    EXPECT_EQ(recording.mostUseful(), 3);
    recording.streams.push_back(recording.streams[3]);
    EXPECT_EQ(recording.mostUseful(), 3) << "the first of two that are alike";
    recording.streams = {MetadataStream()};
    EXPECT_EQ(recording.mostUseful(), -1) << "no set could be read";
}

TEST(KlvSetsByHand, LengthsReachTo256Kilobytes) {
    const auto faults = [](const char* length) {
        KlvBytes head = test::localSetKey();
        test::append(head, bytesOfHex(length));
        return collected({{head}, {LocalSetWriter().item(8, {7}).bytes()}});
    };
    const MetadataStream longest = faults("83040000"), longer = faults("83040001");
    EXPECT_EQ(test::faultsOf(longest, klv::Fault::cut_off), 1);
    EXPECT_EQ(test::faultsOf(longest, klv::Fault::bad_length), 0);
    EXPECT_EQ(test::faultsOf(longer, klv::Fault::cut_off), 0);
    EXPECT_EQ(test::faultsOf(longer, klv::Fault::bad_length), 1);
    EXPECT_EQ(longest.packets.size(), 1U);
    EXPECT_EQ(longer.packets.size(), 1U);
}

}  // namespace eyrie::klv_values_test

#include <gtest/gtest.h>

#include "core/utc_time.h"
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

}  // namespace eyrie::klv_values_test

#include "metadata/vmti/vmti_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "metadata/metadata_packet.h"
#include "metadata/vmti/klv_packing.h"
#include "support/klv_writer.h"
#include "support/vmti_reading.h"

namespace eyrie::vmti::vmti_set_test {
namespace {

using Packed = std::vector<std::uint8_t>;

Frame street() {
    Frame frame;
    frame.utc_us = 1'700'000'000'123'456;
    frame.number = 4711;
    frame.size = {1024, 540};
    frame.system = "Eyrie";
    Target moving;
    moving.id = 300;
    moving.centre = {1023, 539};
    moving.top_left = {1000, 500};
    moving.bottom_right = {1023, 539};
    moving.confidence_percent = 87;
    moving.seen_before = 300;
    moving.place = GeoPoint{48.25, -11.5};
    moving.ellipsoid_height_m = 512;
    moving.track.emplace();
    moving.track->fill(7);
    moving.first_utc_us = frame.utc_us - 4'000'000;
    moving.last_utc_us = frame.utc_us;
    moving.velocity = Target::Velocity{-12.5, 3};
    Target standing;
    standing.id = 5;
    standing.centre = standing.top_left = standing.bottom_right = {0, 0};
    standing.detection = Detection::stopped;
    frame.targets = {moving, standing};
    return frame;
}

/// Hands the sets of a stream to the reader.
std::vector<Frame> framesIn(const Packed& bytes, std::optional<klv::Fault>* fault = nullptr,
                            int* unreadable = nullptr) {
    klv::Splitter splitter;
    std::vector<Frame> frames;
    const auto visit = [&](const klv::Set& set) -> std::optional<klv::Fault> {
        if (!isKey(set.key)) return std::nullopt;
        Frame frame;
        int lost = 0;
        const auto wrong = read(set, frame, lost);
        if (fault != nullptr && wrong) *fault = wrong;
        if (unreadable != nullptr) *unreadable += lost;
        if (!wrong) frames.push_back(frame);
        return wrong;
    };
    splitter.feed(bytes, visit);
    splitter.finish(visit);
    return frames;
}

Packed withSum(Packed set) {
    set.resize(set.size() - 2);
    const auto sum = klv::unsignedBytes(klv::checksumOf(set), 2);
    set.insert(set.end(), sum.begin(), sum.end());
    return set;
}

}  // namespace

TEST(VmtiSet, BeginsWithTheKeyOfTheStandard) {
    const Packed expected{0x06, 0x0E, 0x2B, 0x34, 0x02, 0x0B, 0x01, 0x01, 0x0E, 0x01, 0x03, 0x03, 0x06, 0, 0, 0};
    const Packed written = packed(street());
    EXPECT_EQ(Packed(written.begin(), written.begin() + 16), expected);
}

TEST(VmtiSet, ComesBackAsItWasWritten) {
    const Frame written = street();
    const auto read = framesIn(packed(written));
    ASSERT_EQ(read.size(), 1U);
    const Frame& frame = read[0];
    EXPECT_EQ(frame.utc_us, written.utc_us);
    EXPECT_EQ(frame.number, 4711U);
    EXPECT_EQ(frame.size, cv::Size(1024, 540));
    EXPECT_EQ(frame.system, "Eyrie");
    ASSERT_EQ(frame.targets.size(), 2U);
    const Target& moving = frame.targets[0];
    EXPECT_EQ(moving.id, 300U);
    EXPECT_EQ(moving.centre, cv::Point(1023, 539));
    EXPECT_EQ(moving.top_left, cv::Point(1000, 500));
    EXPECT_EQ(moving.confidence_percent, 87);
    EXPECT_EQ(moving.seen_before, 300);
    EXPECT_NEAR(moving.place->latitude_deg, 48.25, 1.2e-7);
    EXPECT_NEAR(moving.place->longitude_deg, -11.5, 1.2e-7);
    EXPECT_NEAR(*moving.ellipsoid_height_m, 512, 1);
    EXPECT_EQ(moving.track, written.targets[0].track);
    EXPECT_EQ(moving.first_utc_us, written.targets[0].first_utc_us);
    EXPECT_EQ(moving.last_utc_us, written.utc_us);
    EXPECT_NEAR(moving.velocity->east_m_s, -12.5, 0.07);
    EXPECT_NEAR(moving.velocity->north_m_s, 3, 0.07);
    const Target& standing = frame.targets[1];
    EXPECT_EQ(standing.detection, Detection::stopped);
    EXPECT_FALSE(standing.place || standing.velocity || standing.confidence_percent || standing.track);
}

// Worked out by hand from ST 0903 and ST 1201.
TEST(VmtiSet, LiesInTheBytesAsTheStandardSays) {
    Frame frame;
    frame.utc_us = 1;
    frame.number = 2;
    frame.size = {1920, 1080};
    frame.system = "E";
    Target target;
    target.id = 200;                  // BER-OID: 81 48
    target.centre = {959, 539};       // 960 + 539 · 1920 = 1035840 = 0f ce 40
    target.top_left = {0, 0};         // 1
    target.bottom_right = {1919, 0};  // 1920 = 07 80
    target.place = GeoPoint{0, 0};
    frame.targets = {target};
    // Latitude: 2^(31 − 8) · 90 = 2d000000; longitude: 2^(31 − 9) · 180 = 2d000000.
    const std::string expected =
        "060e2b34020b01010e01030306000000"
        "4e"                    // 78 bytes follow
        "02080000000000000001"  // time
        "030145"                // system
        "04020005"              // version
        "050101"
        "060101"  // detected, reported
        "070102"  // frame
        "08020780"
        "09020438"  // size
        "6526"
        "25"    // series of 38 bytes, pack of 37
        "8148"  // id
        "01030fce40"
        "020101"
        "03020780"
        "11082d0000002d000000"  // place without height
        "1302021c"
        "140203c0"  // row 540, column 960
        "6803"
        "020101"  // tracker: active
        "0102";   // checksum
    Packed bytes = packed(frame);
    const test::KlvBytes wanted = test::bytesOfHex(expected);
    ASSERT_EQ(bytes.size(), wanted.size() + 2);
    EXPECT_EQ(Packed(bytes.begin(), bytes.end() - 2), wanted);
    unsigned sum = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) sum += static_cast<unsigned>(wanted[i]) << (i % 2 == 0 ? 8 : 0);
    EXPECT_EQ(bytes[bytes.size() - 2], (sum >> 8) & 0xFF);
    EXPECT_EQ(bytes[bytes.size() - 1], sum & 0xFF);
}

TEST(VmtiSet, AFrameWithoutTargetsSaysSo) {
    Frame empty;
    empty.utc_us = 5;
    empty.size = {64, 48};
    const auto read = framesIn(packed(empty));
    ASSERT_EQ(read.size(), 1U);
    EXPECT_TRUE(read[0].targets.empty());
}

TEST(VmtiSet, ManyTargetsNeedLongLengthsAndStayInTheirFrame) {
    Frame crowd = street();
    for (int i = 0; i < 400; ++i) {
        Target target;
        target.id = 1000 + static_cast<std::uint32_t>(i);
        target.centre = {i, 2000};  // outside: its nearest pixel is written
        crowd.targets.push_back(target);
    }
    const auto read = framesIn(packed(crowd));
    ASSERT_EQ(read.size(), 1U);
    ASSERT_EQ(read[0].targets.size(), 402U);
    EXPECT_EQ(read[0].targets[301].id, 1299U);
    EXPECT_EQ(read[0].targets[301].centre, cv::Point(299, 539));
}

TEST(VmtiSet, BerAndOidNumbersTakeTheirShortestForm) {
    const auto length = [](std::uint64_t value) {
        klv::ByteSink sink;
        sink.putLength(value);
        return sink.bytes();
    };
    EXPECT_EQ(length(127), test::bytesOfHex("7f"));
    EXPECT_EQ(length(128), test::bytesOfHex("8180"));
    EXPECT_EQ(length(65536), test::bytesOfHex("83010000"));
    const auto tag = [](std::uint32_t value) {
        klv::ByteSink sink;
        sink.putTag(value);
        return sink.bytes();
    };
    EXPECT_EQ(tag(0), test::bytesOfHex("00"));
    EXPECT_EQ(tag(127), test::bytesOfHex("7f"));
    EXPECT_EQ(tag(128), test::bytesOfHex("8100"));
    EXPECT_EQ(tag(16384), test::bytesOfHex("818000"));
    EXPECT_EQ(tag(0xFFFFFFFF), test::bytesOfHex("8fffffff7f"));
    for (const std::uint32_t value : {0U, 1U, 127U, 128U, 16383U, 16384U, 2097151U, 2097152U, 0xFFFFFFFFU}) {
        const auto bytes = tag(value);
        klv::ByteCursor cursor(bytes);
        EXPECT_EQ(cursor.takeTag(), value);
        EXPECT_EQ(cursor.left(), 0U);
    }
}

TEST(VmtiSet, NumbersTakeAsFewBytesAsHoldThem) {
    EXPECT_EQ(klv::fewestBytes(0), test::bytesOfHex("00"));
    EXPECT_EQ(klv::fewestBytes(255), test::bytesOfHex("ff"));
    EXPECT_EQ(klv::fewestBytes(256), test::bytesOfHex("0100"));
    EXPECT_EQ(klv::fewestBytes((std::uint64_t{1} << 56) - 1), test::bytesOfHex("ffffffffffffff"));
    EXPECT_EQ(klv::fewestBytes(std::uint64_t{1} << 56), test::bytesOfHex("0100000000000000"));
    EXPECT_EQ(klv::fewestBytes(UINT64_MAX), test::bytesOfHex("ffffffffffffffff"));
    EXPECT_EQ(klv::unsignedBytes(258, 3), test::bytesOfHex("000102"));
}

TEST(VmtiSet, RangesAreWrittenAsSt1201Says) {
    const auto speed = [](double m_s) { return klv::imapbBytes(m_s, -900, 900, 2); };
    // 1800 takes eleven bits: 2^(15 − 11) = 16 steps a unit from −900 on.
    EXPECT_EQ(speed(0), test::bytesOfHex("3840"));      // 14400
    EXPECT_EQ(speed(-12.5), test::bytesOfHex("3778"));  // 14200
    EXPECT_EQ(speed(1000), test::bytesOfHex("7080"));   // 28800: what lies beyond is clamped
    EXPECT_EQ(speed(-1000), test::bytesOfHex("0000"));
    // 64 steps a unit; 0 is met exactly: 57.6 steps above the lower end, which is rounded down to 58 below.
    EXPECT_EQ(klv::imapbBytes(0, -0.9, 0.7, 1), test::bytesOfHex("3a"));
    // On one side of 0 there is nothing to meet: 128 · 0.505 = 64.64.
    EXPECT_EQ(klv::imapbBytes(0.805, 0.3, 1.2, 1), test::bytesOfHex("40"));
    EXPECT_EQ(klv::imapbBytes(-0.695, -1.2, -0.3, 1), test::bytesOfHex("40"));
}

TEST(VmtiSet, WhatLiesOutsideIsWrittenAsTheNearestThatIsAllowed) {
    Frame frame;
    frame.utc_us = 1;
    frame.size = {64, 48};
    Target target;
    target.centre = {70, -3};
    target.top_left = {-5, 50};
    target.bottom_right = {70, 50};
    target.confidence_percent = 150;
    target.seen_before = 70'000;
    frame.targets = {target};
    const Packed bytes = packed(frame);
    const auto read = framesIn(bytes);
    ASSERT_EQ(read.size(), 1U);
    ASSERT_EQ(read[0].targets.size(), 1U);
    EXPECT_EQ(read[0].targets[0].centre, cv::Point(63, 0));
    EXPECT_EQ(read[0].targets[0].top_left, cv::Point(0, 47));
    EXPECT_EQ(read[0].targets[0].bottom_right, cv::Point(63, 47));
    EXPECT_EQ(read[0].targets[0].confidence_percent, 100);
    EXPECT_EQ(read[0].targets[0].seen_before, 65'535);
    const auto holds = [](const Packed& all, const char* hex) {
        const Packed part = test::bytesOfHex(hex);
        return std::search(all.begin(), all.end(), part.begin(), part.end()) != all.end();
    };
    EXPECT_TRUE(holds(bytes, "130101140140")) << "row 1, column 64";
    frame.targets[0].centre = {-1, 60};
    frame.targets[0].confidence_percent = -5;
    EXPECT_TRUE(holds(packed(frame), "130130140101")) << "row 48, column 1";
    EXPECT_EQ(framesIn(packed(frame)).at(0).targets.at(0).confidence_percent, 0);
}

TEST(VmtiSet, AnyFlippedByteIsNoticed) {
    const Packed good = packed(street());
    for (std::size_t at = 17; at < good.size(); ++at) {
        Packed bytes = good;
        bytes[at] ^= 0x10;
        EXPECT_TRUE(framesIn(bytes).empty()) << at;
    }
}

TEST(VmtiSet, WhatIsCutOffIsNotRead) {
    const Packed good = packed(street());
    for (std::size_t size = 0; size < good.size(); ++size)
        EXPECT_TRUE(framesIn(Packed(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size))).empty()) << size;
}

TEST(VmtiSet, ATargetThatCannotBeReadIsLeftOutAndCounted) {
    Frame frame = street();
    frame.targets.resize(1);
    Packed bytes = packed(frame);
    // The centre's pixel number, 1024 · 540, becomes one beyond the frame.
    const Packed number = test::bytesOfHex("0103087000");
    const auto found = std::search(bytes.begin(), bytes.end(), number.begin(), number.end());
    ASSERT_NE(found, bytes.end());
    *(found + 4) = 1;
    int unreadable = 0;
    const auto read = framesIn(withSum(bytes), nullptr, &unreadable);
    ASSERT_EQ(read.size(), 1U);
    EXPECT_TRUE(read[0].targets.empty());
    EXPECT_EQ(unreadable, 1);
}

TEST(VmtiSet, RandomBytesWithARightChecksumAreReadOrRefused) {
    std::mt19937 dice(11);
    const Packed good = packed(street());
    for (int i = 0; i < 5000; ++i) {
        Packed bytes = good;
        for (int changes = 1 + static_cast<int>(dice() % 6); changes > 0; --changes)
            bytes[17 + dice() % (bytes.size() - 19)] = static_cast<std::uint8_t>(dice());
        for (const Frame& frame : framesIn(withSum(bytes)))
            for (const Target& target : frame.targets)
                EXPECT_TRUE(cv::Rect(cv::Point(), frame.size).contains(target.centre));
    }
}

}  // namespace eyrie::vmti::vmti_set_test

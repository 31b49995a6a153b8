#include <gtest/gtest.h>

#include <random>

#include "metadata/collected.h"
#include "metadata/ground_view.h"

namespace eyrie::damaged_klv_test {
namespace {

using test::append;
using test::Carried;
using test::collected;
using test::faultsOf;
using test::KlvBytes;
using test::LocalSetWriter;

KlvBytes goodSet(int number = 0) {
    return LocalSetWriter().time(1'000'000U + static_cast<unsigned>(number)).angle(13, 50 + number, 90).bytes();
}

KlvBytes joined(std::initializer_list<KlvBytes> parts) {
    KlvBytes all;
    for (const KlvBytes& part : parts) append(all, part);
    return all;
}

KlvBytes cut(KlvBytes bytes, std::size_t keep) {
    bytes.resize(keep);
    return bytes;
}

TEST(DamagedKlv, SetsWithinSetsAtFaultAreReadSoOftenAndNoMore) {
    // Keys of groups close together, each with a length that reaches to the end.
    std::vector<std::uint8_t> bytes;
    constexpr std::size_t kBytes = 200'000;
    constexpr std::size_t kOne = 20;
    while (bytes.size() + kOne < kBytes) {
        const std::size_t left = kBytes - bytes.size() - kOne;
        for (const int byte : {0x06, 0x0E, 0x2B, 0x34, 0x02, 0x0B, 1, 1, 0x0E, 1, 3, 1, 1, 0, 0, 0, 0x83})
            bytes.push_back(static_cast<std::uint8_t>(byte));
        for (const int shift : {16, 8, 0}) bytes.push_back(static_cast<std::uint8_t>(left >> shift));
    }
    bytes.resize(kBytes);
    klv::Splitter splitter;
    std::size_t read = 0;
    const auto visit = [&](const klv::Set& set) {
        read += set.whole.size();
        return std::optional(klv::Fault::broken_items);
    };
    splitter.feed(klv::Bytes(bytes), visit);
    splitter.finish(visit);
    EXPECT_GT(read, kBytes);
    EXPECT_LT(read, 8 * kBytes);
}

/// A set whose checksum has so many bytes, the sum in the last two, and is followed by so many bytes of an item.
KlvBytes withChecksumOf(std::uint8_t bytes, std::uint8_t following) {
    KlvBytes set = test::localSetKey();
    append(set, {static_cast<std::uint8_t>(6 + 2 + bytes + following), 13, 4, 0x20, 0, 0, 0, 1, bytes});
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < set.size(); ++i) sum += static_cast<std::uint32_t>(set[i]) << (i % 2 == 0 ? 8 : 0);
    append(set, test::bigEndian(sum & 0xFFFF, bytes));
    if (following > 0) append(set, {3, static_cast<std::uint8_t>(following - 2)});
    set.resize(set.size() + (following > 0 ? following - 2U : 0U), 'x');
    return set;
}

}  // namespace

TEST(DamagedKlv, aChecksumHasTwoBytesAndComesLast) {
    EXPECT_EQ(collected({{withChecksumOf(2, 0)}}).packets.size(), 1U);
    for (const KlvBytes& set : {withChecksumOf(2, 2), withChecksumOf(2, 7), withChecksumOf(1, 0), withChecksumOf(3, 0),
                                withChecksumOf(4, 0), withChecksumOf(4, 3)}) {
        const MetadataStream stream = collected({{set}, {goodSet(1)}});
        EXPECT_EQ(stream.packets.size(), 1U) << set.size();
        EXPECT_EQ(faultsOf(stream, klv::Fault::wrong_checksum), 1) << set.size();
        EXPECT_EQ(stream.damaged(), 1) << set.size();
    }
}

TEST(DamagedKlv, aWrongChecksumCostsOneSet) {
    KlvBytes bad = goodSet(1);
    bad[bad.size() - 8] ^= 0x10;
    const MetadataStream stream = collected({{goodSet(0)}, {bad}, {goodSet(2)}});
    EXPECT_EQ(stream.packets.size(), 2U);
    EXPECT_EQ(faultsOf(stream, klv::Fault::wrong_checksum), 1);
    EXPECT_EQ(stream.damaged(), 1);
}

TEST(DamagedKlv, whereTheFirstDamageLiesIsKnown) {
    KlvBytes bad = goodSet(1);
    bad[bad.size() - 8] ^= 0x10;
    const MetadataStream stream =
        collected({{goodSet(0), kNoStamp, 5}, {bad, kNoStamp, 30}, {bad, kNoStamp, 55}, {goodSet(2), kNoStamp, 80}});
    ASSERT_TRUE(stream.first_damage);
    EXPECT_EQ(stream.first_damage->pictures_before, 30);
    EXPECT_FALSE(collected({{goodSet(0), kNoStamp, 5}}).first_damage);
}

TEST(DamagedKlv, aSetWithoutChecksumIsBelievedAndCounted) {
    const MetadataStream stream = collected({{LocalSetWriter().time(5).angle(13, 50, 90).bytesWithoutChecksum()}});
    EXPECT_EQ(stream.packets.size(), 1U);
    EXPECT_EQ(stream.without_checksum, 1);
    EXPECT_EQ(stream.damaged(), 0);
}

TEST(DamagedKlv, aSetThatIsCutOffDoesNotTakeTheNextWithIt) {
    for (const std::size_t keep : {std::size_t{3}, std::size_t{16}, std::size_t{17}, std::size_t{25}}) {
        const MetadataStream stream = collected({{cut(goodSet(0), keep)}, {goodSet(1)}, {goodSet(2)}});
        EXPECT_EQ(stream.packets.size(), 2U) << keep;
        EXPECT_EQ(faultsOf(stream, klv::Fault::cut_off), 1) << keep;
    }
    const MetadataStream at_end = collected({{goodSet(0)}, {cut(goodSet(1), 30)}});
    EXPECT_EQ(at_end.packets.size(), 1U);
    EXPECT_EQ(faultsOf(at_end, klv::Fault::cut_off), 1);
}

TEST(DamagedKlv, aLengthThatSwallowsTheNextSetsGivesThemBack) {
    KlvBytes bad = goodSet(0);
    bad[16] = static_cast<std::uint8_t>(bad[16] + goodSet(1).size());
    const MetadataStream stream = collected({{joined({bad, goodSet(1), goodSet(2)})}});
    EXPECT_EQ(stream.packets.size(), 2U);
    EXPECT_EQ(stream.damaged(), 1);
}

TEST(DamagedKlv, impossibleLengthsAreCounted) {
    KlvBytes indefinite = goodSet(0), endless = goodSet(0);
    indefinite[16] = 0x80;
    endless[16] = 0x84;
    endless[17] = 0x7F;
    const MetadataStream stream = collected({{indefinite}, {goodSet(1)}, {endless}, {goodSet(2)}});
    EXPECT_EQ(stream.packets.size(), 2U);
    EXPECT_EQ(faultsOf(stream, klv::Fault::bad_length), 2);
}

TEST(DamagedKlv, itemsThatRunOverTheEndOfTheSetAreRefused) {
    KlvBytes set = LocalSetWriter().time(7).bytesWithoutChecksum();
    set[20] = 200;  // length of the time
    const MetadataStream stream = collected({{set}, {goodSet(1)}});
    EXPECT_EQ(stream.packets.size(), 1U);
    EXPECT_EQ(faultsOf(stream, klv::Fault::broken_items), 1);
}

TEST(DamagedKlv, foreignBytesBetweenSetsAreSkipped) {
    const MetadataStream stream = collected({{joined({{1, 2, 3}, goodSet(0), {0x06, 0x0E, 9}, goodSet(1)})}, {{4, 5}}});
    EXPECT_EQ(stream.packets.size(), 2U);
    EXPECT_EQ(faultsOf(stream, klv::Fault::foreign_bytes), 3);
}

TEST(DamagedKlv, aSetMayComeInPieces) {
    const KlvBytes set = goodSet(0);
    const auto half = static_cast<std::ptrdiff_t>(set.size() / 2);
    const MetadataStream stream = collected(
        {{KlvBytes(set.begin(), set.begin() + half)}, {KlvBytes(set.begin() + half, set.end())}, {goodSet(1)}});
    EXPECT_EQ(stream.packets.size(), 2U);
    EXPECT_EQ(stream.damaged(), 0);
}

TEST(DamagedKlv, aPacketThatEndsASetMayBeginTheNext) {
    const KlvBytes set = goodSet(0);
    for (std::size_t rest = 1; rest < set.size(); ++rest) {
        if (rest == 5) continue;  // as long as the header of a cell
        const KlvBytes end(set.end() - static_cast<std::ptrdiff_t>(rest), set.end());
        const MetadataStream stream = collected({{cut(set, set.size() - rest)}, {joined({end, goodSet(1)})}});
        EXPECT_EQ(stream.packets.size(), 2U) << rest;
        EXPECT_EQ(stream.damaged(), 0) << rest;
    }
}

TEST(DamagedKlv, aPieceWithinASetMayLookLikeTheBeginningOfAKey) {
    // A text item holds what every key begins with; a packet that is shorter than a key begins no set.
    const KlvBytes key = test::localSetKey();
    for (std::size_t looks = 1; looks < key.size(); ++looks) {
        const KlvBytes begin = cut(key, looks);
        const KlvBytes set = LocalSetWriter().item(3, begin).angle(13, 45, 90).bytes();
        const std::size_t at = key.size() + 1 + 2;
        const KlvBytes after(set.begin() + static_cast<std::ptrdiff_t>(at + looks), set.end());
        const MetadataStream stream = collected({{cut(set, at)}, {begin}, {after}, {goodSet(1)}});
        EXPECT_EQ(stream.packets.size(), 2U) << looks;
        EXPECT_EQ(stream.damaged(), 0) << looks;
    }
}

TEST(DamagedKlv, aSetThatIsCutOffInItsCellDoesNotTakeTheNextWithIt) {
    const auto cell = [](const KlvBytes& bytes) {
        return joined({{0x00, 1, 0xDF, 0x00, static_cast<std::uint8_t>(goodSet().size())}, bytes});
    };
    const MetadataStream stream = collected({{cell(cut(goodSet(0), 30))}, {cell(goodSet(1))}});
    EXPECT_EQ(stream.packets.size(), 1U);
    EXPECT_EQ(faultsOf(stream, klv::Fault::cut_off), 1);
}

TEST(DamagedKlv, headersOfAccessUnitCellsArePassedOver) {
    const auto inCell = [](const KlvBytes& set, std::uint8_t sequence) {
        return joined({{0x00, sequence, 0xDF, 0x00, static_cast<std::uint8_t>(set.size())}, set});
    };
    const MetadataStream stream =
        collected({{joined({inCell(goodSet(0), 0), inCell(goodSet(1), 1)})}, {inCell(goodSet(2), 2)}});
    EXPECT_EQ(stream.packets.size(), 3U);
    EXPECT_EQ(stream.damaged(), 0);
}

TEST(DamagedKlv, clocksThatJumpAreCounted) {
    const auto at = [](std::uint64_t utc_s) { return Carried{LocalSetWriter().time(utc_s * 1'000'000).bytes()}; };
    const MetadataStream stream = collected({at(100), at(101), at(90), at(500), at(501)});
    EXPECT_EQ(stream.steps_back, 1);
    EXPECT_EQ(stream.leaps, 1);
    EXPECT_EQ(stream.packets.size(), 5U);
}

TEST(DamagedKlv, whereTheClockJumpsFirstIsKnown) {
    const auto at = [](std::uint64_t utc_s, int frame) {
        return Carried{LocalSetWriter().time(utc_s * 1'000'000).bytes(), kNoStamp, frame};
    };
    const MetadataStream stream = collected({at(100, 0), at(101, 25), at(90, 50), at(500, 75)});
    ASSERT_TRUE(stream.first_jump);
    EXPECT_EQ(stream.first_jump->pictures_before, 50);
    EXPECT_FALSE(collected({at(100, 0), at(101, 25)}).first_jump);
    // The first track of a file has the number 0. A file of nothing but metadata has no pictures to count.
    for (const int track : {0, -1}) {
        MetadataCollector collector({track, 0x101, "klv"});
        for (const test::Carried& packet : {at(100, 0), at(90, 25)})
            collector.feed({track, packet.stamp_us, 0, packet.pictures_before, packet.bytes});
        const MetadataStream of_track = collector.finish();
        EXPECT_EQ(of_track.steps_back, 1);
        EXPECT_EQ(of_track.first_jump.has_value(), track == 0);
    }
}

TEST(DamagedKlv, otherSetsAreCountedAndLeftAlone) {
    KlvBytes security = test::bytesOfHex("060e2b34020301010e01030302000000");
    append(security, {3, 1, 1, 1});
    const MetadataStream stream = collected({{security}, {goodSet(0)}});
    EXPECT_EQ(stream.packets.size(), 1U);
    EXPECT_EQ(stream.other_sets.at("060e2b34020301010e01030302000000"), 1);
}

TEST(DamagedKlv, aThousandKindsOfOtherSetsAreToldApart) {
    const auto kind = [](int number) {
        KlvBytes set = test::bytesOfHex("060e2b34020301010e010303");
        append(set, test::bigEndian(0x02000000U + static_cast<unsigned>(number), 4));
        append(set, {1, 7});
        return Carried{set};
    };
    std::vector<Carried> packets;
    for (int i = 0; i < 1003; ++i) packets.push_back(kind(i));
    packets.push_back(kind(0));
    const MetadataStream stream = collected(packets);
    EXPECT_EQ(stream.damaged(), 0);
    EXPECT_EQ(stream.other_sets.size(), 1001U);
    EXPECT_EQ(stream.other_sets.at("others"), 3);
    EXPECT_EQ(stream.other_sets.at("060e2b34020301010e01030302000000"), 2);
    EXPECT_EQ(stream.other_sets.at("060e2b34020301010e010303020003e7"), 1) << "the thousandth";
}

TEST(DamagedKlv, randomDamageNeverEndsTheReading) {
    std::mt19937 random(1);
    for (int round = 0; round < 300; ++round) {
        std::vector<Carried> packets;
        for (int i = 0; i < 20; ++i) {
            Carried packet{goodSet(i), 40'000 * i, i};
            for (int hit = 0; hit < round % 4; ++hit)
                packet.bytes[random() % packet.bytes.size()] ^= 1U << (random() % 8);
            if (round % 5 == 0) packet.bytes.resize(random() % (packet.bytes.size() + 1));
            packets.push_back(packet);
        }
        packets.push_back({goodSet(20), 800'000, 20});
        const MetadataStream stream = collected(packets);
        ASSERT_GE(stream.packets.size(), 1U);
        const std::vector<PictureStamp> pictures(25, PictureStamp{0, 0});
        const MetadataTimeline timeline(stream, pictures);
        groundViewOf(timeline.at(400'000), {640, 480});
    }
}

}  // namespace eyrie::damaged_klv_test

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <random>

#include "core/error.h"
#include "metadata/collected.h"
#include "metadata/metadata_scale.h"
#include "metadata/metadata_tables.h"
#include "metadata/transport_stream.h"
#include "support/shared_data.h"
#include "support/temporary_folder.h"

namespace eyrie::metadata_files_test {
namespace {

using test::LocalSetWriter;
using test::sharedData;
using test::TransportStreamWriter;

/// A file of the data folder with its pictures and what the metadata say at a frame.
struct Opened {
    explicit Opened(const std::string& name) : path(sharedData("klv") / name), recording(readMetadata(path)) {
        SourceOptions options;
        options.index_folder = folder.path();
        source = openSource(path, options);
    }
    const MetadataStream& stream() const {
        return recording.streams.at(static_cast<std::size_t>(recording.mostUseful()));
    }
    MetadataState at(FrameIndex frame) const {
        return MetadataTimeline(stream(), source->pictureStamps()).at(source->timeOf(frame));
    }

    test::TemporaryFolder folder;
    std::filesystem::path path;
    MetadataRecording recording;
    std::unique_ptr<FrameSource> source;
};

std::string wholeText(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

TEST(MetadataFiles, bothCarriagesOfATransportStreamAreRead) {
    for (const auto carriage :
         {TransportStreamWriter::Carriage::asynchronous, TransportStreamWriter::Carriage::synchronous}) {
        const test::TemporaryFolder folder;
        TransportStreamWriter writer(carriage);
        for (int i = 0; i < 40; ++i) {
            LocalSetWriter set;
            set.time(1'000'000U * static_cast<unsigned>(i + 1)).angle(13, i, 90);
            if (i % 3 == 0) set.item(3, test::KlvBytes(300 % 128 + 80, 'x'));  // over two packets
            writer.set(set.bytes(), 90'000 * (i + 1));
        }
        writer.save(folder / "klv.ts");
        const MetadataRecording recording = readMetadata(folder / "klv.ts");
        ASSERT_EQ(recording.streams.size(), 1U);
        const MetadataStream& stream = recording.streams[0];
        EXPECT_EQ(stream.track.id, 0x101);
        ASSERT_EQ(stream.packets.size(), 40U);
        EXPECT_EQ(stream.damaged(), 0);
        EXPECT_NEAR(stream.packets[7].number(13).value_or(-1), 7, 1e-6);
        EXPECT_EQ(stream.packets[7].stamp_us - stream.packets[0].stamp_us, 7'000'000);
    }
}

TEST(MetadataFiles, eachTrackOfAFileIsAStreamOfItsOwn) {
    const test::TemporaryFolder folder;
    TransportStreamWriter writer(TransportStreamWriter::Carriage::asynchronous, 2);
    for (int i = 0; i < 20; ++i) {
        writer.set(LocalSetWriter().time(1'000'000U * static_cast<unsigned>(i + 1)).bytes(), 90'000 * (i + 1));
        writer.set(LocalSetWriter().angle(13, i, 90).bytes(), 90'000 * (i + 1), 0x0102);
        writer.set(LocalSetWriter().angle(13, -i, 90).bytes(), 90'000 * (i + 1) + 45'000, 0x0102);
    }
    writer.save(folder / "two.ts");
    const MetadataRecording recording = readMetadata(folder / "two.ts");
    ASSERT_EQ(recording.streams.size(), 2U);
    EXPECT_TRUE(recording.foreign_tracks.empty());
    const MetadataStream& times = recording.streams[0];
    const MetadataStream& places = recording.streams[1];
    EXPECT_EQ(times.track.id, 0x101);
    EXPECT_EQ(places.track.id, 0x102);
    EXPECT_NE(times.track.number, places.track.number);
    EXPECT_EQ(times.track.codec, "klv");
    EXPECT_EQ(places.track.codec, "klv");
    EXPECT_EQ(times.packets.size(), 20U);
    EXPECT_EQ(places.packets.size(), 40U);
    EXPECT_EQ(times.damaged() + places.damaged(), 0);
    EXPECT_EQ(times.places(), 0);
    EXPECT_EQ(places.places(), 40);
    EXPECT_EQ(places.without_time, 40);
    EXPECT_EQ(recording.mostUseful(), 1);
}

TEST(MetadataFiles, examplesOfTheStandardInH264) {
    EYRIE_NEED_SHARED_DATA("klv");
    for (const char* name : {"h264_klv.ts", "mpeg2_klv.ts"}) {
        const Opened file(name);
        ASSERT_EQ(file.recording.streams.size(), 1U) << name;
        const MetadataStream& stream = file.stream();
        EXPECT_EQ(stream.local_sets, 30) << name;
        EXPECT_EQ(stream.damaged(), 0) << name;
        EXPECT_EQ(stream.without_checksum, 0) << name;
        EXPECT_EQ(stream.without_stamp, 30) << name;
        const MetadataPacket& packet = stream.packets[0];
        EXPECT_NEAR(packet.number(tag::kSensorLatitude).value_or(0), 60.1768229669783, 1e-9);
        EXPECT_NEAR(packet.number(tag::kPlatformHeading).value_or(0), 159.974364843, 1e-6);
        EXPECT_NEAR(packet.number(96).value_or(0), 13898.5, 1e-9);
        EXPECT_NEAR(packet.number(109).value_or(0), 1.625, 1e-9);
        EXPECT_EQ(stream.tags.at(3).text, "MISSION01");
        EXPECT_TRUE(file.at(15).utc_us) << name;
        EXPECT_NEAR(file.at(15).number(tag::kSensorLongitude).value_or(0), 128.4267, 0.01) << name;
    }
}

TEST(MetadataFiles, ofSeveralStreamsTheOneThatSaysMostIsUsed) {
    EYRIE_NEED_SHARED_DATA("klv");
    const Opened file("h265_tricky_klv.ts");
    ASSERT_EQ(file.recording.streams.size(), 3U);
    EXPECT_EQ(file.recording.mostUseful(), 0);
    EXPECT_EQ(file.recording.streams[0].packets.size(), 30U);
    EXPECT_EQ(file.recording.streams[1].packets.size(), 60U);
    EXPECT_EQ(file.recording.streams[2].packets.size(), 0U);
    for (const MetadataStream& stream : file.recording.streams) EXPECT_EQ(stream.damaged(), 0);
    EXPECT_EQ(file.recording.streams[0].without_stamp, 0);
    EXPECT_EQ(file.recording.streams[1].without_stamp, 60);
}

TEST(MetadataFiles, theOlderSetOfARealFlight) {
    EYRIE_NEED_SHARED_DATA("klv");
    const Opened file("aphill_short.ts");
    const MetadataStream& stream = file.stream();
    EXPECT_EQ(stream.universal_sets, 48);
    EXPECT_EQ(stream.damaged(), 0);
    const GroundView view = groundViewOf(file.at(20), file.source->info().size);
    ASSERT_EQ(view.source, GroundSource::corners);
    // 0.8° at 1730 m are 24.2 m over 720 px.
    EXPECT_NEAR(view.gsd_x_m_per_px.value_or(0), 1730 * 0.8 * CV_PI / 180 / 720, 0.001);
    // The camera looks to bearing 125°, 37.5° down: of north, cos 125° lies along the view, which is seen foreshortened
    // by sin 37.5°, and cos 215° to the right.
    ASSERT_TRUE(view.north_deg);
    const double right = std::cos(215 * CV_PI / 180),
                 down = -std::cos(125 * CV_PI / 180) * std::sin(37.5 * CV_PI / 180);
    EXPECT_NEAR(*view.north_deg, std::atan2(down, right) * 180 / CV_PI, 8);
    const MetadataScale scale = scaleByMetadata(*file.source, 0, file.source->info().frame_count - 1);
    EXPECT_TRUE(scale.usable()) << scale.why_not;
    EXPECT_NEAR(scale.gsd_m_per_px, *view.gsd(), 0.002);
    const Opened longer("aphill_klv_10s.ts");
    EXPECT_EQ(longer.stream().universal_sets, 300);
    EXPECT_TRUE(groundViewOf(longer.at(5), longer.source->info().size).footprint);
}

TEST(MetadataFiles, rawDumps) {
    EYRIE_NEED_SHARED_DATA("klv");
    const MetadataRecording cheyenne = readMetadata(sharedData("klv") / "Cheyenne.bin");
    ASSERT_EQ(cheyenne.streams.size(), 1U);
    EXPECT_EQ(cheyenne.streams[0].packets.size(), 407U);
    EXPECT_EQ(cheyenne.streams[0].damaged(), 0);
    EXPECT_NEAR(cheyenne.streams[0].packets[0].number(13).value_or(0), 41.14, 0.05);
    const MetadataRecording flight = readMetadata(sharedData("klv") / "realflight.bin");
    ASSERT_EQ(flight.streams.size(), 1U);
    EXPECT_EQ(flight.streams[0].damaged(), 0);
    // Half of its corners are "out of range".
    EXPECT_EQ(flight.streams[0].tags.at(82).unreadable, flight.streams[0].tags.at(82).packets);
    EXPECT_TRUE(flight.streams[0].packets[0].number(86));
}

TEST(MetadataFiles, aRawDumpIsReadInPiecesOfAnySize) {
    // Sets of more than 100 bytes: together more than are read at once.
    const test::TemporaryFolder folder;
    constexpr int kSets = 900;
    {
        std::ofstream file(folder / "dump.klv", std::ios::binary);
        for (int i = 0; i < kSets; ++i) {
            const auto set = LocalSetWriter().item(3, test::KlvBytes(90, 'x')).angle(13, i / 10.0, 90).bytes();
            file.write(reinterpret_cast<const char*>(set.data()), static_cast<std::streamsize>(set.size()));
        }
    }
    const auto size = static_cast<std::int64_t>(std::filesystem::file_size(folder / "dump.klv"));
    ASSERT_GT(size, 1 << 16);
    EXPECT_TRUE(isRawKlv(folder / "dump.klv"));
    std::vector<double> shares;
    const MetadataRecording recording =
        readMetadata(folder / "dump.klv", [&](double share) { shares.push_back(share); });
    ASSERT_EQ(recording.streams.size(), 1U);
    const MetadataStream& stream = recording.streams[0];
    EXPECT_EQ(stream.track.number, -1);
    EXPECT_EQ(stream.damaged(), 0);
    EXPECT_EQ(stream.without_stamp, kSets);
    ASSERT_EQ(stream.packets.size(), std::size_t{kSets});
    for (int i = 0; i < kSets; ++i)
        ASSERT_NEAR(stream.packets[static_cast<std::size_t>(i)].number(13).value_or(-1), i / 10.0, 1e-6);
    EXPECT_EQ(stream.packets.front().position, 0);
    EXPECT_GT(stream.packets.back().position, 0);
    EXPECT_LT(stream.packets.back().position, size);
    ASSERT_GE(shares.size(), 2U);
    EXPECT_GT(shares.front(), 0);
    EXPECT_LT(shares.front(), 1);
    EXPECT_EQ(shares.back(), 1);
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW(readMetadata(folder / "dump.klv", {}, stop.get_token()), Error);
    std::ofstream(folder / "short.klv", std::ios::binary) << "\x06\x0e\x2b";
    EXPECT_FALSE(isRawKlv(folder / "short.klv"));
    std::ofstream(folder / "text.klv", std::ios::binary) << "\x06\x0e\x2b\x35";
    EXPECT_FALSE(isRawKlv(folder / "text.klv"));
}

TEST(MetadataFiles, aRawDumpMayBeCutAnywhereWithinASet) {
    // Sets of 119 bytes behind one that shifts them: with 62 letters, a key lies 5 bytes behind the first 64 kilobytes,
    // which looks like a packet with the header of an access unit cell.
    const test::TemporaryFolder folder;
    constexpr int kSets = 600;
    for (const std::size_t letters : {57, 60, 62, 64, 80}) {
        std::ofstream file(folder / "dump.klv", std::ios::binary);
        for (int i = 0; i < kSets; ++i) {
            const test::KlvBytes text(i == 0 ? letters : 90, 'x');
            const auto set = LocalSetWriter().item(3, text).angle(13, 45, 90).bytes();
            ASSERT_EQ(set.size(), 29 + text.size());
            file.write(reinterpret_cast<const char*>(set.data()), static_cast<std::streamsize>(set.size()));
        }
        file.close();
        const MetadataRecording recording = readMetadata(folder / "dump.klv");
        EXPECT_EQ(recording.streams.at(0).packets.size(), std::size_t{kSets}) << letters;
        EXPECT_EQ(recording.streams.at(0).damaged(), 0) << letters;
    }
}

TEST(MetadataFiles, videosWithoutMetadataHaveNone) {
    EYRIE_NEED_SHARED_DATA("klv");
    for (const char* name : {"h264_no_klv.ts", "h264_audio.ts"}) {
        const Opened file(name);
        EXPECT_TRUE(file.recording.streams.empty()) << name;
        EXPECT_EQ(file.recording.mostUseful(), -1) << name;
        EXPECT_FALSE(scaleByMetadata(*file.source, 0, 1).usable()) << name;
    }
}

TEST(MetadataFiles, attitudeAgreesWithTheStatedCornersOfARealFlight) {
    EYRIE_NEED_SHARED_DATA("klv");
    const MetadataRecording recording = readMetadata(sharedData("klv") / "Cheyenne.bin");
    MetadataState state;
    state.numbers = recording.streams[0].packets[0].numbers;
    const cv::Size size(1280, 720);
    const GroundView stated = groundViewOf(state, size);
    ASSERT_EQ(stated.source, GroundSource::corner_offsets);
    std::erase_if(state.numbers, [](const auto& one) { return one.tag >= 26 && one.tag <= 33; });
    const GroundView cast = groundViewOf(state, size);
    ASSERT_EQ(cast.source, GroundSource::attitude);
    EXPECT_NEAR(*cast.gsd() / *stated.gsd(), 1, 0.1);
    EXPECT_NEAR(*cast.north_deg, *stated.north_deg, 5);
}

TEST(MetadataFiles, damageOfTheFileCostsSetsAndNothingElse) {
    EYRIE_NEED_SHARED_DATA("klv");
    const std::string good = wholeText(sharedData("klv") / "aphill_short.ts");
    const test::TemporaryFolder folder;
    std::mt19937 random(3);
    for (int round = 0; round < 6; ++round) {
        std::string bad = good;
        for (int hit = 0; hit < 40; ++hit) bad[random() % bad.size()] ^= static_cast<char>(1U << (random() % 7));
        if (round % 2 == 0) bad.resize(bad.size() / 2 + random() % 5000);
        std::ofstream(folder / "bad.ts", std::ios::binary) << bad;
        const MetadataRecording recording = readMetadata(folder / "bad.ts");
        ASSERT_FALSE(recording.streams.empty());
        EXPECT_GT(recording.streams[0].packets.size(), 10U);
    }
}

TEST(MetadataFiles, whatIsNoContainerIsRefused) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "notes.txt") << "not a video";
    EXPECT_THROW(readMetadata(folder / "notes.txt"), Error);
    EXPECT_THROW(readMetadata(folder / "nothing.ts"), Error);
}

TEST(MetadataFiles, theTableHasARowForEachSet) {
    const test::TemporaryFolder folder;
    const MetadataStream stream =
        test::collected({{LocalSetWriter().time(1'000'000).item(3, {'a', ',', 'b'}).range(5, 90, 0, 360).bytes(), 0},
                         {LocalSetWriter().time(2'000'000).angle(13, 45, 90).bytes(), 40'000}});
    const MetadataTimeline timeline(stream, {{0, 0}, {40'000, 40'000}});
    writeMetadataCsv(folder / "sets.csv", stream, &timeline);
    EXPECT_EQ(wholeText(folder / "sets.csv"),
              "packet,position,video_s,utc,mission,platform_heading_deg,sensor_latitude_deg\n"
              "0,0,0,1970-01-01T00:00:01.000000Z,\"a,b\",90.001373312,\n"
              "1," +
                  std::to_string(stream.packets[1].position) + ",0.04,1970-01-01T00:00:02.000000Z,,,45.000000021\n");
}

}  // namespace eyrie::metadata_files_test

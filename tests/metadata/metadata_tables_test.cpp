#include "metadata/metadata_tables.h"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "metadata/collected.h"
#include "support/temporary_folder.h"

namespace eyrie::metadata_tables_test {
namespace {

TagSummary counted(int packets, int unreadable = 0) {
    TagSummary summary;
    summary.packets = packets;
    summary.unreadable = unreadable;
    return summary;
}

TagSummary numbers(TagSummary summary, double least, double greatest) {
    summary.has_numbers = true;
    summary.least = least;
    summary.greatest = greatest;
    return summary;
}

/// Three sets, of which nothing needs to agree.
MetadataStream madeUp() {
    MetadataStream stream;
    stream.track = {2, 0x101, "klv"};
    stream.packets.resize(3);
    stream.packets[0].numbers = {{8, 7.5}};
    stream.packets[0].texts = {{3, "say \"hi\""}, {10, "B"}};
    stream.packets[1].utc_us = 1'000'000;
    stream.packets[1].position = 0;
    stream.packets[2].utc_us = 3'500'000;
    stream.packets[2].position = 188;
    stream.packets[2].texts = {{10, "C"}};
    stream.local_sets = 2;
    stream.universal_sets = 1;
    stream.without_checksum = 4;
    stream.without_stamp = 5;
    stream.without_time = 6;
    stream.steps_back = 7;
    stream.leaps = 8;
    stream.faults[static_cast<std::size_t>(klv::Fault::wrong_checksum)] = 2;
    stream.faults[static_cast<std::size_t>(klv::Fault::cut_off)] = 1;
    stream.tags[0] = counted(2);
    stream.tags[tag::kTime] = numbers(counted(2), 1e6, 3.5e6);
    stream.tags[3] = counted(2);
    stream.tags[3].text = "A";
    stream.tags[3].text_changes = true;
    stream.tags[8] = numbers(counted(3, 1), 7.5, 50);
    stream.tags[10] = counted(2);
    stream.tags[10].text = "B";
    stream.tags[13] = counted(3, 3);
    stream.tags[48] = counted(3);
    return stream;
}

}  // namespace

TEST(MetadataTables, EachTagThatHoldsSomethingHasAColumn) {
    const test::TemporaryFolder folder;
    writeMetadataCsv(folder / "sets.csv", madeUp(), nullptr);
    std::ifstream file(folder / "sets.csv", std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    EXPECT_EQ(text,
              "packet,position,video_s,utc,mission,platform_true_airspeed_m_s,platform\n"
              "0,,,,\"say \"\"hi\"\"\",7.5,B\n"
              "1,0,,1970-01-01T00:00:01.000000Z,,,\n"
              "2,188,,1970-01-01T00:00:03.500000Z,,,C\n");
}

TEST(MetadataTables, MoreThanAThousandRowsStayInOrder) {
    MetadataStream stream;
    stream.packets.resize(2001);
    for (std::size_t i = 0; i < stream.packets.size(); ++i)
        stream.packets[i].position = static_cast<std::int64_t>(10 * i);
    const test::TemporaryFolder folder;
    writeMetadataCsv(folder / "sets.csv", stream, nullptr);
    std::ifstream file(folder / "sets.csv");
    std::string line;
    std::getline(file, line);
    for (int i = 0; i <= 2000; ++i) {
        ASSERT_TRUE(std::getline(file, line)) << i;
        ASSERT_EQ(line, std::to_string(i) + "," + std::to_string(10 * i) + ",,");
    }
    EXPECT_FALSE(std::getline(file, line));
}

TEST(MetadataTables, AStreamIsSummedUpWithItsDamageAndItsTags) {
    const auto facts = jsonOf(madeUp());
    EXPECT_EQ(facts.at("track").dump(), "2");
    EXPECT_EQ(facts.at("id").dump(), "257");
    EXPECT_EQ(facts.at("packets").dump(), "3");
    EXPECT_EQ(facts.at("local_sets").dump(), "2");
    EXPECT_EQ(facts.at("universal_sets").dump(), "1");
    EXPECT_EQ(facts.at("damaged").dump(), "3");
    EXPECT_EQ(facts["damage"].dump(), R"({"cut off":1,"checksum differs":2})");
    EXPECT_EQ(facts.at("without_checksum").dump(), "4");
    EXPECT_EQ(facts.at("without_stamp").dump(), "5");
    EXPECT_EQ(facts.at("without_time").dump(), "6");
    EXPECT_EQ(facts.at("clock_steps_back").dump(), "7");
    EXPECT_EQ(facts.at("clock_leaps").dump(), "8");
    EXPECT_EQ(facts.at("first_utc").dump(), "\"1970-01-01T00:00:01.000000Z\"");
    EXPECT_EQ(facts.at("last_utc").dump(), "\"1970-01-01T00:00:03.500000Z\"");
    ASSERT_EQ(facts["tags"].size(), 7U);
    EXPECT_EQ(facts["tags"][0].dump(), R"({"tag":0,"name":"unknown item","unit":"","packets":2,"unreadable":0})");
    EXPECT_EQ(facts["tags"][2].dump(),
              R"({"tag":3,"name":"mission","unit":"","packets":2,"unreadable":0,"text":"A","text_changes":true})");
    EXPECT_EQ(
        facts["tags"][3].dump(),
        R"({"tag":8,"name":"platform true airspeed","unit":"m/s","packets":3,"unreadable":1,"least":7.5,"greatest":50.0})");
    MetadataStream timeless = madeUp();
    for (MetadataPacket& packet : timeless.packets) packet.utc_us.reset();
    EXPECT_TRUE(jsonOf(timeless)["first_utc"].is_null());
    EXPECT_TRUE(jsonOf(timeless)["last_utc"].is_null());
}

TEST(MetadataTables, AViewSaysWhatIsKnownAndNullWhereNothingIs) {
    GroundView view;
    view.scale_source = GroundSource::target_width;
    view.gsd_x_m_per_px = 0.5;
    EXPECT_EQ(jsonOf(view).dump(),
              R"({"gsd_m_per_px":0.5,"gsd_x_m_per_px":0.5,"gsd_y_m_per_px":null,"scale_source":"the target width",)"
              R"("north_deg":null,"ground_source":"nothing","footprint":null,"remarks":[]})");
    view.gsd_y_m_per_px = 2;
    view.north_deg = 270;
    view.source = GroundSource::corners;
    view.footprint = std::array<GeoPoint, 4>{GeoPoint{1, 2}, GeoPoint{3, 4}, GeoPoint{5, 6}, GeoPoint{7, 8}};
    view.remarks = {"something"};
    EXPECT_EQ(jsonOf(view).dump(),
              R"({"gsd_m_per_px":1.0,"gsd_x_m_per_px":0.5,"gsd_y_m_per_px":2.0,"scale_source":"the target width",)"
              R"("north_deg":270.0,"ground_source":"the frame corners","footprint":[{"latitude":1.0,"longitude":2.0},)"
              R"({"latitude":3.0,"longitude":4.0},{"latitude":5.0,"longitude":6.0},{"latitude":7.0,"longitude":8.0}],)"
              R"("remarks":["something"]})");
}

TEST(MetadataTables, ValuesOfAMomentAreNamedWithTheirUnits) {
    MetadataState state;
    EXPECT_EQ(jsonOf(state).dump(), R"({"utc":null})");
    state.utc_us = 3'500'000;
    state.numbers = {{8, 42}, {34, 1}, {55, 60}, {300, 0.5}};
    EXPECT_EQ(jsonOf(state).dump(),
              R"({"utc":"1970-01-01T00:00:03.500000Z","platform_true_airspeed_m_s":42.0,"icing_detected":1.0,)"
              R"("relative_humidity_percent":60.0,"tag_300":0.5})");
}

}  // namespace eyrie::metadata_tables_test

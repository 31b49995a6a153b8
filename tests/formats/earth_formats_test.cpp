#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "core/time/utc_time.h"
#include "formats/sample_labels.h"
#include "formats/track_world.h"
#include "io/tables/csv_reader.h"

namespace eyrie::earth_formats_test {
namespace {

using test::messageOf;
using test::sampleLabels;
using test::textOf;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr std::int64_t kFilmed_us = 1'231'798'102'000'000;
const GeoPoint kCorner{48.0, 11.0};

struct WorldWishes {
    bool ground = true, place = true, utc = true;
    std::optional<TrackWorld::Height> height = TrackWorld::Height{512, true};
};

/// Half a metre a pixel, the picture's top to the north, 25 frames a second. The first two frames have no place.
std::shared_ptr<const TrackWorld> worldOf(const WorldWishes& wishes = {}) {
    auto world = std::make_shared<TrackWorld>();
    world->frame_rate_hz = 25;
    world->seconds = [](FrameIndex frame) { return frame / 25.0; };
    if (wishes.utc) world->utc_us = [](FrameIndex frame) { return std::optional(kFilmed_us + frame * 40'000LL); };
    if (wishes.ground)
        world->ground = [](FrameIndex, cv::Point2d px) { return std::optional(TrackWorld::GroundPlace{2, px * 0.5}); };
    if (wishes.place)
        world->place = [](FrameIndex frame, cv::Point2d px) {
            return frame < 2 ? std::nullopt : std::optional(LocalPlane(kCorner).placeOf({px.x * 0.5, -px.y * 0.5}));
        };
    world->height = [wishes](FrameIndex) { return wishes.height; };
    world->clock_origin = wishes.utc ? "the video's metadata" : "";
    world->no_place = wishes.place ? "" : "the video carries no metadata (KLV)";
    world->no_clock = wishes.utc ? "" : "the video carries no metadata (KLV)";
    return world;
}

/// The sample with velocities: the car goes 2 px a frame east, which is 25 m/s or 90 km/h.
LabelFile tracks(std::shared_ptr<const TrackWorld> world) {
    LabelFile labels = sampleLabels();
    labels.world = std::move(world);
    for (auto& [frame, boxes] : labels.boxes)
        for (LabelBox& box : boxes)
            if (box.id == 3) box.velocity = {2, 0};
    return labels;
}

class EarthFormats : public testing::Test {
 protected:
    ExportReport write(const LabelFile& labels, const std::string& format) const {
        return writeLabels(labels, file_, format, {});
    }
    std::string text() const { return textOf(file_); }
    test::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "tracks.out";
};

LocalPlane plane() {
    return LocalPlane(kCorner);
}

std::string notesOf(const ExportReport& report) {
    std::string all;
    for (const std::string& note : report.notes) all += note + "\n";
    return all;
}

}  // namespace

TEST_F(EarthFormats, TheTableHasUtcMetresAndSpeeds) {
    write(tracks(worldOf()), "tracks-csv");
    CsvReader table(file_, {"track", "frame", "utc", "ground_x_m", "latitude", "speed_km_h"});
    int rows = 0;
    while (table.next()) {
        ++rows;
        if (table.whole("track") != 3 || table.whole("frame") != 5) continue;
        EXPECT_EQ(table.text("utc"), "2009-01-12T22:08:22.200000Z");
        EXPECT_NEAR(table.real("seconds"), 0.2, 1e-9);
        EXPECT_EQ(table.whole("ground"), 2);
        EXPECT_NEAR(table.real("ground_x_m"), (40.25 + 3.5 * 5) / 2, 1e-3);
        EXPECT_NEAR(table.real("speed_km_h"), 90, 1e-6);
        EXPECT_NEAR(table.real("course_deg"), 90, 0.1);  // to the east
        EXPECT_NEAR(table.real("length_m"), 10.25, 0.01);
        EXPECT_NEAR(table.real("width_m"), 4.63, 0.01);
        const cv::Point2d metres = plane().metresOf({table.real("latitude"), table.real("longitude")});
        EXPECT_NEAR(metres.x, (40.25 + 3.5 * 5) / 2, 0.02);
        EXPECT_NEAR(metres.y, -(60.125 + 5) / 2, 0.02);
        EXPECT_EQ(table.text("class"), "car");
    }
    EXPECT_EQ(rows, 32);
}

TEST_F(EarthFormats, TheTableIsThisToTheLetter) {
    LabelFile labels;
    labels.world = worldOf();
    LabelBox car;
    car.frame = 5;
    car.id = 3;
    car.box = {{100.12345678, 60.98765432}, 20.00004, 9.33333333, radiansFromDegrees(-33.333333)};
    car.object_class = "car, red";
    car.score = 0.123456789;
    car.velocity = {2, 0};
    labels.boxes[5].push_back(car);
    write(labels, "tracks-csv");
    const std::string row = text().substr(text().find('\n') + 1);
    // Half a metre a pixel: 100.12345678 px are 50.061728 m; four decimals of pixels, three of metres.
    EXPECT_THAT(row, testing::StartsWith(
                         "3,5,0.2,2009-01-12T22:08:22.200000Z,100.1235,60.9877,20,9.3333,326.6667,2,50.062,30.494,"));
    EXPECT_THAT(row, testing::EndsWith(",10,4.67,\"car, red\",0.123457,\n"));
}

TEST_F(EarthFormats, WhatIsNotKnownIsEmptyInTheTable) {
    const ExportReport report = write(tracks(worldOf({.ground = false, .place = false, .utc = false})), "tracks-csv");
    CsvReader table(file_, {"track"});
    ASSERT_TRUE(table.next());
    for (const char* column : {"utc", "ground", "ground_x_m", "latitude", "longitude", "speed_km_h", "length_m"})
        EXPECT_EQ(table.text(column), "") << column;
    EXPECT_THAT(notesOf(report), AllOf(HasSubstr("no clock times"), HasSubstr("the scale is not known")));
    write(tracks(nullptr), "tracks-csv");
    EXPECT_THAT(text(), HasSubstr("\n3,0,0,,40.25,60.125,"));
}

TEST_F(EarthFormats, GeoJsonHasAPathForEachTrack) {
    const ExportReport report = write(tracks(worldOf()), "geojson");
    const auto json = nlohmann::json::parse(text());
    ASSERT_EQ(json["type"], "FeatureCollection");
    ASSERT_EQ(json["features"].size(), 3u);
    const auto& car = json["features"][0];
    EXPECT_EQ(car["properties"]["track"], 3);
    EXPECT_EQ(car["properties"]["first_frame"], 2) << "the first two frames have no place";
    EXPECT_NEAR(car["properties"]["mean_speed_km_h"].get<double>(), 90, 0.01);
    EXPECT_EQ(car["properties"]["times"][0], "2009-01-12T22:08:22.080Z");
    EXPECT_EQ(car["geometry"]["type"], "LineString");
    ASSERT_EQ(car["geometry"]["coordinates"].size(), 10u);
    EXPECT_EQ(car["properties"]["frames"].size(), 10u);
    const auto& first = car["geometry"]["coordinates"][0];
    const cv::Point2d metres = plane().metresOf({first[1].get<double>(), first[0].get<double>()});
    EXPECT_NEAR(metres.x, (40.25 + 7) / 2, 0.02);
    EXPECT_NEAR(metres.y, -(60.125 + 2) / 2, 0.02);
    EXPECT_EQ(report.lost(LossKind::other), 6) << "boxes of the first two frames";
    EXPECT_EQ(report.lost(LossKind::rotation), 0);
}

TEST_F(EarthFormats, KmlIsTimedWhereTimesAreKnown) {
    write(tracks(worldOf()), "kml");
    pugi::xml_document timed;
    ASSERT_TRUE(timed.load_file(file_.c_str()));
    const pugi::xml_node track = timed.child("kml").child("Document").child("Placemark").child("gx:Track");
    ASSERT_TRUE(track);
    EXPECT_EQ(std::distance(track.children("when").begin(), track.children("when").end()), 10);
    EXPECT_EQ(std::distance(track.children("gx:coord").begin(), track.children("gx:coord").end()), 10);
    write(tracks(worldOf({.utc = false})), "kml");
    pugi::xml_document plain;
    ASSERT_TRUE(plain.load_file(file_.c_str()));
    EXPECT_TRUE(plain.child("kml").child("Document").child("Placemark").child("LineString").child("coordinates"));
    EXPECT_THAT(text(), Not(HasSubstr("gx:Track>")));
}

TEST_F(EarthFormats, Stanag4676HasPositionsAndTimesThatAddUp) {
    const ExportReport report = write(tracks(worldOf()), "stanag4676");
    pugi::xml_document document;
    ASSERT_TRUE(document.load_file(file_.c_str()));
    const pugi::xml_node message = document.child("nitsRoot").child("message");
    EXPECT_STREQ(document.child("nitsRoot").child_value("nitsVersion"), "B.1");
    const auto base = utcOf(message.child_value("baseTime"));
    ASSERT_TRUE(base);
    EXPECT_EQ(*base, kFilmed_us + 80'000) << "the earliest";
    const double step = message.child("relTimeIncrement").text().as_double();
    const pugi::xml_node segment = message.child("track").child("segment");
    EXPECT_STREQ(message.child("track").child_value("lid"), "3");
    int frame = 2;
    for (const pugi::xml_node point : segment.children("tp")) {
        const double seconds = point.child("relTime").text().as_double() * step;
        EXPECT_NEAR(static_cast<double>(*base - kFilmed_us) / 1e6 + seconds, frame / 25.0, 1e-9);
        const pugi::xml_node dynamics = point.child("dynamics");
        EXPECT_STREQ(dynamics.attribute("cs").value(), "WGS_84");
        double latitude = 0, longitude = 0, height = 0;
        std::stringstream(dynamics.child_value("pos")) >> latitude >> longitude >> height;
        const cv::Point2d metres = plane().metresOf({latitude, longitude});
        EXPECT_NEAR(metres.x, (40.25 + 3.5 * frame) / 2, 0.01);
        EXPECT_NEAR(metres.y, -(60.125 + frame) / 2, 0.01);
        EXPECT_EQ(height, 512);
        ++frame;
    }
    EXPECT_EQ(frame, 12);
    EXPECT_THAT(notesOf(report), HasSubstr("not checked against its schema"));
}

TEST_F(EarthFormats, HeightsThatAreMissingOrAboveTheSeaAreTold) {
    EXPECT_THAT(notesOf(write(tracks(worldOf({.height = std::nullopt})), "stanag4676")),
                HasSubstr("have the height 0"));
    EXPECT_THAT(notesOf(write(tracks(worldOf({.height = TrackWorld::Height{40, false}})), "stanag4676")),
                HasSubstr("above the sea"));
}

TEST_F(EarthFormats, AreRefusedWithTheReasonWhereNoPlaceOrTimeIsKnown) {
    for (const char* format : {"geojson", "kml", "stanag4676"}) {
        const auto message = messageOf([&] { write(tracks(worldOf({.place = false})), format); });
        EXPECT_THAT(message, AllOf(HasSubstr("where on earth"), HasSubstr("carries no metadata"))) << format;
        EXPECT_THAT(messageOf([&] { write(tracks(nullptr), format); }), HasSubstr("only runs of a project"));
        EXPECT_FALSE(std::filesystem::exists(file_)) << format;
    }
    EXPECT_THAT(messageOf([&] { write(tracks(worldOf({.utc = false})), "stanag4676"); }),
                AllOf(HasSubstr("when the video was taken"), HasSubstr("--start")));
}

TEST_F(EarthFormats, BoxesWithoutANumberGetOneWhereTracksAreWritten) {
    LabelFile labels = tracks(worldOf());
    labels.boxes[5][0].id.reset();
    for (const char* format : {"geojson", "kml", "stanag4676"})
        EXPECT_EQ(write(labels, format).lost(LossKind::id), 1) << format;
    EXPECT_EQ(write(labels, "tracks-csv").lost(LossKind::id), 0) << "a row needs none";
    write(labels, "kml");
    pugi::xml_document document;
    ASSERT_TRUE(document.load_file(file_.c_str()));
    std::set<std::string> names;
    for (const pugi::xml_node mark : document.child("kml").child("Document").children("Placemark"))
        names.insert(mark.child_value("name"));
    EXPECT_THAT(names, testing::ElementsAre("12", "13", "3", "7")) << "the next free number";
}

TEST_F(EarthFormats, WithoutTracksTheFilesAreEmptyButWhole) {
    LabelFile none;
    none.world = worldOf();
    write(none, "geojson");
    EXPECT_TRUE(nlohmann::json::parse(text())["features"].empty());
    for (const char* format : {"kml", "stanag4676"}) {
        write(none, format);
        pugi::xml_document document;
        EXPECT_TRUE(document.load_file(file_.c_str())) << format;
    }
    write(none, "tracks-csv");
    const std::string table = text();
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1) << table;
}

TEST_F(EarthFormats, Kw18HasPlacesAndClockTimesAndIsReadBack) {
    write(tracks(worldOf()), "kw18");
    EXPECT_THAT(text(), AllOf(HasSubstr(" 11.000"), HasSubstr(" 1231798102.2")));
    EXPECT_EQ(reportOn(readLabels(file_, "kw18")).boxes, 32);
    write(tracks(nullptr), "kw18");
    EXPECT_THAT(text(), AllOf(HasSubstr(" 0 0 0 0.2"), Not(HasSubstr("1231798102"))));
}

}  // namespace eyrie::earth_formats_test

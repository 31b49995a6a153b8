#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"
#include "events/driven_tracks.h"
#include "events/zones/zone_edits.h"
#include "events/zones/zone_file.h"
#include "support/temporary_folder.h"

namespace eyrie::zones_test {
namespace {

using test::DrivenTracks;
using test::tracksOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A square of 40 m in the middle of the ground, as frame 0 of the standing camera shows it.
Zone square() {
    return {"square", ZoneShape::area, ZoneAnchor::ground, 0, {{400, 200}, {600, 200}, {600, 400}, {400, 400}}};
}

/// Across the ground, down the picture.
Zone line() {
    return {"line", ZoneShape::line, ZoneAnchor::ground, 0, {{500, 100}, {500, 500}}};
}

}  // namespace

TEST(Zones, AnAreaIsEnteredAndLeft) {
    DrivenTracks scene;
    scene.drive({20, 60}, 0, {{30, 36, 36}});
    const auto events = scene.events({}, {square()});
    const auto enters = scene.events(EventKind::enters, {}, {square()});
    const auto exits = scene.events(EventKind::exits, {}, {square()});
    ASSERT_THAT(tracksOf(enters), ElementsAre(1));
    ASSERT_THAT(tracksOf(exits), ElementsAre(1));
    EXPECT_NEAR(enters[0].frame, 6 * 25, 3);
    EXPECT_NEAR(exits[0].frame, 10 * 25, 3);
    EXPECT_NEAR(enters[0].figure, 36, 2);
    EXPECT_NEAR(exits[0].figure, 4, 0.2);
    EXPECT_EQ(exits[0].zone, "square");
    EXPECT_NEAR(enters[0].place.x, 400, 4);
}

TEST(Zones, WhoStandsOnTheEdgeOrPassesByDoesNotEnter) {
    DrivenTracks scene;
    scene.drive({80, 60}, 0, {{40, 0, 0}});
    scene.drive({20, 85}, 0, {{30, 36, 36}});
    EXPECT_THAT(scene.events(EventKind::enters, {}, {square()}), IsEmpty());
    EXPECT_THAT(scene.events(EventKind::exits, {}, {square()}), IsEmpty());
}

TEST(Zones, ALineIsCrossedToOneSide) {
    DrivenTracks scene;
    const TrackId left =
        scene.drive({20, 60}, 0, {{30, 36, 36}});  // the line runs down: its right is the picture's left
    const TrackId right = scene.drive({180, 70}, 180, {{30, 36, 36}}, 50);
    scene.drive({20, 110}, 0, {{30, 36, 36}});  // past its end
    scene.drive({100, 50}, 0, {{30, 0, 0}});    // stands on it
    const auto events = scene.events(EventKind::crosses, {}, {line()});
    ASSERT_THAT(tracksOf(events), ElementsAre(left, right));
    EXPECT_EQ(events[0].sense, CrossingSense::to_left);
    EXPECT_EQ(events[1].sense, CrossingSense::to_right);
    EXPECT_NEAR(events[0].frame, 8 * 25, 3);
    Zone other = line();
    std::swap(other.points[0], other.points[1]);
    EXPECT_EQ(scene.events(EventKind::crosses, {}, {other})[0].sense, CrossingSense::to_right);
}

TEST(Zones, ComingBackCrossesTwiceAndTurningOnTheLineNever) {
    DrivenTracks scene;
    scene.drive({60, 60}, 0, {{5, 36, 36}, {6, 15, 15, 30}, {10, 36, 36}});
    const auto events = scene.events(EventKind::crosses, {}, {line()});
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].sense, CrossingSense::to_left);
    EXPECT_EQ(events[1].sense, CrossingSense::to_right);
    DrivenTracks touching;
    // Comes up to the line and 0.3 m over it, stands, goes back.
    touching.drive({100.3 - 25, 60}, 0, {{3, 15, 15}, {6, 15, 0}, {5, 0, 0}, {6, 0, -15}, {3, -15, -15}});
    EXPECT_THAT(touching.events(EventKind::crosses, {}, {line()}), IsEmpty());
}

TEST(Zones, OnTheGroundTheyStayWhereTheyAreWhenTheCameraMoves) {
    DrivenTracks scene;
    scene.camera = DrivenTracks::moving(0.2);
    scene.drive({40, 60}, 0, {{30, 36, 36}});
    Zone on_ground = square();
    on_ground.frame = 500;
    for (cv::Point2d& point : on_ground.points)
        point = HomographyJacobian(scene.camera(500), point * 0.2).point();  // the same metres, as frame 500 shows them
    const auto enters = scene.events(EventKind::enters, {}, {on_ground});
    ASSERT_THAT(tracksOf(enters), ElementsAre(1));
    EXPECT_NEAR(enters[0].frame, 4 * 25, 3);
    EXPECT_NEAR(scene.placeOf(enters[0]).x, 80, 0.5);
    // Fixed to the image the same corners are elsewhere on the ground.
    Zone in_image = square();
    in_image.anchor = ZoneAnchor::image;
    const auto seen = scene.events(EventKind::enters, {}, {in_image});
    ASSERT_THAT(tracksOf(seen), ElementsAre(1));
    EXPECT_NEAR(seen[0].place.x, 400, 4);
}

TEST(Zones, FixedToAnotherGroundTheyDoNotCount) {
    DrivenTracks scene;
    scene.drive({20, 60}, 0, {{30, 36, 36}});
    Zone elsewhere = square();
    elsewhere.frame = 5000;
    EXPECT_THAT(scene.events(EventKind::enters, {}, {elsewhere}), IsEmpty());
}

namespace {

constexpr const char* kNow = "2026-11-21T08:00:00Z";

/// A project's zones as steps make them.
class ZoneSteps : public testing::Test {
 protected:
    ReviewEdit added(const std::vector<Zone>& zones) {
        return addZones(set_, zones, {"Ada", kNow}, [this] { return ++last_id_; });
    }
    ReviewSet set_;
    int last_id_ = 0;
};

}  // namespace

TEST_F(ZoneSteps, WhatIsThereAlreadyIsNotAddedAgain) {
    applyEdit(set_, added({square(), line()}));
    ASSERT_EQ(set_.zones.size(), 2U);
    EXPECT_EQ(set_.zones.at(1).person, "Ada");
    EXPECT_EQ(zonesOf(set_.zones), (std::vector<Zone>{square(), line()}));
    EXPECT_TRUE(added({square(), line()}).empty());
    Zone more = line();
    more.name = "more";
    EXPECT_EQ(added({square(), more}).name, "Add line \"more\"") << "the rest of the file is";
    Zone late = square();
    late.name = "late";
    late.frame = 20'000'001;  // no project could be read that held it
    EXPECT_THROW(applyEdit(set_, added({late})), Error);
    Zone other = square();
    other.points[0].x += 5;
    const ReviewEdit second = added({other});
    EXPECT_EQ(second.name, "Add zone \"square\"");
    EXPECT_THROW(applyEdit(set_, second), Error) << "its name is taken";
    EXPECT_EQ(newZoneName(set_, ZoneShape::area), "zone 1");
    applyEdit(set_, changeZone(set_, 1, [](StoredZone& zone) { zone.zone.name = "zone 1"; }, {"Bo", kNow}));
    EXPECT_EQ(newZoneName(set_, ZoneShape::area), "zone 2");
    EXPECT_EQ(newZoneName(set_, ZoneShape::line), "line 1");
    EXPECT_EQ(newZoneName(set_, ZoneShape::arrow), "arrow 1");
    Zone arrow = line();
    arrow.name = "arrow 1";
    arrow.shape = ZoneShape::arrow;
    EXPECT_EQ(added({arrow}).name, "Add arrow \"arrow 1\"");
}

TEST_F(ZoneSteps, ARenamedZoneKeepsWhatWasSaidAboutItsEvents) {
    applyEdit(set_, added({square(), line()}));
    for (const int id : {1, 2}) {
        Verdict& verdict = set_.verdicts[id];
        verdict.id = id;
        verdict.subject.kind = EventKind::enters;
        verdict.subject.zone = id == 1 ? "square" : "line";
        verdict.judgement = Judgement::relevant;
    }
    const ReviewEdit rename = changeZone(set_, 1, [](StoredZone& zone) { zone.zone.name = "yard"; }, {"Bo", kNow});
    EXPECT_EQ(rename.name, "Rename zone \"square\"");
    applyEdit(set_, rename);
    EXPECT_EQ(set_.verdicts.at(1).subject.zone, "yard");
    EXPECT_EQ(set_.verdicts.at(2).subject.zone, "line");
    EXPECT_EQ(set_.zones.at(1).person, "Bo");
    applyEdit(set_, inverseOf(rename));
    EXPECT_EQ(set_.verdicts.at(1).subject.zone, "square");
    EXPECT_TRUE(changeZone(set_, 1, [](StoredZone&) {}, {"Bo", kNow}).empty());
    EXPECT_TRUE(changeZone(set_, 9, [](StoredZone&) {}, {"Bo", kNow}).empty());
    const ReviewEdit gone = removeZones(set_, {1, 2, 9});
    EXPECT_EQ(gone.name, "Delete 2 zones");
    applyEdit(set_, gone);
    EXPECT_TRUE(set_.zones.empty());
}

class ZoneFiles : public testing::Test {
 protected:
    std::string messageOf(const std::string& text) const {
        std::ofstream(folder_ / "zones.json") << text;
        try {
            readZones(folder_ / "zones.json");
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            return error.what();
        }
        return "";
    }
    static std::string withZone(const std::string& zone) { return "{\"eyrie_zones\": 1, \"zones\": [" + zone + "]}"; }
    test::TemporaryFolder folder_;
};

TEST_F(ZoneFiles, AreRead) {
    std::ofstream(folder_ / "zones.json") << withZone(
        R"({"name": "gate", "shape": "line", "fixed_to": "image", "frame": 5, "points": [[1, 2], [3.5, 40]]},
           {"name": "yard", "frame": 7, "points": [[0, 0], [10, 0], [10, 10]]})");
    const auto zones = readZones(folder_ / "zones.json");
    ASSERT_EQ(zones.size(), 2U);
    EXPECT_EQ(zones[0].shape, ZoneShape::line);
    EXPECT_EQ(zones[0].anchor, ZoneAnchor::image);
    EXPECT_EQ(zones[0].frame, 0) << "it holds in all";
    EXPECT_THAT(zones[0].points, ElementsAre(cv::Point2d(1, 2), cv::Point2d(3.5, 40)));
    EXPECT_EQ(zones[1].shape, ZoneShape::area);
    EXPECT_EQ(zones[1].anchor, ZoneAnchor::ground);
    EXPECT_EQ(zones[1].frame, 7);
}

TEST_F(ZoneFiles, WhatIsWrongIsToldWithItsPlace) {
    EXPECT_THAT(messageOf("{"), HasSubstr("zones.json: is not valid JSON"));
    EXPECT_THAT(messageOf("[]"), HasSubstr("zones.json: the file: holds no zones"));
    EXPECT_THAT(messageOf("{\"eyrie_zones\": 2, \"zones\": []}"), HasSubstr("expected 1"));
    EXPECT_THAT(messageOf("{\"eyrie_zones\": 1, \"zones\": []}"), HasSubstr("zones: is empty"));
    EXPECT_THAT(messageOf(withZone("7")), HasSubstr("zones[0]: is not an object"));
    EXPECT_THAT(messageOf(withZone(R"({"points": [[0, 0], [9, 0], [9, 9]]})")), HasSubstr("\"name\" is missing"));
    EXPECT_THAT(messageOf(withZone(R"({"name": "a", "pionts": []})")), HasSubstr("did you mean \"points\"?"));
    EXPECT_THAT(messageOf(withZone(R"({"name": "a", "shape": "circle", "points": []})")),
                HasSubstr("zones[0].shape: is \"circle\", expected \"area\", \"line\" or \"arrow\""));
    EXPECT_THAT(messageOf(withZone(R"({"name": "a", "points": [[0, 0], [9, 0], [9]]})")),
                HasSubstr("zones[0].points[2]: is not a point"));
    EXPECT_THAT(messageOf(withZone(R"({"name": "a", "points": [[0, 0], [9, "x"], [9, 9]]})")),
                HasSubstr("zones[0].points[1][1]: is not a number"));
    EXPECT_THAT(messageOf(withZone(R"({"name": "a", "frame": -1, "points": [[0, 0], [9, 0], [9, 9]]})")),
                HasSubstr("zones[0].frame"));
    EXPECT_THAT(messageOf(withZone(R"({"name": "a", "frame": 30000000, "points": [[0, 0], [9, 0], [9, 9]]})")),
                HasSubstr("zones[0].frame"));
    const std::string good = R"({"name": "a", "points": [[0, 0], [9, 0], [9, 9]]})";
    EXPECT_THAT(messageOf(withZone(good + "," + good)), HasSubstr("second zone with the name \"a\""));
    EXPECT_EQ(messageOf(withZone(good)), "");
}

TEST_F(ZoneFiles, WhatIsWrittenIsReadToTheBit) {
    Zone odd = square();
    odd.name = "Höfe, \"Ost\"";
    odd.points[0] = {400 + 1 / 3.0, -0.1};
    Zone fixed = line();
    fixed.anchor = ZoneAnchor::image;
    Zone arrow = line();
    arrow.name = "lane";
    arrow.shape = ZoneShape::arrow;
    writeZones(folder_ / "out.json", {odd, fixed, arrow});
    EXPECT_EQ(readZones(folder_ / "out.json"), (std::vector<Zone>{odd, fixed, arrow}));
}

TEST_F(ZoneFiles, AZoneWithoutAreaIsRefused) {
    EXPECT_THAT(messageOf(withZone(R"({"name": "a", "points": [[0, 0], [50, 50], [100, 100]]})")),
                HasSubstr("zones[0].points: the zone has no area"));
    EXPECT_THAT(messageOf(withZone(R"({"name": "a", "points": [[0, 0], [50, 50]]})")), HasSubstr("three points"));
    EXPECT_THAT(messageOf(withZone(R"({"name": "a", "points": [[0, 0], [50, 50], [50, 0], [0, 50]]})")),
                HasSubstr("crosses itself"));
    EXPECT_THAT(messageOf(withZone(R"({"name": "a", "shape": "line", "points": [[5, 5], [5, 5]]})")),
                HasSubstr("no length"));
}

}  // namespace eyrie::zones_test

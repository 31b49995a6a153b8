#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "events/driven_tracks.h"

namespace eyrie::event_thresholds_test {
namespace {

using test::DrivenTracks;
using test::Leg;

using Values = std::vector<std::pair<std::string, std::string>>;

/// A scene that holds one quantity, and how many events of a kind are found with values on either side of it.
struct Threshold {
    const char* parameter;
    const char* below;
    const char* above;
    EventKind kind;
    std::size_t found_below;
    std::size_t found_above;
    void (*drive)(DrivenTracks&);
    Values others = {};  ///< parameters that would decide before this one
};

/// For messages of failed tests, and the names of the tests.
void PrintTo(const Threshold& threshold, std::ostream* out) {
    *out << threshold.parameter << " for " << nameOf(threshold.kind);
}

std::vector<Event> eventsWith(const DrivenTracks& scene, const Threshold& threshold, const Values& values) {
    EventOptions options;
    setParameters(describeOf(options), threshold.others);
    setParameters(describeOf(options), values);
    // Across the ground and down the picture at x = 100 m; to the right at y = 110 m; a square of 40 m about its
    // middle.
    const std::vector<Zone> zones = {
        {"line", ZoneShape::line, ZoneAnchor::ground, 0, {{500, 50}, {500, 550}}},
        {"arrow", ZoneShape::arrow, ZoneAnchor::ground, 0, {{300, 550}, {800, 550}}},
        {"square", ZoneShape::area, ZoneAnchor::image, 0, {{400, 200}, {600, 200}, {600, 400}, {400, 400}}}};
    return scene.events(threshold.kind, options, zones);
}

double defaultOf(const std::string& name) {
    EventOptions options;
    for (const Parameter& parameter : listParameters(describeOf(options)))
        if (parameter.name == name) return std::stod(parameter.value);
    return -1;
}

// --- drives, without noise; the picture shows 200 m by 120 m ---------------------------------------------------------

const std::vector<Leg> kMeet = {{5, 30, 30}, {4, 30, 0}, {10, 0, 0}, {4, 0, 30}, {8, 30, 30}};  // stands after 58.3 m

/// Slows down to 3 km/h for five seconds.
void crawlsBetween(DrivenTracks& scene) {
    scene.drive({20, 60}, 0, {{4, 36, 36}, {3, 36, 3}, {5, 3, 3}, {3, 3, 36}, {4, 36, 36}});
}
/// Stands, then drives at 5 km/h.
void setsOffSlowly(DrivenTracks& scene) {
    scene.drive({20, 60}, 0, {{4, 0, 0}, {2, 0, 5}, {8, 5, 5}});
}
/// Stands for four seconds.
void standsForFour(DrivenTracks& scene) {
    scene.drive({20, 60}, 0, {{4, 36, 36}, {3.33, 36, 0}, {4, 0, 0}, {3.33, 0, 36}, {4, 36, 36}});
}
/// Moves up by 3.3 m between two standstills.
void movesUp(DrivenTracks& scene) {
    scene.drive({20, 60}, 0, {{5, 0, 0}, {1, 0, 12}, {1, 12, 0}, {5, 0, 0}});
}
/// Is lost at 10 m/s with its front 10 m from the border.
void isLostBeforeTheBorder(DrivenTracks& scene) {
    scene.drive({100, 60}, 0, {{20, 36, 36}});
    scene.cutAfter(8.76);
}
/// Drives along the border, 2 m from it, and is lost.
void isLostAlongTheBorder(DrivenTracks& scene) {
    scene.drive({20, 2.8}, 0, {{20, 36, 36}});
    scene.cutAfter(8);
}
/// Is lost two seconds before the end of the video.
void isLostBeforeTheEnd(DrivenTracks& scene) {
    scene.frames = 500;
    scene.drive({20, 60}, 0, {{10, 20, 20}}, 200);
}
/// Is found in mid-picture two seconds after the beginning of the video.
void isFoundAfterTheBeginning(DrivenTracks& scene) {
    scene.drive({20, 60}, 0, {{10, 20, 20}}, 50);
}
/// Turns by 160 degrees.
void turnsBy160(DrivenTracks& scene) {
    scene.drive({40, 30}, 0, {{5, 30, 30}, {160 / 30.0, 15, 15, 30}, {5, 30, 30}});
}
/// Stands for ten seconds between driving forwards and backwards.
void reversesAfterTen(DrivenTracks& scene) {
    scene.drive({40, 30}, 0, {{5, 30, 30}, {3, 30, 0}, {10, 0, 0}, {3, 0, -20}, {5, -20, -20}});
}
/// Reverses by 6 m.
void reversesForSix(DrivenTracks& scene) {
    scene.drive({40, 30}, 0, {{5, 30, 30}, {3, 30, 0}, {2, 0, 0}, {1.08, 0, -20}, {1.08, -20, 0}, {6, 0, 0}});
}
/// Comes back 40 m beside its way.
void loopsFortyWide(DrivenTracks& scene) {
    scene.drive({40, 30}, 0, {{5, 30, 30}, {15.1, 15, 15, 11.94}, {5, 30, 30}});
}
/// Drives at 10 km/h for eight seconds.
void slowsForEight(DrivenTracks& scene) {
    scene.drive({20, 60}, 0, {{4, 36, 36}, {3, 36, 10}, {8, 10, 10}, {3, 10, 36}, {4, 36, 36}});
}
/// Drives in circles of 14 m radius for 90 s, 450 m.
void circles(DrivenTracks& scene) {
    scene.frames = 2400;
    scene.drive({100, 46}, 0, {{90, 18, 18, 20.46}});
}
/// Six to the right on y = 62, and one the other way for 20 m, 3 m beside their line.
void drivesBesideTheFlow(DrivenTracks& scene) {
    for (int i = 0; i < 6; ++i) scene.drive({-10, 62}, 0, {{40, 45, 45}}, 40 * i);
    scene.drive({120, 65}, 180, {{4, 18, 18}}, 100);
}
/// The same on their line.
void drivesAgainstSix(DrivenTracks& scene) {
    for (int i = 0; i < 6; ++i) scene.drive({-10, 62}, 0, {{40, 45, 45}}, 40 * i);
    scene.drive({120, 62}, 180, {{4, 18, 18}}, 100);
}
/// One alone, 20 m to the left, 3 m beside the arrow.
void drivesBesideTheArrow(DrivenTracks& scene) {
    scene.drive({120, 113}, 180, {{4, 18, 18}}, 100);
}
/// Three drive against nine, so that two of eleven others go the same way as each of them.
void threeDriveAgainstNine(DrivenTracks& scene) {
    for (int i = 0; i < 9; ++i) scene.drive({-10, 62}, 0, {{40, 45, 45}}, 40 * i);
    for (int i = 0; i < 3; ++i) scene.drive({210, 62}, 180, {{40, 45, 45}}, 40 * i);
}
/// Crosses a flow at 140 degrees to its direction.
void crossesTheFlow(DrivenTracks& scene) {
    for (int i = 0; i < 6; ++i) scene.drive({-10, 50}, 7.5, {{40, 45, 45}}, 40 * i);
    scene.drive({125, 50}, 147.5, {{15, 12, 12}}, 100);
}
/// Leaves the way of six others to the side and goes on 8 m beside it, in a video of 20 s.
void leavesForEightBeside(DrivenTracks& scene) {
    scene.frames = 500;
    for (int i = 0; i < 6; ++i) scene.drive({-10, 50}, 0, {{40, 54, 54}}, 25 * i);
    scene.drive({-10, 50}, 0, {{8, 36, 36}, {1, 36, 36, 48}, {1, 36, 36, -48}, {8, 36, 36}});
}
/// Leaves it for 40 m or so.
void leavesAndEnds(DrivenTracks& scene) {
    for (int i = 0; i < 6; ++i) scene.drive({-10, 50}, 0, {{40, 54, 54}}, 25 * i);
    scene.drive({-10, 50}, 0, {{8, 36, 36}, {1, 36, 36, 90}, {4, 36, 36}});
}
/// Three at 20 km/h, each 18 m or 3.24 s behind the other for 25 s.
void threeInLine(DrivenTracks& scene) {
    for (int i = 0; i < 3; ++i) scene.drive({50.0 - 18 * i, 40}, 0, {{25, 20, 20}});
}
/// The same, the middle one 2 m beside the others.
void threeFollow(DrivenTracks& scene) {
    for (int i = 0; i < 3; ++i) scene.drive({50.0 - 18 * i, i == 1 ? 42.0 : 40.0}, 0, {{25, 20, 20}});
}
/// The one behind falls back from 15 m to 21 m while it follows, from 2.7 s to 3.8 s: a third of the mean.
void fallsBack(DrivenTracks& scene) {
    scene.drive({35, 40}, 0, {{25, 21, 21}});
    scene.drive({20, 40}, 0, {{25, 20, 20}});
}
/// Two stand side by side with 4 m between them.
void standFourApart(DrivenTracks& scene) {
    scene.drive({100 - 58.3, 60}, 0, kMeet);
    scene.drive({100 + 58.3, 54.2}, 180, kMeet);
}
/// Two stand beside each other for eight of the ten seconds for which each stands.
void standTogetherForEight(DrivenTracks& scene) {
    scene.drive({100 - 58.3, 60}, 0, kMeet);
    scene.drive({100 + 58.3, 57}, 180, kMeet, 50);
}
/// Two meet whose directions differ by 60 degrees.
void meetAtSixty(DrivenTracks& scene) {
    scene.drive({100 - 58.3, 80}, 0, kMeet);
    scene.drive({100 - 58.3 / 2, 76 - 58.3 * std::sqrt(0.75)}, 60, kMeet);
}
/// Comes 1.2 m over the line at x = 100 m, stands, goes back.
void comesOverTheLine(DrivenTracks& scene) {
    scene.drive({101.2 - 25, 60}, 0, {{3, 15, 15}, {6, 15, 0}, {5, 0, 0}, {6, 0, -15}, {3, -15, -15}});
}
/// The same at the edge of the square, x = 80 m.
void comesOverTheEdge(DrivenTracks& scene) {
    scene.drive({81.2 - 25, 60}, 0, {{3, 15, 15}, {6, 15, 0}, {5, 0, 0}, {6, 0, -15}, {3, -15, -15}});
}

const std::vector<Threshold> kThresholds = {
    // Over more than the four seconds it is never slow.
    {"events.smooth", "2", "8", EventKind::stops, 1, 0, standsForFour},
    {"events.standing_speed", "2.9", "3.1", EventKind::stops, 0, 1, crawlsBetween},
    {"events.moving_speed", "4.9", "5.1", EventKind::starts, 1, 0, setsOffSlowly},
    {"events.min_standing", "3.6", "4.6", EventKind::stops, 1, 0, standsForFour},
    {"events.min_standing", "3.6", "4.6", EventKind::starts, 1, 0, standsForFour},
    {"events.stands", "3.6", "4.6", EventKind::stands, 1, 0, standsForFour},
    // Three deviations seem to move by 2.08 /s over a second; it counts half as much again.
    {"events.noise", "2.1", "2.3", EventKind::starts, 1, 0, setsOffSlowly, {{"events.moving_speed", "4"}}},
    {"events.min_way", "2.7", "3.4", EventKind::starts, 1, 0, movesUp},
    {"events.border_time", "0.9", "1.1", EventKind::lost, 1, 0, isLostBeforeTheBorder},
    {"events.border_time", "0.9", "1.1", EventKind::leaves, 0, 1, isLostBeforeTheBorder},
    {"events.border_distance", "1.9", "2.1", EventKind::lost, 1, 0, isLostAlongTheBorder},
    {"events.edge_time", "1.9", "2.1", EventKind::lost, 1, 0, isLostBeforeTheEnd},
    {"events.edge_time", "1.9", "2.1", EventKind::appears, 1, 0, isFoundAfterTheBeginning},
    {"events.turn_back_angle", "158", "162", EventKind::turns_back, 1, 0, turnsBy160},
    {"events.turn_back_time", "9.5", "11.5", EventKind::turns_back, 0, 1, reversesAfterTen},
    {"events.turn_back_way", "5.5", "6.2", EventKind::turns_back, 1, 0, reversesForSix},
    {"events.turn_back_offset",
     "39",
     "41",
     EventKind::turns_back,
     0,
     1,
     loopsFortyWide,
     {{"events.turn_back_angle", "175"}}},
    {"events.over", "35", "37", EventKind::over_speed, 2, 0, slowsForEight},
    {"events.over_time", "3.8", "5", EventKind::over_speed, 2, 0, slowsForEight, {{"events.over", "35"}}},
    {"events.under", "9.8", "10.2", EventKind::under_speed, 0, 1, slowsForEight},
    {"events.under_time", "7.8", "9", EventKind::under_speed, 1, 0, slowsForEight},
    {"events.loiter_radius", "13.5", "14.5", EventKind::loiters, 0, 1, circles},
    // Twice the diameter is more than the vehicle drives.
    {"events.loiter_radius", "108", "116", EventKind::loiters, 1, 0, circles},
    {"events.loiter_time", "88", "92", EventKind::loiters, 1, 0, circles},
    {"events.flow_radius", "2", "4", EventKind::against_flow, 0, 1, drivesBesideTheFlow},
    {"events.flow_tracks", "6", "7", EventKind::against_flow, 1, 0, drivesAgainstSix},
    {"events.flow_share", "0.17", "0.19", EventKind::against_flow, 0, 3, threeDriveAgainstNine},
    {"events.arrow_radius", "2.8", "3.2", EventKind::against_flow, 0, 1, drivesBesideTheArrow},
    {"events.against_angle", "138", "142", EventKind::against_flow, 1, 0, crossesTheFlow, {{"events.flow_way", "2"}}},
    {"events.flow_way", "19", "21", EventKind::against_flow, 1, 0, drivesAgainstSix},
    {"events.flow_way", "36", "44", EventKind::leaves_flow, 1, 0, leavesAndEnds},
    {"events.off_flow", "6", "9", EventKind::leaves_flow, 1, 0, leavesForEightBeside},
    {"events.off_flow_seen", "19", "21", EventKind::leaves_flow, 1, 0, leavesForEightBeside},
    {"events.convoy_time", "20", "23", EventKind::convoy, 1, 0, threeInLine},
    // A place counts as passed from convoy_lane before it on.
    {"events.convoy_headway", "3.1", "3.3", EventKind::convoy, 0, 1, threeInLine, {{"events.convoy_lane", "0.5"}}},
    {"events.convoy_vehicles", "3", "4", EventKind::convoy, 1, 0, threeInLine},
    {"events.convoy_lane", "1.9", "2.1", EventKind::convoy, 0, 1, threeFollow},
    {"events.convoy_spread",
     "0.28",
     "0.36",
     EventKind::convoy,
     0,
     1,
     fallsBack,
     {{"events.convoy_vehicles", "2"}, {"events.convoy_time", "20"}}},
    {"events.meeting_distance", "3.9", "4.1", EventKind::meeting, 0, 1, standFourApart},
    {"events.meeting_time", "7.5", "9", EventKind::meeting, 1, 0, standTogetherForEight},
    {"events.meeting_angle", "58", "62", EventKind::meeting, 1, 0, meetAtSixty},
    {"events.zone_margin", "1.1", "1.3", EventKind::crosses, 2, 0, comesOverTheLine},
    {"events.zone_margin", "1.1", "1.3", EventKind::enters, 1, 0, comesOverTheEdge},
};

class EventThresholds : public testing::TestWithParam<Threshold> {};

}  // namespace

TEST_P(EventThresholds, DecideWhatIsToldOnEitherSideOfThem) {
    const Threshold& threshold = GetParam();
    DrivenTracks scene;
    scene.noise_px = 0;
    threshold.drive(scene);
    const std::string name = threshold.parameter;
    EXPECT_THAT(eventsWith(scene, threshold, {{name, threshold.below}}), testing::SizeIs(threshold.found_below))
        << name << " = " << threshold.below;
    EXPECT_THAT(eventsWith(scene, threshold, {{name, threshold.above}}), testing::SizeIs(threshold.found_above))
        << name << " = " << threshold.above;
    // With the default it is on one side or the other, as if the other parameter had not been touched.
    const double by_default = defaultOf(name);
    ASSERT_TRUE(by_default <= std::stod(threshold.below) || by_default >= std::stod(threshold.above)) << by_default;
    EXPECT_THAT(
        eventsWith(scene, threshold, {}),
        testing::SizeIs(by_default <= std::stod(threshold.below) ? threshold.found_below : threshold.found_above))
        << name << " by default";
}

INSTANTIATE_TEST_SUITE_P(Parameters, EventThresholds, testing::ValuesIn(kThresholds), [](const auto& entry) {
    std::string name = testing::PrintToString(entry.param) + " " + std::to_string(entry.index);
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
});

}  // namespace eyrie::event_thresholds_test

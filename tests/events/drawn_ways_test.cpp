#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "events/driven_tracks.h"

namespace eyrie::drawn_ways_test {
namespace {

using test::DrivenTracks;
using test::tracksOf;
using testing::ElementsAre;
using testing::IsEmpty;

/// An arrow over the ground, from and to in m, as the camera sees them in a frame.
Zone arrowOver(const DrivenTracks& scene, cv::Point2d from, cv::Point2d to, FrameIndex frame = 0) {
    Zone arrow{"lane", ZoneShape::arrow, ZoneAnchor::ground, frame, {}};
    for (const cv::Point2d place : {from, to})
        arrow.points.push_back(HomographyJacobian(scene.camera(frame), place).point());
    return arrow;
}

std::vector<TrackId> againstFlow(const DrivenTracks& scene, const std::vector<Zone>& zones) {
    return tracksOf(scene.events(EventKind::against_flow, {}, zones));
}

}  // namespace

TEST(DrawnWays, OneAloneIsAgainstAnArrowAndNotWithoutIt) {
    DrivenTracks scene;
    const TrackId wrong = scene.drive({180, 62}, 180, {{12, 40, 40}});
    scene.drive({20, 62}, 0, {{12, 40, 40}}, 300);
    EXPECT_THAT(againstFlow(scene, {}), IsEmpty()) << "nothing is learned of two";
    const auto events = scene.events(EventKind::against_flow, {}, {arrowOver(scene, {70, 62}, {130, 62})});
    ASSERT_THAT(tracksOf(events), ElementsAre(wrong));
    EXPECT_EQ(events[0].zone, "lane");
    EXPECT_NEAR(events[0].figure, 65, 3) << "m: along the arrow and its radius at both ends";
    EXPECT_NEAR(scene.placeOf(events[0]).x, 100, 3);
    // Nobody enters, leaves or crosses an arrow.
    for (const Event& event : scene.events({}, {arrowOver(scene, {100, 40}, {100, 80})}))
        EXPECT_NE(event.kind, EventKind::crosses);
}

TEST(DrawnWays, AnArrowOutvotesWhatMostDoAndElsewhereTheyDecide) {
    DrivenTracks scene;
    for (int i = 0; i < 8; ++i) scene.drive({-10, 62}, 0, {{40, 45, 45}}, 40 * i);
    const TrackId one = scene.drive({210, 62}, 180, {{40, 45, 45}}, 300);
    EXPECT_THAT(againstFlow(scene, {}), ElementsAre(one));
    // Where the arrow lies, the many are wrong and the one is right; it is wrong before and behind it.
    const auto events = scene.events(EventKind::against_flow, {}, {arrowOver(scene, {120, 62}, {80, 62})});
    std::vector<TrackId> by_arrow, by_others;
    for (const Event& event : events) (event.zone.empty() ? by_others : by_arrow).push_back(event.tracks.at(0));
    EXPECT_THAT(by_arrow, testing::UnorderedElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
    EXPECT_THAT(by_others, ElementsAre(one, one));
}

TEST(DrawnWays, OfTwoLanesEachHasTheNearerArrow) {
    DrivenTracks scene;
    const TrackId left = scene.drive({190, 58.5}, 180, {{15, 40, 40}});
    scene.drive({10, 62}, 0, {{15, 40, 40}});
    EventOptions wide;
    wide.arrow_radius_m = 6;  // each reaches into the other lane
    const std::vector<Zone> arrows = {arrowOver(scene, {50, 62}, {150, 62}), arrowOver(scene, {150, 58.5}, {50, 58.5})};
    EXPECT_THAT(scene.events(EventKind::against_flow, wide, arrows), IsEmpty());
    EXPECT_THAT(tracksOf(scene.events(EventKind::against_flow, wide, {arrows[0]})), ElementsAre(left));
}

TEST(DrawnWays, WhoCrossesAnArrowIsNotAgainstIt) {
    DrivenTracks scene;
    scene.drive({100, 20}, 90, {{10, 30, 30}});
    EventOptions options;
    options.flow_way_m = 2;
    EXPECT_THAT(scene.events(EventKind::against_flow, options, {arrowOver(scene, {70, 62}, {130, 62})}), IsEmpty());
}

TEST(DrawnWays, TheyLieOnTheGroundUnderACameraThatMoves) {
    DrivenTracks scene;
    scene.camera = DrivenTracks::moving(0.2);
    const TrackId wrong = scene.drive({150, 62}, 180, {{10, 40, 40}}, 400);
    EXPECT_THAT(againstFlow(scene, {arrowOver(scene, {70, 62}, {130, 62}, 100)}), ElementsAre(wrong));
    EXPECT_THAT(againstFlow(scene, {arrowOver(scene, {130, 62}, {70, 62}, 100)}), IsEmpty());
}

TEST(DrawnWays, InTheImageTheyStayWhereTheyAreOnScreen) {
    DrivenTracks scene;
    // The ground drifts upwards through the picture, by 60 px until the vehicle comes and by 30 px while it drives.
    scene.camera = [](int frame) { return cv::Matx33d(5, 0, 0, 0, 5, -0.2 * frame, 0, 0, 1); };
    const TrackId wrong = scene.drive({170, 62}, 180, {{6, 40, 40}}, 300);
    Zone arrow{"screen", ZoneShape::arrow, ZoneAnchor::image, 0, {{516.5, 220}, {850, 250}}};
    EXPECT_THAT(againstFlow(scene, {arrow}), ElementsAre(wrong));
    Zone on_ground = arrow;
    on_ground.anchor = ZoneAnchor::ground;
    EXPECT_THAT(againstFlow(scene, {on_ground}), IsEmpty()) << "12 m beside it";
    std::reverse(arrow.points.begin(), arrow.points.end());
    EXPECT_THAT(againstFlow(scene, {arrow}), IsEmpty());
}

}  // namespace eyrie::drawn_ways_test

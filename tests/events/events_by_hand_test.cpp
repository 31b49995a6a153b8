/// Events of paths whose places and speeds are written down, so that every figure follows from the definition.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <opencv2/core.hpp>

#include "core/geometry/angle.h"
#include "events/kinds/event_scene.h"

namespace eyrie::events_by_hand_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// A vehicle at one moment: frame, place in metres, speed in m/s.
struct Moment {
    FrameIndex frame = 0;
    cv::Point2d at;
    double speed = 0;
    bool moving = true;
};

/// Paths over a ground of 0.2 m/px that the camera looks straight down on, 25 frames a second.
class ByHand {
 public:
    explicit ByHand(FrameIndex last_frame = 1000) {
        footage.camera = CameraMotion::standing(0, last_frame);
        footage.image_size = {1000, 600};
        footage.last_frame = last_frame;
        footage.scale = {0.2, 25, true};
    }
    /// Cars of 4.5 by 2 m.
    TrackId add(const std::vector<Moment>& moments, double heading = 0) {
        EventTrack& track = tracks.emplace_back();
        track.id = static_cast<TrackId>(tracks.size());
        GroundPath path;
        path.begins = path.ends = path.measured = true;
        for (const Moment& moment : moments) {
            track.boxes.push_back({moment.frame, {moment.at * 5, 22.5, 10, heading}});
            GroundSample sample;
            sample.frame = moment.frame;
            sample.at = moment.at;
            sample.velocity = cv::Point2d(std::cos(heading), std::sin(heading)) * moment.speed;
            sample.speed = moment.speed;
            sample.moving = moment.moving;
            path.samples.push_back(sample);
        }
        path.track = &track;
        paths.push_back(path);
        return track.id;
    }
    template <class Find>
    std::vector<Event> found(Find find) const {
        const GroundStretches ground(footage);
        std::vector<Event> events;
        find(EventScene{ground, paths, options, footage.scale}, events);
        return events;
    }
    std::vector<Event> found(EventKind kind, void (*find)(const EventScene&, std::vector<Event>&)) const {
        std::vector<Event> events = found(find);
        std::erase_if(events, [kind](const Event& event) { return event.kind != kind; });
        return events;
    }
    std::vector<Event> inZone(const Zone& zone) const {
        return found(
            [&](const EventScene& scene, std::vector<Event>& events) { findZoneEvents(scene, {zone}, events); });
    }

    Footage footage;
    EventOptions options;
    std::deque<EventTrack> tracks;  ///< stay where they are
    std::vector<GroundPath> paths;
};

/// Where nobody drew the right way.
void findLearnedFlowEvents(const EventScene& scene, std::vector<Event>& events) {
    findFlowEvents(scene, {}, events);
}

/// Samples a second apart, on the way along x, with these speeds.
std::vector<Moment> withSpeeds(const std::vector<double>& speeds) {
    std::vector<Moment> moments;
    for (const double speed : speeds) {
        const double seconds = static_cast<double>(moments.size());
        moments.push_back({static_cast<FrameIndex>(25 * seconds), {20 + seconds, 60}, speed, speed > 0});
    }
    return moments;
}

/// Stands at a place for the seconds from … to, a sample each.
std::vector<Moment> standing(cv::Point2d at, int from, int to) {
    std::vector<Moment> moments;
    for (int second = from; second <= to; ++second) moments.push_back({25 * second, at, 0, false});
    return moments;
}

/// On y = 60 at these x, a sample a second.
std::vector<Moment> alongX(const std::vector<double>& xs) {
    std::vector<Moment> moments;
    for (const double x : xs) moments.push_back({static_cast<FrameIndex>(25 * moments.size()), {x, 60}, 1, true});
    return moments;
}

}  // namespace

TEST(EventsByHand, ALimitIsExceededUntilTheSpeedIsATenthBelowIt) {
    ByHand scene;
    scene.options.over_kmh = 36;  // 10 m/s
    scene.options.over_time_s = 0;
    scene.add(withSpeeds({9, 10.5, 9.5, 9.1, 8.9, 11, 8}));
    const auto over = scene.found(EventKind::over_speed, findSpeeds);
    ASSERT_THAT(over, SizeIs(2));
    EXPECT_EQ(over[0].first_frame, 25);
    EXPECT_EQ(over[0].last_frame, 75) << "9.1 m/s still belong to it, 8.9 do not";
    EXPECT_EQ(over[0].frame, 25) << "where it is fastest";
    EXPECT_NEAR(over[0].figure, 37.8, 1e-9);
    EXPECT_EQ(over[1].first_frame, 125);
    EXPECT_EQ(over[1].last_frame, 125);
    EXPECT_NEAR(over[1].figure, 39.6, 1e-9);
    scene.options.over_time_s = 2;
    EXPECT_THAT(scene.found(EventKind::over_speed, findSpeeds), SizeIs(1)) << "the first lasts just as long";
    scene.options.over_time_s = 2.1;
    EXPECT_THAT(scene.found(EventKind::over_speed, findSpeeds), IsEmpty());
}

TEST(EventsByHand, ALimitIsFallenShortOfUntilTheSpeedIsANinthAboveIt) {
    ByHand scene;
    scene.options.under_kmh = 18;  // 5 m/s, left at 5.56
    scene.options.under_time_s = 0;
    scene.add(withSpeeds({6, 4.5, 4.2, 5.4, 5.6, 4, 6}));
    const auto under = scene.found(EventKind::under_speed, findSpeeds);
    ASSERT_THAT(under, SizeIs(2));
    EXPECT_EQ(under[0].first_frame, 25);
    EXPECT_EQ(under[0].last_frame, 75);
    EXPECT_EQ(under[0].frame, 50) << "where it is slowest";
    EXPECT_NEAR(under[0].figure, 15.12, 1e-9);
    EXPECT_NEAR(under[1].figure, 14.4, 1e-9);
    EXPECT_EQ(under[1].first_frame, 125);
}

TEST(EventsByHand, StopsAndStartsTellTheFastestOfThreeSecondsAround) {
    ByHand scene;
    scene.options.stands_s = 2;
    scene.add(withSpeeds({20, 9, 5, 4, 0, 0, 0, 2, 3, 4, 7, 20}));
    const auto stops = scene.found(EventKind::stops, findStandstills);
    ASSERT_THAT(stops, SizeIs(1));
    EXPECT_EQ(stops[0].frame, 100);
    EXPECT_NEAR(stops[0].figure, 9 * 3.6, 1e-9) << "four seconds before it was faster";
    const auto stands = scene.found(EventKind::stands, findStandstills);
    ASSERT_THAT(stands, SizeIs(1));
    EXPECT_NEAR(stands[0].figure, 2, 1e-12);
    EXPECT_EQ(stands[0].first_frame, 100);
    EXPECT_EQ(stands[0].frame, 125);
    EXPECT_EQ(stands[0].last_frame, 150);
    const auto starts = scene.found(EventKind::starts, findStandstills);
    ASSERT_THAT(starts, SizeIs(1));
    EXPECT_EQ(starts[0].frame, 175) << "the first sample that moves";
    EXPECT_NEAR(starts[0].figure, 7 * 3.6, 1e-9);
    EXPECT_EQ(starts[0].place, cv::Point2d(27 * 5, 60 * 5));
}

TEST(EventsByHand, WhoStandsFromBeginningToEndNeitherStopsNorStarts) {
    ByHand scene;
    scene.add(standing({50, 60}, 0, 10));
    const auto events = scene.found(findStandstills);
    ASSERT_THAT(events, SizeIs(1));
    EXPECT_EQ(events[0].kind, EventKind::stands);
    EXPECT_NEAR(events[0].figure, 10, 1e-12);
}

TEST(EventsByHand, AVehicleAppearsAsFarInsideAsTheNearestBorder) {
    const auto depthAt = [](cv::Point2d metres) {
        ByHand scene;
        scene.add({{100, metres, 1}, {101, metres, 1}, {102, metres, 1}});
        const auto appears = scene.found(EventKind::appears, findBorderEvents);
        return appears.size() == 1 ? appears[0].figure : -1;
    };
    // Pixels reach from −0.5 to 999.5 and 599.5.
    EXPECT_NEAR(depthAt({60, 20}), 100.5 * 0.2, 1e-9);
    EXPECT_NEAR(depthAt({20, 60}), 100.5 * 0.2, 1e-9);
    EXPECT_NEAR(depthAt({180, 60}), 99.5 * 0.2, 1e-9);
    EXPECT_NEAR(depthAt({100, 104}), 79.5 * 0.2, 1e-9);
}

TEST(EventsByHand, NobodyAppearsInTheFirstFrameOrEndsInTheLast) {
    ByHand scene(200);
    scene.options.edge_time_s = 0;
    scene.add({{0, {100, 60}, 1}, {100, {101, 60}, 1}, {200, {102, 60}, 1}});
    EXPECT_THAT(scene.found(findBorderEvents), IsEmpty());
    scene.add({{1, {100, 60}, 1}, {100, {101, 60}, 1}, {199, {102, 60}, 1}});
    const auto events = scene.found(findBorderEvents);
    ASSERT_THAT(events, SizeIs(2));
    EXPECT_EQ(events[0].kind, EventKind::appears);
    EXPECT_EQ(events[1].kind, EventKind::lost);
    EXPECT_EQ(events[1].frame, 199);
}

TEST(EventsByHand, ANewGroundThatIsConnectedIsNoEdgeOfTheSearch) {
    // The camera climbs by 1 % a frame, so that a new ground begins with frame 111.
    ByHand scene(150);
    std::vector<Homography> steps;
    for (int frame = 0; frame < 150; ++frame)
        steps.push_back({cv::Matx33d(1 / 1.01, 0, 0, 0, 1 / 1.01, 0, 0, 0, 1), frame, frame + 1});
    scene.footage.camera = CameraMotion(steps);
    ASSERT_THAT(GroundStretches(scene.footage).all(), SizeIs(2));
    const std::vector<Moment> ends_before = {{0, {100, 60}, 1}, {104, {100, 60}, 1}, {105, {100, 60}, 1}};
    scene.add(ends_before);
    const auto lost = scene.found(findBorderEvents);
    ASSERT_THAT(lost, SizeIs(1)) << "it was searched for on";
    EXPECT_EQ(lost[0].kind, EventKind::lost);
    ByHand after = scene;
    after.paths.clear();
    after.add({{115, {100, 60}, 1}, {116, {100, 60}, 1}, {150, {100, 60}, 1}});
    after.paths[0].stretch = 1;
    const auto found = after.found(findBorderEvents);
    ASSERT_THAT(found, SizeIs(1)) << "it was searched for before";
    EXPECT_EQ(found[0].kind, EventKind::appears);
    // Where nothing connects them, it is one.
    steps.erase(steps.begin() + 110);
    after.footage.camera = scene.footage.camera = CameraMotion(steps);
    EXPECT_THAT(scene.found(findBorderEvents), SizeIs(0));
    EXPECT_THAT(after.found(findBorderEvents), SizeIs(0));
}

TEST(EventsByHand, WhoHeadsForTheBorderLeavesAndWhoHeadsAwayIsLost) {
    // The front of a car is 2.25 m ahead. At 0.25 m a frame it is 3.75 m further after 0.6 s: it passes the border at
    // x = 199.9 m from 193.9 m on.
    const auto endsAs = [](double last_x, double step) {
        ByHand scene;
        scene.add({{100, {last_x - 2 * step, 60}, 6}, {101, {last_x - step, 60}, 6}, {102, {last_x, 60}, 6}});
        const auto events = scene.found(findBorderEvents);
        return events.back().kind;
    };
    EXPECT_EQ(endsAs(193.8, 0.25), EventKind::lost);
    EXPECT_EQ(endsAs(194.0, 0.25), EventKind::leaves);
    EXPECT_EQ(endsAs(194.0, -0.25), EventKind::lost);
    // The border at x = −0.1 m is passed by the rear, 2.25 m behind, from 5.9 m on.
    EXPECT_EQ(endsAs(6.0, -0.25), EventKind::lost);
    EXPECT_EQ(endsAs(5.8, -0.25), EventKind::leaves);
}

TEST(EventsByHand, TwoStandTogetherWhereAtMostThreeMetresLieBetweenThem) {
    const auto meetings = [](cv::Point2d beside) {
        ByHand scene;
        scene.add(standing({100, 60}, 0, 10));
        scene.add(standing(cv::Point2d(100, 60) + beside, 2, 12), kPi);
        return scene.found(findMeetings);
    };
    // Cars are 4.5 m long and 2 m wide.
    EXPECT_THAT(meetings({0, 4.9}), SizeIs(1));
    EXPECT_THAT(meetings({0, 5.1}), IsEmpty());
    EXPECT_THAT(meetings({7.4, 0}), SizeIs(1));
    EXPECT_THAT(meetings({-7.6, 0}), IsEmpty());
    // From corner to corner: (2.1, 2.1) m are 2.97 m, (2.2, 2.2) m are 3.11 m.
    EXPECT_THAT(meetings({6.6, -4.1}), SizeIs(1));
    EXPECT_THAT(meetings({6.7, -4.2}), IsEmpty());
    const Event event = meetings({0, 4}).at(0);
    EXPECT_THAT(event.tracks, ElementsAre(1, 2));
    EXPECT_EQ(event.first_frame, 50) << "from when both stand";
    EXPECT_EQ(event.last_frame, 250) << "until one of them does not";
    EXPECT_EQ(event.frame, 150);
    EXPECT_NEAR(event.figure, 8, 1e-12);
    EXPECT_EQ(event.unit, FigureUnit::seconds);
}

TEST(EventsByHand, AMeetingLastsAsLongAsItMust) {
    const auto meetings = [](int from, int to) {
        ByHand scene;
        scene.options.meeting_time_s = 5;
        scene.add(standing({100, 64}, from, to), kPi);
        scene.add(standing({100, 60}, 0, 10));
        return scene.found(findMeetings);
    };
    ASSERT_THAT(meetings(5, 15), SizeIs(1)) << "just five seconds";
    EXPECT_THAT(meetings(5, 15)[0].tracks, ElementsAre(1, 2)) << "in the order of their numbers";
    EXPECT_THAT(meetings(6, 16), IsEmpty());
    EXPECT_THAT(meetings(0, 4), IsEmpty());
    EXPECT_THAT(meetings(11, 20), IsEmpty()) << "one after the other";
}

TEST(EventsByHand, AnAreaIsEnteredWhereItsEdgeIsPassedLast) {
    ByHand scene;
    scene.options.zone_margin_m = 0.4;
    // From x = 30 to 40 m. Comes 0.2 m in, goes back, comes in, and out again.
    const Zone area{"yard", ZoneShape::area, ZoneAnchor::ground, 0, {{150, 250}, {200, 250}, {200, 350}, {150, 350}}};
    scene.add(alongX({28, 30.2, 29.8, 30.3, 31, 35, 39.9, 40.2, 39.7, 40.1, 42}));
    const auto events = scene.inZone(area);
    ASSERT_THAT(events, SizeIs(2));
    EXPECT_EQ(events[0].kind, EventKind::enters);
    EXPECT_EQ(events[0].frame, 3 * 25);
    EXPECT_NEAR(events[0].figure, 3.6, 1e-9);
    EXPECT_EQ(events[1].kind, EventKind::exits);
    EXPECT_EQ(events[1].frame, 9 * 25);
    EXPECT_NEAR(events[1].figure, 6, 1e-12) << "seconds inside";
    EXPECT_EQ(events[1].zone, "yard");
}

TEST(EventsByHand, ALineIsCrossedWhereItWasPassedLast) {
    ByHand scene;
    scene.options.zone_margin_m = 0.4;
    const Zone line{"gate", ZoneShape::line, ZoneAnchor::ground, 0, {{150, 250}, {150, 350}}};  // x = 30 m, downwards
    scene.add(alongX({28, 29.8, 30.2, 29.9, 30.3, 32, 30.1, 29.9, 28}));
    const auto events = scene.inZone(line);
    ASSERT_THAT(events, SizeIs(2));
    EXPECT_EQ(events[0].frame, 4 * 25) << "over, back and over again counts once";
    EXPECT_EQ(events[0].sense, CrossingSense::to_left);
    EXPECT_EQ(events[1].frame, 7 * 25);
    EXPECT_EQ(events[1].sense, CrossingSense::to_right);
    ByHand turning;
    turning.options.zone_margin_m = 0.4;
    turning.add(alongX({28, 30.2, 29.8, 28, 30.3, 29.7, 28}));
    EXPECT_THAT(turning.inZone(line), IsEmpty()) << "it always went back";
    ByHand inside;
    inside.options.zone_margin_m = 0.4;
    inside.add(alongX({29.8, 30.2, 32}));
    EXPECT_THAT(inside.inZone(line), IsEmpty()) << "it was never clearly on the first side";
}

TEST(EventsByHand, LoiteringIsLongAndFarInAPlace) {
    // Two pictures a second, to and fro by so many metres, then away; the place is 60 m wide.
    const auto loitering = [](int steps, double by) {
        ByHand scene(400);
        scene.footage.scale.frame_rate_hz = 2;
        std::vector<Moment> moments;
        for (int i = 0; i <= steps; ++i) moments.push_back({i, {50 + (i % 2 == 0 ? 0 : by), 60}, 2 * by, true});
        moments.push_back({steps + 1, {150, 60}, 20, true});
        scene.add(moments);
        return scene.found(findLoitering);
    };
    const auto events = loitering(120, 20);
    ASSERT_THAT(events, SizeIs(1));
    EXPECT_NEAR(events[0].figure, 60, 1e-12) << "just as long as it must";
    EXPECT_EQ(events[0].first_frame, 0);
    EXPECT_EQ(events[0].frame, 60);
    EXPECT_EQ(events[0].last_frame, 120);
    EXPECT_THAT(loitering(119, 20), IsEmpty());
    EXPECT_THAT(loitering(120, 59), SizeIs(1));
    EXPECT_THAT(loitering(120, 61), IsEmpty()) << "it leaves the place each time";
    EXPECT_THAT(loitering(120, 1), SizeIs(1)) << "120 m are twice its width";
    EXPECT_THAT(loitering(120, 0.99), IsEmpty());
}

TEST(EventsByHand, AgainstTheFlowIsWhoMeetsAsManyAsAreNeeded) {
    const auto driven = [](int others) {
        ByHand scene;
        std::vector<double> there, back;
        for (int x = 20; x <= 60; ++x) there.push_back(x);
        back.assign(there.rbegin(), there.rend());
        for (int i = 0; i < others; ++i) scene.add(alongX(there));
        scene.add(alongX(back), kPi);
        return scene.found(EventKind::against_flow, findLearnedFlowEvents);
    };
    const auto events = driven(5);
    ASSERT_THAT(events, SizeIs(1));
    EXPECT_THAT(events[0].tracks, ElementsAre(6));
    EXPECT_NEAR(events[0].figure, 40, 1e-9) << "metres against it";
    EXPECT_EQ(events[0].first_frame, 0);
    EXPECT_EQ(events[0].frame, 20 * 25);
    EXPECT_EQ(events[0].last_frame, 40 * 25);
    EXPECT_THAT(driven(4), IsEmpty());
}

TEST(EventsByHand, TheFastestIsLookedForOnOneSideOnly) {
    ByHand scene;
    scene.add(withSpeeds({9, 5, 2, 4, 7, 30}));
    const GroundStretches ground(scene.footage);
    const EventScene all{ground, scene.paths, scene.options, scene.footage.scale};
    const GroundPath& path = scene.paths[0];
    EXPECT_EQ(fastestBefore(all, path, 2, 0.9), 2);
    EXPECT_EQ(fastestBefore(all, path, 2, 1), 5);
    EXPECT_EQ(fastestBefore(all, path, 2, 100), 9);
    EXPECT_EQ(fastestAfter(all, path, 2, 0.9), 2);
    EXPECT_EQ(fastestAfter(all, path, 2, 2), 7);
    EXPECT_EQ(fastestAfter(all, path, 2, 100), 30);
}

TEST(EventsByHand, FiguresAreReadWithTheirUnits) {
    Event event;
    const auto text = [&](double figure, FigureUnit unit) {
        event.figure = figure;
        event.unit = unit;
        return figureText(event);
    };
    EXPECT_EQ(text(49.6, FigureUnit::km_per_hour), "50 km/h");
    EXPECT_EQ(text(1.756, FigureUnit::px_per_frame), "1.76 px/frame");
    EXPECT_EQ(text(12.44, FigureUnit::seconds), "12.4 s");
    EXPECT_EQ(text(170.4, FigureUnit::degrees), "170°");
    EXPECT_EQ(text(8.7, FigureUnit::metres), "9 m");
    EXPECT_EQ(text(4, FigureUnit::vehicles), "4 vehicles");
    EXPECT_EQ(text(4, FigureUnit::none), "");
}

}  // namespace eyrie::events_by_hand_test

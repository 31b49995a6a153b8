#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "events/driven_tracks.h"

namespace eyrie::event_laws_test {
namespace {

using test::DrivenTracks;
using test::Leg;

const std::vector<Leg> kStop = {{5, 30, 30}, {4, 30, 0}, {10, 0, 0}, {4, 0, 30}, {8, 30, 30}};

/// Something of every kind.
DrivenTracks busyScene() {
    DrivenTracks scene;
    scene.frames = 2200;
    scene.noise_px = 0.2;
    for (int i = 0; i < 40; ++i) {
        scene.drive({-10, 62}, 0, {{40, 45, 45}}, 50 * i);
        scene.drive({210, 58.5}, 180, {{40, 50, 50}}, 50 * i + 13);
    }
    scene.drive({-10, 58.5}, 0, {{40, 40, 40}}, 300);
    scene.drive({-10, 62}, 0, {{7.2, 45, 45}, {3, 25, 25, 25}, {4, 25, 25}}, 720);
    scene.cutAfter(12);
    scene.drive({20, 20}, 0, {{5, 30, 30}, {6, 15, 15, 30}, {5, 30, 30}}, 100);
    scene.drive({20, 100}, 0, {{2, 60, 110}, {3, 110, 110}}, 200);
    scene.drive({20, 90}, 0, {{3, 40, 40}, {2, 40, 9}, {9, 9, 9}, {2, 9, 40}}, 200);
    scene.drive({100 - 58.3, 30}, 0, kStop, 600);
    scene.drive({100 + 58.3, 27}, 180, kStop, 650);
    scene.drive({160, 90}, 0, {{85, 12, 12, 20}}, 20);
    for (int i = 0; i < 3; ++i) scene.drive({30, 15}, 0, {{28, 20, 20}}, 1300 + 70 * i);
    return scene;
}

std::vector<Zone> busyZones(const DrivenTracks& scene, int frame) {
    std::vector<Zone> zones = {
        {"area", ZoneShape::area, ZoneAnchor::ground, frame, {{80, 40}, {120, 40}, {120, 80}, {80, 80}}},
        {"line", ZoneShape::line, ZoneAnchor::ground, frame, {{60, 10}, {60, 110}}}};
    for (Zone& zone : zones)
        for (cv::Point2d& point : zone.points) point = HomographyJacobian(scene.camera(frame), point).point();
    return zones;
}

/// Compares what happens, to whom, about when and where on the ground; `turned` brings places of the second scene
/// to the first.
void expectSame(const DrivenTracks& a, const std::vector<Event>& in_a, const DrivenTracks& b,
                const std::vector<Event>& in_b, const std::function<cv::Point2d(cv::Point2d)>& turned, double metres) {
    EXPECT_EQ(in_a.size(), in_b.size());
    for (const Event& event : in_a) {
        const auto same = std::find_if(in_b.begin(), in_b.end(), [&](const Event& other) {
            const cv::Point2d way = turned(b.placeOf(other)) - a.placeOf(event);
            return other.kind == event.kind && other.tracks == event.tracks && other.zone == event.zone &&
                   other.sense == event.sense && std::abs(other.first_frame - event.first_frame) <= 6 &&
                   std::abs(other.figure - event.figure) <= 0.1 * event.figure + 0.5 &&
                   std::hypot(way.x, way.y) < metres;
        });
        EXPECT_NE(same, in_b.end()) << testing::PrintToString(event);
    }
}

std::vector<Event> withoutBorder(std::vector<Event> events) {
    std::erase_if(events, [](const Event& event) {
        return event.kind == EventKind::appears || event.kind == EventKind::leaves || event.kind == EventKind::lost;
    });
    return events;
}

}  // namespace

TEST(EventLaws, TheBusySceneHasEveryKind) {
    const DrivenTracks scene = busyScene();
    std::map<EventKind, int> counts;
    for (const Event& event : scene.events({}, busyZones(scene, 0))) ++counts[event.kind];
    for (const EventKind kind : allEventKinds()) EXPECT_GT(counts[kind], 0) << nameOf(kind);
}

TEST(EventLaws, TurningTheSceneTurnsItsEvents) {
    const DrivenTracks scene = busyScene();
    DrivenTracks turned = scene;
    turned.size = {scene.size.height, scene.size.width};
    // (x, y) of the picture becomes (height − 1 − y, x).
    const double top = scene.size.height - 1;
    const cv::Matx33d quarter(0, -1, top, 1, 0, 0, 0, 0, 1);
    turned.camera = [camera = scene.camera, quarter](int frame) { return quarter * camera(frame); };
    for (EventTrack& track : turned.tracks) {
        for (TrackedBox& box : track.boxes) {
            box.box.centre = {top - box.box.centre.y, box.box.centre.x};
            box.box.heading = wrapPi(box.box.heading + kPi / 2);
        }
    }
    const auto here = scene.events({}, busyZones(scene, 0));
    const auto there = turned.events({}, busyZones(turned, 0));
    expectSame(
        scene, here, turned, there, [](cv::Point2d place) { return place; }, 1);
    for (const Event& event : there) EXPECT_LT(event.place.x, turned.size.width) << testing::PrintToString(event);
}

TEST(EventLaws, ACameraThatMovesOverStandingGroundChangesNothing) {
    const DrivenTracks scene = busyScene();
    DrivenTracks moving = scene;
    moving.camera = DrivenTracks::moving(0.2);
    for (EventTrack& track : moving.tracks) {
        for (TrackedBox& box : track.boxes) {
            const cv::Point2d ground = HomographyJacobian(scene.camera(box.frame).inv(), box.box.centre).point();
            const HomographyJacobian local(moving.camera(box.frame), ground);
            const double bigger = local.scale() * scene.scale.gsd_m_per_px;
            box.box = {local.point(), box.box.length * bigger, box.box.width * bigger, local.turned(box.box.heading)};
        }
    }
    // The border is elsewhere, so what happens there is not compared; the first frame is that of the same height.
    const auto here = withoutBorder(scene.events({}, busyZones(scene, 0)));
    const auto there = withoutBorder(moving.events({}, busyZones(moving, 700)));
    expectSame(
        scene, here, moving, there, [](cv::Point2d place) { return place; }, 1.5);
}

TEST(EventLaws, LaterFramesChangeNoEventOfBefore) {
    DrivenTracks scene;
    scene.drive({20, 60}, 0, {{5, 30, 30}, {6, 15, 15, 30}, {5, 30, 30}});
    const auto early = scene.events(EventKind::turns_back);
    scene.frames = 1500;
    const auto late = scene.events(EventKind::turns_back);
    ASSERT_EQ(early.size(), 1U);
    ASSERT_EQ(late.size(), 1U);
    EXPECT_EQ(early[0].first_frame, late[0].first_frame);
    EXPECT_EQ(early[0].ground, late[0].ground);
}

TEST(EventLaws, EveryParameterIsDeclared) {
    EventOptions options;
    for (const Parameter& parameter : listParameters(describeOf(options))) {
        EXPECT_TRUE(parameter.name.starts_with("events.")) << parameter.name;
        EXPECT_FALSE(parameter.text.help.empty()) << parameter.name;
    }
    setParameter(describeOf(options), "events.over", "80");
    EXPECT_EQ(options.over_kmh, 80);
}

TEST(EventLaws, KindsHaveNames) {
    for (const EventKind kind : allEventKinds()) EXPECT_EQ(eventKindOf(nameOf(kind)), kind);
    EXPECT_EQ(eventKindOf("turns-back"), EventKind::turns_back);
    EXPECT_THROW(eventKindOf("turnsback"), Error);
}

}  // namespace eyrie::event_laws_test

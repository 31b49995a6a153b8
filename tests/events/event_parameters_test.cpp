#include <gtest/gtest.h>

#include <string>

#include "events/driven_tracks.h"

namespace eyrie {
namespace {

using test::DrivenTracks;

using Play = void (*)(DrivenTracks& scene);

/// A parameter, a scene with one such event, and two values on both sides of what the scene shows.
struct EventLimit {
    const char* parameter;
    EventKind kind;
    Play play;
    const char* told;
    const char* untold;
};

void stopAndGo(DrivenTracks& scene) {
    scene.drive({20, 60}, 0, {{4, 36, 36}, {3.33, 36, 0}, {10, 0, 0}, {3.33, 0, 36}, {4, 36, 36}});
}
void shortStop(DrivenTracks& scene) {
    scene.drive({20, 60}, 0, {{5, 36, 36}, {1, 36, 0}, {2, 0, 0}, {1, 0, 36}, {5, 36, 36}});
}
void nearlyStops(DrivenTracks& scene) {  // 4 km/h for six seconds
    scene.drive({20, 60}, 0, {{4, 36, 36}, {3, 36, 4}, {6, 4, 4}, {3, 4, 36}, {4, 36, 36}});
}
void creepsOn(DrivenTracks& scene) {  // at 10 km/h
    scene.drive({20, 60}, 0, {{4, 36, 36}, {3.33, 36, 0}, {10, 0, 0}, {2, 0, 10}, {12, 10, 10}});
}
void movesUp(DrivenTracks& scene) {  // by 8.3 m between two standstills
    scene.drive({20, 60}, 0, {{8, 0, 0}, {2, 0, 15}, {2, 15, 0}, {8, 0, 0}});
}
void endsBeforeTheBorder(DrivenTracks& scene) {  // 14 m, a second away
    scene.drive({20, 60}, 0, {{30, 50, 50}});
    scene.cutAfter(11.95);
}
void endsSlowlyAtTheBorder(DrivenTracks& scene) {  // its front 3.4 m away, and 1.2 s
    scene.drive({150, 60}, 0, {{30, 10, 10}});
    scene.cutAfter(15.95);
}
void comesUpInMidPicture(DrivenTracks& scene) {  // two seconds after the beginning
    scene.drive({60, 60}, 0, {{12, 36, 36}}, 50);
}
void uTurn(DrivenTracks& scene) {  // by 180° in 6 s, coming back 16 m beside; 42 m there and back
    scene.drive({40, 30}, 0, {{5, 30, 30}, {6, 15, 15, 30}, {5, 30, 30}});
}
void sharpBend(DrivenTracks& scene) {  // by 130°
    scene.drive({40, 30}, 0, {{5, 30, 30}, {6, 15, 15, 21.7}, {5, 30, 30}});
}
void slowsDown(DrivenTracks& scene) {  // to 9 km/h for nine seconds
    scene.drive({10, 90}, 0, {{3, 40, 40}, {2, 40, 9}, {9, 9, 9}, {2, 9, 40}, {2, 40, 40}});
}
void hurries(DrivenTracks& scene) {  // 120 km/h for three seconds
    scene.drive({10, 90}, 0, {{2, 60, 60}, {1, 60, 120}, {3, 120, 120}, {1, 120, 60}});
}
void circles(DrivenTracks& scene) {  // of 14 m for 90 s
    scene.frames = 2500;
    scene.drive({60, 60}, 0, {{90, 18, 18, 20}});
}
void twoLanes(DrivenTracks& scene) {
    for (int i = 0; i < 18; ++i) {
        scene.drive({-10, 62}, 0, {{40, 45, 45}}, 40 * i);
        scene.drive({210, 58.5}, 180, {{40, 50, 50}}, 40 * i + 13);
    }
}
void wrongWay(DrivenTracks& scene) {
    twoLanes(scene);
    scene.drive({-10, 58.5}, 0, {{40, 40, 40}}, 300);
}
void turnsOff(DrivenTracks& scene) {
    twoLanes(scene);
    scene.drive({-10, 62}, 0, {{7.2, 45, 45}, {3, 25, 25, 25}, {6, 25, 25}}, 310);
}
void convoy(DrivenTracks& scene) {  // three, three seconds apart, each 1.5 m beside the one ahead, for 24 s
    for (int i = 0; i < 3; ++i) scene.drive({20, 40 + 1.5 * (i % 2)}, 0, {{24, 20, 20}}, 75 * i);
}
void convoyThatComesApart(DrivenTracks& scene) {
    for (int i = 0; i < 3; ++i) scene.drive({60.0 - 12 * i, 40}, 0, {{24, 20 - 2.0 * i, 20 - 2.0 * i}});
}
void meeting(DrivenTracks& scene) {  // 1.2 m between their sides, for eight seconds
    const std::vector<test::Leg> come = {{5, 30, 30}, {4, 30, 0}, {10, 0, 0}, {4, 0, 30}, {8, 30, 30}};
    scene.drive({100 - 58.3, 60}, 0, come);
    scene.drive({100 + 58.3, 57}, 180, come, 50);
}

class EveryEventParameter : public testing::TestWithParam<EventLimit> {};

}  // namespace

TEST_P(EveryEventParameter, PartsWhatIsToldFromWhatIsNot) {
    DrivenTracks scene;
    GetParam().play(scene);
    const auto count = [&](const char* value) {
        EventOptions options;
        setParameter(describeOf(options), GetParam().parameter, value);
        return scene.events(GetParam().kind, options).size();
    };
    EXPECT_EQ(count(GetParam().told), 1U);
    EXPECT_EQ(count(GetParam().untold), 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Each, EveryEventParameter,
    testing::Values(EventLimit{"events.smooth", EventKind::stops, shortStop, "0.5", "8"},
                    EventLimit{"events.standing_speed", EventKind::stops, nearlyStops, "5.5", "2.5"},
                    EventLimit{"events.moving_speed", EventKind::starts, creepsOn, "6", "14"},
                    EventLimit{"events.min_standing", EventKind::stops, stopAndGo, "8", "14"},
                    EventLimit{"events.min_way", EventKind::starts, movesUp, "6", "11"},
                    EventLimit{"events.border_time", EventKind::lost, endsBeforeTheBorder, "0.3", "2"},
                    EventLimit{"events.border_distance", EventKind::lost, endsSlowlyAtTheBorder, "1", "8"},
                    EventLimit{"events.edge_time", EventKind::appears, comesUpInMidPicture, "1", "3"},
                    EventLimit{"events.stands", EventKind::stands, stopAndGo, "8", "12"},
                    EventLimit{"events.turn_back_angle", EventKind::turns_back, sharpBend, "110", "150"},
                    EventLimit{"events.turn_back_time", EventKind::turns_back, uTurn, "12", "2"},
                    EventLimit{"events.turn_back_way", EventKind::turns_back, uTurn, "20", "80"},
                    EventLimit{"events.turn_back_offset", EventKind::turns_back, uTurn, "20", "10"},
                    EventLimit{"events.over", EventKind::over_speed, hurries, "110", "130"},
                    EventLimit{"events.over_time", EventKind::over_speed, hurries, "2", "6"},
                    EventLimit{"events.under", EventKind::under_speed, slowsDown, "12", "6"},
                    EventLimit{"events.under_time", EventKind::under_speed, slowsDown, "7", "14"},
                    EventLimit{"events.loiter_radius", EventKind::loiters, circles, "17", "10"},
                    EventLimit{"events.loiter_time", EventKind::loiters, circles, "80", "99"},
                    EventLimit{"events.flow_radius", EventKind::against_flow, wrongWay, "2", "10"},
                    EventLimit{"events.flow_tracks", EventKind::against_flow, wrongWay, "10", "40"},
                    EventLimit{"events.against_angle", EventKind::against_flow, wrongWay, "160", "180"},
                    EventLimit{"events.flow_way", EventKind::against_flow, wrongWay, "50", "300"},
                    EventLimit{"events.off_flow", EventKind::leaves_flow, turnsOff, "5", "100"},
                    EventLimit{"events.off_flow_seen", EventKind::leaves_flow, turnsOff, "20", "1000"},
                    EventLimit{"events.convoy_vehicles", EventKind::convoy, convoy, "3", "4"},
                    EventLimit{"events.convoy_time", EventKind::convoy, convoy, "15", "30"},
                    EventLimit{"events.convoy_headway", EventKind::convoy, convoy, "4", "2"},
                    EventLimit{"events.convoy_lane", EventKind::convoy, convoy, "2.5", "0.8"},
                    EventLimit{"events.convoy_spread", EventKind::convoy, convoyThatComesApart, "5", "0.05"},
                    EventLimit{"events.meeting_distance", EventKind::meeting, meeting, "2", "0.5"},
                    EventLimit{"events.meeting_time", EventKind::meeting, meeting, "6", "12"},
                    EventLimit{"events.meeting_angle", EventKind::meeting, meeting, "150", "180"}),
    [](const auto& limit) { return std::string(limit.param.parameter).substr(7); });

}  // namespace eyrie

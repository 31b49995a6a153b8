#include "events/review/carry_over.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "events/driven_tracks.h"
#include "events/review/judging.h"

namespace eyrie::carry_over_test {
namespace {

using testing::Each;
using testing::IsEmpty;

StoredTracks runOf(const test::DrivenTracks& driven) {
    StoredTracks run;
    run.tracks = driven.tracks;
    run.footage = driven.footage();
    for (int frame = 0; frame < driven.frames; ++frame) run.shown_s.push_back(frame / driven.scale.frame_rate_hz);
    for (const EventTrack& track : driven.tracks) run.scores[track.id] = 0.95;
    return run;
}

std::map<int, Verdict> verdictsOn(const std::vector<Event>& events, const StoredTracks& run) {
    std::map<int, Verdict> verdicts;
    for (const Event& event : events) {
        Verdict verdict;
        verdict.id = static_cast<int>(verdicts.size()) + 1;
        verdict.subject = subjectOf(event, run);
        verdict.judgement = Judgement::relevant;
        verdicts[verdict.id] = verdict;
    }
    return verdicts;
}

/// Traffic under a camera that moves: vehicles that stop, drive fast, turn back, and a queue that crosses a line.
void drive(test::DrivenTracks& driven) {
    driven.camera = test::DrivenTracks::moving(0.2);
    driven.drive({40, 30}, 0, {{5, 40, 40}, {3, 40, 0}, {8, 0, 0}, {3, 0, 40}, {4, 40, 40}}, 50);
    driven.drive({45, 50}, 0, {{4, 30, 30}, {2, 30, 0}, {6, 0, 0}, {2, 0, 30}, {3, 30, 30}}, 200);
    driven.drive({150, 80}, 180, {{5, 40, 40}, {2, 40, 15}, {4, 15, 15, 45}, {2, 15, 40}, {3, 40, 40}}, 100);
    for (int i = 0; i < 4; ++i) driven.drive({30, 95}, 0, {{9, 50, 50}}, 300 + 35 * i);
    driven.drive({30, 65}, 0, {{6, 120, 120}}, 500);
}

/// What another run would make of the same traffic: other numbers, boxes a little beside and other ends of tracks.
test::DrivenTracks runAnew(const test::DrivenTracks& driven) {
    test::DrivenTracks anew = driven;
    std::reverse(anew.tracks.begin(), anew.tracks.end());
    cv::RNG random(99);
    TrackId id = 700;
    for (EventTrack& track : anew.tracks) {
        track.id = id++;
        const cv::Point2d beside(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0));
        for (TrackedBox& box : track.boxes) box.box.centre += beside + cv::Point2d(random.gaussian(0.2), 0);
        if (track.boxes.size() > 60) track.boxes.erase(track.boxes.begin(), track.boxes.begin() + 6);
    }
    return anew;
}

const std::vector<Zone>& gate() {
    static const std::vector<Zone> zones = [] {
        Zone line;
        line.name = "gate";
        line.shape = ZoneShape::line;
        // At x = 90 m on the ground, in the picture of frame 0.
        const cv::Matx33d camera = test::DrivenTracks::moving(0.2)(0);
        line.points = {HomographyJacobian(camera, {90, 85}).point(), HomographyJacobian(camera, {90, 105}).point()};
        return std::vector<Zone>{line};
    }();
    return zones;
}

TEST(CarryOver, InTheSameRunEveryEventKeepsItsVerdict) {
    test::DrivenTracks driven;
    drive(driven);
    const StoredTracks run = runOf(driven);
    const auto events = driven.events({}, gate());
    ASSERT_GE(events.size(), 20U);
    const auto carried = carryOver(verdictsOn(events, run), events, {}, run, gate());
    for (std::size_t i = 0; i < events.size(); ++i) EXPECT_EQ(carried.of_event[i], static_cast<int>(i) + 1) << i;
    EXPECT_THAT(carried.left, IsEmpty());
}

TEST(CarryOver, AVerdictOnWhoDrivesAgainstTheFlowStaysWithAndWithoutAnArrowThatSaysIt) {
    test::DrivenTracks driven;
    for (int i = 0; i < 8; ++i) driven.drive({-10, 62}, 0, {{40, 45, 45}}, 40 * i);
    driven.drive({210, 62}, 180, {{40, 45, 45}}, 300);
    const StoredTracks run = runOf(driven);
    const Zone arrow{"lane", ZoneShape::arrow, ZoneAnchor::ground, 0, {{5, 310}, {995, 310}}};
    const auto learned = driven.events(EventKind::against_flow);
    const auto drawn = driven.events(EventKind::against_flow, {}, {arrow});
    ASSERT_EQ(learned.size(), 1U);
    ASSERT_EQ(drawn.size(), 1U);
    ASSERT_EQ(drawn[0].zone, "lane");
    EXPECT_THAT(carryOver(verdictsOn(learned, run), drawn, {}, run, {arrow}).of_event, testing::ElementsAre(1));
    EXPECT_THAT(carryOver(verdictsOn(drawn, run), learned, {}, run, {}).of_event, testing::ElementsAre(1));
    const auto gone = carryOver(verdictsOn(drawn, run), {}, {}, run, {});
    ASSERT_EQ(gone.left.size(), 1U);
    EXPECT_EQ(gone.left[0].fault, CarryFault::no_event) << "searched all the same";
}

TEST(CarryOver, AnotherRunTakesVerdictsOverForTheSameVehicles) {
    test::DrivenTracks driven;
    drive(driven);
    const StoredTracks run = runOf(driven);
    const auto judged = driven.events({}, gate());
    const auto verdicts = verdictsOn(judged, run);
    const test::DrivenTracks anew = runAnew(driven);
    const StoredTracks other = runOf(anew);
    const auto events = anew.events({}, gate());
    const auto carried = carryOver(verdicts, events, {}, other, gate());
    const auto count = static_cast<TrackId>(driven.tracks.size());
    int crossings = 0;
    int taken = 0;
    for (std::size_t i = 0; i < events.size(); ++i) {
        if (carried.of_event[i] == 0) continue;
        ++taken;
        const Event& before = judged[static_cast<std::size_t>(carried.of_event[i] - 1)];
        EXPECT_EQ(events[i].kind, before.kind);
        // Numbers run backwards from 700: the same vehicle, though those of the queue pass the line 1.4 s apart.
        if (events[i].tracks.size() == 1) {
            EXPECT_EQ(count - (events[i].tracks[0] - 700), before.tracks[0]) << i;
        }
        crossings += events[i].kind == EventKind::crosses;
    }
    EXPECT_EQ(crossings, 4);
    EXPECT_GE(taken, static_cast<int>(judged.size()) - 2) << "borders may be judged another way";
    EXPECT_EQ(static_cast<std::size_t>(taken) + carried.left.size(), verdicts.size()) << "none is told twice or lost";
}

TEST(CarryOver, ATrackThatIsLostEarlierStillEndsWithItsVerdict) {
    test::DrivenTracks driven;
    driven.drive({40, 60}, 0, {{12, 50, 50}}, 50);
    driven.cutAfter(8);
    const StoredTracks run = runOf(driven);
    const auto lost = driven.events(EventKind::lost);
    ASSERT_EQ(lost.size(), 1U);
    for (const int frames : {-20, 20}) {
        test::DrivenTracks anew;
        anew.drive({40, 60}, 0, {{12, 50, 50}}, 50);
        anew.cutAfter(8 + frames / 25.0);
        const auto events = anew.events(EventKind::lost);
        ASSERT_EQ(events.size(), 1U);
        // 11 m apart: it is where the vehicle would have been that counts.
        EXPECT_GT(cv::norm(events[0].place - lost[0].place) * 0.2, 10);
        EXPECT_EQ(carryOver(verdictsOn(lost, run), events, {}, runOf(anew)).of_event[0], 1) << frames;
    }
}

TEST(CarryOver, WhatNoEventTakesUpIsListedWithTheReason) {
    test::DrivenTracks driven;
    drive(driven);
    const StoredTracks run = runOf(driven);
    const auto events = driven.events(EventKind::stops);
    ASSERT_EQ(events.size(), 2U);
    auto verdicts = verdictsOn(events, run);
    Verdict twin = verdicts.at(1);
    twin.id = 10;
    twin.subject.first_frame += 10;
    twin.subject.last_frame += 10;
    Verdict beside = verdicts.at(1);
    beside.id = 11;
    beside.subject.place.y += 60;  // 12 m
    Verdict later = verdicts.at(1);
    later.id = 12;
    later.subject.first_frame = later.subject.last_frame = later.subject.frame = later.subject.frame + 60;
    Verdict beyond = later;
    beyond.id = 13;
    beyond.subject.first_frame = beyond.subject.last_frame = beyond.subject.frame = 5000;
    Verdict zone = verdicts.at(1);
    zone.id = 14;
    zone.subject.kind = EventKind::enters;
    zone.subject.zone = "yard";
    for (const Verdict& verdict : {twin, beside, later, beyond, zone}) verdicts[verdict.id] = verdict;
    const auto carried = carryOver(verdicts, events, {}, run);
    EXPECT_THAT(carried.of_event, testing::ElementsAre(1, 2));
    std::map<int, CarryFault> faults;
    for (const LeftVerdict& left : carried.left) faults[left.verdict] = left.fault;
    EXPECT_EQ(faults, (std::map<int, CarryFault>{{10, CarryFault::taken},
                                                 {11, CarryFault::no_event},
                                                 {12, CarryFault::no_event},
                                                 {13, CarryFault::not_searched},
                                                 {14, CarryFault::not_searched}}));
    ReviewOptions wide;
    wide.carry_time_s = 10;
    EXPECT_EQ(carryOver({{12, verdicts.at(12)}}, events, {}, run, {}, wide).of_event[0], 12) << "limits are options";
}

TEST(CarryOver, AcrossFramesThatWereNotRegisteredThePictureCounts) {
    test::DrivenTracks driven;
    driven.drive({40, 60}, 0, {{4, 40, 40}, {3, 40, 0}, {8, 0, 0}}, 20);
    StoredTracks run = runOf(driven);
    const auto events = driven.events(EventKind::stops);
    ASSERT_EQ(events.size(), 1U);
    auto verdicts = verdictsOn(events, run);
    verdicts.at(1).subject.frame += 30;
    verdicts.at(1).subject.last_frame += 30;
    run.footage.camera = CameraMotion();
    run.tracks.clear();  // nothing but places is left to compare
    EXPECT_EQ(carryOver(verdicts, events, {}, run).of_event[0], 1);
    verdicts.at(1).subject.place.x += 40;
    EXPECT_EQ(carryOver(verdicts, events, {}, run).of_event[0], 0);
}

TEST(CarryOver, ReachesAsFarAsItsLimitsOnTheGroundAndInThePicture) {
    test::DrivenTracks driven;
    driven.noise_px = 0;
    driven.drive({40, 60}, 0, {{4, 40, 40}, {3, 40, 0}, {8, 0, 0}}, 20);
    StoredTracks run = runOf(driven);
    const auto events = driven.events(EventKind::stops);
    ASSERT_EQ(events.size(), 1U);
    auto verdicts = verdictsOn(events, run);
    const auto carried = [&](const char* name, const char* value) {
        ReviewOptions options;
        setParameter(describeOf(options), name, value);
        return carryOver(verdicts, events, {}, run, {}, options).of_event[0];
    };
    verdicts.at(1).subject.place.y += 40;  // 8 m
    EXPECT_EQ(carried("review.carry_distance", "5"), 0);
    EXPECT_EQ(carried("review.carry_distance", "7.9"), 0);
    EXPECT_EQ(carried("review.carry_distance", "8.1"), 1);
    EXPECT_EQ(carried("review.carry_picture", "50"), 0) << "the frames are connected";
    run.tracks.clear();
    run.footage.camera = CameraMotion();
    verdicts.at(1).subject.frame += 30;
    verdicts.at(1).subject.last_frame += 30;
    EXPECT_EQ(carried("review.carry_picture", "30"), 0);
    EXPECT_EQ(carried("review.carry_picture", "39.9"), 0);
    EXPECT_EQ(carried("review.carry_picture", "40.1"), 1);
    EXPECT_EQ(carried("review.carry_distance", "50"), 0) << "nothing tells of the ground between them";
}

TEST(CarryOver, OfTwoThatAreNearInThePictureTheNearerTakesIt) {
    test::DrivenTracks driven;
    StoredTracks run = runOf(driven);
    run.footage.camera = CameraMotion();
    std::vector<Event> events(2);
    for (std::size_t i = 0; i < 2; ++i) {
        events[i].kind = EventKind::stops;
        events[i].first_frame = events[i].frame = 130;
        events[i].last_frame = 150;
    }
    auto verdicts = verdictsOn({events[0]}, run);
    verdicts.at(1).subject.frame = 128;
    verdicts.at(1).subject.place = {300, 300};
    for (const bool first : {true, false}) {
        events[0].place = {first ? 304.0 : 312.0, 300};
        events[1].place = {first ? 312.0 : 304.0, 300};
        EXPECT_THAT(carryOver(verdicts, events, {}, run).of_event, testing::ElementsAre(first ? 1 : 0, first ? 0 : 1));
    }
}

TEST(CarryOver, WhatEndedBeforeDoesNotHideWhatBeginsLater) {
    // One event lasts all the time, elsewhere; one ended long before the verdict's, at the same place.
    test::DrivenTracks driven;
    const StoredTracks run = runOf(driven);
    std::vector<Event> events(3);
    const FrameSpan spans[] = {{0, 900}, {100, 110}, {500, 520}};
    for (std::size_t i = 0; i < 3; ++i) {
        events[i].kind = EventKind::stops;
        events[i].first_frame = events[i].frame = spans[i].first;
        events[i].last_frame = spans[i].last;
        events[i].place = i == 0 ? cv::Point2d(900, 100) : cv::Point2d(200, 300);
    }
    const auto verdicts = verdictsOn({events[2]}, run);
    EXPECT_THAT(carryOver(verdicts, events, {}, run).of_event, testing::ElementsAre(0, 0, 1));
}

TEST(CarryOver, StretchesThatCouldNotBeSearchedKeepTheirVerdicts) {
    test::DrivenTracks driven;
    StoredTracks run = runOf(driven);
    const std::vector<FrameSpan> stretches = {{100, 120}, {400, 410}};
    std::map<int, Verdict> verdicts;
    for (const auto& stretch : {FrameSpan{402, 415}, FrameSpan{700, 720}}) {
        Verdict verdict;
        verdict.id = static_cast<int>(verdicts.size()) + 1;
        verdict.subject = subjectOf(stretch, run);
        verdict.judgement = Judgement::not_relevant;
        verdicts[verdict.id] = verdict;
    }
    const auto carried = carryOver(verdicts, {}, stretches, run);
    EXPECT_THAT(carried.of_stretch, testing::ElementsAre(0, 1));
    ASSERT_EQ(carried.left.size(), 1U);
    EXPECT_EQ(carried.left[0].verdict, 2);
}

TEST(CarryOver, TenThousandEventsTakeNoTime) {
    test::DrivenTracks driven;
    driven.frames = 20000;
    driven.drive({40, 60}, 0, {{4, 40, 40}}, 20);
    const StoredTracks run = runOf(driven);
    std::vector<Event> events(10000);
    for (int i = 0; i < 10000; ++i) {
        Event& event = events[static_cast<std::size_t>(i)];
        event.first_frame = event.last_frame = event.frame = 2 * i;
        event.place = {100.0 + i % 50, 100};
        event.tracks = {5000 + i};
    }
    const auto verdicts = verdictsOn(events, run);
    const auto begun = std::chrono::steady_clock::now();
    const auto carried = carryOver(verdicts, events, {}, run);
    EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(3));
    EXPECT_THAT(carried.left, IsEmpty());
}

}  // namespace
}  // namespace eyrie::carry_over_test

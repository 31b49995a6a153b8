/// Which verdict goes where, and what is unsure, on both sides of every limit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "events/review/carry_over.h"
#include "events/review/review_queue.h"

namespace eyrie::review_by_hand_test {
namespace {

using testing::ElementsAre;

/// Frames 0 … 999 of a standing camera at 25 Hz, without tracks.
StoredTracks emptyRun() {
    StoredTracks run;
    run.footage.camera = CameraMotion::standing(0, 999);
    run.footage.image_size = {1000, 600};
    run.footage.last_frame = 999;
    run.footage.scale = {0.2, 25, true};
    return run;
}

Event lasting(FrameIndex first, FrameIndex last, EventKind kind = EventKind::stands) {
    Event event;
    event.kind = kind;
    event.tracks = {5000};  // none of the run
    event.first_frame = event.frame = first;
    event.last_frame = last;
    event.place = {300, 200};
    return event;
}

Verdict verdictOn(const Event& event) {
    Verdict verdict;
    verdict.id = 1;
    verdict.subject = subjectOf(event, emptyRun());
    verdict.judgement = Judgement::relevant;
    return verdict;
}

std::vector<int> carried(const Event& judged, const std::vector<Event>& events) {
    return carryOver({{1, verdictOn(judged)}}, events, {}, emptyRun()).of_event;
}

CarryFault faultIn(FrameIndex frame, const std::vector<FrameSpan>& unsearched) {
    return carryOver({{1, verdictOn(lasting(frame, frame))}}, {}, unsearched, emptyRun()).left.at(0).fault;
}

std::vector<FrameSpan> unsearchedWithout(std::vector<FrameIndex> broken) {
    std::vector<Homography> steps;
    for (int frame = 0; frame < 999; ++frame) {
        if (std::find(broken.begin(), broken.end(), frame + 1) == broken.end())
            steps.push_back({cv::Matx33d::eye(), frame, frame + 1});
    }
    Footage footage = emptyRun().footage;
    footage.camera = CameraMotion(steps);
    return unsearchedStretches(footage);
}

}  // namespace

TEST(ReviewByHand, OfEventsAtTheSameTimeThatWithTheNearerBeginningIsMeant) {
    EXPECT_THAT(carried(lasting(100, 200), {lasting(90, 200), lasting(100, 200)}), ElementsAre(0, 1));
    EXPECT_THAT(carried(lasting(100, 200), {lasting(95, 200), lasting(110, 200)}), ElementsAre(1, 0));
    EXPECT_THAT(carried(lasting(100, 200), {lasting(110, 200), lasting(95, 200)}), ElementsAre(0, 1));
}

TEST(ReviewByHand, TwoSecondsMayLieBetweenAVerdictAndItsEvent) {
    const Event judged = lasting(100, 100);
    EXPECT_THAT(carried(judged, {lasting(150, 160)}), ElementsAre(1));
    EXPECT_THAT(carried(judged, {lasting(151, 160)}), ElementsAre(0));
    EXPECT_THAT(carried(judged, {lasting(20, 50)}), ElementsAre(1));
    EXPECT_THAT(carried(judged, {lasting(20, 49)}), ElementsAre(0));
    EXPECT_THAT(carried(judged, {lasting(20, 180)}), ElementsAre(1)) << "nothing lies between";
    EXPECT_THAT(carried(judged, {lasting(100, 100, EventKind::stops)}), ElementsAre(0)) << "of another kind";
}

TEST(ReviewByHand, OneThatLastsLongHidesNoneThatCameBefore) {
    // Ascending beginnings, the first of which ends last.
    EXPECT_THAT(carried(lasting(500, 500), {lasting(10, 480), lasting(20, 30), lasting(40, 50)}), ElementsAre(1, 0, 0));
}

TEST(ReviewByHand, AVehicleIsWhereItsLastSecondLeadsFromItsTracksEnds) {
    // Stands at x = 250 px up to frame 75, then drives 2 px a frame up to frame 100.
    StoredTracks run = emptyRun();
    EventTrack track{5000, {}};
    for (FrameIndex frame = 40; frame <= 100; ++frame)
        track.boxes.push_back({frame, {{250.0 + 2 * std::max(0, frame - 75), 200}, 22, 9, 0}});
    run.tracks.push_back(track);
    Event event = lasting(10, 170);
    event.place = {900, 500};  // of no help
    const auto isMeantAt = [&](FrameIndex frame, double x) {
        Verdict verdict = verdictOn(event);
        verdict.subject.frame = frame;
        verdict.subject.place = {x, 200};
        return carryOver({{1, verdict}}, {event}, {}, run).of_event[0] == 1;
    };
    // Seen there: 5 m are 25 px.
    EXPECT_TRUE(isMeantAt(90, 280 + 24.9));
    EXPECT_FALSE(isMeantAt(90, 280 + 25.1));
    EXPECT_FALSE(isMeantAt(90, 280 - 25.1));
    // Twenty frames later it would be at 340.
    EXPECT_TRUE(isMeantAt(120, 340 + 24.9));
    EXPECT_FALSE(isMeantAt(120, 340 + 25.1));
    EXPECT_TRUE(isMeantAt(120, 340 - 24.9));
    EXPECT_FALSE(isMeantAt(120, 340 - 25.1));
    EXPECT_TRUE(isMeantAt(150, 400)) << "two seconds later";
    EXPECT_FALSE(isMeantAt(151, 402)) << "that is too long to know";
    // Before it began it stood, as in its first second.
    EXPECT_TRUE(isMeantAt(20, 250 + 24.9));
    EXPECT_FALSE(isMeantAt(20, 250 + 25.1));
}

TEST(ReviewByHand, FramesOfAStretchWereNotSearchedFromItsFirstToItsLast) {
    const std::vector<FrameSpan> stretches = {{50, 60}, {80, 80}};
    for (const FrameIndex frame : {50, 55, 60, 80, 1000, 5000})
        EXPECT_EQ(faultIn(frame, stretches), CarryFault::not_searched) << frame;
    for (const FrameIndex frame : {0, 49, 61, 79, 81, 999})
        EXPECT_EQ(faultIn(frame, stretches), CarryFault::no_event) << frame;
}

TEST(ReviewByHand, StretchesLessThanASecondApartAreOne) {
    EXPECT_EQ(unsearchedWithout({51, 76}), (std::vector<FrameSpan>{{51, 76}})) << "24 frames between";
    EXPECT_EQ(unsearchedWithout({51, 77}), (std::vector<FrameSpan>{{51, 51}, {77, 77}})) << "25, a second";
}

TEST(ReviewByHand, ARareKindHasAsManyEventsAsThatAndAnUnsureTrackLess) {
    const std::vector<Event> events = {lasting(1, 2), lasting(3, 4)};
    const auto groupWith = [&](int rare) {
        ReviewOptions options;
        options.rare = rare;
        return reviewQueue(events, {}, {false, false}, options).at(0).group;
    };
    EXPECT_EQ(groupWith(2), QueueGroup::rare);
    EXPECT_EQ(groupWith(1), QueueGroup::rest);
    StoredTracks run = emptyRun();
    CarriedVerdicts none;
    none.of_event = {0, 0};
    ReviewOptions options;
    options.unsure_score = 0.9;
    run.scores[5000] = 0.9;
    EXPECT_THAT(unsureEvents(events, run, none, {}, options), ElementsAre(false, false)) << "as sure as it must be";
    run.scores[5000] = 0.89;
    EXPECT_THAT(unsureEvents(events, run, none, {}, options), ElementsAre(true, true));
}

TEST(ReviewByHand, FramesAreShownAtTheirTimesAndOthersByTheRate) {
    StoredTracks run = emptyRun();
    run.footage.first_frame = 10;
    run.shown_s = {0.41, 0.52};
    EXPECT_DOUBLE_EQ(run.secondsOf(10), 0.41);
    EXPECT_DOUBLE_EQ(run.secondsOf(11), 0.52);
    EXPECT_DOUBLE_EQ(run.secondsOf(12), 0.48);
    EXPECT_DOUBLE_EQ(run.secondsOf(9), 0.36);
}

}  // namespace eyrie::review_by_hand_test

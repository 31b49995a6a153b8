#include "events/review/review_queue.h"

#include <gmock/gmock.h>

#include "events/driven_tracks.h"
#include "events/review/judging.h"

namespace eyrie::review_queue_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Event eventOf(EventKind kind, FrameIndex frame, TrackId id = 1) {
    Event event;
    event.kind = kind;
    event.tracks = {id};
    event.first_frame = event.last_frame = event.frame = frame;
    return event;
}

TEST(ReviewQueue, WhatCouldBeMissedComesFirst) {
    std::vector<Event> events;
    for (int i = 0; i < 8; ++i) events.push_back(eventOf(EventKind::appears, 10 * i));  // 0 … 7
    events.push_back(eventOf(EventKind::turns_back, 300));                              // 8
    events.push_back(eventOf(EventKind::stops, 20));                                    // 9
    events.push_back(eventOf(EventKind::stops, 15));                                    // 10
    events.push_back(eventOf(EventKind::lost, 90));                                     // 11
    events.push_back(eventOf(EventKind::lost, 40));                                     // 12
    std::vector<bool> unsure(events.size(), false);
    unsure[5] = unsure[8] = unsure[11] = true;
    const auto queue = reviewQueue(events, {{500, 510}, {60, 70}}, unsure);
    using Group = QueueGroup;
    const std::vector<QueueItem> expected = {
        {Group::not_searched, false, 1}, {Group::not_searched, false, 0}, {Group::lost, true, 12},
        {Group::lost, true, 11},         {Group::rare, true, 8},          {Group::rare, true, 10},
        {Group::rare, true, 9},          {Group::unsure, true, 5},        {Group::rest, true, 0},
        {Group::rest, true, 1},          {Group::rest, true, 2},          {Group::rest, true, 3},
        {Group::rest, true, 4},          {Group::rest, true, 6},          {Group::rest, true, 7}};
    EXPECT_EQ(queue, expected);
    ReviewOptions none;
    none.rare = 0;
    EXPECT_EQ(reviewQueue(events, {}, unsure, none)[2].group, QueueGroup::unsure);
    EXPECT_THAT(reviewQueue({}, {}, {}), IsEmpty());
}

TEST(ReviewQueue, UnsureIsWhatAPersonOrTheTrackSays) {
    const std::vector<Event> events = {eventOf(EventKind::stops, 1, 1), eventOf(EventKind::stops, 2, 2),
                                       eventOf(EventKind::stops, 3, 3)};
    StoredTracks run;
    run.scores = {{1, 0.99}, {2, 0.6}, {3, 0.99}};
    CarriedVerdicts carried;
    carried.of_event = {0, 0, 4};
    Verdict verdict;
    verdict.id = 4;
    verdict.judgement = Judgement::unsure;
    EXPECT_THAT(unsureEvents(events, run, carried, {{4, verdict}}), ElementsAre(false, true, true));
    verdict.judgement = Judgement::relevant;
    EXPECT_THAT(unsureEvents(events, run, carried, {{4, verdict}}), ElementsAre(false, true, false));
}

TEST(ReviewQueue, UnsureAreScoresBelowTheGivenOne) {
    const std::vector<Event> events = {eventOf(EventKind::stops, 1, 1), eventOf(EventKind::stops, 2, 2),
                                       eventOf(EventKind::stops, 3, 3)};
    StoredTracks run;
    run.scores = {{1, 0.95}, {2, 0.85}};  // nobody knows that of the third
    CarriedVerdicts carried;
    carried.of_event = {0, 0, 0};
    const auto unsure = [&](const char* value) {
        ReviewOptions options;
        setParameter(describeOf(options), "review.unsure_score", value);
        return unsureEvents(events, run, carried, {}, options);
    };
    EXPECT_THAT(unsure("0.8"), ElementsAre(false, false, false));
    EXPECT_THAT(unsure("0.9"), ElementsAre(false, true, false));
    EXPECT_THAT(unsure("1"), ElementsAre(true, true, false));
}

TEST(UnsearchedStretches, AreFramesThatNothingConnects) {
    Footage footage;
    footage.first_frame = 10;
    footage.last_frame = 400;
    footage.scale.frame_rate_hz = 25;
    std::vector<Homography> steps;
    for (int frame = 10; frame < 400; ++frame) {
        const bool failed =
            frame == 50 || (frame >= 99 && frame < 105) || (frame >= 120 && frame < 125) || frame == 399;
        if (!failed) steps.push_back({cv::Matx33d::eye(), frame, frame + 1});
    }
    footage.camera = CameraMotion(steps);
    EXPECT_EQ(unsearchedStretches(footage), (std::vector<FrameSpan>{{51, 51}, {100, 125}, {400, 400}}));
    ReviewOptions apart;
    apart.join_unsearched_s = 0;
    EXPECT_EQ(unsearchedStretches(footage, apart),
              (std::vector<FrameSpan>{{51, 51}, {100, 105}, {121, 125}, {400, 400}}));
    EXPECT_THAT(unsearchedStretches(Footage{}), IsEmpty());
}

// --- judging ----------------------------------------------------------------------------------------------------

class Judging : public testing::Test {
 protected:
    Judged thing(FrameIndex frame) const {
        StoredTracks run;
        return {subjectOf(eventOf(EventKind::stops, frame), run), std::nullopt};
    }
    Judge ada{"Ada", "2026-11-21T08:00:00Z"};
    int next = 1;
    NewId id = [this] { return next++; };
};

TEST_F(Judging, OneStepForAsManyAsAreChosen) {
    const ReviewEdit edit = judgeAs(Judgement::not_relevant, {thing(1), thing(2), thing(3)}, ada, id);
    EXPECT_EQ(edit.name, "Judge 3 events not relevant");
    ASSERT_EQ(edit.verdicts.size(), 3U);
    EXPECT_FALSE(edit.verdicts[2].before.has_value());
    EXPECT_EQ(edit.verdicts[2].after->id, 3);
    EXPECT_EQ(edit.verdicts[2].after->subject.frame, 3);
    EXPECT_EQ(edit.verdicts[2].after->person, "Ada");
    EXPECT_EQ(judgeAs(Judgement::relevant, {thing(1)}, ada, id).name, "Judge \"stops\" relevant");
    ReviewSet set;
    applyEdit(set, edit);
    EXPECT_EQ(set.verdicts.size(), 3U);
    applyEdit(set, inverseOf(edit));
    EXPECT_TRUE(set.verdicts.empty());
}

TEST_F(Judging, WhatDoesNotChangeIsLeftOutAndWhatSaysNothingGoes) {
    Judged judged = thing(1);
    judged.before = judgeAs(Judgement::relevant, {judged}, ada, id).verdicts[0].after;
    const Judge bo{"Bo", "2026-11-22T08:00:00Z"};
    EXPECT_TRUE(judgeAs(Judgement::relevant, {judged}, bo, id).empty()) << "she keeps it";
    EXPECT_TRUE(judgeAs(Judgement::open, {thing(2)}, bo, id).empty());
    const ReviewEdit taken_back = judgeAs(Judgement::open, {judged}, bo, id);
    ASSERT_EQ(taken_back.verdicts.size(), 1U);
    EXPECT_FALSE(taken_back.verdicts[0].after.has_value());
    const ReviewEdit noted = changeVerdicts(
        {judged}, [](Verdict& v) { v.note = "no lights"; }, "Note", bo, id);
    EXPECT_EQ(noted.verdicts[0].after->judgement, Judgement::relevant);
    EXPECT_EQ(noted.verdicts[0].after->person, "Bo");
    EXPECT_EQ(noted.verdicts[0].after->id, judged.before->id);
    judged.before = noted.verdicts[0].after;
    EXPECT_EQ(judgeAs(Judgement::open, {judged}, bo, id).verdicts[0].after->note, "no lights");
    judged.subject.frame = judged.subject.last_frame = 5;
    EXPECT_EQ(judgeAs(Judgement::relevant, {judged}, bo, id).verdicts[0].after->subject.frame, 5)
        << "judged again in another run it moves there";
}

TEST_F(Judging, BookmarksAreAddedChangedAndRemoved) {
    const Bookmark bookmark{1, 40, 1.6, std::nullopt, "look", "Ada", ""};
    EXPECT_EQ(changeBookmark(std::nullopt, bookmark).name, "Add bookmark");
    EXPECT_EQ(changeBookmark(bookmark, std::nullopt).name, "Remove bookmark");
    EXPECT_TRUE(changeBookmark(bookmark, bookmark).empty());
}

}  // namespace
}  // namespace eyrie::review_queue_test

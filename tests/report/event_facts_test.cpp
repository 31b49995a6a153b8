#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/driven_events.h"

/// What the table of an event says, by the text of the report.
namespace eyrie::event_facts_test {
namespace {

using test::driver;
using test::eventOf;
using test::inputOf;
using testing::HasSubstr;
using testing::Not;

/// 90 km/h up to frame 50, then half of it; speeds are measured over five frames.
ReviewReportInput slowingDown() {
    EventTrack track = driver(7, {100, 200}, {2, 0});
    for (TrackedBox& box : track.boxes)
        if (box.frame > 50) box.box.centre.x = 200 + (box.frame - 50);
    ReviewReportInput input = inputOf({track, driver(8, {100, 300}, {4, 0})});
    input.choice.options.smooth_s = 0.1;
    return input;
}

std::string told(ReviewReportInput input, const Event& event) {
    input.reviewed.events = {event};
    input.reviewed.carried.of_event.resize(1);
    input.reviewed.carried.of_stretch.resize(input.reviewed.unsearched.size());
    return makeReviewReport(input, nullptr).html;
}

std::string row(const std::string& name, const std::string& value) {
    return "<td><b>" + name + "</b></td><td>" + value + "</td>";
}

std::string speedRow(const std::string& value) {
    return row("Speed", value + " km/h");
}

}  // namespace

TEST(EventSpeeds, AreTheLowestAndTheHighestWhileItLasts) {
    const ReviewReportInput input = slowingDown();
    const auto between = [&](FrameIndex first, FrameIndex last) {
        return told(input, eventOf({7}, first, last, first, {0, 0}));
    };
    EXPECT_THAT(between(10, 90), HasSubstr(speedRow("45 to 90")));
    EXPECT_THAT(between(10, 48), HasSubstr(speedRow("90"))) << "one figure where both are the same";
    EXPECT_THAT(between(52, 90), HasSubstr(speedRow("45")));
    EXPECT_THAT(between(10, 52), HasSubstr(speedRow("45 to 90")));
    EXPECT_THAT(between(48, 90), HasSubstr(speedRow("45 to 90")));
}

TEST(EventSpeeds, OfAMomentAreThoseOfTheSecondAboutIt) {
    // Twelve frames before and after it.
    const ReviewReportInput input = slowingDown();
    const auto at = [&](FrameIndex frame) { return told(input, eventOf({7}, frame, frame, frame, {0, 0})); };
    EXPECT_THAT(at(36), HasSubstr(speedRow("90")));
    EXPECT_THAT(at(40), HasSubstr(speedRow("45 to 90")));
    EXPECT_THAT(at(60), HasSubstr(speedRow("45 to 90")));
    EXPECT_THAT(at(64), HasSubstr(speedRow("45")));
}

TEST(EventSpeeds, AreThoseOfTheFirstVehicle) {
    EXPECT_THAT(told(slowingDown(), eventOf({8, 7}, 10, 40, 20, {0, 0})), HasSubstr(speedRow("180")));
    EXPECT_THAT(told(slowingDown(), eventOf({7, 8}, 10, 40, 20, {0, 0})), HasSubstr(speedRow("90")));
}

TEST(EventSpeeds, AreToldOnlyWhereTheyAreKnown) {
    const Event event = eventOf({7}, 10, 20, 15, {0, 0});
    const auto silent = Not(HasSubstr("<b>Speed</b>"));
    EXPECT_THAT(told(inputOf({driver(7, {100, 200}, {2, 0})}), event), HasSubstr(speedRow("90")));
    EXPECT_THAT(told(inputOf({driver(7, {100, 200}, {2, 0})}, 25, false), event), silent) << "no scale";
    EXPECT_THAT(told(inputOf({driver(7, {100, 200}, {2, 0}, 15, 14)}), event), silent) << "seen too shortly";
    EXPECT_THAT(told(inputOf({driver(7, {100, 200}, {2, 0}, 90, 40)}), event), silent) << "not seen meanwhile";
    EXPECT_THAT(told(inputOf({driver(7, {100, 200}, {2, 0})}), eventOf({}, 10, 20, 15, {0, 0})), silent);
}

TEST(EventFacts, SayWhenAndWhereItWasAndOfWhichTracks) {
    Event event = eventOf({3, 12}, 50, 60, 55, {210.4, 199.6});
    event.kind = EventKind::crosses;
    event.zone = "gate <3>";
    event.sense = CrossingSense::to_left;
    event.figure = 43;
    event.unit = FigureUnit::km_per_hour;
    ReviewReportInput input = inputOf({driver(3, {100, 200}, {2, 0}), driver(12, {100, 300}, {2, 0})});
    const std::string html = told(input, event);
    EXPECT_THAT(html, HasSubstr("<h3>1. " + std::string(nameOf(EventKind::crosses)) + ": gate &lt;3&gt;, 0:02.0</h3>"));
    EXPECT_THAT(html, HasSubstr(row("From", "0:02.0")));
    EXPECT_THAT(html, HasSubstr(row("To", "0:02.4")));
    EXPECT_THAT(html, HasSubstr(row("Frames", "50–60")));
    EXPECT_THAT(html, HasSubstr(row("Tracks", "3, 12")));
    EXPECT_THAT(html, HasSubstr(row(figureNameOf(EventKind::crosses), "43 km/h")));
    EXPECT_THAT(html, HasSubstr(row("Place", "x 210, y 200 px in frame 55; gate &lt;3&gt; to the left")));
    EXPECT_THAT(html, HasSubstr(row("Verdict", "not judged")));
    EXPECT_THAT(html, Not(HasSubstr("<b>Score</b>")));

    event = eventOf({3}, 50, 50, 50, {200, 200});
    input.reviewed.tracks.scores = {{3, 0.876}, {12, 0.1}};
    input.clock = VideoClock::startingAt(1'231'798'102'000'000);
    const std::string moment = told(input, event);
    EXPECT_THAT(moment, HasSubstr(row("From", "0:02.0, 2009-01-12T22:08:24.000Z")));
    EXPECT_THAT(moment, Not(HasSubstr("<b>To</b>")));
    EXPECT_THAT(moment, HasSubstr(row("Frames", "50")));
    EXPECT_THAT(moment, HasSubstr(row("Track", "3")));
    EXPECT_THAT(moment, HasSubstr(row("Score", "0.88")));
    EXPECT_THAT(moment, HasSubstr(row("Place", "x 200, y 200 px in frame 50"))) << "neither zone nor sense";
}

TEST(EventFacts, HaveThePlaceOnEarthWhereItIsKnown) {
    // (200, 200) lies 100 m east and 100 m south of 48° N, 11° E: a degree is 111,200 m and 74,600 m there.
    ReviewReportInput input = inputOf({driver(3, {100, 200}, {2, 0})});
    input.places = test::placesAlong({1, 0}, {0, -1});
    EXPECT_THAT(told(input, eventOf({3}, 50, 50, 50, {200, 200})),
                HasSubstr("x 200, y 200 px in frame 50; 47.999101, 11.001340"));
}

TEST(EventFacts, SayWhoJudgedIt) {
    ReviewReportInput input = inputOf({driver(3, {100, 200}, {2, 0})});
    Verdict verdict;
    verdict.id = 4;
    verdict.judgement = Judgement::relevant;
    verdict.starred = true;
    verdict.tags = {"gate 3", "lorry"};
    verdict.person = "Ada";
    verdict.when_utc = "2026-11-21T08:00:00Z";
    input.reviewed.review.verdicts[4] = verdict;
    input.reviewed.carried.of_event = {4};
    const Event event = eventOf({3}, 50, 50, 50, {200, 200});
    const std::string html = told(input, event);
    EXPECT_THAT(html, HasSubstr(row("Verdict", "relevant ★")));
    EXPECT_THAT(html, HasSubstr(row("Judged by", "Ada, 2026-11-21T08:00:00Z")));
    EXPECT_THAT(html, HasSubstr(row("Tags", "gate 3, lorry")));
    EXPECT_THAT(html, Not(HasSubstr("<b>Note</b>")));
    EXPECT_THAT(html, HasSubstr("1 found in 1 tracks, 1 judged by a person"));
    input.reviewed.review.verdicts[4].starred = false;
    input.reviewed.review.verdicts[4].person.clear();
    const std::string nobody = told(input, event);
    EXPECT_THAT(nobody, HasSubstr(row("Verdict", "relevant")));
    EXPECT_THAT(nobody, HasSubstr(row("Judged by", "a person without a name")));
    input.reviewed.review.verdicts[4].judgement = Judgement::open;
    EXPECT_THAT(told(input, event), HasSubstr("1 found in 1 tracks, 0 judged by a person"));
}

TEST(ReviewedVideo, ShareOfWhatWasNotSearchedAndOfWhatWasSeen) {
    // 101 frames of 25 Hz.
    ReviewReportInput input = inputOf({driver(3, {100, 200}, {2, 0})});
    EXPECT_THAT(told(input, {}), HasSubstr(row("Searched", "all of it")));
    EXPECT_THAT(told(input, {}), HasSubstr(row("Seen", "nothing: nobody watched it in the window")));
    input.reviewed.unsearched = {{10, 14}, {80, 82}};
    input.reviewed.tracks.unregistered = 2;
    input.seen = {{"Ada", {{0, 50}}}, {"", {{0, 5}}}};
    const std::string html = told(input, {});
    EXPECT_THAT(html, HasSubstr("not 0:00.3 s (7.9 %) in 2 stretches, listed below; 2 frames could not be registered"));
    EXPECT_THAT(html, HasSubstr(row("Seen",
                                    "50 % (somebody without a name 5.9 %, Ada 50 %), at four times the speed "
                                    "at most")));
    EXPECT_THAT(html, HasSubstr("<td>0:00.4</td><td>0:00.6</td><td>10–14</td><td>not judged</td>"));
    EXPECT_THAT(html, HasSubstr("<td>0:03.2</td><td>0:03.3</td><td>80–82</td><td>not judged</td>"));
}

TEST(SpeedSketch, TwoSamplesAreACurveAndOneIsNone) {
    // Of a picture a second ten seconds before and after an event hold what is left of a way.
    const ReviewReportInput input = inputOf({driver(7, {100, 200}, {2, 0}, 60)}, 1);
    const auto sketch = [&](FrameIndex frame) {
        return speedSketch(ReviewScene(input), eventOf({7}, frame, frame, frame, {0, 0}));
    };
    EXPECT_THAT(sketch(69), HasSubstr("points=\"58,34.3 468,34.3 \"/>"));
    EXPECT_EQ(sketch(70), "");
    EXPECT_EQ(sketch(71), "");
}

}  // namespace eyrie::event_facts_test

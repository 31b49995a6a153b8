#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/driven_events.h"
#include "report/report_file.h"

/// The tables of a review's report about what is beside its events, row by row.
namespace eyrie::review_remainder_test {
namespace {

using test::driver;
using test::eventOf;
using test::inputOf;
using testing::HasSubstr;
using testing::Not;

std::string told(ReviewReportInput input, const std::vector<Event>& events = {}) {
    input.reviewed.events = events;
    input.reviewed.carried.of_event.resize(events.size());
    input.reviewed.carried.of_stretch.resize(input.reviewed.unsearched.size());
    return makeReviewReport(input, nullptr).html;
}

std::string row(const std::vector<std::string>& fields) {
    std::string text = "<tr>";
    for (const std::string& field : fields) text += "<td>" + field + "</td>";
    return text + "</tr>";
}

std::string fact(const std::string& name, const std::string& value) {
    return row({"<b>" + name + "</b>", value});
}

ReviewReportInput oneCar() {
    return inputOf({driver(3, {100, 200}, {2, 0})});
}

}  // namespace

TEST(ReviewRemainder, BookmarksAreListedWithWhoSetThem) {
    ReviewReportInput input = oneCar();
    EXPECT_THAT(told(input), Not(HasSubstr("Bookmarks")));
    input.reviewed.review.bookmarks[2] = {2, 50, 2, {}, "a <gate>", "Ada", "2026-11-21T08:00:00Z"};
    input.reviewed.review.bookmarks[5] = {5, 75, 3, {}, "", "", ""};
    input.reviewed.review.bookmarks[6] = {6, 76, 3.04, {}, "", "Bob", ""};
    const std::string html = told(input);
    EXPECT_THAT(html, HasSubstr("Bookmarks, set by a person"));
    EXPECT_THAT(html, HasSubstr(row({"0:02.0", "50", "a &lt;gate&gt;", "Ada, 2026-11-21T08:00:00Z"})));
    EXPECT_THAT(html, HasSubstr(row({"0:03.0", "75", "", ""})));
    EXPECT_THAT(html, HasSubstr(row({"0:03.0", "76", "", "Bob"})));
}

TEST(ReviewRemainder, CorrectionsAreListedWithWhatBecameOfThem) {
    ReviewReportInput input = oneCar();
    EXPECT_THAT(told(input), HasSubstr(fact("Tracks", "as the machine found them")));
    EXPECT_THAT(told(input), Not(HasSubstr("Tracks corrected by a person")));
    TrackCorrection split;
    split.id = 4;
    split.kind = CorrectionKind::split;
    split.frame = 33;
    split.person = "Ada";
    split.when_utc = "2026-11-21T08:00:00Z";
    input.reviewed.review.corrections[4] = split;
    split.id = 5;
    split.kind = CorrectionKind::reject;
    split.when_utc.clear();
    input.reviewed.review.corrections[5] = split;
    CorrectedTracks& corrections = input.reviewed.tracks.corrections;
    corrections.states = {{4, CorrectionState::applied}, {5, CorrectionState::no_track}};
    corrections.applied = {{CorrectionKind::split, 1}};
    const std::string html = told(input);
    EXPECT_THAT(html, HasSubstr("Tracks corrected by a person"));
    EXPECT_THAT(html, HasSubstr(row({nameOf(CorrectionKind::split), "33", "Ada, 2026-11-21T08:00:00Z",
                                     nameOf(CorrectionState::applied)})));
    EXPECT_THAT(html, HasSubstr(row({nameOf(CorrectionKind::reject), "33", "Ada", nameOf(CorrectionState::no_track)})));
    EXPECT_THAT(html, HasSubstr("as people corrected them: " + correctionsInWords(corrections)));
    input.choice.uncorrected = true;
    EXPECT_THAT(told(input), HasSubstr(fact("Tracks", "as the machine found them, corrections left out")));
}

TEST(ReviewRemainder, EventsOfTracksThatAPersonMadeSaySo) {
    ReviewReportInput input = oneCar();
    input.reviewed.run.id = 8;
    const Event event = eventOf({3}, 50, 50, 50, {200, 200});
    EXPECT_THAT(told(input, {event}), HasSubstr(fact("Found by", "the machine, run 8")));
    for (const auto& [kind, words] :
         {std::pair(CorrectionKind::add, "a person, who added the track"),
          std::pair(CorrectionKind::join, "the machine, run 8, in tracks that a person joined"),
          std::pair(CorrectionKind::split, "the machine, run 8, in a track that a person split")}) {
        CorrectedTrack track;
        track.kind = kind;
        input.reviewed.tracks.corrections.tracks[3] = track;
        EXPECT_THAT(told(input, {event}), HasSubstr(fact("Found by", words)));
    }
}

TEST(ReviewRemainder, VerdictsWithoutAnEventAreToldByKindTimeAndFrame) {
    ReviewReportInput input = oneCar();
    Verdict verdict;
    verdict.id = 4;
    verdict.judgement = Judgement::relevant;
    verdict.note = "a <b>";
    verdict.person = "Ada";
    verdict.when_utc = "2026-11-21T08:00:00Z";
    verdict.subject.kind = EventKind::turns_back;
    verdict.subject.first_s = 61.5;
    verdict.subject.frame = 77;
    input.reviewed.review.verdicts[4] = verdict;
    verdict.id = 5;
    verdict.subject.kind.reset();
    verdict.person.clear();
    input.reviewed.review.verdicts[5] = verdict;
    verdict.id = 6;
    verdict.person = "Bob";
    verdict.when_utc.clear();
    input.reviewed.review.verdicts[6] = verdict;
    input.reviewed.carried.left = {{4, CarryFault::no_event}, {5, CarryFault::no_event}, {6, CarryFault::no_event}};
    const std::string html = told(input), why = nameOf(CarryFault::no_event), when = "2026-11-21T08:00:00Z";
    EXPECT_THAT(html, HasSubstr("Judged before, without an event in this run"));
    EXPECT_THAT(html, HasSubstr(row({nameOf(EventKind::turns_back), "1:01.5", "77", "relevant", "a &lt;b&gt;",
                                     "Ada, " + when, why})));
    EXPECT_THAT(html, HasSubstr(row({"not searched", "1:01.5", "77", "relevant", "a &lt;b&gt;", when, why})));
    EXPECT_THAT(html, HasSubstr(row({"not searched", "1:01.5", "77", "relevant", "a &lt;b&gt;", "Bob", why})));
    EXPECT_THAT(told(oneCar()), Not(HasSubstr("Judged before")));
}

TEST(ReviewRemainder, StretchesThatWereJudgedSayByWhom) {
    ReviewReportInput input = oneCar();
    EXPECT_THAT(told(input), Not(HasSubstr("Could not be searched")));
    input.reviewed.unsearched = {{10, 14}, {80, 80}};
    Verdict verdict;
    verdict.id = 4;
    verdict.judgement = Judgement::unsure;
    verdict.note = "dark";
    verdict.person = "Ada";
    input.reviewed.review.verdicts[4] = verdict;
    input.reviewed.carried.of_stretch = {0, 4};
    input.facts.counts.reasons = {{RegistrationFault::none, PictureQuality::clear, 3},
                                  {RegistrationFault::none, PictureQuality::clear, 2}};
    input.reviewed.tracks.unregistered = 6;
    const std::string html = told(input);
    EXPECT_THAT(html, HasSubstr(row({"0:00.4", "0:00.6", "10–14", "not judged", "", ""})));
    EXPECT_THAT(html, HasSubstr(row({"0:03.2", "0:03.2", "80–80", "unsure", "dark", "Ada"})));
    const std::string reason = nameOf(RegistrationFault::none, PictureQuality::clear);
    EXPECT_THAT(html, HasSubstr("6 frames could not be registered (" + reason + " 3, " + reason + " 2)"));
    // Six of 101 frames are 5.9 %, 20 are 20 %; from a tenth on no digit is told behind the point.
    EXPECT_THAT(html, HasSubstr("not 0:00.2 s (5.9 %) in 2 stretches"));
    input.reviewed.unsearched = {{10, 29}};
    input.reviewed.carried.of_stretch.clear();
    EXPECT_THAT(told(input), HasSubstr("not 0:00.8 s (20 %) in 1 stretch, listed below"));
    ReviewReportInput long_one = inputOf({}, 25, true, 4999);
    long_one.reviewed.unsearched = {{0, 1499}};
    EXPECT_THAT(told(long_one), HasSubstr("not 1:00.0 (30 %)"));
    long_one.reviewed.unsearched = {{0, 1497}};
    EXPECT_THAT(told(long_one), HasSubstr("not 0:59.9 s ("));
}

TEST(ReviewRemainder, WhatWasWatchedIsToldByItsShape) {
    ReviewReportInput input = oneCar();
    Zone zone;
    zone.name = "gate <3>";
    zone.shape = ZoneShape::line;
    input.reviewed.zones.push_back(zone);
    zone.shape = ZoneShape::arrow;
    input.reviewed.zones.push_back(zone);
    zone.shape = ZoneShape::area;
    input.reviewed.zones.push_back(zone);
    const std::string html = told(input);
    EXPECT_THAT(html, HasSubstr("<p>Watched: gate &lt;3&gt;, a line.</p>"));
    EXPECT_THAT(html, HasSubstr("<p>The right way by gate &lt;3&gt;, an arrow that a person drew.</p>"));
    EXPECT_THAT(html, HasSubstr("<p>Watched: gate &lt;3&gt;, an area.</p>"));
}

TEST(ReviewRemainder, FactsOfTheVideo) {
    ReviewReportInput input = oneCar();
    RunRecord& run = input.reviewed.run;
    run.id = 8;
    run.name = "night <1>";
    run.sequence = {.path = "/videos/street.mp4", .size = {640, 400}, .frame_count = 101, .frame_rate_hz = 25};
    run.scale = {0.5, 25, true};
    run.started_utc = "2026-11-21T08:00:00Z";
    run.engine_version = "9.8";
    run.state = RunState::finished;
    const std::string html = told(input);
    EXPECT_THAT(html, HasSubstr("<title>Events of street.mp4, run 8</title>"));
    EXPECT_THAT(html, HasSubstr(fact("Video", "/videos/street.mp4")));
    EXPECT_THAT(html, HasSubstr(fact("SHA-256", "not known")));
    EXPECT_THAT(html, HasSubstr(fact("Image", "640 × 400 px, 25 frames/s, 101 frames")));
    EXPECT_THAT(html, HasSubstr("8, night &lt;1&gt;, frames 0 to 100 (0:00.0 to 0:04.0), started "
                                "2026-11-21T08:00:00Z, Eyrie 9.8, "));
    EXPECT_THAT(html, HasSubstr(fact("Clock", "not known: times are those of the video")));
    EXPECT_THAT(html, HasSubstr(fact("Places", "not known")));
    EXPECT_THAT(html, HasSubstr(fact("Events", "0 found in 1 tracks, 0 judged by a person")));
    EXPECT_THAT(html, HasSubstr(fact("Reported here", "0: all events, judged or not")));
    EXPECT_THAT(html, HasSubstr("Nothing happened that the limits call an event."));
    EXPECT_THAT(html, Not(HasSubstr("By kind")));
    EXPECT_THAT(html, Not(HasSubstr("Report made")));
    EXPECT_THAT(html, Not(HasSubstr("Limits of events")));
    EXPECT_THAT(html, Not(HasSubstr("(assumed)")));
    run.rate_assumed = true;
    run.name.clear();
    input.clock = VideoClock::startingAt(1'231'798'102'000'000);
    input.places = test::placesAlong({1, 0}, {0, -1});
    input.scale_remark = "some remark";
    input.video_digest = "abc";
    input.made_utc = "2026-11-22T09:00:00Z";
    const std::string more = told(input);
    EXPECT_THAT(more, HasSubstr("25 frames/s (assumed), 101 frames"));
    EXPECT_THAT(more, HasSubstr("<td>8, frames 0 to 100 (0:00.0, 2009-01-12T22:08:22.000Z to 0:04.0, "
                                "2009-01-12T22:08:26.000Z), started"));
    EXPECT_THAT(more, HasSubstr(fact("Clock", "from " + input.clock.origin())));
    EXPECT_THAT(more, HasSubstr(fact("Places", "WGS 84, from " + input.places.origin())));
    EXPECT_THAT(more, HasSubstr("; some remark</td>"));
    EXPECT_THAT(more, HasSubstr(fact("SHA-256", "abc")));
    EXPECT_THAT(more, HasSubstr(fact("Report made", "2026-11-22T09:00:00Z")));
    ReviewReportInput empty = inputOf({}, 25, true, -1);
    EXPECT_THAT(told(empty), HasSubstr(fact("Searched", "nothing: the run has no frames")));
    EXPECT_THAT(told(empty), Not(HasSubstr("frames 0 to")));
    ReviewReportInput single = inputOf({}, 25, true, 0);
    EXPECT_THAT(told(single), HasSubstr(fact("Searched", "all of it")));
    EXPECT_THAT(told(single), HasSubstr("frames 0 to 0 (0:00.0 to 0:00.0)"));
}

TEST(ReviewRemainder, WhatWasChosenIsTold) {
    ReviewReportInput input = oneCar();
    Event stop = eventOf({3}, 50, 50, 50, {200, 200}), crossing = stop;
    stop.kind = EventKind::stops;
    crossing.kind = EventKind::crosses;
    EXPECT_THAT(told(input, {stop, crossing, stop}), HasSubstr(fact("Reported here", "3: all events, judged or not")));
    const std::string stops = nameOf(EventKind::stops), crosses = nameOf(EventKind::crosses);
    const bool stops_first = EventKind::stops < EventKind::crosses;
    EXPECT_THAT(
        told(input, {stop, crossing, stop}),
        HasSubstr(fact("By kind", stops_first ? stops + " 2, " + crosses + " 1" : crosses + " 1, " + stops + " 2")));
    input.choice.kinds = {EventKind::stops, EventKind::crosses};
    input.choice.judgements = {Judgement::open, Judgement::relevant};
    EXPECT_THAT(told(input, {stop}),
                HasSubstr(fact("Reported here", "1: not judged, relevant; only " + stops + ", " + crosses)));
    input.choice.judgements = {Judgement::relevant};
    const std::string none = told(input, {stop});
    EXPECT_THAT(none, HasSubstr("None of the events has such a verdict."));
    EXPECT_THAT(none, HasSubstr("0: relevant; only "));
    EXPECT_THAT(none, Not(HasSubstr("Boxes and trails are those of the machine")));
    EXPECT_EQ(countOfEvents(input), 0U);
}

TEST(ReviewRemainder, ThoseWhoWatchedAreToldOnceAndTogether) {
    ReviewReportInput input = oneCar();
    input.seen = {{"Ada", {{0, 9}}}, {"Bob", {{5, 14}}}};
    EXPECT_THAT(told(input), HasSubstr(fact("Seen", "15 % (Ada 9.9 %, Bob 9.9 %), at four times the speed at most")));
}

TEST(ReportFiles, PicturesStandInTheFileAsBase64) {
    // RFC 4648, section 10.
    for (const auto& [bytes, text] : {std::pair<std::string, std::string>{"", ""},
                                      {"f", "Zg=="},
                                      {"fo", "Zm8="},
                                      {"foo", "Zm9v"},
                                      {"foob", "Zm9vYg=="},
                                      {"fooba", "Zm9vYmE="},
                                      {"foobar", "Zm9vYmFy"},
                                      {"\xff\xfe\xfb", "//77"}}) {
        ReportFile report;
        report.html = "<img src=\"a\"> and <img src=\"a\"><img src=\"b\">";
        report.add("a", ReportPicture::Kind::png, bytes, 10);
        const std::string source = "src=\"data:image/png;base64," + text + "\"";
        std::string expected = "<img ";
        expected.append(source).append("> and <img ").append(source).append("><img src=\"b\">");
        EXPECT_EQ(selfContained(report), expected);
    }
    ReportFile kinds;
    kinds.html = "src=\"s\" src=\"j\"";
    kinds.add("s", ReportPicture::Kind::svg, "", 1);
    kinds.add("j", ReportPicture::Kind::jpeg, "", 1);
    EXPECT_EQ(selfContained(kinds), "src=\"data:image/svg+xml;base64,\" src=\"data:image/jpeg;base64,\"");
    EXPECT_EQ(kindOfReport("r.Pdf"), FileKind::pdf);
    EXPECT_EQ(kindOfReport("r.pdfz"), FileKind::html);
    EXPECT_EQ(kindOfReport("r.\xd0\xc4\xc6"), FileKind::html);
}

}  // namespace eyrie::review_remainder_test

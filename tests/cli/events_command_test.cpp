#include <gmock/gmock.h>

#include "cli/events_folder.h"
#include "core/time/utc_time.h"
#include "store/project/video_start.h"
#include "store/review/review_store.h"

namespace eyrie::events_command_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class EventsCommand : public test::EventsFolder {
 protected:
    EventsCommand() {
        writeProject("p.eyrie", true, -1);
        write("zones.json",
              R"({"eyrie_zones": 1, "zones": [
                  {"name": "gate", "shape": "line", "points": [[300, 100], [300, 300]]},
                  {"name": "yard", "points": [[400, 100], [500, 100], [500, 300], [400, 300]]}]})");
    }
    /// Says something about the vehicle in one frame, as if in an earlier run.
    void judge(EventKind kind, int frame, Judgement judgement, const std::string& note) const {
        ProjectFile project = ProjectFile::open(folder_ / "p.eyrie");
        ReviewStore store(project, 1);
        Verdict verdict;
        verdict.id = store.newVerdictId();
        verdict.subject.kind = kind;
        verdict.subject.first_frame = verdict.subject.last_frame = verdict.subject.frame = frame;
        verdict.subject.first_s = verdict.subject.last_s = frame / 25.0;
        verdict.subject.place = placeAt(frame);
        verdict.judgement = judgement;
        verdict.note = note;
        verdict.tags = {"lorry"};
        verdict.starred = true;
        verdict.person = "Ada";
        verdict.when_utc = "2026-11-21T08:00:00Z";
        store.apply({"Judge", {{std::nullopt, verdict}}, {}});
    }
};

}  // namespace

TEST_F(EventsCommand, PrintsWhatHappenedWithTimesFiguresAndPlaces) {
    const auto result = call({"--project", "@p.eyrie"});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, StartsWith("no    kind "));
    EXPECT_THAT(result.output, AllOf(HasSubstr("1     appears           50            0:02.0     5"),
                                     HasSubstr("27 km/h"), HasSubstr("stops "), HasSubstr("stands ")));
    EXPECT_THAT(result.output, HasSubstr("3 events of 1 tracks: 1 appears, 1 stops, 1 stands"));
    EXPECT_EQ(result.errors, "");
}

TEST_F(EventsCommand, KindsAndThresholdsCanBeChosen) {
    const auto stops = call({"--project", "@p.eyrie", "--kind", "stops,stands", "--set", "events.stands=20"});
    EXPECT_EQ(stops.exit_code, 0) << stops.errors;
    EXPECT_THAT(stops.output, HasSubstr("1 event of 1 tracks: 1 stops"));
    const auto over = call({"--project", "@p.eyrie", "--kind", "over-speed", "--set", "events.over=20"});
    EXPECT_THAT(over.output, AllOf(HasSubstr("over speed"), HasSubstr("27 km/h")));
    const auto wrong = call({"--project", "@p.eyrie", "--kind", "stopps"});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_THAT(wrong.errors, HasSubstr("the nearest is \"stops\""));
    EXPECT_EQ(call({"--project", "@p.eyrie", "--set", "events.over=-1"}).exit_code, 2);
    EXPECT_EQ(call({"--project", "@p.eyrie", "--set", "events.over"}).exit_code, 2);
    EXPECT_THAT(call({"--project", "@p.eyrie", "--set", "events.ovr=1"}).errors, HasSubstr("events.over"));
}

TEST_F(EventsCommand, ZonesAreWatchedOnTheGround) {
    const auto result = call({"--project", "@p.eyrie", "--zone", "@zones.json", "--kind", "enters", "--kind", "exits",
                              "--kind", "crosses", "--csv", "@e.csv"});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output,
                AllOf(HasSubstr("gate to the left"), HasSubstr("2 events of 1 tracks: 1 enters, 1 crosses")));
    // x = 280 of frame 0 is where the box's centre, 20 px ahead of its way, comes to the line: frame 237.
    const std::string table = textOf("e.csv");
    EXPECT_THAT(table,
                StartsWith("kind,first_frame,last_frame,start_s,end_s,clock,tracks,figure,unit,zone,sense,frame"));
    EXPECT_THAT(table, HasSubstr("\ncrosses,237,237,9.48,9.48,0:09.5,5,27,km/h,gate,to the left,237,"));
    EXPECT_THAT(table, HasSubstr("\nenters,304,304,"));
}

TEST_F(EventsCommand, WithoutAScaleItSpeaksOfPixelsAndSaysSo) {
    writeProject("unknown.eyrie", false, -1);
    const auto result = call({"--project", "@unknown.eyrie"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.output, AllOf(HasSubstr("1.50 px/frame"), Not(HasSubstr("km/h"))));
    EXPECT_THAT(result.errors, AllOf(HasSubstr("the scale is not known"), HasSubstr("0.2 m/px")));
}

TEST_F(EventsCommand, FramesThatCouldNotBeRegisteredAreTold) {
    writeProject("broken.eyrie", true, 200);
    const auto result = call({"--project", "@broken.eyrie", "--zone", "@zones.json"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.errors, AllOf(HasSubstr("1 frame could not be registered"),
                                     HasSubstr("zone \"gate\" counts in frames 0 to 199 only")));
}

TEST_F(EventsCommand, ZonesOfTheProjectAreWatchedWhereNoFileIsGiven) {
    {
        ProjectFile project = ProjectFile::open(folder_ / "p.eyrie");
        ReviewStore store(project, 1);
        StoredZone zone;
        for (const int x : {200, 300}) {
            zone.id = store.newZoneId();
            zone.zone = {
                "gate " + std::to_string(x), ZoneShape::line, ZoneAnchor::ground, 0, {{x + 0., 100}, {x + 0., 300}}};
            store.apply({"Add", {}, {}, {{std::nullopt, zone}}});
        }
        zone.id = store.newZoneId();
        zone.zone = {"late", ZoneShape::area, ZoneAnchor::ground, 900, {{0, 0}, {50, 0}, {0, 50}}};
        store.apply({"Add", {}, {}, {{std::nullopt, zone}}});
    }
    const auto own = call({"--project", "@p.eyrie", "--kind", "crosses"});
    EXPECT_EQ(own.exit_code, 0) << own.errors;
    EXPECT_THAT(own.output, AllOf(HasSubstr("gate 200"), HasSubstr("gate 300"), HasSubstr("2 events")));
    EXPECT_THAT(own.errors, AllOf(HasSubstr("watching the zones of the project: gate 200, gate 300, late"),
                                  HasSubstr("zone \"late\" is fixed to the ground of frame 900")));
    const auto file = call({"--project", "@p.eyrie", "--kind", "crosses", "--zone", "@zones.json"});
    EXPECT_THAT(file.output, AllOf(HasSubstr("gate"), HasSubstr("1 event of"), Not(HasSubstr("gate 200"))));
    EXPECT_EQ(file.errors, "");
    const auto report =
        test::runLoaded({"report", "--project", at("p.eyrie"), "--events", "--verdict", "all", "--out", at("r.html")});
    EXPECT_EQ(report.exit_code, 0) << report.errors;
    EXPECT_THAT(report.errors, HasSubstr("watching the zones of the project"));
    EXPECT_THAT(textOf("r.html"), AllOf(HasSubstr("Watched: gate 200, a line."), HasSubstr("crosses: gate 300")));
}

TEST_F(EventsCommand, AnArrowOfTheProjectSaysWhichWayIsRight) {
    EXPECT_THAT(call({"--project", "@p.eyrie", "--kind", "against the flow"}).output, Not(HasSubstr("against")));
    {
        ProjectFile project = ProjectFile::open(folder_ / "p.eyrie");
        ReviewStore store(project, 1);
        StoredZone arrow;
        arrow.id = store.newZoneId();
        arrow.zone = {"lane", ZoneShape::arrow, ZoneAnchor::ground, 0, {{400, 200}, {50, 200}}};
        store.apply({"Add", {}, {}, {{std::nullopt, arrow}}});
    }
    const auto result = call({"--project", "@p.eyrie", "--kind", "against the flow"});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, AllOf(HasSubstr("against the flow"), HasSubstr("lane"), HasSubstr("1 event")));
}

TEST_F(EventsCommand, BadZonesAreRefusedWithTheirPlace) {
    write("flat.json", R"({"eyrie_zones": 1, "zones": [{"name": "a", "points": [[0, 0], [5, 5], [9, 9]]}]})");
    write("broken.json", R"({"eyrie_zones": 1, "zones": [{"name": "a",)");
    write("late.json",
          R"({"eyrie_zones": 1, "zones": [{"name": "a", "frame": 900, "points": [[0, 0], [5, 0], [9, 9]]}]})");
    const std::vector<std::pair<std::string, std::string>> files = {
        {"flat.json", "flat.json: zones[0].points: the zone has no area"},
        {"broken.json", "broken.json: is not valid JSON"},
        {"late.json", "zone \"a\" is fixed to the ground of frame 900"},
        {"absent.json", "absent.json"}};
    for (const auto& [file, words] : files) {
        const auto result = call({"--project", "@p.eyrie", "--zone", "@" + file, "--csv", "@none.csv"});
        EXPECT_EQ(result.exit_code, 3) << file;
        EXPECT_THAT(result.errors, HasSubstr(words));
        EXPECT_FALSE(std::filesystem::exists(folder_ / "none.csv"));
    }
}

TEST_F(EventsCommand, VerdictsAreShownWithWhoSaidSoAndWhen) {
    judge(EventKind::stops, 330, Judgement::relevant, "at the gate,\nlights on");
    const auto result = call({"--project", "@p.eyrie", "--csv", "@e.csv"});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, AllOf(HasSubstr(" verdict "), HasSubstr(" relevant * "), HasSubstr("3 events"),
                                     HasSubstr("\"at the gate, lights on\"  [lorry]  Ada  2026-11-21T08:00:00Z\n"),
                                     Not(HasSubstr("could not be carried over"))));
    const std::string table = textOf("e.csv");
    EXPECT_THAT(table,
                HasSubstr(",ground_frame,ground_x,ground_y,verdict,note,tags,starred,person,when_utc,by,number,utc\n"));
    EXPECT_THAT(table, HasSubstr(",relevant,\"at the gate, lights on\",lorry,1,Ada,2026-11-21T08:00:00Z,machine,2,\n"));
    EXPECT_THAT(table, HasSubstr(",,,,,,machine,1,\nst")) << "nobody said anything about the first one";
}

TEST_F(EventsCommand, ClockTimesCountFromTheStartThatIsKeptOrGiven) {
    EXPECT_THAT(call({"--project", "@p.eyrie"}).output, Not(HasSubstr(" utc ")));
    {
        ProjectFile project = ProjectFile::open(folder_ / "p.eyrie");
        storeVideoStart(project, 1, utcOf("2026-11-21T08:00:00Z"));
    }
    const auto kept = call({"--project", "@p.eyrie", "--csv", "@e.csv"});
    EXPECT_EQ(kept.exit_code, 0) << kept.errors;
    EXPECT_THAT(kept.output, AllOf(HasSubstr(" utc "), HasSubstr(" 2026-11-21T08:00:")));
    EXPECT_THAT(textOf("e.csv"), HasSubstr(",2026-11-21T08:00:"));
    const auto given = call({"--project", "@p.eyrie", "--csv", "@e.csv", "--start", "2009-01-12T22:08:22Z", "--force"});
    EXPECT_EQ(given.exit_code, 0) << given.errors;
    EXPECT_THAT(textOf("e.csv"), AllOf(HasSubstr(",2009-01-12T22:08:"), Not(HasSubstr("2026-11-21T08:00:"))));
    const auto wrong = call({"--project", "@p.eyrie", "--start", "noon"});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_THAT(wrong.errors, HasSubstr("UTC"));
}

TEST_F(EventsCommand, EventsCanBeChosenByTheirVerdict) {
    judge(EventKind::stops, 330, Judgement::not_relevant, "");
    const auto hidden = call({"--project", "@p.eyrie", "--verdict", "open,relevant"});
    EXPECT_THAT(hidden.output, HasSubstr("2 events of 1 tracks: 1 appears, 1 stands"));
    EXPECT_THAT(call({"--project", "@p.eyrie", "--verdict", "not-relevant"}).output,
                HasSubstr("1 event of 1 tracks: 1 stops"));
    const auto wrong = call({"--project", "@p.eyrie", "--verdict", "good"});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_THAT(wrong.errors, HasSubstr("there are: open, relevant, not relevant, unsure"));
}

TEST_F(EventsCommand, EventsCanBeChosenByTheirTags) {
    judge(EventKind::stops, 330, Judgement::relevant, "");  // tagged "lorry"
    const auto tagged = call({"--project", "@p.eyrie", "--tag", "gate 3,lorry"});
    EXPECT_EQ(tagged.exit_code, 0) << tagged.errors;
    EXPECT_THAT(tagged.output, HasSubstr("1 event of 1 tracks: 1 stops"));
    EXPECT_THAT(call({"--project", "@p.eyrie", "--tag", "bus"}).output, Not(HasSubstr("stops ")));
}

TEST_F(EventsCommand, VerdictsThatNoEventTakesUpAreListed) {
    judge(EventKind::stops, 150, Judgement::relevant, "earlier");
    judge(EventKind::crosses, 237, Judgement::unsure, "");
    const auto result = call({"--project", "@p.eyrie"});
    EXPECT_THAT(result.output, AllOf(HasSubstr("2 verdicts could not be carried over to this run:"),
                                     HasSubstr("frame 150     0:06.0     relevant *     no such event near"),
                                     HasSubstr("\"earlier\"")));
    const auto near = call({"--project", "@p.eyrie", "--kind", "stops", "--set", "review.carry_time=20"});
    EXPECT_THAT(near.output, AllOf(HasSubstr(" relevant * "), Not(HasSubstr("could not be carried over"))));
    EXPECT_THAT(call({"--project", "@p.eyrie", "--verdict", "unsure"}).output, HasSubstr("1 verdict could not be"));
}

TEST_F(EventsCommand, TracksAreThoseThatPeopleCorrectedUnlessTheRunsOwnAreAskedFor) {
    {
        ProjectFile project = ProjectFile::open(folder_ / "p.eyrie");
        ReviewStore store(project, 1);
        ReviewEdit edit{"Correct", {}, {}};
        TrackCorrection added;
        added.id = store.newCorrectionId();
        for (int frame = 100; frame <= 400; ++frame)
            added.track.push_back({frame, {{50 + frame - 0.25 * frame, 300}, 20, 9, 0}});
        added.frame = 200;
        added.person = "Ada";
        TrackCorrection join = added;
        join.id = store.newCorrectionId();
        join.kind = CorrectionKind::join;
        join.track = {{20, {{100, 40}, 20, 9, 0}}};
        join.other = {{60, {{300, 40}, 20, 9, 0}}};
        edit.corrections = {{std::nullopt, added}, {std::nullopt, join}};
        store.apply(edit);
    }
    const auto result = call({"--project", "@p.eyrie", "--csv", "@e.csv"});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(
        result.output,
        AllOf(HasSubstr("of 2 tracks"),
              HasSubstr("tracks as people corrected them: 1 track added; 1 correction could not be carried over:"),
              HasSubstr("added             frame 200     tracks 6                applied  Ada"),
              HasSubstr("joined            frame 200                             no such track near  Ada")));
    EXPECT_THAT(textOf("e.csv"), AllOf(HasSubstr(",machine,"), HasSubstr(",person: added,")));
    const auto own = call({"--project", "@p.eyrie", "--uncorrected", "--csv", "@own.csv"});
    EXPECT_THAT(own.output, AllOf(HasSubstr("3 events of 1 tracks"), Not(HasSubstr("people"))));
    EXPECT_THAT(textOf("own.csv"), Not(HasSubstr("person: ")));
    const auto written = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"export",     "--project", at("p.eyrie"), "--format",
                                       "tracks-csv", "--out",     at("t.csv"),   "--force"};
        words.insert(words.end(), more.begin(), more.end());
        const auto exported = test::runLoaded(words);
        EXPECT_EQ(exported.exit_code, 0) << exported.errors;
        return exported.output + textOf("t.csv");
    };
    EXPECT_THAT(written({}), AllOf(HasSubstr(",by hand\n"), HasSubstr("note        tracks as people corrected them")));
    EXPECT_THAT(written({"--uncorrected"}), AllOf(Not(HasSubstr(",by hand\n")), HasSubstr(",detected\n")));
}

TEST_F(EventsCommand, RejectedTracksAreLeftOutAndListedAmongWhatPeopleCorrected) {
    writeTraffic();
    {
        ProjectFile project = ProjectFile::open(folder_ / "traffic.eyrie");
        ReviewStore store(project, 1);
        TrackCorrection rejection;
        rejection.id = store.newCorrectionId();
        rejection.kind = CorrectionKind::reject;
        rejection.track = {{0, {{300, 182}, 22, 9, CV_PI}}, {99, {{102, 182}, 22, 9, CV_PI}}};
        rejection.person = "Ada";
        ReviewEdit edit{"Reject", {}, {}};
        edit.corrections = {{std::nullopt, rejection}};
        store.apply(edit);
    }
    const auto result = call({"--project", "@traffic.eyrie"});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output,
                AllOf(HasSubstr("of 2 tracks"),
                      HasSubstr("tracks as people corrected them: 1 track rejected:\n"
                                "rejected          frame 0       tracks 2                applied  Ada")));
    EXPECT_THAT(call({"--project", "@traffic.eyrie", "--uncorrected"}).output,
                AllOf(HasSubstr("of 3 tracks"), Not(HasSubstr("rejected"))));
    const auto exported = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"export",     "--project", at("traffic.eyrie"), "--format",
                                       "tracks-csv", "--out",     at("t.csv"),         "--force"};
        words.insert(words.end(), more.begin(), more.end());
        const auto written = test::runLoaded(words);
        EXPECT_EQ(written.exit_code, 0) << written.errors;
        return written.output + textOf("t.csv");
    };
    EXPECT_THAT(exported({}), AllOf(HasSubstr("\n1,0,"), Not(HasSubstr("\n2,0,")), HasSubstr("1 track rejected")));
    EXPECT_THAT(exported({"--uncorrected"}), AllOf(HasSubstr("\n1,0,"), HasSubstr("\n2,0,")));
}

TEST_F(EventsCommand, EndsAsTheOtherCommandsDo) {
    ProjectFile::create(folder_ / "empty.eyrie");
    EXPECT_EQ(call({"--project", "@absent.eyrie"}).exit_code, 5);
    EXPECT_EQ(call({"--project", "@empty.eyrie"}).exit_code, 5);
    EXPECT_EQ(call({"--project", "@p.eyrie", "--run", "7"}).exit_code, 2);
    EXPECT_EQ(call({}).exit_code, 2);
    write("file", "x");
    EXPECT_EQ(call({"--project", "@p.eyrie", "--csv", "@file/e.csv"}).exit_code, 4);
    EXPECT_EQ(call({"--project", "@p.eyrie", "--csv", "@p.eyrie"}).exit_code, 4);
    EXPECT_EQ(call({"--project", "@p.eyrie", "--zone", "@zones.json", "--csv", "@zones.json"}).exit_code, 4);
    write("old.csv", "a,b\n1,2\n");
    EXPECT_EQ(call({"--project", "@p.eyrie", "--csv", "@old.csv"}).exit_code, 4);
    EXPECT_EQ(call({"--project", "@p.eyrie", "--csv", "@old.csv", "--force"}).exit_code, 0);
    EXPECT_THAT(textOf("old.csv"), StartsWith("kind,"));
}

}  // namespace eyrie::events_command_test

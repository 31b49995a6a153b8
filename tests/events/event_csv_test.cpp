#include "events/event_csv.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "support/temporary_folder.h"

namespace eyrie::event_csv_test {
namespace {

const std::string kHeader =
    "kind,first_frame,last_frame,start_s,end_s,clock,tracks,figure,unit,zone,sense,frame,x,y,ground_frame,ground_x,"
    "ground_y,verdict,note,tags,starred,person,when_utc,by,number,utc\n";

Event crossed() {
    Event event;
    event.kind = EventKind::crosses;
    event.tracks = {3, 17};
    event.first_frame = 100;
    event.last_frame = 125;
    event.frame = 110;
    event.place = {12.345, 67.891};
    event.ground_frame = 90;
    event.ground = {-3.5, 0.126};
    event.figure = 43.21;
    event.unit = FigureUnit::km_per_hour;
    event.zone = "gate, east";
    event.sense = CrossingSense::to_left;
    return event;
}

Event appeared() {
    Event event;
    event.tracks = {4};
    event.first_frame = event.last_frame = event.frame = event.ground_frame = 200;
    event.place = event.ground = {1, 2};
    event.figure = 5;  // of no unit, so it counts nothing
    return event;
}

double seconds(FrameIndex frame) {
    return frame / 25.0;
}

std::string textOf(const std::filesystem::path& file) {
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

}  // namespace

TEST(EventCsv, EventsAreToldWithTheirTimesPlacesAndFigures) {
    const test::TemporaryFolder folder;
    writeEventCsv(folder / "events.csv", {crossed(), appeared()}, seconds);
    EXPECT_EQ(textOf(folder / "events.csv"), kHeader + "crosses,100,125,4,5,0:04.0,3 17,43.21,km/h,\"gate, east\"," +
                                                 nameOf(CrossingSense::to_left) +
                                                 ",110,12.35,67.89,90,-3.5,0.13,,,,,,,machine,1,\n"
                                                 "appears,200,200,8,8,0:08.0,4,,,," +
                                                 nameOf(CrossingSense::none) + ",200,1,2,200,1,2,,,,,,,machine,2,\n");
}

TEST(EventCsv, WhatPeopleSaidStandsBesideThem) {
    Verdict verdict;
    verdict.judgement = Judgement::not_relevant;
    verdict.note = "no \"lights\"";
    verdict.tags = {"lorry", "gate 3"};
    verdict.person = "Ada";
    verdict.when_utc = "2026-11-21T08:00:00Z";
    const test::TemporaryFolder folder;
    const auto written = [&] {
        writeEventCsv(folder / "events.csv", {appeared(), appeared()}, seconds, {nullptr, &verdict}, {7, 12},
                      {"machine", "person: added"}, [](FrameIndex frame) { return "at " + std::to_string(frame); });
        return textOf(folder / "events.csv");
    };
    const std::string told =
        "appears,200,200,8,8,0:08.0,4,,,," + std::string(nameOf(CrossingSense::none)) + ",200,1,2,200,1,2,";
    const std::string said = "not relevant,\"no \"\"lights\"\"\",\"" + tagText(verdict.tags) + "\",";
    EXPECT_EQ(written(), kHeader + told + ",,,,,,machine,7,at 200\n" + told + said +
                             "0,Ada,2026-11-21T08:00:00Z,person: added,12,at 200\n");
    verdict.starred = true;
    EXPECT_NE(written().find(said + "1,Ada"), std::string::npos);
}

TEST(EventCsv, WithoutEventsThereAreTheNamesOfTheColumns) {
    const test::TemporaryFolder folder;
    writeEventCsv(folder / "events.csv", {}, seconds);
    EXPECT_EQ(textOf(folder / "events.csv"), kHeader);
}

}  // namespace eyrie::event_csv_test

#include "io/tables/box_csv.h"

#include <gmock/gmock.h>

#include <clocale>
#include <cmath>

#include "core/geometry/angle.h"
#include "io/atomic_file.h"
#include "io/numbered_video.h"
#include "support/shared_data.h"
#include "support/temporary_folder.h"

namespace eyrie::box_csv_test {
namespace {

using testing::HasSubstr;

class BoxCsv : public testing::Test {
 protected:
    BoxesByFrame read(const std::string& text) {
        test::writeBytes(folder_ / "boxes.csv", text);
        return readBoxCsv(folder_ / "boxes.csv");
    }
    test::TemporaryFolder folder_;
};

BoxRecord record(FrameIndex frame, std::optional<int> id, double heading) {
    BoxRecord record;
    record.frame = frame;
    record.id = id;
    record.box.centre = {12.3456, -7.25};
    record.box.length = 20.5;
    record.box.width = 9.125;
    record.box.heading = heading;
    record.object_class = "car";
    record.score = 0.875;
    record.velocity = {1.5, -0.000125};
    record.origin = StateOrigin::detected;
    return record;
}

void expectSame(const BoxRecord& a, const BoxRecord& b) {
    EXPECT_EQ(a.frame, b.frame);
    EXPECT_EQ(a.id, b.id);
    EXPECT_NEAR(a.box.centre.x, b.box.centre.x, 1e-4);
    EXPECT_NEAR(a.box.centre.y, b.box.centre.y, 1e-4);
    EXPECT_NEAR(a.box.length, b.box.length, 1e-4);
    EXPECT_NEAR(a.box.width, b.box.width, 1e-4);
    EXPECT_NEAR(turnBetween(a.box.heading, b.box.heading), 0, radiansFromDegrees(1e-4));
    EXPECT_EQ(a.object_class, b.object_class);
    EXPECT_EQ(a.ignore, b.ignore);
}

TEST_F(BoxCsv, ResultsSurviveTheRoundTrip) {
    BoxesByFrame boxes;
    boxes[0] = {record(0, 3, 0.25), record(0, std::nullopt, -3.1)};
    boxes[7] = {record(7, 3, kPi)};
    boxes[7][0].object_class = "a \"big\", red bus";
    writeResultCsv(folder_ / "r.csv", boxes);
    const BoxesByFrame back = readBoxCsv(folder_ / "r.csv");
    ASSERT_EQ(back.size(), 2U);
    for (const auto& [frame, records] : boxes) {
        ASSERT_EQ(back.at(frame).size(), records.size());
        for (std::size_t i = 0; i < records.size(); ++i) {
            expectSame(back.at(frame)[i], records[i]);
            EXPECT_NEAR(back.at(frame)[i].score, 0.875, 1e-6);
            EXPECT_NEAR(back.at(frame)[i].velocity.x, 1.5, 1e-6);
            EXPECT_NEAR(back.at(frame)[i].velocity.y, -0.000125, 1e-6);
            EXPECT_EQ(back.at(frame)[i].origin, StateOrigin::detected);
        }
    }
}

TEST_F(BoxCsv, EveryOriginComesBackAndAForeignWordIsNone) {
    BoxesByFrame boxes;
    for (int i = 0; i < kStateOrigins; ++i) {
        boxes[0].push_back(record(0, i, 0));
        boxes[0].back().origin = static_cast<StateOrigin>(i);
    }
    boxes[0].push_back(record(0, kStateOrigins, 0));
    boxes[0].back().origin = std::nullopt;
    writeResultCsv(folder_ / "r.csv", boxes);
    const std::string text = test::bytesOf(folder_ / "r.csv");
    for (const char* word : {"detected", "reconstructed", "predicted", "standing", "by hand", ""})
        EXPECT_THAT(text, HasSubstr(std::string(",-0.000125,") + word + "\n"));
    const BoxesByFrame back = readBoxCsv(folder_ / "r.csv");
    ASSERT_EQ(back.at(0).size(), boxes[0].size());
    for (std::size_t i = 0; i < boxes[0].size(); ++i) EXPECT_EQ(back.at(0)[i].origin, boxes[0][i].origin) << i;
    EXPECT_EQ(read("frame,x,y,length,width,heading,origin\n0,1,1,1,1,0,guessed\n").at(0)[0].origin, std::nullopt);
}

TEST_F(BoxCsv, GroundTruthSurvivesTheRoundTrip) {
    BoxesByFrame boxes;
    boxes[2] = {record(2, 0, 1), record(2, 1, 2)};
    boxes[2][1].ignore = true;
    writeGroundTruthCsv(folder_ / "g.csv", boxes);
    const BoxesByFrame back = readBoxCsv(folder_ / "g.csv");
    for (std::size_t i = 0; i < 2; ++i) expectSame(back.at(2)[i], boxes[2][i]);
}

TEST_F(BoxCsv, TheTextIsAsDocumented) {
    BoxesByFrame boxes;
    boxes[4] = {record(4, std::nullopt, radiansFromDegrees(-90))};
    writeResultCsv(folder_ / "r.csv", boxes);
    EXPECT_EQ(test::bytesOf(folder_ / "r.csv"),
              "frame,id,x,y,length,width,heading,class,score,vx,vy,origin\n"
              "4,,12.3456,-7.25,20.5,9.125,270,car,0.875,1.5,-0.000125,detected\n");
    writeGroundTruthCsv(folder_ / "g.csv", boxes);
    EXPECT_EQ(test::bytesOf(folder_ / "g.csv"),
              "frame,id,x,y,length,width,heading,class,ignore\n4,,12.3456,-7.25,20.5,9.125,270,car,0\n");
}

TEST_F(BoxCsv, NoNameIsAFormulaAndEveryNameComesBack) {
    BoxesByFrame boxes;
    const std::vector<std::string> names{"=1+1", "+car", "-car", "@SUM(A1)", "'=1", "''-x", "'car", "'", "-5", "car"};
    for (std::size_t i = 0; i < names.size(); ++i) {
        boxes[0].push_back(record(0, static_cast<int>(i), 0));
        boxes[0].back().object_class = names[i];
    }
    writeGroundTruthCsv(folder_ / "names.csv", boxes);
    const BoxesByFrame back = readBoxCsv(folder_ / "names.csv");
    for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(back.at(0)[i].object_class, names[i]);
    const std::string text = readWholeFile(folder_ / "names.csv");
    EXPECT_THAT(text, HasSubstr(",'=1+1,"));
    EXPECT_THAT(text, HasSubstr(",-5,")) << "a number stays one";
    EXPECT_THAT(text, HasSubstr(",12.3456,-7.25,"));
}

TEST_F(BoxCsv, HeadingsStayBelow360Degrees) {
    BoxesByFrame boxes;
    boxes[0] = {record(0, 1, -1e-9)};
    writeResultCsv(folder_ / "r.csv", boxes);
    EXPECT_THAT(test::bytesOf(folder_ / "r.csv"), HasSubstr(",9.125,0,car"));
}

TEST_F(BoxCsv, ColumnsInAnyOrderWithDefaultsForTheMissing) {
    const BoxesByFrame boxes = read("heading,y,note,x,width,length,frame\n90, 2 ,hello,1,3,4.5,6\n");
    const BoxRecord& box = boxes.at(6).at(0);
    EXPECT_FALSE(box.id.has_value());
    EXPECT_EQ(box.box.centre, cv::Point2d(1, 2));
    EXPECT_EQ(box.box.length, 4.5);
    EXPECT_EQ(box.box.width, 3);
    EXPECT_NEAR(box.box.heading, kPi / 2, 1e-12);
    EXPECT_EQ(box.score, 1);
    EXPECT_FALSE(box.ignore);
}

TEST_F(BoxCsv, LineEndsBlankLinesQuotesAndByteOrderMark) {
    const BoxesByFrame boxes = read(
        "\xEF\xBB\xBF\"frame\",id,x,y,length,width,heading,class,ignore\r\n\r\n"
        "0,1,1.5,2,3,4,5,\"car, \"\"small\"\"\",1\r\n   \n12.0,,1e1,+2,3,4,-5,,\r\n");
    ASSERT_EQ(boxes.size(), 2U);
    EXPECT_EQ(boxes.at(0)[0].object_class, "car, \"small\"");
    EXPECT_TRUE(boxes.at(0)[0].ignore);
    EXPECT_EQ(boxes.at(12)[0].box.centre, cv::Point2d(10, 2));
    EXPECT_NEAR(boxes.at(12)[0].box.heading, radiansFromDegrees(-5), 1e-12);
}

TEST_F(BoxCsv, IgnoredRegionsMayHaveNames) {
    const BoxesByFrame boxes = read(
        "frame,id,x,y,length,width,heading,ignore\n0,7,1,1,1,1,0,0\n0,i18,1,1,1,1,0,1\n1,i18,1,1,1,1,0,1\n1,i2,1,1,1,1,"
        "0,1\n");
    EXPECT_GT(*boxes.at(0)[1].id, 7);
    EXPECT_EQ(boxes.at(0)[1].id, boxes.at(1)[0].id);
    EXPECT_NE(boxes.at(1)[0].id, boxes.at(1)[1].id);
}

TEST_F(BoxCsv, NamedRegionsNeedNumbersAboveAllOthers) {
    const std::string header = "frame,id,x,y,length,width,heading,ignore\n";
    const std::string named = "0,i1,1,1,1,1,0,1\n0,i2,1,1,1,1,0,1\n1,i1,1,1,1,1,0,1\n";
    const BoxesByFrame boxes = read(header + "0,2147483645,1,1,1,1,0,0\n" + named);
    EXPECT_EQ(boxes.at(0)[1].id, 2147483646);
    EXPECT_EQ(boxes.at(0)[2].id, 2147483647);
    EXPECT_EQ(boxes.at(1)[0].id, 2147483646);
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { read(header + "0,2147483646,1,1,1,1,0,0\n" + named); }),
                HasSubstr("id 2147483646 leaves no number"));
    EXPECT_EQ(read(header + "0,2147483647,1,1,1,1,0,0\n").at(0)[0].id, 2147483647) << "without names it may be any";
    EXPECT_EQ(read(header + "0,i1,1,1,1,1,0,1\n").at(0)[0].id, 0) << "where no others are they count from 0";
}

TEST_F(BoxCsv, IgnoreIsANumberOrAWord) {
    const auto ignored = [&](const std::string& word) {
        return read("frame,x,y,length,width,heading,ignore\n0,1,1,1,1,0," + word + "\n").at(0)[0].ignore;
    };
    for (const char* yes : {"1", "1.0", "true", "True"}) EXPECT_TRUE(ignored(yes)) << yes;
    for (const char* no : {"", "0", "false", "False"}) EXPECT_FALSE(ignored(no)) << no;
    for (const char* neither : {"-1", "2", "yes"})
        EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { ignored(neither); }), HasSubstr("expected 0 or 1"));
}

TEST_F(BoxCsv, WholeNumbersTake32Bits) {
    const std::string header = "frame,x,y,length,width,heading\n";
    EXPECT_EQ(read(header + "2147483647,1,1,1,1,0\n").count(2147483647), 1U);
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { read(header + "2147483648,1,1,1,1,0\n"); }),
                HasSubstr("expected a whole number"));
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { read(header + "-2147483648,1,1,1,1,0\n"); }),
                HasSubstr("0 or more"));
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { read(header + "-2147483649,1,1,1,1,0\n"); }),
                testing::Not(HasSubstr("0 or more")));
}

TEST_F(BoxCsv, ATableWithoutRowsIsEmpty) {
    EXPECT_TRUE(read("frame,id,x,y,length,width,heading\n").empty());
}

TEST_F(BoxCsv, EveryMalformedFieldIsNamedWithItsPlace) {
    const std::string header = "frame,id,x,y,length,width,heading,class,ignore,score,vx\n";
    const std::string good = "0,1,1,1,1,1,0,car,0,1,0\n";
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"0,1,1,1,1,1,abc,car,0,1,0", ":3: column heading = abc, expected a number"},
        {"0,1,1,1,1,1,,car,0,1,0", ":3: column heading is empty, expected a number"},
        {"0,1,nan,1,1,1,0,car,0,1,0", ":3: column x = nan"},
        {"0,1,1,inf,1,1,0,car,0,1,0", ":3: column y = inf"},
        {"0,1,1,1e999,1,1,0,car,0,1,0", ":3: column y = 1e999"},
        {"0,1,1,1,-2,1,0,car,0,1,0", ":3: column length = -2"},
        {"0,1,1,1,1,-0.5,0,car,0,1,0", ":3: column width = -0.5"},
        {"-1,1,1,1,1,1,0,car,0,1,0", ":3: column frame = -1"},
        {"1.5,1,1,1,1,1,0,car,0,1,0", ":3: column frame = 1.5, expected a whole number"},
        {"99999999999,1,1,1,1,1,0,car,0,1,0", ":3: column frame = 99999999999"},
        {",1,1,1,1,1,0,car,0,1,0", ":3: column frame is empty"},
        {"0,x7,1,1,1,1,0,car,0,1,0", ":3: column id = x7"},
        {"0,-7,1,1,1,1,0,car,0,1,0", ":3: column id = -7"},
        {"0,1,1,1,1,1,0,car,2,1,0", ":3: column ignore = 2, expected 0 or 1"},
        {"0,1,1,1,1,1,0,car,0,high,0", ":3: column score = high"},
        {"0,1,1,1,1,1,0,car,0,1,0x10", ":3: column vx = 0x10"},
        {"0,1,\"1,5\",1,1,1,0,car,0,1,0", ":3: column x = 1,5"},
        {"0,1,1 2,1,1,1,0,car,0,1,0", ":3: column x = 1 2"},
        {"0,1,1,1,1,1,0,car,0,1", ":3: the line has 10 fields, the header 11"},
        {"0,1,1,1,1,1,0,car,0,1,0,9", ":3: the line has 12 fields"},
        {"0,1,1,1,1,1,0,\"car,0,1,0", ":3: a quote is not closed"},
        {"0,1,1,1,1,1,0,\"car\"s,0,1,0", ":3: text follows a closing quote"},
    };
    for (const auto& [line, expected] : cases) {
        const std::string message =
            test::messageOf(ErrorKind::input, [&, &line = line] { read(header + good + line); });
        EXPECT_THAT(message, HasSubstr("boxes.csv" + expected)) << line;
    }
}

TEST_F(BoxCsv, HeadersThatDoNotDo) {
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { read(""); }), HasSubstr("is empty"));
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { read("\n\n"); }), HasSubstr("is empty"));
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { read("frame,x,y,length,heading\n"); }),
                HasSubstr(":1: column width is missing"));
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { read("frame,x,y,length,width,heading,x\n"); }),
                HasSubstr("column x is there twice"));
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { read(std::string("\0\1\2\3", 4)); }), HasSubstr("not text"));
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { readBoxCsv(folder_ / "none.csv"); }), HasSubstr("none.csv"));
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { readBoxCsv(folder_.path()); }), HasSubstr("is a folder"));
}

TEST_F(BoxCsv, NumbersDoNotDependOnTheLocale) {
    const char* old = std::setlocale(LC_ALL, nullptr);
    const std::string before = old == nullptr ? "C" : old;
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE"})
        if (std::setlocale(LC_ALL, name) != nullptr) break;
    BoxesByFrame boxes;
    boxes[0] = {record(0, 1, 0.5)};
    writeResultCsv(folder_ / "r.csv", boxes);
    EXPECT_THAT(test::bytesOf(folder_ / "r.csv"), HasSubstr("12.3456"));
    expectSame(readBoxCsv(folder_ / "r.csv").at(0)[0], boxes[0][0]);
    std::setlocale(LC_ALL, before.c_str());
}

TEST_F(BoxCsv, WritingFailsWithoutTouchingWhatIsThere) {
    const BoxesByFrame boxes;
    EXPECT_THAT(test::messageOf(ErrorKind::output, [&] { writeResultCsv(folder_ / "none" / "r.csv", boxes); }),
                HasSubstr("cannot be written"));
    std::filesystem::create_directory(folder_ / "r.csv");
    test::messageOf(ErrorKind::output, [&] { writeResultCsv(folder_ / "r.csv", boxes); });
    test::messageOf(ErrorKind::output, [&] { writeResultCsv("/dev/full", boxes); });
    writeResultCsv(folder_ / "ok.csv", boxes);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 2) << "no temporary file stays";
}

TEST(RealBoxCsv, GroundTruthIsRead) {
    EYRIE_NEED_SHARED_DATA("uavdt_m1303");
    const BoxesByFrame drone = readBoxCsv(test::sharedData("uavdt_m1303/ground_truth.csv"));
    EXPECT_EQ(drone.size(), 150U);
    const BoxesByFrame collage = readBoxCsv(test::sharedData("collage_day/ground_truth.csv"));
    EXPECT_NEAR(degreesFromRadians(collage.at(0)[0].box.heading), 186.51, 1e-9);
    EXPECT_EQ(collage.at(0)[0].id, 2);
}

}  // namespace
}  // namespace eyrie::box_csv_test

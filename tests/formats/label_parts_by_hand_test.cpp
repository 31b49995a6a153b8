#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/format_functions.h"
#include "formats/frame_offset.h"
#include "formats/mot/mot_classes.h"
#include "formats/sample_labels.h"

/// The parts that readers and writers share, each limit from both sides.
namespace eyrie::label_parts_by_hand_test {
namespace {

using test::messageOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

LabelBox boxOf(int frame, std::optional<int> id, const OrientedBox& box, const std::string& object_class = "car") {
    LabelBox record;
    record.frame = frame;
    record.id = id;
    record.box = box;
    record.object_class = object_class;
    return record;
}

TEST(LineByHand, FieldsAreSplitAtCommasOutsideOfQuotes) {
    const TextLine line("f", 3, " 12 , x,\"b \"\"c\"\", d\" ,,e\r");
    ASSERT_EQ(line.size(), 5U);
    EXPECT_EQ(line.text(0), "12");
    EXPECT_EQ(line.text(1), "x");
    EXPECT_EQ(line.text(2), "b \"c\", d");
    EXPECT_EQ(line.text(3), "");
    EXPECT_EQ(line.text(4), "e");
    EXPECT_EQ(TextLine("f", 3, "1,").size(), 2U) << "an empty field at the end is one";
    EXPECT_EQ(TextLine("f", 3, "1,\"a\"").size(), 2U);
    EXPECT_EQ(TextLine("f", 3, "1,\"a\",").size(), 3U);
    EXPECT_TRUE(TextLine("f", 3, "").blank());
    EXPECT_TRUE(TextLine("f", 3, " \t", ' ').blank());
    EXPECT_FALSE(TextLine("f", 3, ",").blank());
    EXPECT_THAT(messageOf([] { TextLine("f", 3, "1,\"a"); }), HasSubstr("f:3:3: a quote is opened"));
    EXPECT_THAT(messageOf([] { TextLine("f", 3, "1,\"a\" b"); }), HasSubstr("f:3:3: text follows a closing quote"));
}

TEST(LineByHand, ErrorsNameTheColumnOfTheField) {
    const auto columnOf = [](const std::string& text, std::size_t field, char separator = ',') {
        return messageOf([&] { TextLine("f", 3, text, separator).number(field, "size"); });
    };
    EXPECT_THAT(columnOf(" 12 , x", 1), HasSubstr("f:3:7:"));
    EXPECT_THAT(columnOf(" x", 0), HasSubstr("f:3:2:"));
    EXPECT_THAT(columnOf("1,x", 1), HasSubstr("f:3:3:"));
    EXPECT_THAT(columnOf(" 1  x", 1, ' '), HasSubstr("f:3:5:"));
    EXPECT_THAT(columnOf("1,2", 2), HasSubstr("f:3:3: the line ends before the size"));
}

TEST(LineByHand, BlanksSeparateHoweverManyThereAre) {
    const TextLine line("f", 1, "\t1  ab \r", ' ');
    ASSERT_EQ(line.size(), 2U);
    EXPECT_EQ(line.text(0), "1");
    EXPECT_EQ(line.text(1), "ab");
}

TEST(LineByHand, NumbersAreFiniteAndInRange) {
    const auto taken = [](const char* text, const auto& read) {
        return messageOf([&] { read(TextLine("f", 1, text)); }) == "no error";
    };
    const auto number = [](const TextLine& line) { line.number(0, "x"); };
    for (const char* good : {"5", "+5", "-5.25", "1e3", "0"}) EXPECT_TRUE(taken(good, number)) << good;
    for (const char* bad : {"", "++5", "5x", "inf", "nan", "5 6", "1e999"}) EXPECT_FALSE(taken(bad, number)) << bad;
    const auto whole = [](const TextLine& line) { line.integer(0, "x"); };
    for (const char* good : {"2147483647", "-2147483647", "3.0"}) EXPECT_TRUE(taken(good, whole)) << good;
    for (const char* bad : {"2147483648", "-2147483648", "1.5"}) EXPECT_FALSE(taken(bad, whole)) << bad;
    const auto pixels = [](const TextLine& line) { line.pixels(0, "x"); };
    for (const char* good : {"10000000", "-10000000"}) EXPECT_TRUE(taken(good, pixels)) << good;
    for (const char* bad : {"10000001", "-10000001"}) EXPECT_FALSE(taken(bad, pixels)) << bad;
    const auto size = [](const TextLine& line) { line.size(0, "x"); };
    EXPECT_TRUE(taken("0", size));
    EXPECT_FALSE(taken("-0.1", size));
    const auto frame = [](const TextLine& line) { line.frame(0, 1); };
    for (const char* good : {"1", "9999999"}) EXPECT_TRUE(taken(good, frame)) << good;
    for (const char* bad : {"0", "10000000"}) EXPECT_FALSE(taken(bad, frame)) << bad;
    EXPECT_EQ(TextLine("f", 1, "7").frame(0, 1), 6);
    EXPECT_EQ(TextLine("f", 1, "7").frame(0, 0), 7);
    const auto identity = [](const TextLine& line) { line.identity(0); };
    EXPECT_TRUE(taken("0", identity));
    EXPECT_FALSE(taken("-1", identity));
    const auto word = [](const TextLine& line) { line.word(0, "x"); };
    EXPECT_TRUE(taken("a b", word));
    EXPECT_FALSE(taken("a\x1f", word));
}

TEST(LineByHand, Utf8IsToldAtTheEndsOfItsRanges) {
    for (const char* good : {"", "a\x7F", "\xC2\x80", "\xDF\xBF", "\xE0\xA0\x80", "\xED\x9F\xBF", "\xEE\x80\x80",
                             "\xEF\xBF\xBF", "\xF0\x90\x80\x80", "\xF4\x8F\xBF\xBF", "\xC2\x80\xC2\x80"})
        EXPECT_TRUE(isUtf8(good)) << good;
    for (const char* bad :
         {"\x80", "\xC1\xBF", "\xC2", "\xC2\xC0", "\xE0\x9F\xBF", "\xE1\x80", "\xE1\x80\xC0", "\xED\xA0\x80",
          "\xF0\x8F\xBF\xBF", "\xF1\x80\x80", "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "a\xC2"})
        EXPECT_FALSE(isUtf8(bad)) << bad;
}

TEST(PartsByHand, LeadingNumbersEndAtTheFirstWord) {
    EXPECT_THAT(leadingNumbers("1,-2.5,x,3", ','), ElementsAre(1, -2.5));
    EXPECT_THAT(leadingNumbers("1,2\r", ','), ElementsAre(1, 2));
    EXPECT_THAT(leadingNumbers("1,2,", ','), ElementsAre(1, 2));
    EXPECT_THAT(leadingNumbers(" 1\t 2 ", ' '), ElementsAre(1, 2));
    EXPECT_THAT(leadingNumbers("x,1", ','), IsEmpty());
    EXPECT_THAT(leadingNumbers("", ','), IsEmpty());
}

TEST(PartsByHand, NamesAndCounts) {
    EXPECT_EQ(numberedName(0), "000000");
    EXPECT_EQ(numberedName(41), "000041");
    EXPECT_EQ(numberedName(999'999), "999999");
    EXPECT_EQ(numberedName(1'234'567), "1234567");
    EXPECT_EQ(counted(0, "box", "boxes"), "0 boxes");
    EXPECT_EQ(counted(1, "box", "boxes"), "1 box");
    EXPECT_EQ(counted(2, "box", "boxes"), "2 boxes");
}

TEST(PartsByHand, FramesReachAtLeastToTheLastBox) {
    LabelFile labels;
    EXPECT_EQ(framesToWrite(labels), 0);
    labels.boxes[5].push_back(boxOf(5, 1, {{5, 5}, 4, 2, 0}));
    EXPECT_EQ(framesToWrite(labels), 6);
    labels.frame_count = 3;
    EXPECT_EQ(framesToWrite(labels), 6);
    labels.frame_count = 10;
    EXPECT_EQ(framesToWrite(labels), 10);
    labels.frame_count = 1'000'000;
    EXPECT_EQ(imagesToWrite(labels, "d"), 1'000'000);
    labels.frame_count = 1'000'001;
    EXPECT_THROW(imagesToWrite(labels, "d"), Error);
}

TEST(PartsByHand, FiveReasonsOfRowsLeftOutAreToldAndTheOthersCounted) {
    const auto notesOf = [](int rows) {
        LabelFile labels;
        labels.boxes[0].push_back(boxOf(0, 1, {{5, 5}, 4, 2, 0}));
        LeftOutRows left_out;
        for (int row = 0; row < rows; ++row) left_out.add(Error(ErrorKind::input, "row " + std::to_string(row)));
        left_out.tell(labels);
        return labels.notes;
    };
    EXPECT_THAT(notesOf(0), IsEmpty());
    EXPECT_THAT(notesOf(1), ElementsAre("left out: row 0"));
    EXPECT_EQ(notesOf(5).size(), 5U);
    EXPECT_EQ(notesOf(6).back(), "left out: 1 row more for such reasons");
    EXPECT_EQ(notesOf(7).back(), "left out: 2 rows more for such reasons");
    LeftOutRows all;
    all.add(Error(ErrorKind::input, "row 0"));
    LabelFile none;
    EXPECT_THROW(all.tell(none), Error) << "nothing was read";
    EXPECT_THROW(all.add(Error(ErrorKind::output, "disk")), Error) << "no fault of the row";
}

TEST(PartsByHand, BoxesByEdgesAndByCornersAreTheSame) {
    const OrientedBox by_edges = boxByEdges(TextLine("f", 1, "x,11,21,30,40"), 1, 1);
    const OrientedBox by_corners = boxByCorners(TextLine("f", 1, "x,11,21,41,61"), 1, 1);
    for (const OrientedBox& box : {by_edges, by_corners}) {
        EXPECT_EQ(box.centre, cv::Point2d(24.5, 39.5));
        EXPECT_EQ(box.length, 30);
        EXPECT_EQ(box.width, 40);
    }
    EXPECT_EQ(boxByCorners(TextLine("f", 1, "1,2,1,2"), 0, 0).area(), 0) << "no extent is one";
    EXPECT_THAT(messageOf([] { boxByCorners(TextLine("f", 1, "1,2,0.9,5"), 0, 0); }), HasSubstr("f:1:5: the right"));
    EXPECT_THAT(messageOf([] { boxByCorners(TextLine("f", 1, "1,2,5,1.9"), 0, 0); }), HasSubstr("f:1:7: the bottom"));
}

TEST(PartsByHand, AnImageHasBothSides) {
    EXPECT_EQ(neededSize(cv::Size(1, 1), "f", "YOLO"), cv::Size(1, 1));
    EXPECT_THROW(neededSize(cv::Size(0, 9), "f", "YOLO"), Error);
    EXPECT_THROW(neededSize(cv::Size(9, 0), "f", "YOLO"), Error);
    EXPECT_THROW(neededSize(std::nullopt, "f", "YOLO"), Error);
}

TEST(EdgesByHand, ATurnCountsWhereItMovesAnEdgeByFiveThousandths) {
    // A turn t moves the edges of a box by about width · t / 2 in its length: here by t · 100.
    EXPECT_FALSE(isTurned({{0, 0}, 200, 200, 0.00004}));
    EXPECT_TRUE(isTurned({{0, 0}, 200, 200, 0.00006}));
    for (const double quarter : {0.0, kPi / 2, -kPi / 2, kPi}) EXPECT_FALSE(isTurned({{0, 0}, 200, 100, quarter}));
    EXPECT_TRUE(isTurned({{0, 0}, 200, 100, kPi / 4}));
}

TEST(EdgesByHand, AQuarterTurnSwapsTheSides) {
    const BoxEdges lying = edgesOf({{24.5, 39.5}, 30, 40, kPi}, 0);
    EXPECT_EQ(lying.left, 10);
    EXPECT_EQ(lying.top, 20);
    EXPECT_EQ(lying.width, 30);
    EXPECT_EQ(lying.height, 40);
    const BoxEdges upended = edgesOf({{24.5, 39.5}, 40, 30, kPi / 2}, 1);
    EXPECT_EQ(upended.left, 11) << "where pixels count from 1";
    EXPECT_EQ(upended.top, 21);
    EXPECT_EQ(upended.width, 30);
    EXPECT_EQ(upended.height, 40);
}

TEST(EdgesByHand, CornersTellTheDirectionAlsoWithoutLength) {
    const CornerBox flat = boxFromCorners({cv::Point2d(0, 0), {4, 0}, {4, 0}, {0, 0}});
    EXPECT_EQ(flat.box.length, 0);
    EXPECT_EQ(flat.box.width, 4);
    EXPECT_NEAR(flat.box.heading, -kPi / 2, 1e-12) << "the front left corner is left on screen";
    EXPECT_NEAR(flat.departure, 0, 1e-12);
    // One corner of a square of 10 px, 4 px too far to the front: the mean rectangle is 2 px longer and leans back.
    const CornerBox skewed = boxFromCorners({cv::Point2d(14, 0), {10, 10}, {0, 10}, {0, 0}});
    EXPECT_EQ(skewed.box.centre, cv::Point2d(6, 5));
    EXPECT_EQ(skewed.box.length, 12);
    EXPECT_EQ(skewed.box.heading, 0);
    EXPECT_NEAR(skewed.box.width, std::hypot(2, 10), 1e-12);
    // Its corners lie at x = 0 and 12, and at half its width on both sides of y = 5.
    EXPECT_NEAR(skewed.departure, std::hypot(2, std::hypot(2, 10) / 2 - 5), 1e-12);
}

TEST(ReportByHand, ACentreOnTheImagesEdgeIsInside) {
    const auto outside = [](double x, double y) {
        LabelFile labels;
        labels.image_size = cv::Size(100, 60);
        labels.boxes[0] = {boxOf(0, 1, {{x, y}, 4, 2, 0})};
        return reportOn(labels).outside;
    };
    for (const cv::Point2d in : {cv::Point2d(-0.5, 5), {99.5, 5}, {5, -0.5}, {5, 59.5}})
        EXPECT_EQ(outside(in.x, in.y), 0);
    for (const cv::Point2d out : {cv::Point2d(-0.6, 5), {99.6, 5}, {5, -0.6}, {5, 59.6}})
        EXPECT_EQ(outside(out.x, out.y), 1);
}

TEST(ReportByHand, AsksAboutScaleAndShiftWhereTheyLookWrong) {
    LabelFile labels;
    labels.image_size = cv::Size(100, 60);
    labels.frame_count = 4;
    for (int frame = 0; frame < 4; ++frame) labels.boxes[frame] = {boxOf(frame, 1, {{50, 30}, 4, 2, 0})};
    EXPECT_THAT(reportOn(labels).notes, IsEmpty());
    labels.boxes[0][0].box.centre.x = 200;
    EXPECT_THAT(reportOn(labels).notes, ElementsAre("1 boxes have their centre outside the image")) << "a quarter";
    labels.boxes[1][0].box.centre.y = 200;
    EXPECT_THAT(reportOn(labels).notes, ElementsAre(HasSubstr("is the scale right?")));
    labels.frame_count = 3;
    EXPECT_THAT(reportOn(labels).notes, Contains(HasSubstr("last box is in frame 3, but only 3 frames are declared")));
    labels.boxes[2] = {boxOf(2, {}, {{5, 5}, 4, 2, 0.5}), boxOf(2, {}, {{5, 5}, 4, 2, 0})};
    labels.boxes[2][1].ignore = true;
    labels.boxes[7] = {};
    const LabelReport report = reportOn(labels);
    EXPECT_EQ(report.without_id, 2);
    EXPECT_EQ(report.loose, 1);
    EXPECT_EQ(report.turned, 1);
    EXPECT_EQ(report.frames, 4);
    EXPECT_EQ(report.last_frame, 3) << "frame 7 has no box";
}

/// A car of 20 px that drives 30 px a frame, so that neighbouring frames do not overlap.
BoxesByFrame fastCar(int frames, int late, double aside = 0) {
    BoxesByFrame boxes;
    for (int frame = 0; frame < frames; ++frame)
        boxes[frame + late] = {boxOf(frame + late, 1, {{30.0 * frame + aside, 40}, 20, 10, 0})};
    return boxes;
}

TEST(OffsetByHand, IsFoundWithinItsReachEitherWay) {
    const BoxesByFrame tracks = fastCar(40, 10);
    EXPECT_EQ(guessFrameOffset(fastCar(40, 13), tracks, 3)->shift, -3);
    EXPECT_EQ(guessFrameOffset(fastCar(40, 7), tracks, 3)->shift, 3);
    EXPECT_FALSE(guessFrameOffset(fastCar(40, 13), tracks, 2));
    EXPECT_EQ(guessFrameOffset(fastCar(40, 13), tracks, 3)->overlap_as_is, 0);
}

TEST(OffsetByHand, NeedsTwentyPairsThatOverlapByAFifth) {
    EXPECT_TRUE(guessFrameOffset(fastCar(20, 0), fastCar(20, 0), 3));
    EXPECT_FALSE(guessFrameOffset(fastCar(19, 0), fastCar(19, 0), 3));
    EXPECT_TRUE(guessFrameOffset(fastCar(20, 0, 12), fastCar(20, 0), 3)) << "8 px of 32";
    EXPECT_FALSE(guessFrameOffset(fastCar(20, 0, 14), fastCar(20, 0), 3)) << "6 px of 34; the next are 16 px off";
}

TEST(ObjectsByHand, NumbersAreRaisedWhereTheyBeginBelowOne) {
    const auto idsOf = [](int first, int second) {
        LabelFile labels;
        labels.boxes[0] = {boxOf(0, first, {{5, 5}, 4, 2, 0}), boxOf(0, second, {{50, 5}, 4, 2, 0})};
        const ImportedLabels imported = annotationsOf(labels);
        std::vector<int> ids{imported.id_step};
        for (const auto& [id, object] : imported.annotations.objects) ids.push_back(object.id);
        return ids;
    };
    EXPECT_THAT(idsOf(1, 5), ElementsAre(0, 1, 5));
    EXPECT_THAT(idsOf(0, 4), ElementsAre(1, 1, 5));
    EXPECT_THAT(idsOf(-3, 4), ElementsAre(4, 1, 8));
}

TEST(ObjectsByHand, AnObjectTakesItsMostFrequentClassAndGoesOutsideOverAGapOfOneFrame) {
    LabelFile labels;
    for (const int frame : {0, 1, 3}) labels.boxes[frame] = {boxOf(frame, 1, {{5.0 + frame, 5}, 4, 2, 0}, "van")};
    for (const int frame : {0, 1}) labels.boxes[frame].push_back(boxOf(frame, 2, {{50, 5}, 4, 2, 0}, "car"));
    EXPECT_THAT(annotationsOf(labels).notes, IsEmpty()) << "none changes";
    labels.boxes[0][0].object_class = "bus";
    const ImportedLabels imported = annotationsOf(labels);
    const LabelledObject& object = imported.annotations.objects.at(1);
    EXPECT_EQ(object.object_class, "van");
    EXPECT_EQ(imported.annotations.objects.at(2).object_class, "car");
    EXPECT_THAT(imported.notes, ElementsAre(HasSubstr("1 objects change their class")));
    ASSERT_EQ(object.keyframes.size(), 4U);
    EXPECT_EQ(object.keyframes[2].frame, 2);
    EXPECT_TRUE(object.keyframes[2].outside);
    EXPECT_EQ(object.keyframes[2].box.centre.x, 6) << "where it was seen last";
    EXPECT_EQ(object.last_frame, 3);
}

TEST(ObjectsByHand, AnAreaThatRestsAFrameOrChangesIsAnotherRegion) {
    const auto regionsOf = [](std::vector<std::pair<int, OrientedBox>> areas) {
        LabelFile labels;
        for (const auto& [frame, box] : areas) {
            labels.boxes[frame].push_back(boxOf(frame, {}, box));
            labels.boxes[frame].back().ignore = true;
        }
        return annotationsOf(labels).annotations.regions;
    };
    const OrientedBox box{{20, 20}, 10, 8, 0};
    EXPECT_EQ(regionsOf({{0, box}, {1, box}, {2, box}}).size(), 1U);
    EXPECT_EQ(regionsOf({{0, box}, {2, box}}).size(), 2U);
    const OrientedBox beside{{200, 20}, 9, 9, 0};
    EXPECT_EQ(regionsOf({{0, box}, {1, box}, {1, beside}}).size(), 2U) << "one that begins after one that goes on";
    EXPECT_EQ(regionsOf({{0, box}, {0, box}, {1, box}, {1, box}}).size(), 2U) << "two at one place are two";
    for (const OrientedBox& other :
         {OrientedBox{{21, 20}, 10, 8, 0}, {{20, 20}, 11, 8, 0}, {{20, 20}, 10, 9, 0}, {{20, 20}, 10, 8, 0.1}})
        EXPECT_EQ(regionsOf({{0, box}, {1, other}}).size(), 2U);
    const IgnoreRegion region = regionsOf({{4, box}, {5, box}}).at(1);
    EXPECT_EQ(region.first_frame, 4);
    EXPECT_EQ(region.reference_frame, 4);
    EXPECT_EQ(region.last_frame, 5);
    EXPECT_EQ(region.polygon.size(), 4U);
}

TEST(MotClassesByHand, AreTheBenchmarks) {
    const std::vector<std::string> words{"",           "person",  "person", "car",   "bicycle",
                                         "motorcycle", "vehicle", "person", "other", "other"};
    for (int number = 0; number < 10; ++number)
        EXPECT_EQ(classFromMot(number), words.at(static_cast<std::size_t>(number))) << number;
    EXPECT_EQ(classFromMot(-1), "");
    const auto written = [](const char* word) {
        return std::pair(motFromClass(word).number, motFromClass(word).exact);
    };
    EXPECT_EQ(written("person"), std::pair(1, true));
    EXPECT_EQ(written("car"), std::pair(3, true));
    EXPECT_EQ(written("bicycle"), std::pair(4, true));
    EXPECT_EQ(written("motorcycle"), std::pair(5, true));
    EXPECT_EQ(written("vehicle"), std::pair(6, true));
    EXPECT_EQ(written("bus"), std::pair(6, false));
    EXPECT_EQ(written("two_wheeler"), std::pair(5, false));
    EXPECT_EQ(written("other"), std::pair(8, true));
    EXPECT_EQ(written("boat"), std::pair(8, false));
    EXPECT_EQ(written(""), std::pair(-1, true));
}

}  // namespace
}  // namespace eyrie::label_parts_by_hand_test

#include "formats/mot/motchallenge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/error.h"
#include "core/geometry/angle.h"
#include "support/error_message.h"
#include "support/shared_data.h"
#include "support/temporary_folder.h"

namespace eyrie::motchallenge_test {
namespace {

using testing::HasSubstr;

class MotChallenge : public testing::Test {
 protected:
    std::filesystem::path write(const std::string& text) {
        const auto path = folder_ / "boxes.txt";
        std::ofstream(path, std::ios::binary) << text;
        return path;
    }
    std::string messageFor(const std::string& text, bool truth = true) {
        try {
            if (truth) {
                readMotTruth(write(text));
            } else {
                readMotResult(write(text));
            }
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            return error.what();
        }
        return "no error";
    }
    static std::string textOf(const std::filesystem::path& path) {
        std::stringstream text;
        text << std::ifstream(path, std::ios::binary).rdbuf();
        return text.str();
    }

    test::TemporaryFolder folder_;
};

TEST_F(MotChallenge, FirstPixelAndFirstFrameAreOne) {
    const LabelBoxes boxes = readMotTruth(write("1,4,1,1,1,1,1,3,0.5\n"));
    ASSERT_EQ(boxes.size(), 1u);
    const BoxRecord& record = boxes.at(0).at(0);
    EXPECT_EQ(record.frame, 0);
    EXPECT_EQ(record.id, 4);
    EXPECT_EQ(record.box.centre, cv::Point2d(0, 0));  // our first pixel
    EXPECT_EQ(record.box.length, 1);
    EXPECT_EQ(record.object_class, "car");
    EXPECT_FALSE(record.ignore);
}

TEST_F(MotChallenge, PixelsMayBeginElsewhere) {
    const auto path = write("1,1,203,247,97,56,1,1,1\n");
    EXPECT_EQ(readMotTruth(path, {.first_pixel_edge = 0}).at(0)[0].box.centre, cv::Point2d(251, 274.5));
    EXPECT_EQ(readMotTruth(path, {.first_pixel_edge = -0.5}).at(0)[0].box.centre, cv::Point2d(251.5, 275));
}

TEST_F(MotChallenge, FlagZeroIsIgnoredAndMayRepeatAnId) {
    const LabelBoxes boxes = readMotTruth(write("3,1,10,10,5,5,0,8,1\n3,1,40,10,5,5,0,8,1\n3,1,70,10,5,5,1,3,1\n"));
    EXPECT_TRUE(boxes.at(2)[0].ignore);
    EXPECT_EQ(boxes.at(2)[0].object_class, "other");
    EXPECT_FALSE(boxes.at(2)[2].ignore);
}

TEST_F(MotChallenge, ResultsCarryAScoreAndDetectionsNoId) {
    const BoxesByFrame boxes = readMotResult(write("2,-1,10,20,30,40,0.25,-1,-1,-1\r\n\n2, 7, 1.5, 2.5, 3, 4\n"));
    EXPECT_FALSE(boxes.at(1)[0].id);
    EXPECT_EQ(boxes.at(1)[0].score, 0.25);
    EXPECT_EQ(boxes.at(1)[1].id, 7);
    EXPECT_EQ(boxes.at(1)[1].score, 1);
    EXPECT_TRUE(boxes.at(1)[0].object_class.empty());
}

TEST_F(MotChallenge, AnEmptyFileHoldsNoBoxes) {
    EXPECT_TRUE(readMotResult(write("")).empty());
}

TEST_F(MotChallenge, MalformedLinesAreNamedWithTheirPlace) {
    const std::string good = "1,1,10,10,5,5,1,3,1\n";
    EXPECT_THAT(messageFor(good + "1,2,10,ten,5,5,1,3,1\n"), HasSubstr("boxes.txt:2:8: \"ten\" is not a number"));
    EXPECT_THAT(messageFor(good + "0,2,10,10,5,5,1,3,1\n"), HasSubstr(":2:1: frame 0"));
    EXPECT_THAT(messageFor("1.5,2,10,10,5,5\n"), HasSubstr(":1:1: \"1.5\" is not a whole number"));
    EXPECT_THAT(messageFor("1,2,10,10,-5,5\n"), HasSubstr(":1:11: the width is negative"));
    EXPECT_THAT(messageFor("1,2,10,10,5,-5\n"), HasSubstr("the height is negative"));
    EXPECT_THAT(messageFor("1,2,nan,10,5,5\n"), HasSubstr(":1:5: \"nan\" is not a number"));
    EXPECT_THAT(messageFor("1,2,1e999,10,5,5\n"), HasSubstr(":1:5:"));
    EXPECT_THAT(messageFor("1,2,,10,5,5\n"), HasSubstr(":1:5:"));
    EXPECT_THAT(messageFor("99999999999,2,1,10,5,5\n"), HasSubstr("whole number in range"));
    EXPECT_THAT(messageFor("1 2 10 10 5 5\n"), HasSubstr("1 columns, expected 6 to 10"));
    EXPECT_THAT(messageFor("1,2,10,10,5\n"), HasSubstr("5 columns"));
    EXPECT_THAT(messageFor("1,2,3,4,5,6,7,8,9,10,11\n"), HasSubstr("11 columns"));
    EXPECT_THAT(messageFor(good + good), HasSubstr(":2:3: id 1 has a box in this frame already, in line 1"));
    EXPECT_THAT(messageFor(good + good, false), HasSubstr("already"));
    EXPECT_THAT(messageFor(std::string("1,1,10\0,10,5,5\n", 15)), HasSubstr("zero bytes"));
    EXPECT_THROW(readMotTruth(folder_ / "absent.txt"), Error);
    EXPECT_THROW(readMotTruth(folder_.path()), Error);
}

BoxesByFrame someBoxes() {
    BoxesByFrame boxes;
    for (int frame = 0; frame < 3; ++frame) {
        for (int id = 1; id < 4; ++id) {
            BoxRecord record;
            record.frame = frame;
            record.id = id;
            record.box = {{10.25 * id + frame, 20.125 + frame}, 12.5, 6.0 + id, 0};
            record.object_class = id == 1 ? "car" : "person";
            record.ignore = id == 3;
            record.score = 0.25 * id;
            boxes[frame].push_back(record);
        }
    }
    return boxes;
}

TEST_F(MotChallenge, UprightTruthComesBackAsItWas) {
    const BoxesByFrame before = someBoxes();
    const MotLosses losses = writeMotTruth(folder_ / "gt.txt", before);
    EXPECT_EQ(losses.boxes, 9);
    EXPECT_EQ(losses.turned + losses.classes + losses.velocities, 0);
    const LabelBoxes after = readMotTruth(folder_ / "gt.txt");
    ASSERT_EQ(after.size(), before.size());
    for (const auto& [frame, records] : before) {
        for (std::size_t k = 0; k < records.size(); ++k) {
            const BoxRecord& a = records[k];
            const BoxRecord& b = after.at(frame).at(k);
            EXPECT_EQ(a.id, b.id);
            EXPECT_EQ(a.object_class, b.object_class);
            EXPECT_EQ(a.ignore, b.ignore);
            EXPECT_NEAR(a.box.centre.x, b.box.centre.x, 1e-3);
            EXPECT_NEAR(a.box.centre.y, b.box.centre.y, 1e-3);
            EXPECT_NEAR(a.box.length, b.box.length, 1e-3);
            EXPECT_NEAR(a.box.width, b.box.width, 1e-3);
        }
    }
    EXPECT_THAT(textOf(folder_ / "gt.txt"), HasSubstr("1,1,5.5,"));
}

TEST_F(MotChallenge, TurnedBoxesAreEnclosedAndReported) {
    BoxesByFrame boxes = someBoxes();
    boxes.at(0)[0].box.heading = kPi / 2;
    boxes.at(0)[0].velocity = {1, 0};
    boxes.at(0)[1].object_class = "truck";
    boxes.at(0)[1].box.heading = kPi;  // upright as well, as after any quarter turn
    boxes.at(1)[0].box.heading = 0.6;
    const MotLosses losses = writeMotTruth(folder_ / "gt.txt", boxes);
    EXPECT_EQ(losses.turned, 1);
    EXPECT_EQ(losses.velocities, 1);
    EXPECT_EQ(losses.classes, 1);
    const BoxRecord back = readMotTruth(folder_ / "gt.txt").at(0)[0];
    EXPECT_NEAR(back.box.length, 7, 1e-3);
    EXPECT_NEAR(back.box.width, 12.5, 1e-3);
    EXPECT_NEAR(back.box.centre.x, 10.25, 1e-3);
}

TEST_F(MotChallenge, EveryClassOneIsForTrackEval) {
    writeMotTruth(folder_ / "gt.txt", someBoxes(), {.pixels = {}, .every_class_one = true});
    const std::string text = textOf(folder_ / "gt.txt");
    EXPECT_THAT(text, HasSubstr(",1,1,1\n"));
    EXPECT_THAT(text, testing::Not(HasSubstr(",1,3,1\n")));
}

TEST_F(MotChallenge, ResultsRoundTripWithTenColumns) {
    BoxesByFrame boxes = someBoxes();
    boxes.at(1)[1].id.reset();
    writeMotResult(folder_ / "result.txt", boxes);
    EXPECT_THAT(textOf(folder_ / "result.txt"), HasSubstr(",0.25,-1,-1,-1\n"));
    const BoxesByFrame back = readMotResult(folder_ / "result.txt");
    EXPECT_FALSE(back.at(1)[1].id);
    EXPECT_EQ(back.at(2)[2].id, 3);
    EXPECT_EQ(back.at(2)[2].score, 0.75);
}

TEST_F(MotChallenge, WhatCannotBeWrittenIsAnError) {
    EXPECT_THROW(writeMotResult(folder_ / "absent" / "result.txt", someBoxes()), Error);
    BoxesByFrame boxes = someBoxes();
    boxes.at(1)[1].id.reset();
    EXPECT_THROW(writeMotTruth(folder_ / "gt.txt", boxes), Error);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "gt.txt"));
}

TEST_F(MotChallenge, SequenceInformation) {
    const MotSequence sequence = readMotSequence(
        write("[Sequence]\r\nname=a\nimDir=img1\nframeRate=29.97\nseqLength=60\nimWidth=1024\n imHeight = 540\n"));
    EXPECT_EQ(sequence.frame_count, 60);
    EXPECT_EQ(sequence.frame_rate_hz, 29.97);
    EXPECT_EQ(sequence.image_size, cv::Size(1024, 540));
    EXPECT_FALSE(readMotSequence(write("[Sequence]\nimWidth=1024\n")).image_size);
    EXPECT_THROW(readMotSequence(write("seqLength=many\n")), Error);
    for (const char* key : {"imWidth", "imHeight", "seqLength", "frameRate"}) {
        for (const char* wrong : {"0", "-4", "4x", "x", ""})
            EXPECT_THAT(
                test::messageOf(
                    [&] { readMotSequence(write("[Sequence]\n" + std::string(key) + "=" + wrong + "\n")); }),
                testing::HasSubstr(":2: " + std::string(key) + " = \"" + wrong + "\", expected a number above 0"));
        EXPECT_EQ(test::messageOf([&] { readMotSequence(write(std::string(key) + "=1\n")); }), "no error") << key;
    }
}

TEST_F(MotChallenge, RealGroundTruthMeetsTheDerivedTable) {
    EYRIE_NEED_SHARED_DATA("uavdt_m1303");
    // ground_truth.csv says of the first object in frame 0: centre (251, 274.5), 97 × 56 px; UAVDT counts from 0.
    const auto path = test::sharedData("uavdt_m1303") / "gt" / "M1303_gt.txt";
    const LabelBoxes boxes = readMotTruth(path, {.first_pixel_edge = 0});
    const BoxRecord& first = boxes.at(0).at(0);
    EXPECT_EQ(first.box.centre, cv::Point2d(251, 274.5));
    EXPECT_EQ(first.box.length, 97);
    EXPECT_EQ(first.box.width, 56);
}

}  // namespace
}  // namespace eyrie::motchallenge_test

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/sample_labels.h"

/// Tables of boxes as their own programs have them: the text to the letter, and what may stand in each column.
namespace eyrie::tables_by_hand_test {
namespace {

using test::messageOf;
using test::textOf;
using test::writeText;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class TablesByHand : public testing::Test {
 protected:
    LabelFile read(const std::string& name, const std::string& text, const std::string& format,
                   const ImportOptions& options = {}) const {
        return readLabels(writeText(folder_ / name, text), format, options);
    }
    /// Whether a text is taken.
    bool taken(const std::string& name, const std::string& text, const std::string& format) const {
        return messageOf([&] { read(name, text, format); }) == "no error";
    }
    static LabelBox edged(int frame, int id, const BoxEdges& edges, const std::string& object_class) {
        LabelBox record;
        record.frame = frame;
        record.id = id;
        record.box = boxFromEdges(edges, 0);
        record.object_class = object_class;
        return record;
    }
    std::string written(const LabelFile& labels, const std::string& name, const std::string& format) {
        report_ = writeLabels(labels, folder_ / name, format);
        return textOf(folder_ / name);
    }
    static std::vector<std::string> remarksOf(const ExportReport& report) {
        std::vector<std::string> remarks;
        for (const ExportLoss& loss : report.losses) remarks.push_back(loss.remark);
        return remarks;
    }

    test::TemporaryFolder folder_;
    ExportReport report_;
};

TEST_F(TablesByHand, VisDroneHasTwelveCategories) {
    std::string text;
    for (int category = -1; category < 12; ++category)
        text += "1," + std::to_string(category + 1) + ",0,0,9,9,1," + std::to_string(category) + ",0,0\n";
    const LabelFile labels = read("v.txt", text, "visdrone");
    std::vector<std::string> words;
    for (const LabelBox& box : labels.boxes.at(0)) words.push_back(box.object_class);
    EXPECT_THAT(words, ElementsAre("", "", "person", "person", "bicycle", "car", "van", "truck", "tricycle",
                                   "awning-tricycle", "bus", "motorcycle", "other"));
    EXPECT_FALSE(labels.boxes.at(0)[0].ignore);
    EXPECT_TRUE(labels.boxes.at(0)[1].ignore);
    EXPECT_FALSE(labels.boxes.at(0)[1].id) << "an area";
    EXPECT_EQ(labels.boxes.at(0)[2].id, 2);
    EXPECT_THAT(labels.notes, ElementsAre("1 box of category \"people\" became persons"));
    EXPECT_FALSE(taken("v.txt", "1,1,0,0,9,9,1,-2,0,0\n", "visdrone"));
    EXPECT_FALSE(taken("v.txt", "1,1,0,0,9,9,1,12,0,0\n", "visdrone"));
}

TEST_F(TablesByHand, VisDroneTellsScoresTruncationAndOcclusion) {
    const LabelFile labels = read("v.txt",
                                  "1,-1,0,0,9,9,0.25,4,0,-1\n1,2,20,0,9,9,0,4,1,0\n1,3,40,0,9,9,1,4,1,1\n"
                                  "1,0,60,0,9,9,1,4,0,2,\n",
                                  "visdrone");
    const auto& boxes = labels.boxes.at(0);
    ASSERT_EQ(boxes.size(), 4U);
    EXPECT_FALSE(boxes[0].id);
    EXPECT_EQ(boxes[3].id, 0);
    EXPECT_EQ(boxes[0].score, 0.25);
    EXPECT_EQ(boxes[1].score, 1);
    EXPECT_TRUE(boxes[1].ignore);
    EXPECT_FALSE(boxes[0].ignore);
    EXPECT_EQ(boxes[0].occlusion, Occlusion::none);
    EXPECT_EQ(boxes[2].occlusion, Occlusion::partly);
    EXPECT_EQ(boxes[3].occlusion, Occlusion::fully);
    EXPECT_THAT(labels.notes, ElementsAre(HasSubstr("2 boxes are cut by the border")));
    for (const char* bad : {"1,1,0,0,9,9,1,4,0,3\n", "1,1,0,0,9,9,1,4,0,-2\n", "1,1,0,0,9,9,1,4,0\n",
                            "1,1,0,0,9,9,1,4,0,0,5\n", "0,1,0,0,9,9,1,4,0,0\n"})
        EXPECT_FALSE(taken("v.txt", bad, "visdrone")) << bad;
}

TEST_F(TablesByHand, VisDroneIsWrittenInWholePixels) {
    LabelFile labels;
    labels.boxes[0] = {edged(0, 7, {10.4, 20.6, 30, 40}, "car"), edged(0, 8, {1, 2, 3, 4}, "two_wheeler"),
                       edged(0, 9, {5, 6, 7, 8}, "boat"), edged(0, 10, {9, 9, 9, 9}, "car")};
    labels.boxes[0][0].occlusion = Occlusion::partly;
    labels.boxes[0][3].ignore = true;
    EXPECT_EQ(written(labels, "v.txt", "visdrone"),
              "1,7,10,21,30,40,1,4,0,1\n1,8,1,2,3,4,1,10,0,0\n1,9,5,6,7,8,1,11,0,0\n1,10,9,9,9,9,0,0,0,0\n");
    EXPECT_EQ(report_.lost(LossKind::rounded), 1);
    EXPECT_EQ(report_.lost(LossKind::class_name), 3);
    const auto remarks = remarksOf(report_);
    EXPECT_THAT(remarks, Contains(HasSubstr("became cars or motors")));
    EXPECT_THAT(remarks, Contains(HasSubstr("became \"others\"")));
    EXPECT_THAT(remarks, Contains(HasSubstr("became ignored areas")));
}

TEST_F(TablesByHand, VisDroneIsKnownByTheRangesOfItsColumns) {
    const auto formatOf = [&](const std::string& text) {
        try {
            return sniffLabelFormat(writeText(folder_ / "s.txt", text));
        } catch (const Error&) {
            return std::string();
        }
    };
    const std::string good = "1,1,0,0,9,9,1,4,0,0\n";
    EXPECT_EQ(formatOf(good), "visdrone");
    EXPECT_EQ(formatOf(good + "1,2,0,0,9,9,1,11,1,2\n1,3,0,0,9,9,1,0,0,0\n"), "visdrone");
    for (const char* other :
         {"1,1,0,0,9,9,1,12,0,0\n", "1,1,0,0,9,9,1,-1,-1,-1\n", "1,1,0,0,9,9,1,4,2,0\n", "1,1,0,0,9,9,1,4,0,3\n"}) {
        EXPECT_EQ(formatOf(other), "mot-result") << other;
        EXPECT_EQ(formatOf(good + other), "mot-result") << "every line counts";
    }
}

TEST_F(TablesByHand, UavdtReadsItsDegreesAndNothingElse) {
    const LabelFile labels = read(
        "u_gt_whole.txt", "1,1,0,0,9,9,1,1,1\n1,2,20,0,9,9,2,2,2\n1,3,40,0,9,9,3,3,3\n1,4,60,0,9,9,1,4,1\n", "uavdt");
    std::vector<std::string> words;
    std::vector<bool> occluded;
    for (const LabelBox& box : labels.boxes.at(0)) {
        words.push_back(box.object_class);
        occluded.push_back(box.occlusion == Occlusion::partly);
    }
    EXPECT_THAT(words, ElementsAre("car", "truck", "bus", "car"));
    EXPECT_THAT(occluded, ElementsAre(false, true, true, true));
    EXPECT_THAT(labels.notes,
                ElementsAre(HasSubstr("2 boxes lie partly out of view"), HasSubstr("degree of occlusion")));
    EXPECT_THAT(read("u_gt_whole.txt", "1,1,0,0,9,9,1,1,1\n", "uavdt").notes, IsEmpty());
    for (const char* bad : {"1,1,0,0,9,9,1,0,1\n", "1,1,0,0,9,9,1,5,1\n", "1,1,0,0,9,9,1,1,0\n", "1,1,0,0,9,9,1,1,4\n",
                            "1,1,0,0,9,9,1,1\n", "0,1,0,0,9,9,1,1,1\n", "1,-1,0,0,9,9,1,1,1\n"})
        EXPECT_FALSE(taken("u_gt_whole.txt", bad, "uavdt")) << bad;
    const LabelFile plain = read("p_gt.txt", "1,1,0,0,9,9,1,1,-1\n2,1,0,0,9,9,0,1,-1\n", "uavdt");
    EXPECT_FALSE(plain.boxes.at(0)[0].ignore);
    EXPECT_TRUE(plain.boxes.at(1)[0].ignore);
    const LabelFile areas = read("a_gt_ignore.txt", "1,1,0,0,9,9,1,-1,-1\n", "uavdt");
    EXPECT_TRUE(areas.boxes.at(0)[0].ignore);
    EXPECT_FALSE(areas.boxes.at(0)[0].id);
}

TEST_F(TablesByHand, UavdtIsWrittenAsThreeTexts) {
    LabelFile labels;
    labels.image_size = cv::Size(100, 60);
    labels.boxes[1] = {edged(1, 1, {0, 0, 100, 60}, "car"), edged(1, 2, {-1, 5, 9, 9}, "truck"),
                       edged(1, 3, {5, -1, 9, 9}, "bus"),   edged(1, 4, {92, 5, 9, 9}, "boat"),
                       edged(1, 5, {5, 52, 9, 9}, "car"),   edged(1, 6, {10.4, 20.6, 30, 9}, "car")};
    labels.boxes[1][1].occlusion = Occlusion::partly;
    labels.boxes[1][2].occlusion = Occlusion::fully;
    labels.boxes[1][5].ignore = true;
    EXPECT_EQ(written(labels, "u_gt.txt", "uavdt"),
              "2,1,0,0,100,60,1,1,-1\n2,2,-1,5,9,9,1,1,-1\n2,3,5,-1,9,9,1,1,-1\n2,4,92,5,9,9,1,1,-1\n"
              "2,5,5,52,9,9,1,1,-1\n");
    EXPECT_EQ(textOf(folder_ / "u_gt_whole.txt"),
              "2,1,0,0,100,60,1,1,1\n2,2,-1,5,9,9,1,3,2\n2,3,5,-1,9,9,1,2,3\n2,4,92,5,9,9,1,1,1\n2,5,5,52,9,9,1,1,1\n");
    EXPECT_EQ(textOf(folder_ / "u_gt_ignore.txt"), "2,6,10,21,30,9,1,-1,-1\n");
    EXPECT_EQ(report_.lost(LossKind::rounded), 1);
    EXPECT_EQ(report_.lost(LossKind::occlusion), 2);
    EXPECT_EQ(report_.lost(LossKind::other), 4) << "one over each border; what fills the image is in it";
    EXPECT_EQ(report_.lost(LossKind::class_name), 2) << "a boat, and the class of an area";
}

TEST_F(TablesByHand, ViratHasSixTypesAndItsDurations) {
    const LabelFile labels = read("v.txt",
                                  "0 1 0 0 0 9 9 0\n1 1 0 20 0 9 9 1\n2 1 0 40 0 9 9 2\n3 1 0 60 0 9 9 3\n"
                                  "4 1 0 80 0 9 9 4\n5 1 0 100 0 9 9 5\n",
                                  "virat");
    std::vector<std::string> words;
    for (const LabelBox& box : labels.boxes.at(0)) words.push_back(box.object_class);
    EXPECT_THAT(words, ElementsAre("", "person", "car", "vehicle", "other", "bicycle"));
    for (const char* bad : {"0 1 0 0 0 9 9 6\n", "0 1 0 0 0 9 9 -1\n", "0 1 0 0 0 9 9\n", "0 1 0 0 0 9 9 1 1\n"})
        EXPECT_FALSE(taken("v.txt", bad, "virat")) << bad;
    EXPECT_THAT(messageOf([&] { read("v.txt", "0 1 0 0 0 9 9 1 1 1\n", "virat"); }), HasSubstr("VIRAT events"));
    LabelFile ours;
    ours.boxes[3] = {edged(3, 2, {10.5, 20.25, 30, 40}, "bus"), edged(3, 5, {1, 2, 3, 4}, "motorcycle")};
    ours.boxes[4] = {edged(4, 2, {11, 20, 30, 40}, "bus"), edged(4, 6, {1, 2, 3, 4}, "boat")};
    EXPECT_EQ(written(ours, "w.txt", "virat"),
              "2 2 3 10.5 20.25 30 40 3\n2 2 4 11 20 30 40 3\n5 1 3 1 2 3 4 5\n6 1 4 1 2 3 4 4\n");
    EXPECT_EQ(report_.lost(LossKind::class_name), 4);
}

TEST_F(TablesByHand, VividMarksPersonsByANegativeWidth) {
    const LabelFile labels =
        read("t.csv", "image,frame,id,x,y,w,h\na.jpg,3,1,10,20,-30,40\na.jpg,3,2,10,20,30,40\n", "vivid");
    ASSERT_EQ(labels.boxes.at(3).size(), 2U);
    EXPECT_TRUE(labels.boxes.at(3)[0].ignore);
    EXPECT_EQ(labels.boxes.at(3)[0].object_class, "person");
    EXPECT_EQ(labels.boxes.at(3)[0].box.centre, cv::Point2d(24.5, 39.5));
    EXPECT_FALSE(labels.boxes.at(3)[1].ignore);
    EXPECT_EQ(labels.image_names.at(3), "a.jpg");
    EXPECT_FALSE(taken("t.csv", "h\na.jpg,3,1,10,20,30\n", "vivid"));
    LabelFile ours;
    ours.boxes[3] = {edged(3, 1, {10, 20, 30, 40}, ""), edged(3, 2, {0, 0, 1, 1}, "")};
    ours.boxes[3][1].ignore = true;
    EXPECT_EQ(written(ours, "w.csv", "vivid"),
              "image,frame,id,x,y,w,h\nframe000003.jpg,3,1,10,20,30,40\nframe000003.jpg,3,2,0,0,-1,1\n");
}

TEST_F(TablesByHand, Kw18TellsMiddlesCornersAreaAndTime) {
    LabelFile labels;
    labels.frame_rate_hz = 10;
    labels.boxes[3] = {edged(3, 2, {10, 20, 30, 40}, "car")};
    labels.boxes[3][0].velocity = {1.5, -2};
    labels.boxes[5] = {edged(5, 2, {10, 20, 30, 40}, "car")};
    const std::string text = written(labels, "k.kw18", "kw18");
    EXPECT_EQ(text.substr(text.find('\n') + 1),
              "2 2 3 0 0 1.5 -2 25 40 10 20 40 60 1200 0 0 0 0.3\n2 2 5 0 0 0 0 25 40 10 20 40 60 1200 0 0 0 0.5\n");
    labels.boxes[5][0].score = 0.25;
    const std::string scored = written(labels, "k.kw18", "kw18");
    EXPECT_THAT(scored, HasSubstr(" 0 0 0 0.3 1\n"));
    EXPECT_THAT(scored, HasSubstr(" 0 0 0 0.5 0.25\n"));
    const std::string row = "2 2 3 0 0 1.5 -2 25 40 10 20 40 60 1200 0 0 0 0.3";
    const LabelFile back = read("b.kw18", row + " 0.75\n" + row.substr(0, 4) + "4" + row.substr(5) + "\n", "kw18");
    EXPECT_EQ(back.boxes.at(3)[0].velocity, cv::Point2d(1.5, -2));
    EXPECT_EQ(back.boxes.at(3)[0].score, 0.75);
    EXPECT_EQ(back.boxes.at(3)[0].box.centre, cv::Point2d(24.5, 39.5));
    EXPECT_THAT(back.notes, IsEmpty()) << "two states, as declared";
    EXPECT_THAT(read("c.kw18", row + "\n", "kw18").notes, ElementsAre("1 track has another length than declared"));
    EXPECT_THAT(read("d.kw18", row + " 1 2\n", "kw18").notes, Contains(HasSubstr("types and activities")));
    EXPECT_FALSE(taken("e.kw18", row + " 1 2 3\n", "kw18"));
    EXPECT_FALSE(taken("e.kw18", row.substr(0, row.size() - 4) + "\n", "kw18"));
}

TEST_F(TablesByHand, ViameHasAConfidenceAClassAndAttributes) {
    const LabelFile labels = read("v.csv",
                                  "0,a.png,0,10,20,40,60,-1,-1,car,0.5,bus,0.5,van,0.75\n"
                                  "1,a.png,0,10,20,40,60,0,-1,car,0.5,bus,0.25,(note) x,(kp) head 1 2\n"
                                  "2,a.png,0,10,20,40,60,0.25,-1,(atr) rotation 1000,(atr) occluded true\n"
                                  "3,a.png,0,10,20,40,60,0.25,-1,(atr) rotation 1000.5\n",
                                  "viame");
    const auto& boxes = labels.boxes.at(0);
    ASSERT_EQ(boxes.size(), 3U);
    EXPECT_EQ(boxes[0].object_class, "van");
    EXPECT_EQ(boxes[0].score, 1) << "nobody said";
    EXPECT_EQ(boxes[0].box.centre, cv::Point2d(24.5, 39.5));
    EXPECT_EQ(boxes[1].object_class, "car");
    EXPECT_EQ(boxes[1].score, 0);
    EXPECT_EQ(boxes[2].occlusion, Occlusion::partly);
    EXPECT_THAT(labels.notes, Contains(HasSubstr("2 entries of other kinds")));
    EXPECT_THAT(labels.notes, Contains(HasSubstr("not an angle in radians")));
    EXPECT_EQ(read("e.csv", "0,a.png,0,10,20,40,60,1,-1,car,0.5,bus,0.5\n", "viame").boxes.at(0)[0].object_class, "car")
        << "the first of two that are as sure";

    LabelFile ours;
    ours.frame_rate_hz = 12.5;
    ours.boxes[3] = {edged(3, 2, {10, 20, 30, 40}, "car"), edged(3, 4, {10, 20, 30, 40}, "")};
    ours.boxes[3][0].box.heading = 0.5;
    ours.boxes[3][0].occlusion = Occlusion::fully;
    ours.boxes[3][0].score = 0.25;
    ours.boxes[3][1].box.heading = 0.0009;
    ours.boxes[3][1].ignore = true;
    ours.boxes[3][1].occlusion = Occlusion::partly;
    const std::string text = written(ours, "w.csv", "viame");
    EXPECT_THAT(text, HasSubstr("# metadata,fps: 12.5\n# metadata,Fps: 12.5\n"));
    EXPECT_THAT(text, HasSubstr("\n2,000003,3,10,20,40,60,0.25,-1,car,0.25,(atr) rotation 0.5,(atr) occluded fully\n"
                                "4,000003,3,10,20,40,60,1,-1,(atr) occluded partly,(atr) ignore true\n"));
    ours.boxes[3][1].box.heading = -0.0012;
    EXPECT_THAT(written(ours, "w.csv", "viame"), HasSubstr("(atr) rotation -0.0012"));
}

TEST_F(TablesByHand, ViameIsKnownByAnyOfTheFirstTwentyLines) {
    const auto known = [&](const std::string& text) {
        return test::messageOf([&] { EXPECT_EQ(sniffLabelFormat(writeText(folder_ / "s.csv", text)), "viame"); }) ==
               "no error";
    };
    const std::string row = "0,a.png,0,10,20,40,60,1,-1";
    EXPECT_TRUE(known(row + "\n")) << "a class is not needed";
    EXPECT_TRUE(known(row + ",car,1\n"));
    EXPECT_TRUE(known("0,a.png,0,10,20,40,60,,\n")) << "nor confidence and length";
    EXPECT_FALSE(known("0,a.png,0,10,20,40,60,1\n"));
    EXPECT_FALSE(known("x,a.png,0,10,20,40,60,1,-1\n"));
    for (const char* wrong :
         {"0,a.png,x,10,20,40,60,1,-1\n", "0,a.png,0,x,20,40,60,1,-1\n", "0,a.png,0,10,20,40,,1,-1\n",
          "0,a.png,0,10,20,40,60,x,-1\n", "0,a.png,0,10,20,40,60,1,x\n"})
        EXPECT_FALSE(known(wrong)) << wrong;
    const auto behind = [&](int lines, const std::string& line) {
        std::string text;
        for (int i = 0; i < lines; ++i) text += line;
        return known(text + row + "\n");
    };
    EXPECT_TRUE(behind(19, "# said\n"));
    EXPECT_FALSE(behind(20, "# said\n"));
    EXPECT_TRUE(behind(300, " \t\n")) << "empty lines say nothing";
    EXPECT_TRUE(behind(19, "0,\"a broken row\n")) << "which is left out";
    // Without a head, numbers alone could be a table of anything.
    EXPECT_FALSE(known("0,1,0,10,20,40,60,1,-1,5\n"));
    EXPECT_TRUE(known("# head\n0,1,0,10,20,40,60,1,-1,5\n"));
}

TEST_F(TablesByHand, ViamesFrameRateStandsInItsHead) {
    const auto rateOf = [&](const std::string& head) {
        return read("r.csv", head + "\n0,a.png,0,10,20,40,60,1,-1,car,1\n", "viame").frame_rate_hz;
    };
    EXPECT_EQ(rateOf("# metadata,fps: 12.5"), 12.5);
    EXPECT_EQ(rateOf("# metadata,Fps: 12.5,exported_by: x"), 12.5);
    EXPECT_EQ(rateOf("# metadata,fps:5\r"), 5);
    EXPECT_EQ(rateOf("# Fps: 3, fps: 4"), 4);
    for (const char* none : {"# metadata,fps: 0", "# metadata,fps: -5", "# metadata,fps: x", "# metadata,fps:", "# x"})
        EXPECT_FALSE(rateOf(none)) << none;
}

TEST_F(TablesByHand, MotIsKnownByItsFirstLine) {
    const auto formatOf = [&](const std::string& text) { return sniffLabelFormat(writeText(folder_ / "s.txt", text)); };
    for (const char* more : {"", ",3", ",3,0.5"}) {
        const std::string row = "1,7,10,20,30,40,1" + std::string(more) + "\n";
        EXPECT_EQ(formatOf(row), *more == '\0' ? "mot-result" : "mot") << row;
        EXPECT_EQ(formatOf(row + "the end\n"), *more == '\0' ? "mot-result" : "mot") << row;
    }
    EXPECT_EQ(formatOf("1,-1,10,20,30,40\n"), "mot-result");
    for (const char* other : {"0,7,10,20,30,40,1\n", "1,7,10,20,30\n", "1,7,10,20,30,40,1,3,1,1,1\n",
                              "1,7,10,20,30,40,1,\n", "1,7,10,20,30,40,\"1\"\n", "1,7,10,20,30,40,\"1\n"})
        EXPECT_THAT(messageOf([&] { formatOf(other); }), HasSubstr("matches no known format")) << other;
    EXPECT_EQ(formatOf("1,7,10,20,30,40,0.5,-1,-1,-1\n"), "mot-result");
    EXPECT_THAT(messageOf([&] { formatOf("1 7 10 20 30 40 1\n1,7,10,20,30,40,1,3\n"); }),
                HasSubstr("matches no known format"));
}

TEST_F(TablesByHand, YoloIsKnownByAClassAndSharesOfThePicture) {
    const auto isYolo = [&](const std::string& text) {
        std::string found;
        messageOf([&] { found = sniffLabelFormat(writeText(folder_ / "s.txt", text)); });
        return found == "yolo-obb";
    };
    const std::string box = "2 0.1 0.5 0.05 0.2", corners = "2 0.1 0.5 0.05 0.5 0.05 0.2 0.1 0.2";
    for (const std::string& line : {box, box + " 0.75", corners, corners + " 0.75"}) {
        EXPECT_TRUE(isYolo(line + "\n")) << line;
        EXPECT_TRUE(isYolo("\n \n" + line + "\n")) << line;
        EXPECT_FALSE(isYolo(line + " 1 1\n")) << line;
        EXPECT_FALSE(isYolo("-" + line + "\n")) << "no number of a class";
        EXPECT_FALSE(isYolo("2.5" + line.substr(1) + "\n")) << "no number of a class";
    }
    // A box may reach beyond the picture, but not by pictures; what follows is a score, however large.
    EXPECT_TRUE(isYolo("2 -3 3 0.05 0.2\n"));
    for (const char* far : {"2 3.1 0.5 0.05 0.2\n", "2 0.1 0.5 0.05 -3.1\n", "2 0.1 0.5 0.05 3.1 0.75\n",
                            "2 0.1 0.5 0.05 0.5 0.05 0.2 0.1 3.1\n", "2 3.1 0.5 0.05 0.5 0.05 0.2 0.1 0.2 0.75\n"})
        EXPECT_FALSE(isYolo(far)) << far;
    EXPECT_TRUE(isYolo(box + " 99\n"));
    EXPECT_TRUE(isYolo(corners + " 99\n"));
}

TEST_F(TablesByHand, ViratIsKnownByEightNumbersAndItsTypes) {
    const auto isVirat = [&](const std::string& text) {
        std::string found;
        messageOf([&] { found = sniffLabelFormat(writeText(folder_ / "s.txt", text)); });
        return found == "virat";
    };
    for (int type = 0; type <= 5; ++type) EXPECT_TRUE(isVirat("0 1 7 10 20 30 40 " + std::to_string(type) + "\n"));
    for (const char* other : {"0 1 7 10 20 30 40 -1\n", "0 1 7 10 20 30 40 6\n", "0 1 7 10 20 30 40\n",
                              "0 1 7 10 20 30 40 1 1\n", "0 1 7 10 20 30 40 1 x\n"})
        EXPECT_FALSE(isVirat(other)) << other;
}

TEST_F(TablesByHand, ColumnsMayBePartedByManyBlanks) {
    ImportOptions options;
    options.columns = "frame  id   x1 y1  w h";
    const LabelFile labels = read("c.txt", "4 7 10 20 30 40\n", "columns", options);
    ASSERT_EQ(labels.boxes.count(4), 1U);
    EXPECT_EQ(labels.boxes.at(4)[0].id, 7);
    EXPECT_EQ(labels.boxes.at(4)[0].box.length, 30);
    EXPECT_EQ(labels.boxes.at(4)[0].box.width, 40);
}

TEST_F(TablesByHand, TheListOfSequencesOfATrackEvalTreeGrows) {
    for (const ExportFile& file : filesToWrite(folder_ / "tree", "trackeval"))
        EXPECT_EQ(file.grows, file.path.parent_path().filename() == "seqmaps") << file.path;
    ExportOptions tracker;
    tracker.tracker = "ours";
    for (const ExportFile& file : filesToWrite(folder_ / "tree", "trackeval", tracker)) EXPECT_FALSE(file.grows);
}

TEST_F(TablesByHand, AnyTwoColumnsOfAnAxisGiveTheSameBox) {
    const std::map<std::string, std::string> across{{"x1", "10"}, {"x2", "40"}, {"cx", "25"}, {"w", "30"}};
    const std::map<std::string, std::string> down{{"y1", "20"}, {"y2", "60"}, {"cy", "40"}, {"h", "40"}};
    LabelFile ours;
    ours.boxes[0] = {edged(0, 1, {10, 20, 30, 40}, "car")};
    const auto expectPair = [&](const std::string& columns, const std::string& values) {
        ImportOptions options;
        options.columns = "frame," + columns;
        const OrientedBox box = read("c.csv", "0," + values + "\n", "columns", options).boxes.at(0)[0].box;
        EXPECT_EQ(box.centre, cv::Point2d(24.5, 39.5)) << columns;
        EXPECT_EQ(box.length, 30) << columns;
        EXPECT_EQ(box.width, 40) << columns;
        ExportOptions written;
        written.columns = options.columns;
        writeLabels(ours, folder_ / "w.csv", "columns", written);
        EXPECT_EQ(textOf(folder_ / "w.csv"), "0," + values + "\n") << columns;
    };
    for (auto a = across.begin(); a != across.end(); ++a)
        for (auto b = std::next(a); b != across.end(); ++b)
            expectPair(a->first + "," + b->first + ",y1,h", a->second + "," + b->second + ",20,40");
    for (auto a = down.begin(); a != down.end(); ++a)
        for (auto b = std::next(a); b != down.end(); ++b)
            expectPair("x1,w," + a->first + "," + b->first, "10,30," + a->second + "," + b->second);
}

TEST_F(TablesByHand, OwnColumnsAreCheckedOneByOne) {
    const auto takenAs = [&](const std::string& columns, const std::string& text) {
        ImportOptions options;
        options.columns = columns;
        return messageOf([&] { read("c.csv", text, "columns", options); }) == "no error";
    };
    EXPECT_TRUE(takenAs("frame,x1,y1,x2,y2", "0,10,20,10,20\n")) << "no extent is one";
    EXPECT_FALSE(takenAs("frame,x1,y1,x2,y2", "0,10,20,9,60\n"));
    EXPECT_FALSE(takenAs("frame,x1,y1,x2,y2", "0,10,20,40\n"));
    EXPECT_FALSE(takenAs("frame,x1,y1,x2,y2", "0,10,20,40,60,5\n"));
    EXPECT_FALSE(takenAs("frame,x1,x2,cx,y1,h", "0,10,40,25,20,40\n")) << "three of one axis";
    EXPECT_FALSE(takenAs("frame,x1,y1,h", "0,10,20,40\n")) << "one of an axis";
    EXPECT_TRUE(takenAs("frame,x,y,w,h,heading", "0,10,20,30,40,1000000\n"));
    EXPECT_FALSE(takenAs("frame,x,y,w,h,heading", "0,10,20,30,40,1000001\n"));
    for (const char* good : {"0", "1", "2"})
        EXPECT_TRUE(takenAs("frame,x,y,w,h,occluded", std::string("0,1,1,3,4,") + good)) << good;
    for (const char* bad : {"-1", "3"})
        EXPECT_FALSE(takenAs("frame,x,y,w,h,occluded", std::string("0,1,1,3,4,") + bad)) << bad;
    EXPECT_TRUE(takenAs("frame,n,[id,x,y,w,h]", "0,2,1,10,20,30,40,2,50,20,30,40\n1,0\n"));
    EXPECT_TRUE(takenAs("frame,n,[id,x,y,w,h]", "0,1,1,10,20,30,40,\n")) << "a separator at the end";
    EXPECT_FALSE(takenAs("frame,n,[id,x,y,w,h]", "0,1,1,10,20,30,40,2,50,20,30,40\n"));
    EXPECT_FALSE(takenAs("frame,n,[id,x,y,w,h]", "0,-1\n"));
    EXPECT_FALSE(takenAs("frame,[id,x,y,w,h]", "0,1,10,20,30\n")) << "a piece of a box";
    for (const char* bad :
         {"frame", "frame,x,y,w,h,x", "x,y,w,h", "[frame,x,y,w,h]", "frame,[[x,y,w,h]]", "frame,x],y,w,h",
          "frame,[x,y,w,h", "frame,[x,y,w,h],id", "frame,n,x,y,w,h", "frame,class,classid,x,y,w,h"})
        EXPECT_FALSE(takenAs(bad, "0,1,1,1,1,1,1,1\n")) << bad;
}

TEST_F(TablesByHand, OwnColumnsAreReadByTheirMeaning) {
    ImportOptions options;
    options.columns = "frame;n;[id;classid;x;y;w;h;heading;score;ignore;occluded;_]";
    options.first_frame_number = 1;
    options.first_pixel_edge = 1;
    const LabelFile labels =
        read("c.txt", "5;2;7;3;11;21;30;40;90;0.5;true;2;x;-1;0;11;21;30;40;0;1;0;0;x\n", "columns", options);
    ASSERT_EQ(labels.boxes.at(4).size(), 2U);
    const LabelBox& first = labels.boxes.at(4)[0];
    EXPECT_EQ(first.id, 7);
    EXPECT_EQ(first.object_class, "class 3");
    EXPECT_EQ(first.box.centre, cv::Point2d(24.5, 39.5));
    EXPECT_NEAR(first.box.heading, kPi / 2, 1e-12);
    EXPECT_EQ(first.score, 0.5);
    EXPECT_TRUE(first.ignore);
    EXPECT_EQ(first.occlusion, Occlusion::fully);
    EXPECT_FALSE(labels.boxes.at(4)[1].id);
    EXPECT_FALSE(labels.boxes.at(4)[1].ignore);
    EXPECT_EQ(labels.first_frame_number, 1);
    options.columns = "image,x1,y1,x2,y2";
    options.first_frame_number.reset();
    const LabelFile images =
        read("d.txt", "image,x1,y1,x2,y2\nb.png,1,1,2,2\na.png,1,1,2,2\nb.png,5,5,6,6\n", "columns", options);
    EXPECT_EQ(images.boxes.at(0).size(), 2U);
    EXPECT_EQ(images.image_names.at(1), "a.png");
    EXPECT_THAT(images.notes, ElementsAre(HasSubstr("taken for a heading"), HasSubstr("order of the file")));
}

TEST_F(TablesByHand, ClassesWithoutNumbersTakeThoseThatAreFree) {
    LabelFile ours;
    ours.boxes[0] = {edged(0, 1, {1, 2, 3, 4}, "van"), edged(0, 2, {1, 2, 3, 4}, "class 1"),
                     edged(0, 3, {1, 2, 3, 4}, "bus"), edged(0, 4, {1, 2, 3, 4}, "car")};
    ExportOptions options;
    options.columns = "frame,id,classid,x,y,w,h";
    options.first_frame_number = 1;
    writeLabels(ours, folder_ / "w.csv", "columns", options);
    EXPECT_EQ(textOf(folder_ / "w.csv"), "1,1,3,1,2,3,4\n1,2,1,1,2,3,4\n1,3,0,1,2,3,4\n1,4,2,1,2,3,4\n");
    options.columns = "frame,n,[id,x,y,w,h]";
    writeLabels(ours, folder_ / "w.csv", "columns", options);
    EXPECT_EQ(textOf(folder_ / "w.csv"), "1,4,1,1,2,3,4,2,1,2,3,4,3,1,2,3,4,4,1,2,3,4\n");
}

TEST_F(TablesByHand, BoxesAreCutAtEachBorderWhereAsked) {
    LabelFile labels;
    labels.image_size = cv::Size(100, 60);
    labels.boxes[0] = {edged(0, 1, {-5, 10, 20, 10}, "car"), edged(0, 2, {10, -5, 20, 10}, "car"),
                       edged(0, 3, {90, 10, 20, 10}, "car"), edged(0, 4, {10, 55, 20, 10}, "car"),
                       edged(0, 5, {0, 0, 100, 60}, "car")};
    ExportOptions options;
    options.clip = true;
    const ExportReport report = writeLabels(labels, folder_ / "c.txt", "virat", options);
    EXPECT_EQ(textOf(folder_ / "c.txt"),
              "1 1 0 0 10 15 10 2\n2 1 0 10 0 20 5 2\n3 1 0 90 10 10 10 2\n4 1 0 10 55 20 5 2\n5 1 0 0 0 100 60 2\n");
    EXPECT_EQ(report.lost(LossKind::clipped), 4);
}

TEST_F(TablesByHand, LossesAreCountedOneByOne) {
    LabelFile labels;
    for (int id = 1; id <= 4; ++id) labels.boxes[0].push_back(edged(0, id, {40.0 * id, 20, 30, 10}, "car"));
    labels.boxes[0][0].box.heading = kPi;    // a heading, no rotation
    labels.boxes[0][1].box.heading = 0.009;  // a rotation, if a small one
    labels.boxes[0][2].box.heading = 1e-4;   // neither
    labels.boxes[0][3].score = 0.5;
    labels.boxes[0][3].velocity = {1, 0};
    const ExportReport report = writeLabels(labels, folder_ / "l.txt", "virat");
    EXPECT_EQ(report.lost(LossKind::heading), 1);
    EXPECT_EQ(report.lost(LossKind::rotation), 1);
    EXPECT_EQ(report.lost(LossKind::score), 1);
    EXPECT_EQ(report.lost(LossKind::velocity), 1);
    EXPECT_EQ(report.lost(LossKind::id), 0);
    EXPECT_EQ(report.lost(LossKind::clipped), 0);
}

TEST_F(TablesByHand, ScaleAndShiftReachAllThatAFileSays) {
    writeText(folder_ / "seqinfo.ini", "[Sequence]\nseqLength=60\nimWidth=101\nimHeight=50\n");
    ImportOptions options;
    options.scale = 0.5;
    options.frame_shift = 7;
    const LabelFile labels = read("m.txt", "1,1,11,21,30,40,1,3,1\n", "mot", options);
    EXPECT_EQ(labels.frame_count, 67);
    EXPECT_EQ(labels.image_size, cv::Size(50, 25));
    const OrientedBox box = labels.boxes.at(7)[0].box;
    EXPECT_EQ(box.centre, cv::Point2d(12, 19.5)) << "(24.5 + .5) / 2 − .5, (39.5 + .5) / 2 − .5";
    EXPECT_EQ(box.width, 20);
    options.frame_shift = 0;
    const LabelFile dota = read("P1.txt", "gsd:0.2\n20 50 10 50 10 20 20 20 car 0\n", "dota", options);
    EXPECT_EQ(dota.gsd_m, 0.4);
    options.scale = 1;
    options.frame_shift = 9'999'999;
    EXPECT_TRUE(read("n.txt", "1,1,11,21,30,40,1,3,1\n", "mot", options).boxes.contains(9'999'999));
    options.frame_shift = 10'000'000;
    EXPECT_THROW(read("n.txt", "1,1,11,21,30,40,1,3,1\n", "mot", options), Error);
}

TEST_F(TablesByHand, MotTellsFlagClassAndVisibility) {
    const LabelFile labels =
        read("m.txt", "1,0,1,1,9,9,1,3,1\n1,-1,21,1,9,9,1,3,0.5\n1,2,41,1,9,9,0,3,0\n1,3,61,1,9,9,1,3,-1\n", "mot");
    const auto& boxes = labels.boxes.at(0);
    EXPECT_EQ(boxes[0].id, 0);
    EXPECT_FALSE(boxes[1].id);
    EXPECT_EQ(boxes[0].occlusion, Occlusion::none);
    EXPECT_EQ(boxes[1].occlusion, Occlusion::partly);
    EXPECT_EQ(boxes[2].occlusion, Occlusion::fully);
    EXPECT_EQ(boxes[3].occlusion, Occlusion::none);
    EXPECT_FALSE(boxes[1].ignore);
    EXPECT_TRUE(boxes[2].ignore);
    LabelFile ours;
    ours.boxes[4] = {edged(4, 2, {10, 20, 30, 40}, "bus"), edged(4, 3, {1, 2, 3, 4}, "car")};
    ours.boxes[4][1].occlusion = Occlusion::fully;
    ours.boxes[4][1].ignore = true;
    EXPECT_EQ(written(ours, "w.txt", "mot"), "5,2,11,21,30,40,1,6,1\n5,3,2,3,3,4,0,3,0\n");
    EXPECT_EQ(written(ours, "r.txt", "mot-result"), "5,2,11,21,30,40,1,-1,-1,-1\n5,3,2,3,3,4,1,-1,-1,-1\n");
}

TEST_F(TablesByHand, CvatKeepsAKeyframeWhereSomethingChanges) {
    LabelFile ours;
    for (int frame = 0; frame < 5; ++frame)
        ours.boxes[frame] = {edged(frame, 1, {10.0 + 2 * frame, 20, 30, 40}, "car")};
    ours.boxes[3][0].occlusion = Occlusion::partly;
    ours.boxes[4][0].occlusion = Occlusion::partly;
    ours.frame_count = 8;
    const std::string text = written(ours, "c.xml", "cvat");
    EXPECT_THAT(text, HasSubstr("<size>8</size>"));
    EXPECT_THAT(text, HasSubstr("<stop_frame>7</stop_frame>"));
    const auto keyframes = [](const std::string& all) {
        std::string frames;
        for (std::size_t at = all.find("<box frame"); at != std::string::npos; at = all.find("<box frame", at + 1))
            if (all.compare(at + 14, 12, " keyframe=\"1") == 0) frames += all[at + 12];
        return frames;
    };
    EXPECT_EQ(keyframes(text), "0345") << "steady motion until the occlusion begins; the last one is outside";
    EXPECT_THAT(text, HasSubstr("frame=\"5\" keyframe=\"1\" outside=\"1\""));
    EXPECT_THAT(report_.notes, Contains(HasSubstr("4 keyframes reproduce")));
    ours.frame_count = 5;
    EXPECT_THAT(written(ours, "c.xml", "cvat"), Not(HasSubstr("outside=\"1\""))) << "it ends with the video";
}

}  // namespace
}  // namespace eyrie::tables_by_hand_test

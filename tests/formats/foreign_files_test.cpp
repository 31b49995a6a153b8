#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "formats/sample_labels.h"

/// Files as other programs write them, with what their own readers make of them.
namespace eyrie::foreign_files_test {
namespace {

using test::textOf;
using test::writeText;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

class ForeignFiles : public testing::Test {
 protected:
    LabelFile read(const std::string& name, const std::string& text, const std::string& format = "auto",
                   const ImportOptions& options = {}) {
        return readLabels(writeText(folder_ / name, text), format, options);
    }
    static LabelBox boxOf(int frame, int id, const OrientedBox& box, const std::string& object_class) {
        LabelBox record;
        record.frame = frame;
        record.id = id;
        record.box = box;
        record.object_class = object_class;
        return record;
    }
    test::TemporaryFolder folder_;
};

TEST_F(ForeignFiles, ALabelsTextBesideMotTellsClassesAndPixelsFromZero) {
    writeText(folder_ / "gt/labels.txt", "car\ntruck\n  bus\n");
    const std::string text =
        "1,1,10,20,30,40,1,1,1.0\n1,2,50,20,30,40,1,3,0.0\n2,-1,5,5,4,4,0,2,1.0\n2,7,5,5,4,4,1,9,1\n";
    const LabelFile labels = read("gt/gt.txt", text);
    EXPECT_EQ(labels.format, "mot-cvat");
    EXPECT_THAT(labels.classes, ElementsAre("car", "truck", "bus"));
    EXPECT_EQ(labels.boxes.at(0)[0].object_class, "car");
    EXPECT_EQ(labels.boxes.at(0)[0].box.centre, cv::Point2d(24.5, 39.5));
    EXPECT_EQ(labels.boxes.at(0)[1].object_class, "bus");
    EXPECT_EQ(labels.boxes.at(0)[1].occlusion, Occlusion::partly);
    EXPECT_FALSE(labels.boxes.at(1)[0].id.has_value());
    EXPECT_TRUE(labels.boxes.at(1)[0].ignore);
    EXPECT_EQ(labels.boxes.at(1)[1].object_class, "class 9");
    EXPECT_THAT(labels.notes, Contains(AllOf(HasSubstr("labels.txt"), HasSubstr("count from 0"))));
    // the folder, and by the name of the benchmark's format, it is the same
    EXPECT_EQ(readLabels(folder_.path()).boxes.at(0)[1].object_class, "bus");
    EXPECT_EQ(readLabels(folder_ / "gt/gt.txt", "mot").boxes.at(0)[1].object_class, "bus");
    ImportOptions options;
    options.first_pixel_edge = 1;
    const LabelFile told = read("gt/gt.txt", text, "auto", options);
    EXPECT_EQ(told.boxes.at(0)[0].box.centre, cv::Point2d(23.5, 38.5));
    EXPECT_THAT(told.notes, testing::Not(Contains(HasSubstr("count from 0"))));
    // without the list it is the benchmark's
    const LabelFile plain = read("other/gt.txt", text);
    EXPECT_EQ(plain.format, "mot");
    EXPECT_EQ(plain.boxes.at(0)[0].object_class, "person");
    EXPECT_EQ(plain.boxes.at(0)[0].box.centre, cv::Point2d(23.5, 38.5));
}

TEST_F(ForeignFiles, FramesFromZeroAreSeenWithALabelsText) {
    writeText(folder_ / "gt/labels.txt", "car");
    const LabelFile labels = read("gt/gt.txt", "1,1,10,20,30,40,1,1,1.0\n0,1,10,20,30,40,1,1,1.0\n");
    EXPECT_EQ(labels.boxes.begin()->first, 0);
    EXPECT_EQ(labels.boxes.rbegin()->first, 1);
    EXPECT_EQ(labels.first_frame_number, 0);
    EXPECT_THAT(labels.notes, Contains(HasSubstr("frames count from 0")));
}

TEST_F(ForeignFiles, MotForCvatSitsWhereCvatReadsIt) {
    LabelFile labels;
    labels.boxes[0] = {boxOf(0, 0, {{24.5, 39.5}, 30, 40, 0}, "truck"), boxOf(0, 3, {{60, 60}, 10, 10, 0}, "")};
    labels.boxes[0][0].occlusion = Occlusion::partly;
    labels.boxes[4] = {boxOf(4, 3, {{60, 60}, 10, 10, 0}, "")};
    const ExportReport report = writeLabels(labels, folder_ / "task", "mot-cvat");
    EXPECT_EQ(textOf(folder_ / "task/gt/gt.txt"),
              "1,1,10,20,30,40,1,2,0\n1,4,55.5,55.5,10,10,1,1,1\n5,4,55.5,55.5,10,10,1,1,1\n");
    EXPECT_EQ(textOf(folder_ / "task/gt/labels.txt"), "object\ntruck");
    EXPECT_THAT(report.notes, Contains(HasSubstr("pixels count from 0")));
    const LabelFile back = readLabels(folder_ / "task");
    EXPECT_EQ(back.boxes.at(0)[0].box.centre, cv::Point2d(24.5, 39.5));
    EXPECT_EQ(back.boxes.at(0)[0].object_class, "truck");
    EXPECT_EQ(back.boxes.at(0)[0].occlusion, Occlusion::partly);
    // the benchmark's says how it counts
    EXPECT_THAT(writeLabels(labels, folder_ / "m.txt", "mot").notes,
                Contains(AllOf(HasSubstr("count from 1"), HasSubstr("mot-cvat"))));
}

TEST_F(ForeignFiles, WhatIsSaidToBeEnclosedIs) {
    for (const double degrees : {0.4, 1.0, 2.0, 45.0, 89.0, 91.5, -179.2}) {
        LabelFile labels;
        labels.boxes[0] = {boxOf(0, 1, {{60, 50}, 22, 9, radiansFromDegrees(degrees)}, "car")};
        const OrientedBox enclosing = labels.boxes[0][0].box.upright();
        for (const std::string format : {"mot", "mot-result", "kw18", "virat", "vivid", "trackeval", "mot-cvat"}) {
            const auto path = folder_ / (format + std::to_string(degrees));
            const ExportReport report = writeLabels(labels, path, format);
            EXPECT_EQ(report.lost(LossKind::rotation), 1) << format;
            const OrientedBox written = readLabels(path, format).boxes.at(0)[0].box;
            EXPECT_NEAR(written.length, enclosing.length, 0.001) << format << degrees;
            EXPECT_NEAR(written.width, enclosing.width, 0.001) << format << degrees;
            EXPECT_NEAR(written.centre.x, enclosing.centre.x, 0.001) << format << degrees;
        }
    }
}

TEST_F(ForeignFiles, CocoPolygonsGiveTheBoxWhereThereIsNone) {
    const std::string head =
        R"({"images":[{"id":1,"file_name":"a.png"}],"categories":[{"id":1,"name":"car"}],"annotations":[)";
    const LabelFile labels =
        read("p.json", head + R"({"id":1,"image_id":1,"category_id":1,"segmentation":[[10,10,30,12,20,40]]},
            {"id":2,"image_id":1,"category_id":1,"bbox":[],"segmentation":[[0,0,5,0,5,5],[20,20,30,20,30,30]]},
            {"id":3,"image_id":1,"category_id":1,"segmentation":{"exterior":[[1,2],[11,2],[11,9],[1,9]]}},
            {"id":4,"image_id":1,"category_id":1,"bbox":[]},
            {"id":5,"image_id":1,"category_id":1,"segmentation":{"counts":"PPYo0","size":[10,10]}}]})");
    const std::vector<LabelBox>& boxes = labels.boxes.at(0);
    ASSERT_EQ(boxes.size(), 3u);
    EXPECT_EQ(boxes[0].box.centre, cv::Point2d(19.5, 24.5));
    EXPECT_EQ(boxes[0].box.length, 20);
    EXPECT_EQ(boxes[0].box.width, 30);
    EXPECT_EQ(boxes[1].box.centre, cv::Point2d(14.5, 14.5));
    EXPECT_EQ(boxes[1].box.length, 30);
    EXPECT_EQ(boxes[2].box.centre, cv::Point2d(5.5, 5));
    EXPECT_THAT(labels.notes, Contains(HasSubstr("3 annotations have no bbox; the box of the polygon was taken")));
    EXPECT_THAT(labels.notes, Contains(HasSubstr("2 annotations have no bbox and no polygon")));
    // nothing remains, and that is said
    const LabelFile none = read("n.json", head + R"({"id":4,"image_id":1,"category_id":1,"bbox":[]}]})");
    EXPECT_TRUE(none.boxes.empty());
    EXPECT_THAT(none.notes, Contains(HasSubstr("1 annotation has no bbox and no polygon")));
}

TEST_F(ForeignFiles, CvatPolygonsBecomeTheBoxesAroundThem) {
    const std::string head = "<annotations><meta><task><size>3</size></task></meta><track id=\"4\" label=\"car\">";
    const LabelFile labels =
        read("p.xml", head + R"(<polygon frame="0" keyframe="1" outside="0" points="10,20;30.5,22;15,40"/>
            <polygon frame="2" keyframe="1" outside="0" points="14,20;34.5,22;19,40"/></track></annotations>)");
    EXPECT_EQ(labels.boxes.at(0)[0].box.centre, cv::Point2d(19.75, 29.5));
    EXPECT_EQ(labels.boxes.at(0)[0].box.length, 20.5);
    EXPECT_EQ(labels.boxes.at(1)[0].box.centre, cv::Point2d(21.75, 29.5));
    EXPECT_THAT(labels.notes, Contains(HasSubstr("2 polygons became the boxes around them")));
    for (const char* bad : {"", "10", "10,x;3,4", ";"}) {
        EXPECT_THAT(test::messageOf([&] {
                        read("p.xml", head + "<polygon frame=\"0\" keyframe=\"1\" points=\"" + bad +
                                          "\"/></track></annotations>");
                    }),
                    HasSubstr("is not a point"));
    }
}

TEST_F(ForeignFiles, ViameTellsImagesApartByNameWhereFramesDoNot) {
    const LabelFile labels = read("seals.csv",
                                  "0,ims/C_10.png,0,10,10,20,20,1,-1,seal,1\n1,ims/C_9.png,0,30,10,40,20,1,-1,seal,1\n"
                                  "2,ims/C_9.png,0,50,10,60,20,1,-1,seal,1\n3,,0,50,10,60,20,1,-1,seal,1\n");
    EXPECT_EQ(labels.format, "viame");
    ASSERT_EQ(labels.boxes.size(), 2u);
    EXPECT_EQ(labels.boxes.at(0).size(), 2u);
    EXPECT_EQ(labels.image_names.at(0), "ims/C_9.png");
    EXPECT_EQ(labels.image_names.at(1), "ims/C_10.png");
    EXPECT_THAT(labels.notes, Contains(HasSubstr("frames are the images in the order of their names")));
    EXPECT_THAT(labels.notes, Contains(AllOf(HasSubstr(":4:"), HasSubstr("names no image"))));
}

TEST_F(ForeignFiles, OneBadRowOfViameIsLeftOutAndSaid) {
    const LabelFile labels = read("d.csv",
                                  "# metadata,fps: 10\n"
                                  "0,\"yard, north.png\",0,10,10,20,20,,-1,car,1\n"
                                  "1,\"yard, north.png\",0,40,10,30,20,1,-1,car,1\n"
                                  "2,\"yard, north.png\",0,nan,10,30,20,1,-1,car,1\n"
                                  "3,\"yard, north.png\",0,10,40,20,50,0.5,,car,0.5\n"
                                  "3,\"yard, north.png\",0,11,40,20,50,0.5,-1,car,0.5\n"
                                  "4,\"yard, north.png\n");
    EXPECT_EQ(labels.format, "viame");
    ASSERT_EQ(labels.boxes.at(0).size(), 2u);
    EXPECT_EQ(labels.boxes.at(0)[0].score, 1);
    EXPECT_EQ(labels.boxes.at(0)[1].id, 3);
    EXPECT_EQ(labels.image_names.at(0), "yard, north.png");
    const auto leftOut = [&](const char* place, const char* reason) {
        EXPECT_THAT(labels.notes, Contains(AllOf(HasSubstr("left out"), HasSubstr(place), HasSubstr(reason))));
    };
    leftOut("d.csv:3:", "right edge is left of the left one");
    leftOut("d.csv:4:", "is not a number");
    leftOut("d.csv:6:", "has a box in this frame already");
    leftOut("d.csv:7:", "never closed");
    // a name with a comma in the first line is no hindrance to knowing the format
    EXPECT_EQ(read("q.csv", "0,\"a,b.png\",0,10,10,20,20,1,-1,car,1\n").format, "viame");
}

TEST_F(ForeignFiles, OneBadEntryOfKwcocoIsLeftOutAndSaid) {
    const LabelFile labels =
        read("k.json",
             R"({"videos":[{"id":1,"name":"v"}],"images":[{"id":1,"file_name":"a.png","frame_index":0,"video_id":1}],
            "categories":[{"id":1},{"id":2,"name":"NaN car"}],"annotations":[
            {"id":1,"image_id":1,"category_id":2,"track_id":5,"bbox":[0,0,10,10],"score":NaN},
            {"id":2,"image_id":1,"category_id":2,"track_id":5,"bbox":[20,0,10,10]},
            {"id":3,"image_id":1,"category_id":1,"track_id":6,"bbox":[40,0,10,10]},
            {"id":4,"image_id":1,"category_id":2,"track_id":7,"bbox":[NaN,0,-Infinity,10]}]})");
    ASSERT_EQ(labels.boxes.at(0).size(), 2u);
    EXPECT_EQ(labels.boxes.at(0)[0].object_class, "NaN car");
    EXPECT_EQ(labels.boxes.at(0)[0].score, 1);
    EXPECT_EQ(labels.boxes.at(0)[1].object_class, "class 1");
    EXPECT_THAT(labels.notes, Contains(AllOf(HasSubstr("annotations[1]"), HasSubstr("has a box in frame 0 already"))));
    EXPECT_THAT(labels.notes, Contains(AllOf(HasSubstr("annotations[3].bbox[0]"), HasSubstr("is not a number"))));
    EXPECT_THAT(labels.notes, Contains(HasSubstr("1 category has no name")));
}

TEST_F(ForeignFiles, DiveSeesIgnoredBoxesAndWeItsSurestClass) {
    LabelFile ours;
    ours.boxes[0] = {boxOf(0, 1, {{50, 50}, 20, 10, 0}, "car")};
    ours.boxes[0][0].ignore = true;
    ours.boxes[0][0].occlusion = Occlusion::fully;
    writeLabels(ours, folder_ / "out.json", "kwcoco");
    const auto json = nlohmann::json::parse(textOf(folder_ / "out.json"));
    EXPECT_EQ(json["annotations"][0]["dive_detection_attributes"],
              nlohmann::json::parse(R"({"occluded":"fully","ignore":true})"));
    const LabelFile theirs = read(
        "dive.json",
        R"({"images":[{"id":1,"file_name":"a.png"}],"categories":[{"id":1,"name":"car"},{"id":2,"name":"bus"},{"id":3,"name":"van"}],
            "annotations":[
            {"id":1,"image_id":1,"category_id":1,"bbox":[0,0,9,9],"prob":[0.1,0.7,0.2]},
            {"id":2,"image_id":1,"category_id":1,"bbox":[20,0,9,9],"dive_confidence_pairs":[["car",0.2],["van",0.8]],"prob":[0.1,0.7,0.2]},
            {"id":3,"image_id":1,"category_id":1,"bbox":[40,0,9,9],"prob":[0.1,0.7]},
            {"id":4,"image_id":1,"category_id":3,"bbox":[60,0,9,9],"dive_detection_attributes":{"ignore":true,"occluded":"partly"}}]})");
    std::vector<std::string> classes;
    for (const LabelBox& box : theirs.boxes.at(0)) classes.push_back(box.object_class);
    EXPECT_THAT(classes, ElementsAre("bus", "van", "car", "van"));
    EXPECT_TRUE(theirs.boxes.at(0)[3].ignore);
    EXPECT_EQ(theirs.boxes.at(0)[3].occlusion, Occlusion::partly);
    EXPECT_THAT(theirs.notes, Contains(HasSubstr("2 annotations take the class of the highest confidence")));
}

TEST_F(ForeignFiles, UavdtSaysWhatItCannotCarry) {
    LabelFile labels;
    labels.image_size = cv::Size(100, 100);
    labels.boxes[0] = {boxOf(0, 1, {{50, 50}, 20, 10, 0}, "car"), boxOf(0, 2, {{96, 50}, 20, 10, 0}, "car")};
    labels.boxes[0][0].occlusion = Occlusion::partly;
    const ExportReport report = writeLabels(labels, folder_ / "u_gt.txt", "uavdt");
    std::vector<std::string> remarks = report.notes;
    for (const ExportLoss& loss : report.losses) remarks.push_back(loss.remark);
    EXPECT_EQ(report.lost(LossKind::occlusion), 1);
    EXPECT_THAT(remarks, Contains(HasSubstr("1 box partly occluded became medium occlusion")));
    EXPECT_THAT(remarks, Contains(HasSubstr("1 box reaching beyond the image")));
    EXPECT_THAT(remarks, Contains(HasSubstr("written as in view (1)")));
    labels.boxes[0] = {boxOf(0, 1, {{50, 50}, 20, 10, 0}, "")};
    labels.boxes[0][0].ignore = true;
    EXPECT_TRUE(writeLabels(labels, folder_ / "areas_gt.txt", "uavdt").notes.empty()) << "areas are not in view";
}

TEST_F(ForeignFiles, SkewedOutlinesTakeTheRectangleThatFitsBest) {
    // A parallelogram far from any rectangle: the mean rectangle lies across its long diagonal.
    const LabelFile skewed = read("P1.txt", "10 10 60 60 70 60 20 10 ship 0\n", "dota");
    const OrientedBox box = skewed.boxes.at(0)[0].box;
    const OrientedBox mean = boxFromCorners({cv::Point2d(9.5, 9.5), {59.5, 59.5}, {69.5, 59.5}, {19.5, 9.5}}).box;
    // The parallelogram's area is 500 and lies wholly inside of the smallest rectangle.
    for (const cv::Point2d corner : {cv::Point2d(9.5, 9.5), cv::Point2d(59.5, 59.5), cv::Point2d(69.5, 59.5)})
        EXPECT_TRUE(box.contains(corner, 0.01)) << corner.x;
    EXPECT_GT(500 / box.area(), 0.8);
    EXPECT_LT(std::abs(turnBetween(mean.heading, box.heading)), kPi / 4 + 1e-3) << "the front stays the front";
    EXPECT_THAT(skewed.notes, Contains(HasSubstr("best fitting one was taken")));
    // what is nearly a rectangle stays as it was
    const LabelFile plain = read("P2.txt", "20 50 10 50 10 20 20 21 ship 0\n", "dota");
    EXPECT_THAT(plain.notes, testing::Not(Contains(HasSubstr("best fitting"))));
}

TEST_F(ForeignFiles, NumbersBeyondCountingAreRefused) {
    EXPECT_THAT(test::messageOf([&] { read("v.txt", "2147483647 1 0 10 10 5 5 2\n0 1 0 40 10 5 5 2\n", "virat"); }),
                HasSubstr("ids reach from 0 to 2147483647"));
    EXPECT_EQ(read("v.txt", "2147483647 1 0 10 10 5 5 2\n", "virat").boxes.at(0)[0].id, 2147483647);
    ImportOptions options;
    options.frame_shift = 2'000'000'000;
    EXPECT_THAT(test::messageOf([&] { read("v.txt", "7 1 0 10 10 5 5 2\n", "virat", options); }), HasSubstr("shift"));
    writeText(folder_ / "seqinfo.ini", "[Sequence]\nseqLength=2147483647\nimWidth=2147483647\nimHeight=9\n");
    options.frame_shift = 5;
    options.scale = 1000;
    const LabelFile labels = read("m.txt", "1,1,1,1,1,1,1,3,1\n", "mot", options);
    EXPECT_GT(labels.frame_count.value(), 0);
    EXPECT_GT(labels.image_size->width, 0);
}

}  // namespace
}  // namespace eyrie::foreign_files_test

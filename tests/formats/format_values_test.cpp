#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "formats/sample_labels.h"

/// Values worked by hand: where a pixel, a frame and an angle of each format lie in ours.
namespace eyrie::format_values_test {
namespace {

using test::writeText;
using testing::Contains;
using testing::HasSubstr;

class FormatValues : public testing::Test {
 protected:
    LabelFile read(const std::string& name, const std::string& text, const std::string& format,
                   const ImportOptions& options = {}) {
        return readLabels(writeText(folder_ / name, text), format, options);
    }
    static void expectBox(const OrientedBox& box, double x, double y, double length, double width, double degrees) {
        EXPECT_NEAR(box.centre.x, x, 1e-6);
        EXPECT_NEAR(box.centre.y, y, 1e-6);
        EXPECT_NEAR(box.length, length, 1e-6);
        EXPECT_NEAR(box.width, width, 1e-6);
        EXPECT_NEAR(turnBetween(box.heading, radiansFromDegrees(degrees)), 0, 1e-6);
    }
    test::TemporaryFolder folder_;
};

// In formats whose pixels begin at 0 a box of 1 px at 0,0 is our pixel (0, 0).
TEST_F(FormatValues, FirstPixelAndFirstFrame) {
    const std::string cvat_head =
        "<annotations><version>1.1</version><meta><task><size>3</size></task></meta><track id=\"4\" label=\"car\">";
    expectBox(
        read("a.xml",
             cvat_head +
                 "<box frame=\"0\" keyframe=\"1\" xtl=\"0\" ytl=\"0\" xbr=\"1\" ybr=\"1\"/></track></annotations>",
             "cvat")
            .boxes.at(0)[0]
            .box,
        0, 0, 1, 1, 0);
    expectBox(read("a.json", R"({"images":[{"id":9,"file_name":"a.png"}],"categories":[{"id":1,"name":"car"}],
        "annotations":[{"id":1,"image_id":9,"category_id":1,"bbox":[0,0,1,1]}]})",
                   "coco")
                  .boxes.at(0)[0]
                  .box,
              0, 0, 1, 1, 0);
    expectBox(read("v.txt", "1,0,0,0,1,1,1,4,0,0\n", "visdrone").boxes.at(0)[0].box, 0, 0, 1, 1, 0);
    expectBox(read("u_gt.txt", "1,1,0,0,1,1,1,-1,-1\n", "uavdt").boxes.at(0)[0].box, 0, 0, 1, 1, 0);
    expectBox(read("k.kw18", "5 1 0 0 0 0 0 .5 .5 0 0 1 1 1 0 0 0 0\n", "kw18").boxes.at(0)[0].box, 0, 0, 1, 1, 0);
    expectBox(read("o.txt", "5 1 0 0 0 1 1 2\n", "virat").boxes.at(0)[0].box, 0, 0, 1, 1, 0);
    expectBox(read("d.csv", "5,a.png,0,0,0,1,1,1,-1,car,1\n", "viame").boxes.at(0)[0].box, 0, 0, 1, 1, 0);
    expectBox(read("w.csv", "image,frame,id,x,y,w,h\na.jpg,0,5,0,0,1,1\n", "vivid").boxes.at(0)[0].box, 0, 0, 1, 1, 0);
    expectBox(read("m.txt", "1,1,1,1,1,1,1,3,1\n", "mot").boxes.at(0)[0].box, 0, 0, 1, 1, 0);
    ImportOptions options;
    options.columns = "frame,id,cname,x1,y1,x2,y2";
    expectBox(read("c.csv", "0,5,car,0,0,1,1\n", "columns", options).boxes.at(0)[0].box, 0, 0, 1, 1, 0);
}

// The first corner of DOTA and YOLO-OBB is the front left one: the box below drives downwards, its left is our right.
TEST_F(FormatValues, CornersBeginAtTheFrontLeft) {
    const LabelFile dota = read("P1.txt", "imagesource:x\ngsd:0.2\n20 50 10 50 10 20 20 20 small-vehicle 1\n", "dota");
    expectBox(dota.boxes.at(0)[0].box, 14.5, 34.5, 30, 10, 90);
    EXPECT_EQ(dota.gsd_m, 0.2);
    EXPECT_TRUE(dota.boxes.at(0)[0].ignore);
    EXPECT_EQ(dota.boxes.at(0)[0].object_class, "small-vehicle");
    const auto gsdOf = [&](const std::string& gsd) {
        return read("P1.txt", "gsd:" + gsd + "\n20 50 10 50 10 20 20 20 ship 1\n", "dota").gsd_m;
    };
    EXPECT_EQ(gsdOf("999.5"), 999.5);
    for (const char* none : {"1000", "0", "-0.2", "null"}) EXPECT_EQ(gsdOf(none), std::nullopt) << none;
    expectBox(read("P2.txt", "20.0,50.0,10.0,50.0,10.0,20.0,20.0,20.0,car,0\n", "dota").boxes.at(0)[0].box, 14.5, 34.5,
              30, 10, 90);
    ImportOptions options;
    options.image_size = cv::Size(200, 100);
    const LabelFile yolo = read("y.txt", "2 0.1 0.5 0.05 0.5 0.05 0.2 0.1 0.2 0.75\n", "yolo-obb", options);
    expectBox(yolo.boxes.at(0)[0].box, 14.5, 34.5, 30, 10, 90);
    EXPECT_EQ(yolo.boxes.at(0)[0].score, 0.75);
    EXPECT_EQ(yolo.boxes.at(0)[0].object_class, "class 2");
    EXPECT_THAT(test::messageOf([&] { read("y.txt", "2 0.1 0.5 0.05 0.5 0.05 0.2 0.1 0.2\n", "yolo-obb"); }),
                HasSubstr("--size"));
}

TEST_F(FormatValues, FramesOfImageTextsFollowTheImages) {
    for (const char* name : {"f_007", "f_010", "f_013"}) {
        writeText(folder_ / "set" / "images" / (std::string(name) + ".png"), "");
    }
    writeText(folder_ / "set" / "labelTxt" / "f_013.txt", "0 0 1 0 1 1 0 1 car 0\n");
    EXPECT_TRUE(readLabels(folder_ / "set").boxes.contains(2));
    writeText(folder_ / "numbers" / "labelTxt" / "f_013.txt", "0 0 1 0 1 1 0 1 car 0\n");
    EXPECT_TRUE(readLabels(folder_ / "numbers").boxes.contains(13));
    writeText(folder_ / "long" / "labelTxt" / "f_000000013.txt", "0 0 1 0 1 1 0 1 car 0\n");
    EXPECT_TRUE(readLabels(folder_ / "long").boxes.contains(13));
    writeText(folder_ / "times" / "labelTxt" / "f_0000000013.txt", "0 0 1 0 1 1 0 1 car 0\n");
    EXPECT_TRUE(readLabels(folder_ / "times").boxes.contains(0)) << "ten digits are a time";
    writeText(folder_ / "set" / "labelTxt" / "g.txt", "");
    EXPECT_THAT(test::messageOf([&] { readLabels(folder_ / "set"); }),
                HasSubstr("g.txt: there is no image of this name"));
}

TEST_F(FormatValues, CocoTellsTheSizeOfItsImagesWhereItIsOne) {
    const auto sizeBy = [&](const std::string& size) {
        return read("a.json",
                    R"({"images":[{"id":1,"file_name":"a.png")" + size +
                        R"(}],"annotations":[{"image_id":1,"bbox":[10,20,30,40]}]})",
                    "coco")
            .image_size;
    };
    EXPECT_EQ(sizeBy(R"(,"width":320,"height":240)"), cv::Size(320, 240));
    for (const char* none : {"", R"(,"width":320)", R"(,"width":0,"height":240)", R"(,"width":320,"height":0)"})
        EXPECT_FALSE(sizeBy(none)) << none;
}

TEST_F(FormatValues, YoloNamesComeFromDataYaml) {
    for (const char* names :
         {"names: [car, 'big truck']\n", "names:\n  0: car\n  1: \"big truck\"\n", "names:\n- car\n- big truck\n"}) {
        test::TemporaryFolder folder;
        writeText(folder / "data.yaml", std::string("# ours\npath: .\n") + names + "image_size: [200, 100]\nnc: 2\n");
        writeText(folder.path() / "labels" / "train" / "0004.txt", "1 0.1 0.5 0.05 0.5 0.05 0.2 0.1 0.2\n");
        EXPECT_EQ(readLabels(folder.path()).boxes.at(4)[0].object_class, "big truck") << names;
    }
}

TEST_F(FormatValues, PlainYoloIsReadToo) {
    ImportOptions options;
    options.image_size = cv::Size(200, 100);
    const LabelFile labels = read("y.txt", "0 0.1 0.5 0.05 0.2\n1 0.1 0.5 0.05 0.2 0.75\n", "auto", options);
    EXPECT_EQ(labels.format, "yolo-obb");
    expectBox(labels.boxes.at(0)[0].box, 19.5, 49.5, 10, 20, 0);
    EXPECT_EQ(labels.boxes.at(0)[1].score, 0.75);
}

TEST_F(FormatValues, CvatTurnsClockwiseAboutTheCentreAndInterpolatesByTheShorterArc) {
    const LabelFile labels =
        read("a.xml",
             "<?xml version=\"1.0\"?>\n<annotations><version>1.1</version><meta><task><size>30</size>"
             "<original_size><width>640</width><height>480</height></original_size></task></meta>\n"
             "<track id=\"0\" label=\"car\" source=\"manual\">\n"
             "<box frame=\"2\" keyframe=\"1\" outside=\"0\" occluded=\"0\" xtl=\"10\" ytl=\"20\" xbr=\"30\" ybr=\"30\" "
             "rotation=\"350\"/>\n"
             "<box frame=\"4\" keyframe=\"0\" outside=\"0\" occluded=\"1\" xtl=\"0\" ytl=\"0\" xbr=\"3\" ybr=\"3\"/>\n"
             "<box frame=\"6\" keyframe=\"1\" outside=\"0\" occluded=\"1\" xtl=\"20\" ytl=\"20\" xbr=\"40\" ybr=\"30\" "
             "rotation=\"30\"/>\n"
             "<box frame=\"8\" keyframe=\"1\" outside=\"1\" occluded=\"0\" xtl=\"20\" ytl=\"20\" xbr=\"40\" ybr=\"30\" "
             "rotation=\"30\"/>\n"
             "</track><track id=\"0\" label=\"bus\"><box frame=\"27\" keyframe=\"1\" outside=\"0\" occluded=\"0\" "
             "xtl=\"1\" ytl=\"1\" xbr=\"2\" ybr=\"2\"/>"
             "<polygon frame=\"28\"/></track></annotations>",
             "auto");
    EXPECT_EQ(labels.format, "cvat");
    expectBox(labels.boxes.at(2)[0].box, 19.5, 24.5, 20, 10, 350);
    expectBox(labels.boxes.at(4)[0].box, 24.5, 24.5, 20, 10, 10);  // half way, not through 190°
    EXPECT_EQ(labels.boxes.at(6)[0].occlusion, Occlusion::partly);
    EXPECT_TRUE(labels.boxes.contains(7));
    EXPECT_FALSE(labels.boxes.contains(8));
    ASSERT_EQ(labels.objects.size(), 2u);
    EXPECT_EQ(labels.objects[0].keyframes.size(), 3u);  // the third holds the box up to the frame before it is outside
    EXPECT_EQ(labels.objects[0].last_frame, 7);
    EXPECT_EQ(labels.objects[1].id, 1);           // the number 0 was taken
    EXPECT_EQ(labels.objects[1].last_frame, 29);  // no end told
    EXPECT_THAT(labels.notes, Contains(HasSubstr("run to the end of the clip")));
    EXPECT_THAT(labels.notes, Contains(HasSubstr("1 shape other than boxes")));
    EXPECT_EQ(labels.image_size, cv::Size(640, 480));
}

TEST_F(FormatValues, CvatNeedsFewKeyframesForSteadyMotion) {
    LabelFile labels;
    for (int frame = 0; frame < 1000; ++frame) {
        LabelBox box;
        box.frame = frame;
        box.id = 1;
        box.object_class = "a <b> & \"c\"";
        box.box = {{10 + 0.25 * frame, 20}, 20, 10, radiansFromDegrees(frame < 500 ? 0 : 0.5 * (frame - 500))};
        labels.boxes[frame].push_back(box);
    }
    writeLabels(labels, folder_ / "steady.xml", "cvat");
    const LabelFile back = readLabels(folder_ / "steady.xml");
    ASSERT_EQ(back.objects.size(), 1u);
    EXPECT_LE(back.objects[0].keyframes.size(), 6u);
    EXPECT_EQ(back.objects[0].object_class, "a <b> & \"c\"");
    EXPECT_EQ(back.objects[0].last_frame, 999);
    for (const auto& [frame, records] : labels.boxes) {
        EXPECT_NEAR(cv::norm(back.boxes.at(frame)[0].box.centre - records[0].box.centre), 0, 0.04);
    }
}

TEST_F(FormatValues, DiveRotationIsClockwiseAboutTheMiddleOfTheBounds) {
    const LabelFile csv = read("d.csv",
                               "# metadata,fps: 23.976,exported\n3,a.png,7,10,20,30,30,0.5,-1,car,0.5,(atr) rotation "
                               "0.5235987756,(kp) head 1 2\n",
                               "auto");
    EXPECT_EQ(csv.format, "viame");
    EXPECT_EQ(csv.frame_rate_hz, 23.976);
    expectBox(csv.boxes.at(7)[0].box, 19.5, 24.5, 20, 10, 30);
    const char* json =
        R"({"videos":[{"id":1,"name":"v","annotation_fps":10}],"images":[{"id":5,"video_id":1,"frame_index":7,"width":64,"height":48}],
        "categories":[{"id":2,"name":"car"}],"annotations":[{"id":1,"image_id":5,"category_id":2,"track_id":3,"bbox":[10,20,20,10],
        "dive_detection_attributes":{"rotation":0.5235987755982988}}]})";
    const LabelFile kwcoco = read("d.json", json, "auto");
    EXPECT_EQ(kwcoco.format, "kwcoco");
    EXPECT_EQ(kwcoco.boxes.at(7)[0].id, 3);
    EXPECT_EQ(kwcoco.frame_rate_hz, 10);
    expectBox(kwcoco.boxes.at(7)[0].box, 19.5, 24.5, 20, 10, 30);
}

TEST_F(FormatValues, CocoProfilesBothComeBack) {
    for (const bool unrotated : {false, true}) {
        ExportOptions options;
        options.unrotated_bounds = unrotated;
        LabelFile labels;
        LabelBox box;
        box.id = 1;
        box.object_class = "car";
        box.box = {{100, 50}, 20, 10, kPi / 2};
        labels.boxes[0].push_back(box);
        writeLabels(labels, folder_ / "p.json", "coco", options);
        EXPECT_THAT(test::textOf(folder_ / "p.json"),
                    HasSubstr(unrotated ? "[90.5, 45.5, 20, 10]" : "[95.5, 40.5, 10, 20]"));
        const LabelFile back = readLabels(folder_ / "p.json", "coco");
        EXPECT_NEAR(back.boxes.at(0)[0].box.length, 20, 1e-3);
        EXPECT_NEAR(back.boxes.at(0)[0].box.heading, kPi / 2, 1e-5);
    }
}

TEST_F(FormatValues, CocoOutlinesWithoutRotationLieAlongTheirLongSide) {
    const char* json =
        R"({"images":[{"id":2,"file_name":"f10.png"},{"id":1,"file_name":"f9.png"}],"categories":[],"annotations":[
        {"id":1,"image_id":2,"bbox":[0,0,20,20],"segmentation":[[10,0,20,10,10,20,0,10]],"iscrowd":1},
        {"id":2,"image_id":1,"bbox":[0,0,20,10],"segmentation":[[0,0,20,0,20,10,0,10]]},
        {"id":3,"image_id":1,"bbox":[0,0,20,10],"segmentation":{"counts":"x","size":[1,1]}},
        {"id":4,"image_id":1,"segmentation":[]}]})";
    const LabelFile labels = read("c.json", json, "auto");
    EXPECT_EQ(labels.format, "coco");
    ASSERT_EQ(labels.boxes.at(0).size(), 2u);  // f9 before f10
    expectBox(labels.boxes.at(0)[0].box, 9.5, 4.5, 20, 10, 0);
    EXPECT_NEAR(std::abs(labels.boxes.at(1)[0].box.heading), kPi / 4, 1e-9);
    EXPECT_NEAR(labels.boxes.at(1)[0].box.length, std::sqrt(200), 1e-9);
    EXPECT_TRUE(labels.boxes.at(1)[0].ignore);
    EXPECT_THAT(labels.notes, Contains(HasSubstr("1 annotation has no bbox")));
    const LabelFile results =
        read("r.json", R"([{"image_id":4,"category_id":3,"bbox":[0,0,1,1],"score":0.25}])", "auto");
    EXPECT_EQ(results.boxes.at(4)[0].score, 0.25);
}

TEST_F(FormatValues, SeveralVideosMustBeChosenFrom) {
    const char* json =
        R"({"videos":[{"id":1,"name":"a"},{"id":2,"name":"b"}],"categories":[],"images":[{"id":1,"video_id":1,"frame_index":0},
        {"id":2,"video_id":2,"frame_index":3}],"annotations":[{"image_id":1,"bbox":[0,0,1,1]},{"image_id":2,"bbox":[0,0,2,2],"track_id":"x"}]})";
    EXPECT_THAT(test::messageOf([&] { read("v.json", json, "kwcoco"); }),
                HasSubstr("videos: holds several; choose one by name (--sequence): a, b"));
    ImportOptions options;
    options.sequence = "b";
    const LabelFile labels = read("v.json", json, "kwcoco", options);
    EXPECT_EQ(labels.boxes.size(), 1u);
    EXPECT_TRUE(labels.boxes.at(3)[0].id);
}

TEST_F(FormatValues, VisDroneAndUavdtFlags) {
    const LabelFile v =
        read("v.txt", "2,0,10,20,30,40,0,0,0,0\n2,5,10,20,30,40,1,9,1,2\n2,6,0,0,3,3,1,2,0,1\n", "auto");
    EXPECT_EQ(v.format, "visdrone");
    EXPECT_TRUE(v.boxes.at(1)[0].ignore);
    EXPECT_FALSE(v.boxes.at(1)[0].id);
    EXPECT_EQ(v.boxes.at(1)[1].object_class, "bus");
    EXPECT_EQ(v.boxes.at(1)[1].occlusion, Occlusion::fully);
    EXPECT_EQ(v.boxes.at(1)[2].object_class, "person");
    writeText(folder_ / "s_gt_ignore.txt", "1,1,0,0,5,5,1,-1,-1\n");
    writeText(folder_ / "s_gt_whole.txt", "1,1,0,0,5,5,1,3,3\n");
    const LabelFile u = read("s_gt.txt", "1,1,0,0,5,5,1,-1,-1\n", "auto");
    ASSERT_EQ(u.boxes.at(0).size(), 2u);
    EXPECT_EQ(u.boxes.at(0)[0].object_class, "bus");
    EXPECT_EQ(u.boxes.at(0)[0].occlusion, Occlusion::partly);
    EXPECT_TRUE(u.boxes.at(0)[1].ignore);
}

TEST_F(FormatValues, VividMarksIgnoredPersonsByANegativeWidth) {
    const LabelFile labels = read(
        "egtest01_truth.csv", "name,frame,id,x,y,w,h\nframe0.jpg,0,1,10,20,30,40\nframe0.jpg,0,2,10,20,-6,8\n", "auto");
    EXPECT_EQ(labels.format, "vivid");
    expectBox(labels.boxes.at(0)[0].box, 24.5, 39.5, 30, 40, 0);
    EXPECT_TRUE(labels.boxes.at(0)[1].ignore);
    expectBox(labels.boxes.at(0)[1].box, 12.5, 23.5, 6, 8, 0);
}

TEST_F(FormatValues, Kw18ConfidenceOnlyWithExactlyNineteenColumns) {
    const std::string begin = "1 2 4 0 0 0.5 0 0 0 10 20 30 40 400 0 0 0 1";
    const LabelFile labels =
        read("k.kw18", "# comment\n" + begin + " 0.5\n1 2 5 0 0 0 0 0 0 10 20 30 40 400 0 0 0 1 7 3\n", "auto");
    EXPECT_EQ(labels.format, "kw18");
    EXPECT_EQ(labels.boxes.at(4)[0].score, 0.5);
    EXPECT_EQ(labels.boxes.at(4)[0].velocity.x, 0.5);
    EXPECT_EQ(labels.boxes.at(5)[0].score, 1);
}

TEST_F(FormatValues, ColumnsAreTheUsersOwn) {
    ImportOptions options;
    options.columns = "fn, n, [id, cname, cx, cy, w, h, heading]";
    options.first_frame_number = 1;
    options.first_pixel_edge = 1;
    const LabelFile labels =
        read("d.txt", "frame,count\n3,2,7,car,11,21,20,10,90,8,bus,1.5,1.5,1,1,0\n4,0\n", "auto", options);
    EXPECT_EQ(labels.format, "columns");
    expectBox(labels.boxes.at(2)[0].box, 9.5, 19.5, 20, 10, 90);
    expectBox(labels.boxes.at(2)[1].box, 0, 0, 1, 1, 0);
    EXPECT_EQ(labels.boxes.at(2)[1].object_class, "bus");
    EXPECT_THAT(labels.notes, Contains(HasSubstr("heading")));

    options = {};
    options.columns = "iname;x2;y2;w;h;classid;_";
    const LabelFile images = read("e.txt", "b.jpg;10;10;4;4;3;x\na.jpg;10;10;4;4;3;\n", "columns", options);
    EXPECT_EQ(images.boxes.at(1)[0].object_class, "class 3");
    expectBox(images.boxes.at(0)[0].box, 7.5, 7.5, 4, 4, 0);
    options.columns = "frame n [id x y w h]";
    EXPECT_EQ(read("f.txt", "0 2 1 0 0 1 1 2 3 3 1 1\n", "columns", options).boxes.at(0).size(), 2u);
}

TEST_F(FormatValues, ColumnTemplatesThatCannotWorkAreRefused) {
    const auto refusal = [&](const std::string& columns) {
        ImportOptions options;
        options.columns = columns;
        return test::messageOf([&] { read("x.txt", "1,1\n", "columns", options); });
    };
    EXPECT_THAT(refusal("frame"), HasSubstr("no separator"));
    EXPECT_THAT(refusal("frame,x,y,w"), HasSubstr("vertical extent"));
    EXPECT_THAT(refusal("frame,x,y,w,h,x2"), HasSubstr("more than two"));
    EXPECT_THAT(refusal("id,x,y,w,h"), HasSubstr("neither frame nor image"));
    EXPECT_THAT(refusal("frame,x,y,w,h,foo"), HasSubstr("\"foo\" names no column"));
    EXPECT_THAT(refusal("frame,x,y,w,h,w"), HasSubstr("given twice"));
    EXPECT_THAT(refusal("frame,n,x,y,w,h"), HasSubstr("n needs a group"));
    EXPECT_THAT(refusal("frame,[x,y,[w,h]]"), HasSubstr("nest"));
    EXPECT_THAT(refusal("frame,[x,y,w,h"), HasSubstr("never closed"));
    EXPECT_THAT(refusal("frame,[x,y,w,h],id"), HasSubstr("nothing may follow"));
}

TEST_F(FormatValues, TrackEvalTreeIsComplete) {
    LabelFile labels = test::sampleLabels();
    ExportOptions options;
    options.sequence = "day 1/a";
    const ExportReport report = writeLabels(labels, folder_ / "data", "trackeval", options);
    const auto root = folder_ / "data" / "gt" / "mot_challenge";
    EXPECT_EQ(test::textOf(root / "seqmaps" / "EYRIE-train.txt"), "name\nday_1_a\n");
    const std::string info = test::textOf(root / "EYRIE-train" / "day_1_a" / "seqinfo.ini");
    EXPECT_THAT(info, HasSubstr("seqLength=14\n"));
    EXPECT_THAT(info, HasSubstr("imWidth=320\n"));
    const std::string truth = test::textOf(root / "EYRIE-train" / "day_1_a" / "gt" / "gt.txt");
    EXPECT_THAT(truth, HasSubstr("\n1,2,"));  // ids are dense
    EXPECT_THAT(truth, testing::Not(HasSubstr("\n1,12,")));
    EXPECT_THAT(truth, HasSubstr(",1,1,1\n"));
    EXPECT_THAT(truth, HasSubstr(",0,8,1\n"));  // ignored: distractors
    EXPECT_THAT(report.notes, Contains(HasSubstr("run_mot_challenge.py")));
    options.tracker = "eyrie";
    writeLabels(labels, folder_ / "data", "trackeval", options);
    EXPECT_THAT(test::textOf(folder_ / "data" / "trackers" / "mot_challenge" / "EYRIE-train" / "eyrie" / "data" /
                             "day_1_a.txt"),
                HasSubstr(",-1,-1,-1\n"));
    options.sequence = "second";
    options.tracker.clear();
    writeLabels(labels, folder_ / "data", "trackeval", options);
    EXPECT_EQ(test::textOf(root / "seqmaps" / "EYRIE-train.txt"), "name\nday_1_a\nsecond\n");
    EXPECT_THAT(test::messageOf([&] { readLabels(folder_ / "data"); }), HasSubstr("holds 2 sequences"));
    EXPECT_EQ(readLabels(root / "EYRIE-train" / "second").format, "mot");
}

TEST(LabelFormats, DialogsShowTheFilesOfEveryFormat) {
    EXPECT_EQ(labelFilePatterns(), "*.csv *.json *.kw18 *.trk *.txt *.xml");
}

}  // namespace
}  // namespace eyrie::format_values_test

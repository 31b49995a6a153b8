#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/sample_labels.h"

/// What is wrong in a file is said with the file and the place.
namespace eyrie::damaged_labels_test {
namespace {

using test::messageOf;
using test::writeText;
using testing::AllOf;
using testing::HasSubstr;

class DamagedLabels : public testing::Test {
 protected:
    std::string refusal(const std::string& format, const std::string& text, const std::string& columns = "") {
        ImportOptions options;
        options.columns = columns;
        options.image_size = cv::Size(100, 100);
        const auto file = writeText(folder_ / "labels.txt", text);
        const std::string message = messageOf([&] { readLabels(file, format, options); });
        EXPECT_THAT(message, HasSubstr("labels.txt")) << format << ": " << text.substr(0, 200);
        return message;
    }
    /// What is said of the row that is left out, where programs of the format read on, or of the file that is refused.
    std::string complaint(const std::string& format, const std::string& text, const std::string& columns = "") {
        const bool reads_on = format == "viame" || format == "coco" || format == "kwcoco";
        if (!reads_on) return refusal(format, text, columns);
        const LabelFile labels = readLabels(writeText(folder_ / "labels.txt", text), format);
        EXPECT_EQ(reportOn(labels).boxes, 1) << "the good one";
        EXPECT_THAT(labels.notes, testing::Contains(AllOf(testing::StartsWith("left out: "), HasSubstr("labels.txt"))));
        return labels.notes.empty() ? "" : labels.notes.back();
    }
    test::TemporaryFolder folder_;
};

struct Table {
    const char* format;
    const char* header;
    std::vector<std::string> fields;  ///< of a good line
    char separator;
    std::size_t frame, x, size;  ///< fields: of the frame, of an edge, of a size or the far edge
    const char* columns = "";
};

std::vector<Table> tables() {
    return {{"mot", "", {"1", "1", "10", "10", "5", "5", "1", "3", "1"}, ',', 0, 2, 4},
            {"mot-result", "", {"1", "1", "10", "10", "5", "5", "0.5", "-1", "-1", "-1"}, ',', 0, 2, 4},
            {"visdrone", "", {"1", "1", "10", "10", "5", "5", "1", "4", "0", "0"}, ',', 0, 2, 4},
            {"uavdt", "", {"1", "1", "10", "10", "5", "5", "1", "-1", "-1"}, ',', 0, 2, 4},
            {"kw18",
             "",
             {"1", "1", "1", "0", "0", "0", "0", "0", "0", "10", "10", "20", "20", "100", "0", "0", "0", "0"},
             ' ',
             2,
             9,
             11},
            {"virat", "", {"1", "1", "1", "10", "10", "5", "5", "2"}, ' ', 2, 3, 5},
            {"viame", "", {"1", "a.png", "1", "10", "10", "20", "20", "1", "-1", "car", "1"}, ',', 2, 3, 5},
            {"vivid", "name,frame,id,x,y,w,h\n", {"a.jpg", "1", "1", "10", "10", "5", "5"}, ',', 1, 3, 6},
            {"dota", "", {"20", "50", "10", "50", "10", "20", "20", "20", "car", "0"}, ' ', 99, 2, 99},
            {"yolo-obb", "", {"0", ".2", ".5", ".1", ".5", ".1", ".2", ".2", ".2"}, ' ', 99, 2, 99},
            {"native",
             "frame,id,x,y,length,width,heading,class,ignore\n",
             {"1", "1", "10", "10", "5", "5", "0", "car", "0"},
             ',',
             0,
             2,
             4},
            {"columns", "", {"1", "1", "car", "10", "10", "5", "5"}, ',', 0, 3, 5, "frame,id,cname,x,y,w,h"}};
}

std::string lineOf(const Table& table, std::size_t changed = 999, const std::string& value = "",
                   std::size_t fields = 999) {
    std::string line;
    for (std::size_t i = 0; i < std::min(fields, table.fields.size()); ++i) {
        if (i > 0) line += table.separator;
        line += i == changed ? value : table.fields[i];
    }
    return line + "\n";
}

TEST_F(DamagedLabels, TablesNameLineAndColumn) {
    for (const Table& table : tables()) {
        SCOPED_TRACE(table.format);
        const std::string good = table.header + lineOf(table);
        const std::string where = *table.header ? ":3" : ":2";
        ImportOptions options;
        options.columns = table.columns;
        options.image_size = cv::Size(100, 100);
        EXPECT_EQ(messageOf([&] { readLabels(writeText(folder_ / "good.txt", good), table.format, options); }),
                  "no error");
        for (const char* bad : {"ten", "nan", "inf", "1e999", "1e12", "0x10", "--1", "1,5.2.3"}) {
            if (table.separator == ',' && std::string(bad).find(',') != std::string::npos) continue;
            const std::string message = complaint(table.format, good + lineOf(table, table.x, bad), table.columns);
            const bool native_range = std::string(table.format) == "native" && std::string(bad) == "1e12";
            EXPECT_THAT(message, HasSubstr(native_range ? "frame 1" : where)) << bad;
        }
        EXPECT_THAT(complaint(table.format, good + lineOf(table, 999, "", 3), table.columns), HasSubstr(where));
        const std::string longer = lineOf(table).substr(0, lineOf(table).size() - 1) + table.separator + "7" +
                                   table.separator + "7" + table.separator + "7";
        if (std::string(table.format) != "viame") {
            EXPECT_THAT(complaint(table.format, good + longer + "\n", table.columns), HasSubstr(where));
        }
        if (table.frame < 99) {
            EXPECT_THAT(complaint(table.format, good + lineOf(table, table.frame, "-1"), table.columns),
                        HasSubstr(where));
            EXPECT_THAT(complaint(table.format, good + lineOf(table, table.frame, "1.5"), table.columns),
                        HasSubstr(where));
            complaint(table.format, good + lineOf(table, table.frame, "2000000000"), table.columns);
            EXPECT_THAT(complaint(table.format, good + lineOf(table, table.frame, "99999999999999"), table.columns),
                        HasSubstr(where));
            EXPECT_THAT(complaint(table.format, good + lineOf(table), table.columns),
                        HasSubstr("id 1"));  // twice in a frame
        }
        if (table.size < 99) {
            EXPECT_THAT(complaint(table.format, good + lineOf(table, table.size, "-5"), table.columns),
                        HasSubstr(where));
        }
        EXPECT_THAT(refusal(table.format, good + "\xff\xfe" + lineOf(table), table.columns), HasSubstr("UTF-8"));
        EXPECT_THAT(refusal(table.format, good + std::string("1\0", 2) + lineOf(table), table.columns),
                    HasSubstr("zero bytes"));
    }
}

TEST_F(DamagedLabels, WrongColumnsOfOneFormatAreToldApart) {
    EXPECT_THAT(refusal("virat", "0 1 2 3 4 5 6 7 8 9\n"), HasSubstr("these are VIRAT events"));
    EXPECT_THAT(refusal("visdrone", "1,1,1,1,1,1,1,12,0,0\n"), HasSubstr("category 12"));
    EXPECT_THAT(refusal("visdrone", "1,1,1,1,1,1,1,4,0,3\n"), HasSubstr("occlusion 3"));
    EXPECT_THAT(refusal("virat", "0 1 2 3 4 5 6 9\n"), HasSubstr("type 9"));
    EXPECT_THAT(refusal("viame", "1,a,0,0,0,1,1,1,-1,car\n"), HasSubstr("ends before the score of the class"));
    EXPECT_THAT(refusal("viame", "1,a,0,0,0,1,1,1,-1,(atr) rotation x\n"), HasSubstr("is not an angle"));
    EXPECT_THAT(refusal("viame", "1,\"a,0,0,0,1,1,1,-1\n"), HasSubstr("never closed"));
    EXPECT_THAT(refusal("viame", "1,\"a\"b,0,0,0,1,1,1,-1\n"), HasSubstr("closing quote"));
    EXPECT_THAT(refusal("columns", "1,3,1,2,3,4\n", "frame,n,[x,y,w,h]"),
                HasSubstr("3 boxes are announced and 1 follow"));
    EXPECT_THAT(refusal("native", "frame,id,x,y,length,width,heading,class,ignore\n0,1,1,1,1,1,0,c\x1b[2Jar,0\n"),
                HasSubstr("frame 0 has a class with control characters"));
    EXPECT_THAT(refusal("columns", "1,1,2,3\n", "frame,[x,y,w,h]"), HasSubstr(":1:1"));
}

TEST_F(DamagedLabels, CvatNamesTheLine) {
    const std::string head =
        "<annotations>\n<meta><task><size>9</size></task></meta>\n<track id=\"1\" label=\"car\">\n";
    const auto box = [](const std::string& attributes) { return "<box " + attributes + "/>\n"; };
    const std::string good = "frame=\"1\" keyframe=\"1\" xtl=\"1\" ytl=\"1\" xbr=\"2\" ybr=\"2\"";
    const std::string end = "</track>\n</annotations>\n";
    EXPECT_THAT(refusal("cvat", head + box(good)), HasSubstr("labels.txt:"));
    EXPECT_THAT(refusal("cvat", head + box(good) + "<box " + end), HasSubstr(":5"));
    EXPECT_THAT(refusal("cvat", head + box("frame=\"1\" xtl=\"1\"") + end),
                HasSubstr(":4: <box>: the attribute keyframe is missing"));
    EXPECT_THAT(refusal("cvat", head + box("keyframe=\"1\" xtl=\"1\"") + end), HasSubstr("attribute frame is missing"));
    EXPECT_THAT(refusal("cvat", head + box("frame=\"1\" keyframe=\"1\" xtl=\"1\"") + end), HasSubstr("ytl is missing"));
    EXPECT_THAT(refusal("cvat", head + box(good + " rotation=\"nan\"") + end), HasSubstr("rotation=\"nan\""));
    EXPECT_THAT(refusal("cvat", head + box("frame=\"1e9\" keyframe=\"1\"") + end), HasSubstr(":4"));
    EXPECT_THAT(
        refusal("cvat", head + box("frame=\"-1\" keyframe=\"1\" xtl=\"1\" ytl=\"1\" xbr=\"2\" ybr=\"2\"") + end),
        HasSubstr("beyond any video"));
    EXPECT_THAT(refusal("cvat", head + box("frame=\"1\" keyframe=\"1\" xtl=\"3\" ytl=\"1\" xbr=\"2\" ybr=\"2\"") + end),
                HasSubstr("xbr or ybr"));
    EXPECT_THAT(refusal("cvat", head + box(good) + box(good) + end), HasSubstr("two keyframes"));
    EXPECT_THAT(refusal("cvat", "<annotations><track id=\"1\"><box " + good + "/></track></annotations>"),
                HasSubstr("label is missing"));
    EXPECT_THAT(refusal("cvat", "<other/>"), HasSubstr("no <annotations>"));
    EXPECT_THAT(refusal("cvat", ""), HasSubstr("labels.txt:1"));
    EXPECT_THAT(refusal("cvat", "<annotations><image id=\"0\"/></annotations>"), HasSubstr("CVAT for video 1.1"));
    EXPECT_THAT(refusal("cvat", head + "\xc3\x28" + end), HasSubstr("UTF-8"));
    // millions of frames from two keyframes
    EXPECT_THAT(refusal("cvat", "<annotations><track id=\"1\" label=\"a\"><box " + good +
                                    "/><box frame=\"9999999\" keyframe=\"1\" xtl=\"1\" ytl=\"1\" xbr=\"2\" ybr=\"2\"/>"
                                    "</track></annotations>"),
                HasSubstr("span implausibly many frames"));
}

TEST_F(DamagedLabels, EntitiesThatGrowAreRefused) {
    std::string bomb = "<?xml version=\"1.0\"?>\n<!DOCTYPE lolz [<!ENTITY a \"lol\">";
    for (char c = 'b'; c < 'k'; ++c) {
        bomb += std::string("<!ENTITY ") + c + " \"";
        for (int i = 0; i < 10; ++i) bomb += std::string("&") + static_cast<char>(c - 1) + ";";
        bomb += "\">";
    }
    EXPECT_THAT(refusal("cvat", bomb + "]>\n<annotations>&j;</annotations>"), HasSubstr("document type"));
    EXPECT_THAT(refusal("auto", bomb + "]>\n<annotations>&j;</annotations>"), HasSubstr("document type"));
}

TEST_F(DamagedLabels, DeepNestingIsRefused) {
    std::string deep(2'000'000, '[');
    EXPECT_THAT(refusal("coco", deep), HasSubstr("nested deeper"));
    std::string objects = "{\"images\":[],\"annotations\":";
    for (int i = 0; i < 10000; ++i) objects += "{\"a\":";
    EXPECT_THAT(refusal("kwcoco", objects), HasSubstr("nested deeper"));
    std::string elements = "<annotations>";
    for (int i = 0; i < 200'000; ++i) elements += "<a>";
    EXPECT_THAT(refusal("cvat", elements), HasSubstr("labels.txt:1"));
    for (int i = 0; i < 200'000; ++i) elements += "</a>";
    ImportOptions options;
    EXPECT_EQ(
        messageOf([&] { readLabels(writeText(folder_ / "d.xml", elements + "</annotations>"), "cvat", options); }),
        "no error");
}

TEST_F(DamagedLabels, CocoNamesTheEntry) {
    const auto beside = [](const std::string& annotation) {
        return R"({"images":[{"id":1,"file_name":"a"}],"categories":[{"id":1,"name":"car"}],)"
               R"("annotations":[{"image_id":1,"bbox":[0,0,1,1]},)" +
               annotation + "]}";
    };
    const auto with = [&](const std::string& annotation) { return complaint("coco", beside(annotation)); };
    EXPECT_THAT(with(R"({"image_id":2,"bbox":[0,0,1,1]})"),
                HasSubstr("annotations[1].image_id: there is no such image"));
    EXPECT_THAT(with(R"({"bbox":[0,0,1,1]})"), HasSubstr("\"image_id\" is missing"));
    EXPECT_THAT(with(R"({"image_id":1,"bbox":[0,0,1]})"), HasSubstr("annotations[1].bbox: 3 numbers"));
    EXPECT_THAT(with(R"({"image_id":1,"bbox":[0,"x",1,1]})"), HasSubstr("bbox[1]: is not a number"));
    EXPECT_THAT(with(R"({"image_id":1,"bbox":[0,0,-1,1]})"), HasSubstr("negative"));
    EXPECT_THAT(with(R"({"image_id":1,"bbox":[0,0,1e30,1]})"), HasSubstr("outside any image"));
    EXPECT_THAT(with(R"({"image_id":1,"bbox":{}})"), HasSubstr("bbox: is not a list"));
    EXPECT_THAT(with(R"({"image_id":1.5,"bbox":[0,0,1,1]})"), HasSubstr("whole number"));
    EXPECT_THAT(with(R"({"image_id":1,"bbox":[0,0,1,1],"track_id":-4})"), HasSubstr("negative"));
    EXPECT_THAT(with(R"({"image_id":1,"bbox":[0,0,1,1],"dive_detection_attributes":{"rotation":"a"}})"),
                HasSubstr("rotation: is not a number"));
    EXPECT_THAT(refusal("coco", beside(R"({"image_id":1,"bbox":[0,0,1,1e999]})")), HasSubstr("labels.txt"));
    EXPECT_THAT(with("7"), HasSubstr("annotations[1]: is not an object"));
    EXPECT_THAT(refusal("coco", beside("{")), HasSubstr("is not valid JSON"));
    EXPECT_THAT(refusal("coco", "{}"), HasSubstr("is this COCO"));
    EXPECT_THAT(refusal("coco", ""), HasSubstr("is not valid JSON"));
    EXPECT_THAT(refusal("coco", "{\"images\":\"\xff\"}"), HasSubstr("is not valid JSON"));
    EXPECT_THAT(refusal("coco", R"({"images":[{"id":1},{"id":1}],"annotations":[]})"),
                HasSubstr("images[1]: another image has the id 1"));
    EXPECT_THAT(refusal("kwcoco", R"({"images":[{"id":1,"frame_index":2000000000}],"annotations":[]})"),
                HasSubstr("frame_index: is beyond any video"));
}

TEST_F(DamagedLabels, UnknownFilesAreRefusedWithAdvice) {
    EXPECT_THAT(refusal("auto", ""), HasSubstr("is empty"));
    EXPECT_THAT(refusal("auto", "hello world\nthis is prose\n"),
                AllOf(HasSubstr("matches no known format"), HasSubstr("--format")));
    EXPECT_THAT(messageOf([&] { readLabels(folder_ / "absent.txt"); }), HasSubstr("absent.txt: there is no such file"));
    std::ofstream(folder_ / "clip.mp4") << std::string(
                                               "\0\0\0\x18"
                                               "ftypisom\0\0\0\0",
                                               16)
                                        << "no labels";
    EXPECT_THAT(messageOf([&] { readLabels(folder_ / "clip.mp4"); }), HasSubstr("is a video and no file of labels"));
    EXPECT_THAT(messageOf([&] { readLabels(folder_.path()); }), HasSubstr("the folder matches no known label format"));
    EXPECT_THAT(messageOf([&] { readLabels(folder_.path(), "nonsense"); }),
                HasSubstr("\"nonsense\" is unknown; there are native"));
    for (const LabelFormatInfo& info : labelFormats()) {
        const std::string message = messageOf([&] { readLabels(folder_ / "absent", info.name); });
        EXPECT_NE(message, "no error") << info.name;
        ImportOptions options;
        options.image_size = cv::Size(9, 9);
        options.columns = "frame,x,y,w,h";
        EXPECT_NE(messageOf([&] { readLabels(folder_.path(), info.name, options); }), "no error") << info.name;
    }
}

}  // namespace
}  // namespace eyrie::damaged_labels_test

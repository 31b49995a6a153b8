#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "formats/sample_labels.h"

namespace eyrie::upright_test {
namespace {

using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

/// Boxes along the image's axes in whole pixels, so that every format has digits enough for them.
LabelFile uprightLabels() {
    LabelFile labels;
    labels.image_size = cv::Size(320, 240);
    labels.frame_count = 12;
    labels.frame_rate_hz = 25;
    for (int frame = 0; frame < 12; ++frame) {
        for (const int id : {2, 5}) {
            LabelBox box;
            box.frame = frame;
            box.id = id;
            box.object_class = id == 2 ? "car" : "person";
            box.box = boxFromEdges({10.0 * id + 3 * frame, 40.0 + frame * (id - 3), 21, 13.0 + frame % 2}, 0);
            labels.boxes[frame].push_back(box);
        }
    }
    return labels;
}

class Upright : public testing::TestWithParam<std::string> {
 protected:
    std::filesystem::path path(const std::string& stem) const {
        for (const LabelFormatInfo& info : labelFormats()) {
            if (info.name != GetParam()) continue;
            if (info.folder) return folder_ / stem;
            return folder_ / (stem + (info.name == "uavdt" ? "_gt.txt" : "." + info.extensions.front()));
        }
        return {};
    }
    test::TemporaryFolder folder_;
};

/// Upright in, upright out: the same numbers, no rotation, nothing lost but what the format has no place for.
TEST_P(Upright, BoxesComeBackAsTheyWere) {
    ExportOptions options;
    options.columns = "frame,id,cname,x1,y1,w,h";
    ImportOptions import;
    if (GetParam() == "columns") import.columns = options.columns;
    const LabelFile before = uprightLabels();
    const ExportReport report = writeLabels(before, path("a"), GetParam(), options);
    EXPECT_EQ(report.lost(LossKind::rotation), 0);
    EXPECT_EQ(report.lost(LossKind::rounded), 0);
    EXPECT_EQ(report.lost(LossKind::heading), 0);
    const LabelFile after = readLabels(path("a"), GetParam(), import);
    EXPECT_EQ(reportOn(after).turned, 0);
    ASSERT_EQ(after.boxes.size(), before.boxes.size());
    const double digits = GetParam() == "yolo-obb" ? 1e-5 : 1e-9;  // that one divides by the image
    for (const auto& [frame, records] : before.boxes) {
        std::vector<LabelBox> found = after.boxes.at(frame);
        ASSERT_EQ(found.size(), records.size());
        std::sort(found.begin(), found.end(),
                  [](const LabelBox& a, const LabelBox& b) { return a.box.centre.x < b.box.centre.x; });
        for (std::size_t i = 0; i < records.size(); ++i) {
            EXPECT_EQ(found[i].box.heading, 0) << frame;
            EXPECT_NEAR(found[i].box.centre.x, records[i].box.centre.x, digits);
            EXPECT_NEAR(found[i].box.centre.y, records[i].box.centre.y, digits);
            EXPECT_NEAR(found[i].box.length, records[i].box.length, digits);
            EXPECT_NEAR(found[i].box.width, records[i].box.width, digits);
        }
    }
    // Written again they are the same text.
    LabelFile again = after;
    again.image_size = before.image_size;
    again.frame_count = before.frame_count;
    again.frame_rate_hz = before.frame_rate_hz;
    again.image_names.clear();
    writeLabels(again, path("b"), GetParam(), options);
    if (!std::filesystem::is_directory(path("a"))) {
        EXPECT_EQ(test::textOf(path("a")), test::textOf(path("b")));
    }
}

/// A turn by a fiftieth of a degree is how somebody's arithmetic rounds, not a rotation.
TEST_P(Upright, ATurnThatMovesNoEdgeIsNone) {
    ExportOptions options;
    options.columns = "frame,id,cname,x1,y1,w,h";
    LabelFile labels = uprightLabels();
    const std::filesystem::path exact = path("a"), turned = path("b");
    writeLabels(labels, exact, GetParam(), options);
    for (auto& [frame, records] : labels.boxes) {
        for (LabelBox& record : records) record.box.heading = radiansFromDegrees(0.02);
    }
    EXPECT_EQ(reportOn(labels).turned, 0);
    const ExportReport report = writeLabels(labels, turned, GetParam(), options);
    EXPECT_EQ(report.lost(LossKind::rotation), 0);
    EXPECT_EQ(report.lost(LossKind::heading), 0);
    const auto& formats = labelFormats();
    const auto info = std::find_if(formats.begin(), formats.end(),
                                   [](const LabelFormatInfo& entry) { return entry.name == GetParam(); });
    if (!info->carries.rotation && !info->folder) {
        EXPECT_EQ(test::textOf(exact), test::textOf(turned));
    }
    for (auto& [frame, records] : labels.boxes) {
        for (LabelBox& record : records) record.box.heading = radiansFromDegrees(10);
    }
    EXPECT_EQ(reportOn(labels).turned, 24);
}

INSTANTIATE_TEST_SUITE_P(Formats, Upright,
                         testing::Values("native", "native-result", "mot", "mot-cvat", "mot-result", "trackeval",
                                         "cvat", "coco", "kwcoco", "dota", "yolo-obb", "visdrone", "uavdt", "kw18",
                                         "virat", "viame", "vivid", "columns"),
                         [](const auto& entry) {
                             std::string name = entry.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

/// What the formats' own programs want of a file, where ours could differ without harm to our own reader.
struct TextFields : std::vector<std::string> {
    explicit TextFields(const std::string& line) {
        std::stringstream text(line);
        for (std::string field; std::getline(text, field, ',');) push_back(field);
    }
};

struct OwnPrograms : testing::Test {
    std::vector<std::string> linesOf(const std::filesystem::path& path) const {
        std::vector<std::string> lines;
        std::stringstream text(test::textOf(path));
        for (std::string line; std::getline(text, line);) lines.push_back(line);
        return lines;
    }
    test::TemporaryFolder folder_;
};

TEST_F(OwnPrograms, YoloTrainersStartFromTheFolderOfTheYaml) {
    writeLabels(uprightLabels(), folder_ / "set", "yolo-obb");
    const std::string yaml = test::textOf(folder_ / "set/data.yaml");
    EXPECT_THAT(yaml, AllOf(Not(HasSubstr("path:")), HasSubstr("train: images\n"), HasSubstr("val: images\n")));
}

TEST_F(OwnPrograms, DotaReadersTakeTheHeadForNoBox) {
    ExportOptions options;
    options.sequence = "a name of more than nine words is one word to them";
    writeLabels(uprightLabels(), folder_ / "d", "dota", options);
    const std::vector<std::string> lines = linesOf(folder_ / "d/labelTxt/000003.txt");
    ASSERT_EQ(lines.size(), 4u);
    for (const std::string& line : lines) {
        const auto blanks = std::count(line.begin(), line.end(), ' ');
        EXPECT_EQ(blanks, line.find(':') == std::string::npos ? 9 : 0) << line;
    }
}

TEST_F(OwnPrograms, UavdtMarksBoxesAsInView) {
    writeLabels(uprightLabels(), folder_ / "u_gt.txt", "uavdt");
    EXPECT_THAT(linesOf(folder_ / "u_gt.txt"), Each(testing::EndsWith(",1,1,-1")));
}

TEST_F(OwnPrograms, CocoBoundsHoldAllCornersHoweverLittleABoxIsTurned) {
    LabelFile labels = uprightLabels();
    for (auto& [frame, records] : labels.boxes) {
        for (LabelBox& record : records) record.box.heading = 0.02 * frame;
    }
    writeLabels(labels, folder_ / "c.json", "coco");
    const auto json = nlohmann::json::parse(test::textOf(folder_ / "c.json"));
    for (const auto& annotation : json["annotations"]) {
        const auto& corners = annotation["segmentation"][0];
        const double left = annotation["bbox"][0], width = annotation["bbox"][2];
        double first = 1e9, last = -1e9;
        for (std::size_t i = 0; i < 8; i += 2) {
            first = std::min(first, corners[i].get<double>());
            last = std::max(last, corners[i].get<double>());
        }
        EXPECT_NEAR(left, first, 2e-4);
        EXPECT_NEAR(left + width, last, 2e-4);
    }
}

TEST_F(OwnPrograms, CategoriesHaveNamesOfTheirOwn) {
    LabelFile labels = uprightLabels();
    labels.boxes[0][0].object_class.clear();
    labels.boxes[0][1].object_class = "object";
    writeLabels(labels, folder_ / "c.json", "kwcoco");
    const auto json = nlohmann::json::parse(test::textOf(folder_ / "c.json"));
    std::set<std::string> names;
    for (const auto& category : json["categories"]) {
        EXPECT_TRUE(names.insert(category["name"].get<std::string>()).second) << category;
    }
}

TEST_F(OwnPrograms, TrackEvalReadsTheTreeLineByLine) {
    ExportOptions options;
    options.sequence = "one";
    const auto map = folder_ / "t/gt/mot_challenge/seqmaps/EYRIE-train.txt";
    test::writeText(map, "name\n\n");  // a blank line ends TrackEval with an exception
    LabelFile labels = uprightLabels();
    labels.boxes[3][0].ignore = true;
    writeLabels(labels, folder_ / "t", "trackeval", options);
    options.sequence = "two";
    writeLabels(labels, folder_ / "t", "trackeval", options);
    EXPECT_THAT(linesOf(map), testing::ElementsAre("name", "one", "two"));
    const auto sequence = folder_ / "t/gt/mot_challenge/EYRIE-train/two";
    EXPECT_THAT(test::textOf(sequence / "seqinfo.ini"), AllOf(HasSubstr("[Sequence]\n"), HasSubstr("seqLength=12\n")));
    for (const std::string& line : linesOf(sequence / "gt/gt.txt")) {
        const TextFields fields(line);
        ASSERT_EQ(fields.size(), 9u) << line;
        EXPECT_GE(std::stoi(fields[0]), 1);
        EXPECT_LE(std::stoi(fields[0]), 12);
        const bool ignored = fields[6] == "0";
        EXPECT_EQ(fields[7], ignored ? "8" : "1") << "a distractor or a pedestrian: " << line;
    }
    options.tracker = "ours";
    writeLabels(labels, folder_ / "t", "trackeval", options);
    for (const std::string& line : linesOf(folder_ / "t/trackers/mot_challenge/EYRIE-train/ours/data/two.txt")) {
        const TextFields fields(line);
        ASSERT_EQ(fields.size(), 10u);
        EXPECT_EQ(fields[7], "-1") << "no class but pedestrian is taken";
    }
}

}  // namespace
}  // namespace eyrie::upright_test

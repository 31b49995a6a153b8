#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "formats/sample_labels.h"

/// An export says that something was lost where it does not come back, and only there.
namespace eyrie::told_losses_test {
namespace {

class ToldLosses : public testing::TestWithParam<std::string> {
 protected:
    const LabelFormatInfo& info() const {
        const auto& all = labelFormats();
        return *std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.name == GetParam(); });
    }
    std::string columns() const {
        return info().name == "columns" ? "frame,id,cname,x1,y1,w,h,heading,score,ignore,occluded" : "";
    }
    /// Three upright cars of whole pixels in each of four frames.
    LabelFile cars() const {
        LabelFile labels;
        labels.image_size = cv::Size(320, 240);
        labels.frame_count = 4;
        labels.frame_rate_hz = 25;
        for (int frame = 0; frame < 4; ++frame)
            for (int k = 0; k < 3; ++k) {
                LabelBox box;
                box.frame = frame;
                box.id = k + 1;
                box.box = {{59.5 + 80 * k, 99.5 + 2 * frame}, 20, 10, 0};
                box.object_class = "car";
                labels.boxes[frame].push_back(box);
            }
        return labels;
    }
    /// What is told of labels, and the boxes of their second frame that come back, from left to right.
    std::pair<ExportReport, std::vector<LabelBox>> trip(const LabelFile& labels) {
        std::filesystem::path path = folder_ / ("trip" + std::to_string(++trips_));
        if (!info().folder)
            path += info().name == "uavdt" ? "_gt.txt"
                                           : "." + (info().extensions.empty() ? "txt" : info().extensions.front());
        ExportOptions options;
        options.columns = columns();
        ExportReport report = writeLabels(labels, path, info().name, options);
        ImportOptions import;
        import.columns = columns();
        std::vector<LabelBox> boxes = readLabels(path, info().name, import).boxes.at(1);
        std::sort(boxes.begin(), boxes.end(),
                  [](const LabelBox& a, const LabelBox& b) { return a.box.centre.x < b.box.centre.x; });
        return {report, boxes};
    }
    test::TemporaryFolder folder_;
    int trips_ = 0;
};

TEST_P(ToldLosses, OfUprightCarsNothingButIdsAndClassesIsLost) {
    const auto [report, boxes] = trip(cars());
    for (const LossKind kind : {LossKind::rotation, LossKind::occlusion, LossKind::ignore, LossKind::score,
                                LossKind::velocity, LossKind::clipped, LossKind::rounded, LossKind::other})
        EXPECT_EQ(report.lost(kind), 0) << static_cast<int>(kind);
    ASSERT_EQ(boxes.size(), 3U);
    const bool has_ids = boxes[0].id.has_value();
    EXPECT_EQ(report.lost(LossKind::id), has_ids ? 0 : 12);
    EXPECT_EQ(report.lost(LossKind::class_name), boxes[0].object_class == "car" ? 0 : 12);
}

TEST_P(ToldLosses, IgnoredBoxesAreIgnoredOrToldToCount) {
    LabelFile labels = cars();
    labels.boxes[1][1].ignore = true;
    const auto [report, boxes] = trip(labels);
    ASSERT_EQ(boxes.size(), 3U);
    EXPECT_EQ(report.lost(LossKind::ignore), boxes[1].ignore ? 0 : 1);
    EXPECT_FALSE(boxes[0].ignore);
    EXPECT_FALSE(boxes[2].ignore);
}

TEST_P(ToldLosses, OcclusionComesBackOrIsToldLost) {
    LabelFile labels = cars();
    labels.boxes[1][1].occlusion = Occlusion::fully;
    const auto [report, boxes] = trip(labels);
    EXPECT_EQ(report.lost(LossKind::occlusion), boxes.at(1).occlusion == Occlusion::fully ? 0 : 1);
    EXPECT_EQ(boxes.at(0).occlusion, Occlusion::none);
}

TEST_P(ToldLosses, ScoresComeBackOrAreToldLost) {
    LabelFile labels = cars();
    labels.boxes[1][1].score = 0.25;
    const auto [report, boxes] = trip(labels);
    EXPECT_EQ(report.lost(LossKind::score), boxes.at(1).score == 0.25 ? 0 : 1);
    EXPECT_EQ(boxes.at(0).score, 1);
}

TEST_P(ToldLosses, TurnedBoxesComeBackTurnedOrAreToldEnclosed) {
    LabelFile labels = cars();
    labels.boxes[1][1].box.heading = 0.5;
    const auto [report, boxes] = trip(labels);
    EXPECT_EQ(report.lost(LossKind::rotation), std::abs(boxes.at(1).box.heading) > 0.4 ? 0 : 1);
    EXPECT_NEAR(boxes.at(0).box.heading, 0, 1e-9);
}

TEST_P(ToldLosses, BoxesBetweenPixelsComeBackSoOrAreToldRounded) {
    LabelFile labels = cars();
    labels.boxes[1][1].box.centre += cv::Point2d(0.25, 0.25);
    const auto [report, boxes] = trip(labels);
    const bool moved = cv::norm(boxes.at(1).box.centre - labels.boxes[1][1].box.centre) > 0.1;
    EXPECT_EQ(report.lost(LossKind::rounded), moved ? 1 : 0);
}

INSTANTIATE_TEST_SUITE_P(Formats, ToldLosses,
                         testing::Values("native", "native-result", "mot", "mot-cvat", "mot-result", "cvat", "coco",
                                         "kwcoco", "dota", "yolo-obb", "visdrone", "uavdt", "kw18", "virat", "viame",
                                         "vivid", "columns"),
                         [](const auto& format) {
                             std::string name = format.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace eyrie::told_losses_test

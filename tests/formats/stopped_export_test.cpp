#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <stop_token>

#include "formats/sample_labels.h"

namespace eyrie::stopped_export_test {
namespace {

/// Labels that are stopped when so many of their frames were handed over, however often they are gone through.
LabelStream stoppedAfter(int frames, const LabelFile& labels, std::stop_source& stop) {
    LabelStream stream;
    stream.about = labels;
    stream.about.boxes.clear();
    stream.frames = [all = framesOf(labels.boxes), left = std::make_shared<int>(frames),
                     &stop](const FrameVisitor& visitor) {
        all([&](FrameIndex frame, const std::vector<LabelBox>& boxes) {
            if ((*left)-- == 0) stop.request_stop();
            visitor(frame, boxes);
        });
    };
    return stream;
}

class StoppedExport : public testing::TestWithParam<std::string> {
 protected:
    ExportOptions options() const {
        ExportOptions options;
        options.columns = "frame,id,cname,x1,y1,w,h";
        return options;
    }
    test::TemporaryFolder folder_;
};

TEST_P(StoppedExport, LeavesNothingOrIsWhole) {
    const LabelFile labels = test::sampleLabels();
    int stopped = 0;
    for (int frames = 0; frames < 40; ++frames) {
        const std::filesystem::path place = folder_ / std::to_string(frames);
        std::filesystem::create_directories(place);
        std::stop_source stop;
        const LabelStream stream = stoppedAfter(frames, labels, stop);
        std::vector<std::filesystem::path> written;
        try {
            written = writeLabels(stream, place / "labels.txt", GetParam(), options(), stop.get_token()).files;
        } catch (const Error& error) {
            ASSERT_TRUE(stop.stop_requested()) << error.what();
            EXPECT_TRUE(std::filesystem::is_empty(place)) << "after " << frames << " frames";
            ++stopped;
            continue;
        }
        for (const auto& file : written) EXPECT_TRUE(std::filesystem::exists(file)) << file;
    }
    // They are looked through once and written once; of several files the second look cannot be left half done.
    const auto& known = labelFormats();
    const bool folder =
        std::find_if(known.begin(), known.end(), [](const auto& format) { return format.name == GetParam(); })->folder;
    const bool one_file = !folder && filesToWrite(folder_ / "labels.txt", GetParam(), options()).size() == 1;
    EXPECT_GE(stopped, static_cast<int>(labels.boxes.size()) * (one_file ? 2 : 1));
}

INSTANTIATE_TEST_SUITE_P(Formats, StoppedExport,
                         testing::Values("native", "native-result", "mot", "mot-cvat", "trackeval", "cvat", "coco",
                                         "dota", "yolo-obb", "visdrone", "uavdt", "kw18", "virat", "viame", "vivid",
                                         "columns", "tracks-csv"),
                         [](const auto& format) {
                             std::string name = format.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace eyrie::stopped_export_test

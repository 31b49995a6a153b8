#include "learning/training/labelled_frames.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace eyrie::labelled_frames_test {
namespace {

TrainingBoxes boxesIn(const std::vector<FrameIndex>& frames) {
    TrainingBoxes boxes;
    for (const FrameIndex frame : frames)
        boxes[frame] = {{{{50, 40}, 22, 10, 0}, true}, {{{120, 80}, 22, 10, 0}, false}};
    return boxes;
}

cv::Mat noise(FrameIndex frame) {
    cv::Mat image(160, 240, CV_8UC1);
    cv::RNG random(static_cast<std::uint64_t>(frame) + 1);
    random.fill(image, cv::RNG::UNIFORM, 0, 255);
    return image;
}

TEST(LabelledFrames, LabelledOnesThatLieApart) {
    std::vector<FrameIndex> read;
    double share = 0;
    const auto images = labelledImagesOf(
        boxesIn({-3, 5, 15, 25, 35, 45, 99}), "clip", 60, 12,
        [&](FrameIndex frame) {
            read.push_back(frame);
            return noise(frame);
        },
        {}, [&](double done) { share = done; });
    EXPECT_EQ(read, (std::vector<FrameIndex>{5, 25, 45}));  // −3 and 99 are not in the video
    ASSERT_EQ(images.size(), 3U);
    EXPECT_EQ(images[0].vehicles.size(), 1U);
    EXPECT_EQ(images[0].unclear.size(), 1U);
    EXPECT_EQ(images[0].group, "clip");
    EXPECT_GT(share, 0.5);
}

TEST(LabelledFrames, ClearAreVehiclesInFullView) {
    BoxRecord record;
    record.box = {{5, 5}, 20, 10, 0};
    record.object_class = "car";
    EXPECT_TRUE(trainingBoxOf(record).clear);
    EXPECT_FALSE(trainingBoxOf(record, true).clear);
    record.ignore = true;
    EXPECT_FALSE(trainingBoxOf(record).clear);
    record.ignore = false;
    record.object_class = "person";
    EXPECT_FALSE(trainingBoxOf(record).clear);
    record.object_class = "truck";
    record.box.width = 0;
    EXPECT_FALSE(trainingBoxOf(record).clear);
}

TEST(LabelledFrames, FourOthersToEachVehicle) {
    const auto images = labelledImagesOf(boxesIn({0, 1}), "clip", 2, 1, noise, {});
    const SampleSet samples = samplesFromImages(images, 7);
    EXPECT_EQ(countOf(samples, true), 2);
    EXPECT_EQ(countOf(samples, false), 8);
    const SampleSet again = samplesFromImages(images, 7);
    ASSERT_EQ(again.size(), samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i)
        EXPECT_EQ(cv::norm(samples[i].window, again[i].window, cv::NORM_INF), 0);
}

TEST(LabelledFrames, EndsWhenStopped) {
    std::stop_source stop;
    const auto images = labelledImagesOf(
        boxesIn({0, 1, 2}), "clip", 3, 1,
        [&](FrameIndex frame) {
            stop.request_stop();
            return noise(frame);
        },
        stop.get_token());
    EXPECT_EQ(images.size(), 1U);
}

}  // namespace
}  // namespace eyrie::labelled_frames_test

#include "ground/track_story.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "events/driven_tracks.h"

namespace eyrie::track_story_test {
namespace {

StoredTracks drivenUnderACamera() {
    test::DrivenTracks scene;
    scene.camera = test::DrivenTracks::moving(0.2);
    scene.drive({50, 60}, 0, {{8, 36, 36}, {4, 0, 0}, {8, 36, 36}});
    StoredTracks run;
    run.tracks = scene.tracks;
    run.footage = scene.footage();
    return run;
}

}  // namespace

TEST(TrackStory, TellsSpeedsAndWaysOnTheGround) {
    const StoredTracks run = drivenUnderACamera();
    const GroundStretches ground(run.footage);
    const auto story = storyOf(run, ground, 1, 100);
    ASSERT_GT(story.size(), 400U);
    for (const StoryPoint& point : story) {
        const double t = point.frame / 25.0;
        if ((t > 1 && t < 7) || (t > 13 && t < 19)) {
            EXPECT_NEAR(point.speed, 10, 1) << point.frame;
        }
        if (t > 9 && t < 11) {
            EXPECT_LT(point.speed, 1) << point.frame;
        }
        EXPECT_DOUBLE_EQ(point.seconds, t);
        EXPECT_NEAR(point.length_px, 4.5 / 0.2, 5);
    }
    EXPECT_NEAR(cv::norm(story[175].at - story[25].at), 60, 2);
    EXPECT_TRUE(storyOf(run, ground, 9, 100).empty());
    EXPECT_TRUE(storyOf(run, ground, 1, 5000).empty());
}

TEST(TrackStory, InAnObliqueViewSpeedsAndWaysAreThoseOfThePlace) {
    StoredTracks run = drivenUnderACamera();
    const GroundStretches flat_ground(run.footage);
    const auto flat = storyOf(run, flat_ground, 1, 100);
    EXPECT_NEAR(flat.back().way_m, cv::norm(flat.back().at - flat.front().at), 3);
    run.footage.scale.slope = ScaleSlope::ofPicture(run.footage.image_size, 0.001, 0);
    const GroundStretches ground(run.footage);
    const auto oblique = storyOf(run, ground, 1, 100);
    ASSERT_EQ(oblique.size(), flat.size());
    double way = 0;
    double before = 0;
    for (std::size_t i = 0; i < flat.size(); ++i) {
        // Metres of the scale in the middle, pixels of the frame, metres of the place.
        const double px = 1 / flat_ground.metresPerPixel(flat[i].frame, flat[i].image);
        const double metres = 0.2 / (1 + 0.001 * (flat[i].image.x - 499.5));
        EXPECT_NEAR(oblique[i].speed, flat[i].speed * px * metres, 1e-9);
        // The scale changes from one end of a step to the other.
        if (i > 0) way += cv::norm(flat[i].at - flat[i - 1].at) * (before + px * metres) / 2;
        before = px * metres;
        EXPECT_NEAR(oblique[i].way_m, way, 1e-6);
    }
}

TEST(TrackStory, FramesAroundAMomentAreSpreadEvenly) {
    std::vector<StoryPoint> story;
    for (int frame = 0; frame < 200; ++frame) story.push_back({frame, frame / 25.0, 0, 0, {}, {}, 0});
    const auto chosen = chosenAround(story, 100, 2, 2, 11);
    ASSERT_EQ(chosen.size(), 11U);
    EXPECT_EQ(chosen.front().frame, 50);
    EXPECT_EQ(chosen[5].frame, 100);
    EXPECT_EQ(chosen.back().frame, 150);
    EXPECT_EQ(chosenAround(story, 0, 2, 0.1, 50).size(), 3U);
    EXPECT_EQ(chosenAround(story, 999, 0, 0, 5).front().frame, 199);
    const auto alone = chosenAround(story, 100, 2, 2, 1);
    ASSERT_EQ(alone.size(), 1U);
    EXPECT_EQ(alone.front().frame, 100);
    EXPECT_TRUE(chosenAround({}, 3, 1, 1, 5).empty());
    EXPECT_TRUE(chosenAround(story, 3, 1, 1, 0).empty());
}

TEST(TrackStory, AStackShowsTheVehicleWithLessNoise) {
    constexpr int kFrames = 40;
    StoredTracks run;
    run.footage.image_size = {200, 100};
    run.footage.last_frame = kFrames - 1;
    EventTrack track;
    track.id = 3;
    for (int frame = 0; frame < kFrames; ++frame) track.boxes.push_back({frame, {{40.0 + 2 * frame, 50}, 24, 12, 0}});
    run.tracks.push_back(track);
    const GrayFrames gray = [&](FrameIndex frame) {
        cv::Mat picture(100, 200, CV_8UC1, cv::Scalar(90)), noise(100, 200, CV_8UC1);
        picture(cv::Rect(28 + 2 * frame, 44, 25, 13)).setTo(200);
        cv::RNG random(static_cast<std::uint64_t>(frame) + 7);
        random.fill(noise, cv::RNG::UNIFORM, 0, 50);
        return cv::Mat(picture + noise);
    };
    const ObjectStack stack = stackOfTrack(run, 3, 20, gray);
    ASSERT_FALSE(stack.stacked.empty());
    EXPECT_EQ(stack.layers, 25);
    const cv::Rect middle(stack.stacked.cols / 2 - 8, stack.stacked.rows / 2 - 4, 16, 8);
    cv::Scalar mean, deviation;
    cv::meanStdDev(stack.stacked(middle), mean, deviation);
    EXPECT_NEAR(mean[0], 225, 8) << "the vehicle lies in the middle";
    EXPECT_LT(deviation[0], 7) << "one frame has 14";
    EXPECT_LT(stack.stacked.at<unsigned char>(2, 2), 150) << "and ground around it";
    EXPECT_TRUE(stackOfTrack(run, 9, 20, gray).stacked.empty());
    EXPECT_TRUE(stackOfTrack(run, 3, kFrames, gray).stacked.empty());
}

TEST(TrackStory, AChipShowsThePlaceInItsMiddle) {
    cv::Mat picture = cv::Mat::zeros(100, 100, CV_8UC1);
    picture.at<uchar>(30, 70) = 200;
    const cv::Mat chip = chipOf(picture, {70, 30}, 11, 11);
    ASSERT_EQ(chip.size(), cv::Size(11, 11));
    EXPECT_EQ(chip.at<uchar>(5, 5), 200);
    EXPECT_EQ(cv::countNonZero(chip), 1);
    EXPECT_EQ(chipOf(picture, {70, 30}, 10, 40).size(), cv::Size(40, 40));
    EXPECT_EQ(cv::countNonZero(chipOf(picture, {-90, -90}, 20, 20)), 0);
    const cv::Mat pixel = chipOf(picture, {70, 30}, 1, 1);
    ASSERT_EQ(pixel.size(), cv::Size(1, 1));
    EXPECT_EQ(pixel.at<uchar>(0, 0), 200);
    EXPECT_TRUE(chipOf(cv::Mat(), {0, 0}, 20, 20).empty());
    EXPECT_TRUE(chipOf(picture, {0, 0}, 0, 20).empty());
}

}  // namespace eyrie::track_story_test

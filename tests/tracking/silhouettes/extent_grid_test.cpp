// How far a lorry of which a box holds the cab reaches, on pictures that are known to the pixel.
#include "tracking/silhouettes/extent_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace eyrie::extent_grid_test {
namespace {

constexpr double kMetre = 5;  // px
const OrientedBox kCab{{150, 60}, 24, 12, 0};
const ExtentGrid kGrid(kCab, kMetre, false);
const cv::Rect kLorry(102, 54, 60, 12);  ///< from 48 px behind the middle of the cab to 12 px ahead of it
const cv::Matx33d kHere = cv::Matx33d::eye();

cv::Mat road(double brightness = 150) {
    cv::Mat picture(120, 320, CV_8UC1);
    cv::RNG(7).fill(picture, cv::RNG::NORMAL, brightness, 3);
    return picture;
}

cv::Mat with(cv::Mat picture, const cv::Rect& place, double brightness) {
    picture(place).setTo(brightness);
    return picture;
}

cv::Mat shadedAt(cv::Mat picture, const cv::Rect& place) {
    cv::Mat(picture(place) * 0.5).copyTo(picture(place));
    return picture;
}

std::optional<VehicleExtent> extentOf(const cv::Mat& picture, const std::vector<OrientedBox>& others = {},
                                      const std::vector<ExtentGrid::Sample>& grounds = {
                                          kGrid.sampled(road(), kHere, {}, false)}) {
    return kGrid.compare(kGrid.sampled(picture, kHere, others, true), grounds);
}

}  // namespace

TEST(ExtentGrid, ReachesTheWholeLorryOfWhichTheBoxHoldsTheCab) {
    const auto extent = extentOf(with(road(), kLorry, 230));
    ASSERT_TRUE(extent);
    EXPECT_NEAR(extent->whole.rear, -48, 1.1);
    EXPECT_NEAR(extent->whole.front, 12, 1.1);
    EXPECT_NEAR(extent->whole.left, -6, 1.1);
    EXPECT_NEAR(extent->whole.right, 6, 1.1);
    ASSERT_TRUE(extent->lit);
    EXPECT_NEAR(extent->lit->rear, -48, 1.1);
    EXPECT_DOUBLE_EQ(extent->lit_beyond, 1);
    EXPECT_FALSE(extent->cut);
}

TEST(ExtentGrid, ReachesTheLongestLorriesWhereOtherPartsOfThemAreFollowed) {
    // 9 m, and 14 m, beyond the cab's box.
    const cv::Rect longest(70, 54, 92, 12);
    EXPECT_TRUE(extentOf(with(road(), longest, 230))->cut);
    const ExtentGrid grid(kCab, kMetre, true);
    const auto extent = grid.compare(grid.sampled(with(road(), longest, 230), kHere, {}, true),
                                     {grid.sampled(road(), kHere, {}, false)});
    ASSERT_TRUE(extent);
    EXPECT_NEAR(extent->whole.rear, -80, 1.1);
    EXPECT_FALSE(extent->cut);
}

TEST(ExtentGrid, TurnsWithTheBox) {
    cv::Mat picture = road();
    cv::Mat turned;
    cv::rotate(with(road(), kLorry, 230), turned, cv::ROTATE_90_CLOCKWISE);
    cv::Mat bare;
    cv::rotate(road(), bare, cv::ROTATE_90_CLOCKWISE);
    const OrientedBox down{{119.0 - 60, 150}, 24, 12, CV_PI / 2};
    const ExtentGrid grid(down, kMetre, false);
    const auto extent = grid.compare(grid.sampled(turned, kHere, {}, true), {grid.sampled(bare, kHere, {}, false)});
    ASSERT_TRUE(extent);
    EXPECT_NEAR(extent->whole.rear, -48, 1.1);
    EXPECT_NEAR(extent->whole.front, 12, 1.1);
}

TEST(ExtentGrid, TellsWhatIsNoShadow) {
    // A dark car, and the ground behind it as dark as in the shade.
    const auto shade = extentOf(shadedAt(with(road(), {138, 54, 24, 12}, 20), {102, 54, 36, 12}));
    ASSERT_TRUE(shade);
    EXPECT_NEAR(shade->whole.rear, -48, 1.1);
    EXPECT_NEAR(shade->lit_beyond, 0, 0.02);
    ASSERT_TRUE(shade->lit);
    EXPECT_NEAR(shade->lit->rear, -12, 1.1) << "where the car ends";
    const auto half = extentOf(shadedAt(with(road(), kLorry, 230), {102, 54, 17, 12}));
    ASSERT_TRUE(half);
    EXPECT_NEAR(half->lit_beyond, 0.53, 0.07);
    const auto none = extentOf(with(road(), {138, 54, 24, 12}, 230));
    ASSERT_TRUE(none);
    EXPECT_DOUBLE_EQ(none->lit_beyond, 0) << "nothing lies beyond the box";
}

TEST(ExtentGrid, StopsAtAnotherVehicle) {
    // Bumper to bumper with a car that has a track.
    const cv::Mat picture = with(road(), kLorry, 230);
    const OrientedBox car{{119.5, 59.5}, 36, 12, 0};
    const auto extent = extentOf(picture, {car});
    ASSERT_TRUE(extent);
    EXPECT_NEAR(extent->whole.rear, -12, 1.1);
    EXPECT_NEAR(extent->whole.front, 12, 1.1);
}

TEST(ExtentGrid, LeavesOutWhatGroundSaysNothingOf) {
    // Another drives behind in both pictures of the ground: what it hides tells nothing, nor does what is close to it.
    const cv::Rect follower(100, 54, 30, 12);
    const cv::Mat queue = with(road(), follower, 90);
    const OrientedBox box{{114.5, 59.5}, 30, 12, 0};
    const auto ground = [&](bool told) {
        return kGrid.sampled(queue, kHere, told ? std::vector<OrientedBox>{box} : std::vector<OrientedBox>{}, false);
    };
    const cv::Mat picture = with(road(), {132, 54, 30, 12}, 230);
    const auto extent = extentOf(picture, {}, {ground(true), ground(true)});
    ASSERT_TRUE(extent);
    EXPECT_NEAR(extent->whole.rear, -18, 1.6) << "2.5 px about the other are unknown";
    // One picture in which nobody hides it says enough.
    const auto seen = extentOf(with(road(), kLorry, 230), {}, {ground(true), kGrid.sampled(road(), kHere, {}, false)});
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->whole.rear, -48, 1.1);
}

TEST(ExtentGrid, PlacesBeyondThePictureSayNothing) {
    const OrientedBox near_border{{20, 60}, 24, 12, 0};
    const ExtentGrid grid(near_border, kMetre, false);
    const auto extent = grid.compare(grid.sampled(with(road(), {0, 54, 32, 12}, 230), kHere, {}, true),
                                     {grid.sampled(road(), kHere, {}, false)});
    ASSERT_TRUE(extent);
    EXPECT_NEAR(extent->whole.rear, -20, 1.1);
    EXPECT_NEAR(extent->whole.front, 12, 1.1);
    EXPECT_FALSE(extent->cut);
}

TEST(ExtentGrid, TellsWhatGoesOnBeyondIt) {
    const auto behind = extentOf(with(road(), {60, 54, 102, 12}, 230));
    ASSERT_TRUE(behind);
    EXPECT_TRUE(behind->cut);
    const auto ahead = extentOf(with(road(), {138, 54, 110, 12}, 230));
    ASSERT_TRUE(ahead);
    EXPECT_TRUE(ahead->cut);
}

TEST(ExtentGrid, FollowsTheCamera) {
    // The ground was seen 30 px farther to the right, where the picture of the lorry shows it at its own place.
    const cv::Matx33d there(1, 0, 30, 0, 1, 0, 0, 0, 1);
    cv::Mat striped = road();
    for (int x = 0; x < striped.cols; x += 16) striped.colRange(x, std::min(x + 8, striped.cols)).setTo(90);
    cv::Mat moved(striped.size(), CV_8UC1, cv::Scalar(150));
    striped.colRange(0, 290).copyTo(moved.colRange(30, 320));
    const auto extent = extentOf(with(striped.clone(), kLorry, 230), {}, {kGrid.sampled(moved, there, {}, false)});
    ASSERT_TRUE(extent);
    EXPECT_NEAR(extent->whole.rear, -48, 1.1);
    EXPECT_NEAR(extent->whole.front, 12, 1.1);
    EXPECT_TRUE(kGrid.mayReach({{150 + 30 - 60, 60}, 20, 10, 0}, there));
    EXPECT_FALSE(kGrid.mayReach({{150 + 30 - 90, 60}, 20, 10, 0}, there));
    EXPECT_TRUE(kGrid.mayReach({{150 - 60, 60}, 20, 10, 0}, kHere));
}

TEST(ExtentGrid, SaysNothingOfWhatDoesNotStandOut) {
    EXPECT_FALSE(extentOf(road()));
    EXPECT_FALSE(extentOf(with(road(), {102, 54, 30, 12}, 230))) << "it stands behind the box";
}

}  // namespace eyrie::extent_grid_test

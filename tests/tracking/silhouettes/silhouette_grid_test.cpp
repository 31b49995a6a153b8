// What a silhouette tells of a vehicle and its shadow, on a patch that is known to the pixel.
#include "tracking/silhouettes/silhouette_grid.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace eyrie::silhouette_grid_test {
namespace {

const OrientedBox kBox{{60, 40}, 24, 12, 0};
const SilhouetteGrid kGrid(kBox, 10, 1);

cv::Mat bareGround(double brightness = 150) {
    cv::Mat ground(80, 120, CV_8UC1);
    cv::RNG(7).fill(ground, cv::RNG::NORMAL, brightness, 3);
    return ground;
}

/// A car of 24 × 12 px in the box, and its shadow that reaches 4 px beyond its front and 3 px to its right.
cv::Mat withCar(cv::Mat ground, double paint) {
    for (int y = 34; y < 49; ++y) {
        for (int x = 48; x < 76; ++x) {
            uchar& pixel = ground.at<uchar>(y, x);
            if (x < 72 && y < 46) {
                pixel = cv::saturate_cast<uchar>(paint);
            } else if (x >= 52 && y >= 37) {
                pixel = cv::saturate_cast<uchar>(0.5 * pixel);
            }
        }
    }
    return ground;
}

std::optional<Silhouette> seen(const cv::Mat& vehicle, const std::vector<cv::Mat>& grounds) {
    std::vector<cv::Mat> sampled;
    sampled.reserve(grounds.size());
    for (const cv::Mat& ground : grounds) sampled.push_back(kGrid.sampled(ground));
    return kGrid.compare(kGrid.sampled(vehicle), sampled);
}

}  // namespace

TEST(SilhouetteGrid, TellsABrightVehicleFromItsShadow) {
    const auto silhouette = seen(withCar(bareGround(), 230), {bareGround()});
    ASSERT_TRUE(silhouette && silhouette->lit);
    EXPECT_NEAR(silhouette->whole.rear, -12, 1.01);
    EXPECT_NEAR(silhouette->whole.front, 16, 1.01);
    EXPECT_NEAR(silhouette->whole.left, -6, 1.01);
    EXPECT_NEAR(silhouette->whole.right, 9, 1.01);
    EXPECT_NEAR(silhouette->lit->rear, -12, 1.01);
    EXPECT_NEAR(silhouette->lit->front, 12, 1.01);
    EXPECT_NEAR(silhouette->lit->left, -6, 1.01);
    EXPECT_NEAR(silhouette->lit->right, 6, 1.01);
    EXPECT_TRUE(silhouette->lit_vehicle);
}

TEST(SilhouetteGrid, DoesNotTellADarkVehicleFromItsShadow) {
    const auto silhouette = seen(withCar(bareGround(), 80), {bareGround()});
    ASSERT_TRUE(silhouette);
    EXPECT_NEAR(silhouette->whole.front, 16, 1.01);
    EXPECT_FALSE(silhouette->lit_vehicle);
}

TEST(SilhouetteGrid, TellsHowMuchOfTheBoxIsShaded) {
    const cv::Mat ground = bareGround();
    const auto shaded = [&](const cv::Mat& vehicle, const cv::Mat& bare) {
        return kGrid.shadedInBox(kGrid.sampled(vehicle), {kGrid.sampled(bare)});
    };
    EXPECT_DOUBLE_EQ(shaded(ground, ground), 0);
    cv::Mat half = ground.clone();
    half(cv::Rect(48, 30, 12, 20)) *= 0.5;
    EXPECT_NEAR(shaded(half, ground), 0.5, 0.05) << "the rear half, and beside the box as well";
    cv::Mat lamp_post = ground.clone();
    lamp_post(cv::Rect(74, 20, 6, 40)) *= 0.5;
    EXPECT_DOUBLE_EQ(shaded(lamp_post, ground), 0) << "before the box, not in it";
    EXPECT_NEAR(shaded(withCar(ground.clone(), 80), ground), 1, 0.05) << "a dark vehicle cannot be told from it";
    EXPECT_NEAR(shaded(withCar(ground.clone(), 230), ground), 0, 0.05);
    EXPECT_LT(shaded(withCar(ground.clone(), 20), ground), 0.2) << "black, darker than any shadow but at its edges";
    cv::Mat night = bareGround(40);
    cv::Mat in_shade = night * 0.5;
    EXPECT_DOUBLE_EQ(shaded(in_shade, night), 0);
    // It must be shaded against the ground of all pictures.
    EXPECT_DOUBLE_EQ(kGrid.shadedInBox(kGrid.sampled(half), {kGrid.sampled(ground), kGrid.sampled(half)}), 0);
}

TEST(SilhouetteGrid, DoesNotTakeARoofForTheVehicle) {
    cv::Mat picture = withCar(bareGround(), 80);
    picture(cv::Rect(56, 37, 6, 6)).setTo(230);
    const auto silhouette = seen(picture, {bareGround()});
    ASSERT_TRUE(silhouette && silhouette->lit);
    EXPECT_FALSE(silhouette->lit_vehicle);
}

TEST(SilhouetteGrid, WantsAllGroundsToDiffer) {
    // What stood there in one picture and not in the other is on the ground of one of them.
    cv::Mat parked = bareGround();
    parked(cv::Rect(43, 30, 8, 20)).setTo(60);
    const auto one = seen(withCar(bareGround(), 230), std::vector<cv::Mat>{parked});
    const auto both = seen(withCar(bareGround(), 230), {parked, bareGround()});
    ASSERT_TRUE(one);
    ASSERT_TRUE(both);
    EXPECT_NEAR(one->whole.rear, -17, 1.01);
    EXPECT_NEAR(both->whole.rear, -12, 1.01);
}

TEST(SilhouetteGrid, SaysNothingAtNightAndWhereItIsOneWithOtherThings) {
    EXPECT_TRUE(seen(withCar(bareGround(70), 230), {bareGround(70)}));
    EXPECT_FALSE(seen(withCar(bareGround(50), 230), {bareGround(50)}));
    cv::Mat merged = withCar(bareGround(), 230);
    merged(cv::Rect(60, 20, 8, 20)).setTo(230);
    EXPECT_FALSE(seen(merged, {bareGround()}));
    EXPECT_FALSE(seen(bareGround(), {bareGround()}));
}

TEST(SilhouetteGrid, SamplesNothingBeyondThePicture) {
    EXPECT_FALSE(kGrid.sampled(bareGround()).empty());
    EXPECT_TRUE(SilhouetteGrid({{10, 40}, 24, 12, 0}, 10, 1).sampled(bareGround()).empty());
    EXPECT_TRUE(kGrid.sampled(bareGround(), {1, 0, 60, 0, 1, 0, 0, 0, 1}).empty());
}

TEST(SilhouetteGrid, TurnsWithTheBox) {
    // The same car from behind: what lay beyond its front lies beyond its rear, and left is right.
    const SilhouetteGrid turned({kBox.centre, 24, 12, CV_PI}, 10, 1);
    const auto silhouette = turned.compare(turned.sampled(withCar(bareGround(), 230)), {turned.sampled(bareGround())});
    ASSERT_TRUE(silhouette);
    EXPECT_NEAR(silhouette->whole.rear, -16, 1.01);
    EXPECT_NEAR(silhouette->whole.front, 12, 1.01);
    EXPECT_NEAR(silhouette->whole.left, -9, 1.01);
    EXPECT_NEAR(silhouette->whole.right, 6, 1.01);
}

}  // namespace eyrie::silhouette_grid_test

#include "motion/vectors/local_background.h"

#include <gtest/gtest.h>

namespace eyrie::local_background_test {
namespace {

/// Cells of 30 px in a picture of 100 × 70 px: four across, three down.
LocalBackground withCells(int min_corners) {
    LocalBackgroundOptions options;
    options.local_background = true;
    options.local_background_cell_m = 9;
    options.local_background_min_corners = min_corners;
    LocalBackground background(options, {0.3, 25, true});
    background.prepare({100, 70});
    return background;
}

TEST(LocalBackground, EachCellDriftsByTheMedianOfItsCorners) {
    LocalBackground background = withCells(3);
    for (const double speed : {0.1, 0.2, 5.0}) {
        background.add({31, 31}, {speed, -speed});         // second column, second row
        background.add({95, 65}, {2 * speed, 3 * speed});  // the last of both
    }
    background.finish();
    EXPECT_NEAR(background.at({59, 59}).x, 0.2, 1e-6);
    EXPECT_NEAR(background.at({59, 59}).y, -0.2, 1e-6) << "the median of -5, -0.2 and -0.1";
    EXPECT_NEAR(background.at({99, 69}).x, 0.4, 1e-6);
    EXPECT_NEAR(background.at({99, 69}).y, 0.6, 1e-6);
    EXPECT_NEAR(background.at({500, 500}).y, 0.6, 1e-6) << "beyond the picture the outermost cell counts";
    for (const cv::Point2f elsewhere : {cv::Point2f(29, 31), {61, 31}, {31, 29}, {31, 61}, {0, 0}, {-40, -40}})
        EXPECT_EQ(background.at(elsewhere), cv::Point2d(0, 0)) << elsewhere;
}

TEST(LocalBackground, FewCornersSayNothing) {
    LocalBackground background = withCells(4);
    for (int i = 0; i < 3; ++i) background.add({10, 10}, {1, 1});
    for (int i = 0; i < 4; ++i) background.add({40, 10}, {1, 1});
    background.finish();
    EXPECT_EQ(background.at({10, 10}), cv::Point2d(0, 0));
    EXPECT_EQ(background.at({40, 10}), cv::Point2d(1, 1));
    background.prepare({100, 70});
    EXPECT_EQ(background.at({40, 10}), cv::Point2d(0, 0)) << "every frame starts anew";
}

TEST(LocalBackground, CellsAreNeverSmallerThan24Pixels) {
    LocalBackgroundOptions options;
    options.local_background_cell_m = 1;
    options.local_background_min_corners = 1;
    LocalBackground background(options, {0.3, 25, true});
    EXPECT_EQ(background.at({3, 3}), cv::Point2d(0, 0)) << "before anything is known";
    background.prepare({100, 70});
    background.add({1, 1}, {1, 0});
    background.finish();
    EXPECT_EQ(background.at({23, 23}), cv::Point2d(1, 0));
    EXPECT_EQ(background.at({25, 1}), cv::Point2d(0, 0));
}

}  // namespace
}  // namespace eyrie::local_background_test

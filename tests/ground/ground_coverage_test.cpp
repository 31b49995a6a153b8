#include "ground/ground_coverage.h"

#include <gtest/gtest.h>

#include <vector>

#include "annotation/scenes.h"
#include "ground/footage_of_view.h"

namespace eyrie::ground_coverage_test {
namespace {

constexpr double kFrame_s = 0.04;  // 25 a second

/// The left border of the picture in each frame, over a ground of px; pictures are 200×120.
StoredTracks filmedFrom(const std::vector<double>& lefts, int broken_at = -1) {
    const auto view = [&lefts](double frame) {
        return cv::Matx33d(1, 0, -lefts[static_cast<std::size_t>(frame)], 0, 1, 0, 0, 0, 1);
    };
    StoredTracks run;
    run.footage = test::footageOf(view, static_cast<int>(lefts.size()) - 1, broken_at);
    run.footage.scale.frame_rate_hz = 25;
    return run;
}

/// In cells of 10 px.
std::vector<SheetCoverage> coverageOf(const StoredTracks& run, FrameIndex anchor = 0) {
    return groundCoverage(GroundSheets(run.footage, anchor), run, {.cells_across = 12});
}

/// Whether all cells of the columns were seen for so long, and last in this frame.
void expectColumns(const SheetCoverage& sheet, int first, int last, double seconds, int frame) {
    for (int row = 0; row < sheet.seen_s.rows; ++row)
        for (int x = first; x <= last; ++x) {
            EXPECT_NEAR(sheet.seen_s.at<double>(row, x), seconds, 1e-9) << row << ' ' << x;
            EXPECT_EQ(sheet.last_frame.at<int>(row, x), frame) << row << ' ' << x;
        }
}

}  // namespace

TEST(GroundCoverage, WhereTwoFramesOverlapByHalfTheirTimesAddUp) {
    const auto covered = coverageOf(filmedFrom({0, 100}));
    ASSERT_EQ(covered.size(), 1U);
    const SheetCoverage& sheet = covered.front();
    EXPECT_NEAR(sheet.cell, 10, 1e-9);
    EXPECT_NEAR(sheet.area.x, -0.5, 1e-9);
    ASSERT_EQ(sheet.seen_s.size(), cv::Size(30, 12));
    expectColumns(sheet, 0, 9, kFrame_s, 0);
    expectColumns(sheet, 10, 19, 2 * kFrame_s, 1);
    expectColumns(sheet, 20, 29, kFrame_s, 1);
    EXPECT_NEAR(sheet.shortest_s, kFrame_s, 1e-9);
    EXPECT_NEAR(sheet.longest_s, 2 * kFrame_s, 1e-9);
    EXPECT_EQ(sheet.frames, (FrameSpan{0, 1}));
}

TEST(GroundCoverage, TheTimeThatThePictureWasElsewhereDoesNotCount) {
    const auto covered = coverageOf(filmedFrom({0, 200, 200, 0}));
    ASSERT_EQ(covered.size(), 1U);
    ASSERT_EQ(covered[0].seen_s.size(), cv::Size(40, 12));
    expectColumns(covered[0], 0, 19, 2 * kFrame_s, 3);
    expectColumns(covered[0], 20, 39, 2 * kFrame_s, 2);
}

TEST(GroundCoverage, AFrameThatCouldNotBeRegisteredShowsNothingThatWasSearched) {
    const auto covered = coverageOf(filmedFrom({0, 0, 0, 100}, 2));
    ASSERT_EQ(covered.size(), 2U);
    expectColumns(covered[0], 0, 19, 2 * kFrame_s, 1);
    ASSERT_EQ(covered[1].seen_s.size(), cv::Size(30, 12));
    expectColumns(covered[1], 0, 9, 0, -1);
    expectColumns(covered[1], 10, 29, kFrame_s, 3);
    EXPECT_NEAR(covered[1].shortest_s, kFrame_s, 1e-9) << "what was never seen is not the shortest";
    EXPECT_EQ(covered[1].frames, (FrameSpan{3, 3}));
    // Nothing else on its ground.
    const auto alone = coverageOf(filmedFrom({0, 0, 0}, 2));
    ASSERT_EQ(alone.size(), 2U);
    EXPECT_EQ(alone[1].longest_s, 0);
    EXPECT_EQ(alone[1].shortest_s, 0);
    EXPECT_LT(alone[1].frames.last, alone[1].frames.first);
}

TEST(GroundCoverage, AFrameLastsUntilTheNextOneIsShown) {
    StoredTracks run = filmedFrom({0, 0, 200});
    run.shown_s = {10, 10.5, 13};
    const auto covered = coverageOf(run);
    ASSERT_EQ(covered.size(), 1U);
    expectColumns(covered[0], 0, 19, 3, 1);
    expectColumns(covered[0], 20, 39, kFrame_s, 2);  // the last one, by the frame rate
}

TEST(GroundCoverage, ACellIsSeenWhereverThePictureHoldsItsMiddleHoweverTheCameraTurns) {
    StoredTracks run;
    run.footage = test::footageOf(test::flyingView, 60);
    run.footage.scale.frame_rate_hz = 25;
    const GroundSheets sheets(run.footage, 30);
    const auto covered = groundCoverage(sheets, run, {.cells_across = 9});
    ASSERT_EQ(covered.size(), 1U);
    const SheetCoverage& sheet = covered[0];
    int never = 0;
    for (int row = 0; row < sheet.seen_s.rows; ++row)
        for (int x = 0; x < sheet.seen_s.cols; ++x) {
            const cv::Point2d middle = sheet.area.tl() + cv::Point2d(x + 0.5, row + 0.5) * sheet.cell;
            ASSERT_EQ(sheet.cellAt(middle), cv::Point(x, row));
            int frames = 0;
            int last = -1;
            for (int frame = 0; frame <= 60; ++frame)
                if (sheets.inImage(frame, middle)) {
                    ++frames;
                    last = frame;
                }
            EXPECT_NEAR(sheet.seen_s.at<double>(row, x), frames * kFrame_s, 1e-9) << row << ' ' << x;
            EXPECT_EQ(sheet.last_frame.at<int>(row, x), last) << row << ' ' << x;
            never += frames == 0 ? 1 : 0;
        }
    EXPECT_GT(never, 0) << "a turning picture leaves corners of the grid out";
    EXPECT_FALSE(sheet.cellAt(sheet.area.tl() - cv::Point2d(1, 1)));
    EXPECT_FALSE(sheet.cellAt(sheet.area.br() + cv::Point2d(1, 1)));
}

TEST(GroundCoverage, CellsGrowWhereALongWayWouldNeedTooMany) {
    std::vector<double> lefts;
    lefts.reserve(500);
    for (int i = 0; i < 500; ++i) lefts.push_back(100.0 * i);
    const StoredTracks run = filmedFrom(lefts, 200);
    const GroundSheets sheets(run.footage, 0);
    const auto covered = groundCoverage(sheets, run, {.cells_across = 12, .max_cells = 5000});
    ASSERT_EQ(covered.size(), 2U);
    EXPECT_LE(covered[0].seen_s.total() + covered[1].seen_s.total(), 5000U);
    EXPECT_GE(covered[0].seen_s.total() + covered[1].seen_s.total(), 2000U);
    EXPECT_NEAR(covered[0].longest_s, 2 * kFrame_s, 1e-9);
}

TEST(GroundCoverage, WithoutFramesThereIsNone) {
    EXPECT_TRUE(groundCoverage(GroundSheets(), StoredTracks()).empty());
}

}  // namespace eyrie::ground_coverage_test

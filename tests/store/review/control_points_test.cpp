#include "store/review/control_points.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "store/health/project_check.h"
#include "store/samples.h"
#include "support/temporary_folder.h"

namespace eyrie::control_points_test {
namespace {

TEST(ControlPoints, AreKeptWithTheirVideoAndReplacedWhole) {
    const test::TemporaryFolder folder;
    test::writeSampleProject(folder / "p.eyrie", 2);
    ProjectFile project = ProjectFile::open(folder / "p.eyrie");
    EXPECT_TRUE(readControlPoints(project, 1).empty());
    replaceControlPoints(project, 1, {{3, {10.5, -2}, {48.137154, 11.576124}}, {4, {1, 2}, {-90, 180}}});
    replaceControlPoints(project, 1, {{3, {10.5, -2}, {48.137154, 11.576124}}, {0, {1, 2}, {-90, 180}}});
    const auto points = readControlPoints(project, 1);
    ASSERT_EQ(points.size(), 2U);
    EXPECT_EQ(points[0].frame, 3);
    EXPECT_EQ(points[0].px, cv::Point2d(10.5, -2));
    EXPECT_EQ(points[0].place.latitude_deg, 48.137154);
    EXPECT_EQ(points[1].place.longitude_deg, 180);
    EXPECT_TRUE(checkProject(folder / "p.eyrie").healthy());
}

TEST(ControlPoints, WhatAnotherProgramChangedIsNotOverwritten) {
    const test::TemporaryFolder folder;
    test::writeSampleProject(folder / "p.eyrie", 2);
    ProjectFile project = ProjectFile::open(folder / "p.eyrie");
    const std::vector<ControlPoint> mine{{3, {10.1, 2.3}, {48.1, 11.3}}};
    const std::vector<ControlPoint> others{{4, {1, 2}, {48, 11}}};
    EXPECT_TRUE(exchangeControlPoints(project, 1, {}, mine));
    EXPECT_EQ(readControlPoints(project, 1), mine);
    replaceControlPoints(project, 1, others);
    EXPECT_FALSE(exchangeControlPoints(project, 1, mine, {}));
    EXPECT_EQ(readControlPoints(project, 1), others);
    EXPECT_TRUE(exchangeControlPoints(project, 1, others, {}));
    EXPECT_TRUE(readControlPoints(project, 1).empty());
}

TEST(ControlPoints, WhatIsNotOnTheEarthIsRefusedAndFound) {
    const test::TemporaryFolder folder;
    test::writeSampleProject(folder / "p.eyrie", 2);
    {
        ProjectFile project = ProjectFile::open(folder / "p.eyrie");
        replaceControlPoints(project, 1, {{3, {10, 2}, {48, 11}}});
        project.database().exec("UPDATE control_point SET latitude_deg = 91");
        EXPECT_THROW(readControlPoints(project, 1), Error);
    }
    EXPECT_FALSE(checkProject(folder / "p.eyrie").healthy());
    EXPECT_FALSE(isPossible({0, {0, 0}, {std::numeric_limits<double>::quiet_NaN(), 0}}));
    EXPECT_FALSE(isPossible({-1, {0, 0}, {0, 0}}));
    EXPECT_TRUE(isPossible({0, {0, 0}, {0, 0}}));
    // A point may lie beyond the picture, but not anywhere.
    EXPECT_TRUE(isPossible({0, {-9e5, 9e5}, {-90, -180}}));
    EXPECT_TRUE(isPossible({0, {9e5, -9e5}, {90, 180}}));
    for (const double far : {-1e6, 1e6, 2e6}) {
        EXPECT_FALSE(isPossible({0, {far, 0}, {0, 0}})) << far;
        EXPECT_FALSE(isPossible({0, {0, far}, {0, 0}})) << far;
    }
    EXPECT_FALSE(isPossible({0, {0, 0}, {-90.1, 0}}));
    EXPECT_FALSE(isPossible({0, {0, 0}, {0, 180.1}}));
    EXPECT_FALSE(isPossible({0, {0, 0}, {0, -180.1}}));
}

}  // namespace
}  // namespace eyrie::control_points_test

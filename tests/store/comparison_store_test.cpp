#include "store/sweeps/comparison_store.h"

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace eyrie::comparison_store_test {
namespace {

TEST(ComparisonStore, KeepsReportsInTheirOrder) {
    const test::TemporaryFolder folder;
    {
        ProjectFile project = ProjectFile::openOrCreate(folder / "p.eyrie");
        EXPECT_TRUE(comparisons(project).empty());
        EXPECT_EQ(addComparison(project, "/a/clip.mp4", R"({"f":0.5})"), 1);
        EXPECT_EQ(addComparison(project, "/a/other.mp4", "{}"), 2);
    }
    ProjectFile project = ProjectFile::open(folder / "p.eyrie", ProjectFile::Mode::read_only);
    const auto all = comparisons(project);
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].sequence, "/a/clip.mp4");
    EXPECT_EQ(all[0].report, R"({"f":0.5})");
    EXPECT_EQ(all[1].id, 2);
    EXPECT_EQ(all[1].made_utc.size(), std::string("2026-01-01T00:00:00Z").size());
}

}  // namespace
}  // namespace eyrie::comparison_store_test

#include "store/sweeps/sweep_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace eyrie::sweep_store_test {
namespace {

TEST(SweepStore, KeepsPlansAndPoints) {
    const test::TemporaryFolder folder;
    {
        ProjectFile project = ProjectFile::openOrCreate(folder / "p.eyrie");
        SweepStore store(project);
        EXPECT_TRUE(store.sweeps().empty());
        EXPECT_EQ(store.add("quantile", 3, R"({"a":1})"), 1);
        EXPECT_EQ(store.add("", 1, "{}"), 2);
        EXPECT_TRUE(store.addPoint(1, {2, 0.25, "two"}));
        EXPECT_TRUE(store.addPoint(1, {0, 0.5, "zero"}));
        EXPECT_FALSE(store.addPoint(1, {0, 9, "again"}));
        EXPECT_THROW(store.addPoint(77, {0, 1, ""}), Error);
    }
    ProjectFile project = ProjectFile::open(folder / "p.eyrie");
    SweepStore store(project);
    const auto all = store.sweeps();
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].plan, R"({"a":1})");
    EXPECT_EQ(all[0].point_count, 3);
    EXPECT_EQ(all[0].points_done, 2);
    EXPECT_EQ(all[0].name, "quantile");
    const auto points = store.points(1);
    ASSERT_EQ(points.size(), 2U);
    EXPECT_EQ(points[0].position, 0);
    EXPECT_EQ(points[0].figures, "zero");
    EXPECT_DOUBLE_EQ(points[1].seconds, 0.25);
    EXPECT_THAT(store.pointsDone(1), testing::ElementsAre(0, 2));
    store.remove(1);
    ASSERT_EQ(store.sweeps().size(), 1U);
    EXPECT_EQ(store.sweeps()[0].id, 2);
    EXPECT_TRUE(store.points(1).empty());
}

TEST(SweepStore, EveryPointSurvivesAKill) {
    const test::TemporaryFolder folder;
    const auto path = folder / "p.eyrie";
    {
        ProjectFile project = ProjectFile::openOrCreate(path);
        SweepStore(project).add("", 100000, "{}");
    }
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        try {
            ProjectFile project = ProjectFile::open(path);
            SweepStore store(project);
            for (int i = 0;; ++i) {
                store.addPoint(1, {i, 1, std::string(3000, 'x')});
                const char message = 1;
                if (write(ends[1], &message, 1) != 1) break;
            }
        } catch (...) {
        }
        _exit(1);
    }
    close(ends[1]);
    int reported = 0;
    char message = 0;
    while (reported < 20 && read(ends[0], &message, 1) == 1) ++reported;
    kill(child, SIGKILL);
    while (read(ends[0], &message, 1) == 1) ++reported;
    close(ends[0]);
    waitpid(child, nullptr, 0);
    ProjectFile project = ProjectFile::open(path);
    const auto points = SweepStore(project).points(1);
    EXPECT_GE(static_cast<int>(points.size()), reported);
    EXPECT_LE(static_cast<int>(points.size()), reported + 1);
    for (const auto& point : points) EXPECT_EQ(point.figures.size(), 3000U);
}

}  // namespace
}  // namespace eyrie::sweep_store_test

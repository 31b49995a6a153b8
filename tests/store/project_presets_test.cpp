#include "store/project/project_presets.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace eyrie::project_presets_test {
namespace {

TEST(ProjectPresets, areKeptWithTheirValuesInOrder) {
    const test::TemporaryFolder folder;
    {
        ProjectFile project = ProjectFile::openOrCreate(folder / "p.eyrie");
        EXPECT_TRUE(presets(project).empty());
        savePreset(project, {"night", "", {{"motion.min_speed", "2"}, {"clustering.along", "3.5"}}});
        savePreset(project, {"day", "", {}});
        savePreset(project, {"night", "", {{"motion.min_speed", "1.5"}}});
    }
    ProjectFile project = ProjectFile::open(folder / "p.eyrie");
    const auto all = presets(project);
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].name, "day");
    EXPECT_TRUE(all[0].values.empty());
    EXPECT_EQ(all[1].name, "night");
    EXPECT_FALSE(all[1].saved_utc.empty());
    EXPECT_EQ(all[1].values, (std::vector<std::pair<std::string, std::string>>{{"motion.min_speed", "1.5"}}));
    EXPECT_EQ(preset(project, "night")->values, all[1].values);
    EXPECT_FALSE(preset(project, "noon"));
    EXPECT_FALSE(preset(project, ""));
}

TEST(ProjectPresets, areRenamedAndRemoved) {
    const test::TemporaryFolder folder;
    ProjectFile project = ProjectFile::openOrCreate(folder / "p.eyrie");
    savePreset(project, {"a", "", {{"x.y", "1"}}});
    savePreset(project, {"b", "", {}});
    EXPECT_THROW(renamePreset(project, "a", "b"), Error);
    EXPECT_THROW(renamePreset(project, "a", ""), Error);
    EXPECT_THROW(renamePreset(project, "c", "d"), Error);
    renamePreset(project, "a", "c");
    EXPECT_EQ(preset(project, "c")->values.size(), 1U);
    removePreset(project, "c");
    EXPECT_FALSE(preset(project, "c"));
    EXPECT_THROW(removePreset(project, "c"), Error);
    EXPECT_THROW(savePreset(project, {"", "", {}}), Error);
    EXPECT_EQ(presets(project).size(), 1U);
}

}  // namespace
}  // namespace eyrie::project_presets_test

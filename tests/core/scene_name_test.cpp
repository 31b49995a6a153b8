#include "core/scene_name.h"

#include <gtest/gtest.h>

namespace eyrie::scene_name_test {
namespace {

TEST(SceneName, IsToldFromAPath) {
    EXPECT_EQ(sceneName("seq1"), "scene:seq1");
    EXPECT_TRUE(isScene("scene:seq1"));
    EXPECT_EQ(sceneOf("scene:seq1"), "seq1");
    for (const char* path : {"", "scene", "/scene:seq1", "Scene:seq1", "my scene:1.mp4"}) {
        EXPECT_FALSE(isScene(path)) << path;
        EXPECT_EQ(sceneOf(path), path);
    }
}

}  // namespace
}  // namespace eyrie::scene_name_test

#include "core/project_name.h"

#include <gtest/gtest.h>

namespace eyrie::project_name_test {

TEST(ProjectName, isToldByItsEnding) {
    for (const char* name : {"p.eyrie", "/a.b/p.EYRIE", "flight.2.Eyrie"}) EXPECT_TRUE(hasProjectName(name)) << name;
    for (const char* name : {"", "p", ".eyrie", "p.eyrie.labelling", "p.eyries", "p.eyri", "p.eyrie/clip.mp4"})
        EXPECT_FALSE(hasProjectName(name)) << name;
}

}  // namespace eyrie::project_name_test

#include "io/file_kind.h"

#include <gmock/gmock.h>

#include <sstream>

namespace eyrie::file_kind_test {

TEST(FileKind, DialogsAskForEveryNameThatAVideoHas) {
    std::istringstream patterns(videoFilePatterns());
    int asked_for = 0;
    for (std::string pattern; patterns >> pattern; ++asked_for) {
        ASSERT_EQ(pattern.substr(0, 2), "*.");
        EXPECT_TRUE(hasVideoName("flight" + pattern.substr(1))) << pattern;
    }
    EXPECT_GE(asked_for, 26);
    // As cameras, recorders and encoders name them.
    for (const char* ending : {"mp4", "mkv", "mov", "avi", "ts", "m2ts", "mts", "mpg", "m4v", "webm", "wmv", "mxf",
                               "h264", "hevc", "flv", "ogv", "y4m"})
        EXPECT_THAT(videoFilePatterns() + " ", testing::HasSubstr(std::string("*.") + ending + " "));
    EXPECT_TRUE(hasVideoName("DJI_0001.MP4"));
    EXPECT_FALSE(hasVideoName("notes.txt"));
}

}  // namespace eyrie::file_kind_test

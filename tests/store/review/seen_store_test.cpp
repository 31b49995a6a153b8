#include "store/review/seen_store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.h"
#include "store/labels/annotation_store.h"
#include "store/samples.h"
#include "support/temporary_folder.h"

namespace eyrie::seen_store_test {

/// For messages of failed tests.
inline void PrintTo(const FrameSpan& span, std::ostream* out) {
    *out << span.first << '-' << span.last;
}

namespace {

using testing::ElementsAre;

class SeenStoreTest : public testing::Test {
 protected:
    void SetUp() override { ensureSequence(project_, test::sampleRun().sequence); }
    int rows() { return project_.database().execAndGet("SELECT count(*) FROM seen").getInt(); }

    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "clip.eyrie";
    ProjectFile project_ = ProjectFile::create(path_);
};

TEST_F(SeenStoreTest, WhatMeetsIsJoinedForEachPerson) {
    addSeen(project_, 1, "Ada", {{0, 10}, {30, 40}});
    addSeen(project_, 1, "Bo", {{5, 15}});
    addSeen(project_, 1, "Ada", {{11, 20}, {50, 60}});
    EXPECT_THAT(seenBy(project_, 1).at("Ada"), ElementsAre(FrameSpan{0, 20}, FrameSpan{30, 40}, FrameSpan{50, 60}));
    EXPECT_EQ(rows(), 4);
    addSeen(project_, 1, "Ada", {{15, 55}});
    EXPECT_THAT(seenBy(project_, 1).at("Ada"), ElementsAre(FrameSpan{0, 60}));
    EXPECT_THAT(seenBy(project_, 1).at("Bo"), ElementsAre(FrameSpan{5, 15}));
    EXPECT_THAT(seenByAnybody(project_, 1), ElementsAre(FrameSpan{0, 60}));
    EXPECT_EQ(rows(), 2);
    addSeen(project_, 1, "Ada", {});
    addSeen(project_, 1, "Ada", {{20, 10}});
    EXPECT_EQ(rows(), 2);
}

TEST_F(SeenStoreTest, SeveralProgramsMayAddAtOnce) {
    constexpr int kPrograms = 4;
    constexpr int kSpans = 25;
    std::vector<pid_t> children;
    for (int program = 0; program < kPrograms; ++program) {
        const pid_t child = fork();
        if (child == 0) {
            int code = 1;
            try {
                ProjectFile project = ProjectFile::open(path_);
                for (int i = 0; i < kSpans; ++i) {
                    const int first = (i * kPrograms + program) * 10;
                    addSeen(project, 1, "Ada", {{first, first + 9}});
                }
                code = 0;
            } catch (const std::exception& error) {
                std::fprintf(stderr, "%s\n", error.what());
            }
            _exit(code);
        }
        children.push_back(child);
    }
    for (const pid_t child : children) {
        int status = 0;
        waitpid(child, &status, 0);
        EXPECT_EQ(status, 0);
    }
    EXPECT_THAT(seenBy(project_, 1).at("Ada"), ElementsAre(FrameSpan{0, kPrograms * kSpans * 10 - 1}));
}

TEST_F(SeenStoreTest, RowsThatNobodyWroteAreRefused) {
    addSeen(project_, 1, "Ada", {{0, 10}});
    project_.database().exec("UPDATE seen SET first_frame = 11");
    EXPECT_THROW(seenBy(project_, 1), Error);
    project_.database().exec("UPDATE seen SET first_frame = -1");
    EXPECT_THROW(seenBy(project_, 1), Error);
}

}  // namespace
}  // namespace eyrie::seen_store_test
